#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Writes the reference of all parameters as Markdown, from what `signorini --print-parameters` declares.

usage: parameter_reference.py PROGRAM [EXAMPLES ...] > parameters.md

Examples are lines of the parameter files that are named; of each parameter the first one that is not the default.
"""
import os
import re
import subprocess
import sys


def declared(text):
    """[(section, name, default, description)] of a complete parameter file."""
    result, sections, description = [], [], []
    for line in text.splitlines():
        words = line.strip()
        if words in ('# Listing of Parameters', '# ---------------------'):
            continue
        if words.startswith('#'):
            description.append(words[1:].strip())
        elif words.startswith('subsection '):
            sections.append(words[len('subsection '):])
            description = []
        elif words == 'end':
            sections.pop()
            description = []
        elif words.startswith('set '):
            name, _, value = words[4:].partition('=')
            result.append(('/'.join(sections), name.strip(), value.strip(), ' '.join(description)))
            description = []
    return result


def examples(files):
    """{(kind of section, name): [(value, file)]}"""
    found = {}
    for file in files:
        with open(file) as f:
            for section, name, value, _ in declared(f.read()):
                found.setdefault((section.split(' ')[0], name), []).append((value, file))
    return found


HEADINGS = {'': 'The problem', 'Body first': 'Body NAME', 'Pair contact': 'Pair NAME'}


def main():
    program, files = sys.argv[1], sys.argv[2:]
    text = subprocess.run([program, '--print-parameters'], stdout=subprocess.PIPE, check=True, universal_newlines=True,
                          env=dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1')).stdout
    found = examples(files)
    print('# Parameters\n\nMade from the declarations of the program: `signorini --print-parameters` prints the same as a parameter file. '
          '`--set "Section/Name=value"`\nreplaces a value on the command line. Lengths, forces and stresses are in whatever units the problem has.\n')
    last = None
    parameters = [p for p in declared(text) if p[0] != 'Body second']
    # What stands at the top of the file comes first.
    for section, name, default, description in sorted(parameters, key=lambda p: p[0] != ''):
        if section != last:
            print(f'## {HEADINGS.get(section, section.replace("/", " / "))}\n')
            last = section
        place = HEADINGS.get(section, section)
        print(f'### {section.split(" ")[0] + ": " if section else ""}{name}\n')
        print(re.sub(r'([<>|_*])', r'\\\1', description) + '\n')
        print(f'- default: {"`" + default + "`" if default else "empty"}')
        kind = section.split(' ')[0]
        used = [(value, file) for value, file in found.get((kind, name), []) if value and value != default]
        for value, file in used[:1]:
            print(f'- example, `{os.path.basename(file)}`: `set {name} = {value}`')
        if section:
            print(f'- on the command line: `--set "{place}/{name}={used[0][0] if used else default or "..."}"`')
        print()


if __name__ == '__main__':
    main()
