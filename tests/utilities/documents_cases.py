#!/usr/bin/python3
"""That documents.py and messages.py see what they should: wrong links, anchors, words, commands, names of parameters, a message without an entry."""
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import documents  # noqa: E402
import messages  # noqa: E402


def expect(condition, text):
    if not condition:
        print('not seen:', text)
        expect.failures += 1


expect.failures = 0
with tempfile.TemporaryDirectory() as folder:
    words = os.path.join(documents.TOP, 'tests', 'utilities', 'words.txt')
    with open(words) as f:
        known = f.read()
    os.makedirs(os.path.join(folder, 'tests', 'utilities'))
    with open(os.path.join(folder, 'tests', 'utilities', 'words.txt'), 'w') as f:
        f.write(known)
    documents.TOP = folder

    def write(text):
        with open(os.path.join(folder, 'page.md'), 'w') as f:
            f.write('# A page\n\n' + text)

    write('A [link](nowhere.md), an [anchor](#a-pag), a file `doc/nowhere.md`.\n')
    found = documents.links()
    expect(len(found) == 3, f'three wrong links: {found}')
    write('A [link](#a-page) and `code [x](y)`.\n')
    expect(documents.links() == [], 'right links')
    write('A sentense with a mistake.\n')
    expect(any('sentense' in c for c in documents.spelling()), 'a wrong word')
    write('A sentence without, and with `sentense` in code.\n')
    expect(documents.spelling() == [], f'right words: {documents.spelling()}')
    write('<!-- not run: why -->\n```bash\nfalse\n```\n\n```prm\nsubsection Body a\n  set Colour = red\nend\n```\n')
    found = documents.blocks('page.md')
    expect([b[1] for b in found] == ['bash', 'prm'] and found[0][3][0] == 'not run' and not found[1][3], f'blocks: {found}')
expect(messages.pattern('Body …: "…" is wrong.').search('error: Body a: "b" is wrong.'), 'a message')
expect(not messages.pattern('Body …: "…" is wrong.').search('error: Body a: "b" is right.'), 'another message')
expect(any('has no entry' in c for c in messages.missing([])), 'messages without an entry')
sys.exit(expect.failures > 0)
