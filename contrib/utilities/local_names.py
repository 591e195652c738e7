#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Names in the anonymous namespaces of a layer's sources, as universal-ctags sees them (Debian: universal-ctags).

usage: local_names.py [FOLDER]...

Sources of a layer may be compiled together (SIGNORINI_UNITY). So no two of them have a type or a constant with the same name, or a
function with the same name and the same types of parameters; equal aliases (`using Cell = NodalSpace::Cell;`) are allowed.
Looks at the folders of source/ by default; the exit code is 1 where names clash."""
import collections
import glob
import json
import os
import re
import subprocess
import sys

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def parameter_types(signature):
    """The types of a signature, as text: without names, const and default values."""
    types, depth, part = [], 0, ''
    for letter in signature[signature.index('(') + 1:signature.rindex(')')].replace('->', '  ') + ',':
        depth += (letter in '(<[{') - (letter in ')>]}')
        if letter == ',' and depth == 0:
            words = re.findall(r'[\w:]+|[^\w\s]', re.sub(r'\bconst\b', '', part.split('=')[0]))
            types.append(' '.join(words[:-1] if len(words) > 1 and re.match(r'\w', words[-1]) else words))
            part = ''
        else:
            part += letter
    return ', '.join(types)


def in_conflict(tags):
    """Those of the tags with the same name and different sources that can't stand in one source."""
    if len({tag['path'] for tag in tags}) < 2:
        return []
    if all(tag['kind'] == 'typedef' for tag in tags):
        return tags if len({re.sub(r'\s+', ' ', tag['pattern']) for tag in tags}) > 1 else []
    if any(tag['kind'] != 'function' for tag in tags):
        return tags
    equal = collections.defaultdict(list)
    for tag in tags:
        equal[parameter_types(tag['signature'])].append(tag)
    return [tag for group in equal.values() if len({tag['path'] for tag in group}) > 1 for tag in group]


def clashes(folder):
    """Lines of text, one for each name of the sources of a folder that more than one of them has."""
    sources = sorted(glob.glob(os.path.join(folder, '*.cc')))
    if not sources:
        return []
    run = subprocess.run(['ctags', '--languages=C++', '--c++-kinds=cefgnstuv', '--fields=+neSst', '--output-format=json', '-f', '-', *sources],
                         stdout=subprocess.PIPE, text=True, check=True)
    tags = collections.defaultdict(list)
    for line in run.stdout.splitlines():
        tag = json.loads(line)
        if tag['_type'] == 'tag' and '__anon' in tag.get('scope', '').split('::')[-1] and not tag['name'].startswith('__anon'):
            tags[tag['name']].append(tag)
    found = []
    for name in sorted(tags):
        places = [f'{os.path.relpath(tag["path"], TOP)}:{tag["line"]}' for tag in in_conflict(tags[name])]
        if places:
            found.append(f'{name}: ' + ', '.join(places))
    return found


def main():
    folders = sys.argv[1:] or sorted(glob.glob(os.path.join(TOP, 'source', '*', '')))
    if any(folder.startswith('-') for folder in folders):
        sys.exit(__doc__)
    try:
        # A module of its own, not compiled together.
        found = [line for folder in folders if os.path.basename(folder.rstrip('/')) != 'python' for line in clashes(folder)]
    except FileNotFoundError:
        sys.exit('local_names.py: ctags is missing (Debian package universal-ctags)')
    for line in found:
        print('two sources of a layer have a name in common: ' + line)
    return len(found) > 0


if __name__ == '__main__':
    sys.exit(main())
