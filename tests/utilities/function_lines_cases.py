#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""contrib/utilities/function_lines.py counts as it says: lines from the name to the closing brace, parameters whatever
their types and default values are, and --check fails where a bar does not hold."""
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
COUNT = os.path.join(TOP, 'contrib', 'utilities', 'function_lines.py')

SHORT = '''namespace Signorini
{
  void Short::six(const std::map<int, std::pair<int, int>> &a, const std::array<double, 3> &b, int c = f(1, 2),
                  const std::function<void(int, int)> &d = {}, const A &e = {{1, 2}}, B &&f)
  {
    const auto inner = [&](int a, int b, int c, int d, int e, int f, int g) { return a + b + c + d + e + f + g; };
  }
  void none() {}
}
'''
MANY = 'void many(int a, int b, int c, int d, int e, int f, std::map<int, int> g)\n{\n}\n'


def body(n_lines):
    """A function of so many lines."""
    return 'void Long::function()\n{\n' + (n_lines - 3) * '  ++i;\n' + '}\n'


def run(text, *options):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, 'a.cc'), 'w', encoding='utf-8') as f:
            f.write(text)
        result = subprocess.run([sys.executable, COUNT, *options, folder], stdout=subprocess.PIPE, text=True, check=False)
    return result.returncode, result.stdout


def main():
    failures = []
    for text, options, code, words in [
            (SHORT, ['--check'], 0, ['2 functions', 'largest 5 (bar 80)', 'largest 6 (bar 6)']),
            (SHORT + 20 * SHORT + body(80), ['--check'], 0, ['largest 80 (bar 80)']),
            (SHORT + 20 * SHORT + body(81), ['--check'], 1, ['  81 lines', 'Long::function', 'largest 81 (bar 80)']),
            (SHORT + 20 * SHORT + body(81), [], 0, ['  81 lines']),
            (body(31), ['--check'], 1, ['p90 31 (bar 30)']),
            (body(31), ['--above', '30'], 0, ['  31 lines']),
            (20 * SHORT + MANY, ['--check'], 1, ['   7 parameters', ': many', 'largest 7 (bar 6)'])]:
        result, output = run(text, *options)
        if result != code or any(word not in output for word in words):
            failures.append(f'{options}: exit code {result}, expected {code} and {words}:\n{output}')
    print('\n'.join(failures) if failures else 'all counts as they should be')
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main())
