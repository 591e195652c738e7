#!/usr/bin/python3
"""A file includes its own folder and the layers listed for it only (doc/layers.md); includes of tests are free."""
import os
import re
import sys

ALLOWED = {
    'algebra': [],
    'surface': [],
    'solvers': ['algebra'],
    'mesh': ['algebra', 'surface'],
    'discretization': ['algebra', 'solvers', 'mesh'],
    'mortar': ['algebra', 'surface', 'solvers', 'mesh', 'discretization'],
    'output': ['algebra', 'surface', 'solvers', 'mesh', 'discretization', 'mortar'],
    'application': ['algebra', 'surface', 'solvers', 'mesh', 'discretization', 'mortar', 'output'],
}


def main():
    top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    bad = []
    for root in ('include/signorini', 'source'):
        for layer, allowed in ALLOWED.items():
            folder = os.path.join(top, root, layer)
            for name in sorted(os.listdir(folder)):
                if not name.endswith(('.h', '.cc')):
                    continue
                path = os.path.join(folder, name)
                with open(path) as f:
                    lines = f.read().splitlines()
                for number, line in enumerate(lines, 1):
                    match = re.match(r'#include <signorini/(\w+)/', line)
                    if match and match.group(1) != layer and match.group(1) not in allowed:
                        bad.append(f'{os.path.relpath(path, top)}:{number}: layer {layer} must not include {match.group(1)}')
                limit = 300 if name.endswith('.h') else 500
                if len(lines) > limit:
                    print(f'note: {os.path.relpath(path, top)} has {len(lines)} lines (budget {limit})')
    print('\n'.join(bad) if bad else 'layers: all includes in order')
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
