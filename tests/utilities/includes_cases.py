#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""contrib/utilities/includes.py finds names that a file has no header for, and nothing else."""
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
INCLUDES = os.path.join(TOP, 'contrib', 'utilities', 'includes.py')

HEADERS = {
    'a/ball.h': 'namespace Signorini\n{\n  class Ball\n  {\n  public:\n    double roll();\n  };\n  double size(const Ball &ball);\n}\n',
    'a/socket.h': '#include <signorini/a/ball.h>\nnamespace Signorini\n{\n  struct Socket\n  {\n    Ball ball;\n    struct Rim\n    {\n    };\n  };\n}\n',
    'a/later.h': 'namespace Signorini\n{\n  class Ball;\n  class Later\n  {\n    const Ball *ball;\n  };\n}\n',
}


def run(text):
    """Exit code and output for a tree with the headers above and a source with this text in the namespace."""
    with tempfile.TemporaryDirectory() as top:
        for path, words in {**{f'include/signorini/{p}': t for p, t in HEADERS.items()}, 'source/a/it.cc': text}.items():
            os.makedirs(os.path.dirname(os.path.join(top, path)), exist_ok=True)
            with open(os.path.join(top, path), 'w', encoding='utf-8') as f:
                f.write(words)
        result = subprocess.run([sys.executable, INCLUDES, top], stdout=subprocess.PIPE, text=True, check=False)
    return result.returncode, result.stdout


def source(body, *headers):
    return ''.join(f'#include <signorini/a/{h}.h>\n' for h in headers) + 'namespace Signorini\n{\n' + body + '}\n'


def main():
    failures = 0
    for right, name, text in (
            (0, 'included', source('  void f(Ball &b) { b.roll(); }\n', 'ball')),
            (0, 'by way of another', source('  void f(Socket &s) { size(s.ball); }\n', 'socket')),
            (0, 'declared ahead', source('  class Ball;\n  void f(Ball &b);\n')),
            (0, 'a member and another scope', source('  void f(Data &d) { d.size(); std::size(d); Base::Inner::size(d); }\n')),
            (0, 'a name of its own', source('  namespace\n  {\n    double size(int i) { return i; }\n  }\n  double g() { return size(1); }\n')),
            (0, 'a local name', source('  int f()\n  {\n    const int size = 1;\n    return size;\n  }\n')),
            (0, 'a comment and a text', source('  // Ball\n  const char *f() { return "a Ball"; }\n')),
            (1, 'a class', source('  void f(Ball &b) { b.roll(); }\n')),
            (1, 'a class in a template', source('  std::vector<Signorini::Ball> f();\n')),
            (1, 'a function', source('  double f(const Socket::Ball &b) { return size(b); }\n')),
            (1, 'its nested type', source('  Socket::Rim f(); \n', 'ball'))):
        code, output = run(text)
        if code != right or (right == 1 and 'source/a/it.cc uses' not in output):
            failures += 1
            print(f'{name}: exit code {code} instead of {right}, {output!r}')
    return failures > 0


if __name__ == '__main__':
    sys.exit(main())
