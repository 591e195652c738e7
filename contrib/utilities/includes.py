#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Every source and header reaches, by what it includes, a declaration of each name of Signorini that it uses.

usage: includes.py [TOP]    TOP is the tree to look at, this one by default

Sources of a layer are compiled together (SIGNORINI_UNITY), and what one forgets to include a neighbour may have. Names are those
that headers declare in the namespace, as universal-ctags sees them (Debian: universal-ctags); members, and names that a file has
itself, are passed over. A compiler knows better, but takes a hundred times as long: tests/utilities/sources_alone.py,
headers_alone.py. The exit code is 1 where an include is missing."""
import collections
import glob
import json
import os
import re
import subprocess
import sys

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:<(signorini/[^>]+)>|"([^"]+)")', re.M)
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|^\s*#[^\n]*', re.S | re.M)
# A name, and what stands before it: a member and a name of another scope are not ours.
USE = re.compile(r'(\.\s*|->\s*|~|(?:\b(?!Signorini\b)\w+(?:<[^<>;]*>)?\s*::\s*)+)?\b([A-Za-z_]\w*)\b')
FORWARD = re.compile(r'\b(?:class|struct|enum class)\s+(\w+)\s*;')


def tags_of(files):
    """By file: tags with name, kind and scope."""
    run = subprocess.run(['ctags', '--languages=C++', '--c++-kinds=+pxlz', '--fields=+KsS', '--output-format=json', '-f', '-', '-L', '-'],
                         input='\n'.join(files), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=True)
    tags = collections.defaultdict(list)
    for line in run.stdout.splitlines():
        tag = json.loads(line)
        if tag['_type'] == 'tag':
            tags[tag['path']].append(tag)
    return tags


class Tree:
    """The files of a tree, what they include, declare and use."""

    def __init__(self, top):
        self.top = top
        self.headers = sorted(glob.glob(os.path.join(top, 'include', '**', '*.h'), recursive=True))
        self.sources = sorted(glob.glob(os.path.join(top, 'source', '**', '*.cc'), recursive=True) +
                              glob.glob(os.path.join(top, 'source', '**', '*.h'), recursive=True))
        self.texts = {}
        for path in self.headers + self.sources:
            with open(path, encoding='utf-8') as f:
                self.texts[path] = f.read()
        self.tags = tags_of(self.headers + self.sources)
        self.declared = collections.defaultdict(set)
        for path in self.headers + [p for p in self.sources if p.endswith('.h')]:
            for tag in self.tags[path]:
                if tag.get('scope') == 'Signorini' and tag['kind'] != 'namespace':
                    self.declared[tag['name']].add(path)
        self.reached = {}

    def included(self, path):
        for angled, quoted in INCLUDE.findall(self.texts[path]):
            target = os.path.join(self.top, 'include', angled) if angled else os.path.normpath(os.path.join(os.path.dirname(path), quoted))
            if target in self.texts:
                yield target

    def reach(self, path):
        """All files of ours that a file includes, itself among them."""
        if path not in self.reached:
            self.reached[path] = {path}
            for target in self.included(path):
                self.reached[path] |= self.reach(target)
        return self.reached[path]

    def headers_of(self, name, path):
        """Headers that declare a name for a file: public ones, and those of its own folder in source/."""
        return sorted(p for p in self.declared[name] if p in self.headers or os.path.dirname(p) == os.path.dirname(path))

    def missing(self, path):
        """Names of ours that a file uses without a header for them."""
        code = NOT_CODE.sub(' ', self.texts[path])
        # Of a qualified name the first part is looked up here.
        used = {re.match(r'\w*', before).group() if before else name for before, name in USE.findall(code)}
        known = set()
        for p in self.reach(path):
            known |= {tag['name'] for tag in self.tags[p]} | set(FORWARD.findall(self.texts[p]))
        return sorted(name for name in used - known if self.headers_of(name, path))


def main():
    if any(word.startswith('-') for word in sys.argv[1:]) or len(sys.argv) > 2:
        sys.exit(__doc__)
    try:
        tree = Tree(os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else TOP)
    except FileNotFoundError:
        sys.exit('includes.py: ctags is missing (Debian package universal-ctags)')
    found = 0
    for path in tree.headers + tree.sources:
        for name in tree.missing(path):
            found += 1
            where = ' or '.join(os.path.relpath(p, tree.top) for p in tree.headers_of(name, path))
            print(f'{os.path.relpath(path, tree.top)} uses {name} without {where}')
    print(f'{len(tree.headers)} headers, {len(tree.sources)} sources, {found} missing includes')
    return found > 0 or not tree.headers


if __name__ == '__main__':
    sys.exit(main())
