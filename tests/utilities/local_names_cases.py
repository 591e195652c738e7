#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""contrib/utilities/local_names.py finds what can not be compiled together, and nothing else."""
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
NAMES = os.path.join(TOP, 'contrib', 'utilities', 'local_names.py')


def run(*texts):
    """Exit code and output for a layer with these sources in its anonymous namespaces."""
    with tempfile.TemporaryDirectory() as folder:
        for i, text in enumerate(texts):
            with open(os.path.join(folder, f'{i}.cc'), 'w', encoding='utf-8') as f:
                f.write('namespace Signorini\n{\n  namespace\n  {\n' + text + '  }\n}\n')
        result = subprocess.run([sys.executable, NAMES, folder], stdout=subprocess.PIPE, text=True, check=False)
    return result.returncode, result.stdout


def main():
    failures = 0
    for right, name, texts in (
            (0, 'different names', ('    void f(int i) {}\n', '    void g(int i) {}\n')),
            (0, 'overloads', ('    void f(const int i) {}\n', '    void f(const double i, std::map<int, int> m = {}) {}\n')),
            (0, 'equal aliases', ('    using Cell = A::Cell;\n', '    using Cell = A::Cell;\n')),
            (0, 'members', ('    struct A\n    {\n      int n;\n    };\n', '    struct B\n    {\n      int n;\n    };\n')),
            (1, 'functions', ('    void f(const int i, const std::map<int, int> &m) {}\n',
                              '    int f(int number, const std::map<int, int> &places = {}) { return 0; }\n')),
            (1, 'constants', ('    constexpr double pi = 3.;\n', '    constexpr double pi = 3.;\n')),
            (1, 'types', ('    struct Rule\n    {\n      int n;\n    };\n', '    struct Rule\n    {\n      double x;\n    };\n')),
            (1, 'a constant and a function', ('    constexpr double turned = 1.;\n', '    double turned(double x) { return -x; }\n')),
            (1, 'different aliases', ('    using Cells = A;\n', '    using Cells = B;\n'))):
        code, output = run(*texts)
        if code != right or (right == 1 and '0.cc' not in output):
            failures += 1
            print(f'{name}: exit code {code} instead of {right}, {output!r}')
    return failures > 0


if __name__ == '__main__':
    sys.exit(main())
