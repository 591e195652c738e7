#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Input filter for doxygen. In our headers a comment belongs to all declarations from it to the next blank line or comment;
doxygen gives it to the first name only, but can repeat it in a member group. So such declarations are put in one:

    /// The ends of an edge (length).                ///@{
    Point low, high;                          ->     /// The ends of an edge (length).
                                                     Point low, high;
                                                     ///@}

Line numbers stay: the marks are put on the lines of the comment and of the last declaration."""
import re
import sys


def is_run(lines):
    """Whether lines are declarations only, of more than one name."""
    text = ' '.join(lines)
    if not text.endswith(';') or '{\n' in text or any(line.strip() in ('{', '}', '};') for line in lines):
        return False
    plain = text
    for pattern in (r'\{[^{}]*\}', r'\([^()]*\)', r'<[^<>]*>'):
        previous = None
        while previous != plain:
            previous, plain = plain, re.sub(pattern, '', plain)
    return plain.count(';') > 1 or ',' in plain


def main():
    with open(sys.argv[1], encoding='utf-8') as f:
        lines = f.read().split('\n')
    at = 0
    while at < len(lines):
        if not lines[at].lstrip().startswith('///'):
            at += 1
            continue
        comment = at
        while lines[at].lstrip().startswith('///'):
            at += 1
        begin = at
        while lines[at].strip() and not lines[at].lstrip().startswith(('//', '}')):
            at += 1
        if at > begin and is_run([line.rstrip() for line in lines[begin:at]]):
            lines[comment] = '/**@{*/ ' + lines[comment]
            lines[at - 1] += ' /**@}*/'
    sys.stdout.write('\n'.join(lines))


if __name__ == '__main__':
    main()
