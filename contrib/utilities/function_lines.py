#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Lengths of functions and numbers of their parameters, as universal-ctags sees them (Debian: universal-ctags).

usage: function_lines.py [--check] [--above LINES] [FOLDER OR FILE]...

A function reaches from the line of its name to its closing brace; a lambda belongs to the function around it. Looks at
source/ by default and lists functions of more than LINES lines (the bar by default) and with too many parameters.
With --check the exit code is 1 where a bar does not hold."""
import argparse
import json
import os
import subprocess
import sys

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
P90_LINES, MOST_LINES, MOST_PARAMETERS = 30, 80, 6


def n_parameters(signature):
    """Number of parameters in a signature: commas outside of all brackets but the outer ones."""
    inside = signature[signature.index('(') + 1:signature.rindex(')')]
    if inside.strip() in ('', 'void'):
        return 0
    depth = commas = 0
    for letter in inside.replace('->', '  '):
        depth += (letter in '(<[{') - (letter in ')>]}')
        commas += letter == ',' and depth == 0
    return commas + 1


def functions(paths):
    """(lines, parameters, place, name) of all functions in files and folders."""
    run = subprocess.run(['ctags', '-R', '--languages=C++', '--langmap=C++:.cc.h', '--c++-kinds=f', '--fields=+neSs',
                          '--output-format=json', '-f', '-', *paths], stdout=subprocess.PIPE, text=True, check=True)
    found = []
    for line in run.stdout.splitlines():
        tag = json.loads(line)
        if tag['_type'] != 'tag' or tag['name'].startswith('__anon') or 'end' not in tag:
            continue
        scope = tag.get('scope', '')
        name = tag['name'] if scope in ('', 'Signorini') or '__anon' in scope.split('::')[-1] else scope.split('::')[-1] + '::' + tag['name']
        found.append((tag['end'] - tag['line'] + 1, n_parameters(tag['signature']),
                      f'{os.path.relpath(tag["path"], TOP)}:{tag["line"]}', name))
    return sorted(found, reverse=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--check', action='store_true')
    parser.add_argument('--above', type=int, default=MOST_LINES)
    parser.add_argument('paths', nargs='*', default=[os.path.join(TOP, 'source')])
    options = parser.parse_args()
    try:
        found = functions(options.paths)
    except FileNotFoundError:
        sys.exit('function_lines.py: ctags is missing (Debian package universal-ctags)')
    if not found:
        sys.exit('function_lines.py: no functions found')
    for lines, _, place, name in found:
        if lines > options.above:
            print(f'{lines:4} lines       {place}: {name}')
    for _, parameters, place, name in sorted(found, key=lambda f: -f[1]):
        if parameters > MOST_PARAMETERS:
            print(f'{parameters:4} parameters  {place}: {name}')
    lengths = [f[0] for f in found]
    p90 = lengths[len(lengths) // 10]
    most = max(f[1] for f in found)
    print(f'{len(found)} functions; lines: median {lengths[len(lengths) // 2]}, p90 {p90} (bar {P90_LINES}), largest {lengths[0]} '
          f'(bar {MOST_LINES}); parameters: largest {most} (bar {MOST_PARAMETERS})')
    return 1 if options.check and (p90 > P90_LINES or lengths[0] > MOST_LINES or most > MOST_PARAMETERS) else 0


if __name__ == '__main__':
    sys.exit(main())
