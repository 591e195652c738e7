#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""The examples of doc/python.md run as they stand there, print what stands there, and have at most 15 lines; what the module offers is
documented."""
import contextlib
import inspect
import io
import os
import re
import unittest

import numpy as np
import signorini
from harness import TOP

NUMBER = r'\d+(?:\.\d+)?'


def examples():
    """(title, code, output) of the examples: a block of Python, then one of text with what it prints."""
    with open(os.path.join(TOP, 'doc', 'python.md'), encoding='utf-8') as f:
        text = f.read()
    return re.findall(r'^## (Example: [^\n]+)\n.*?^```python\n(.*?)^```\n.*?^```text\n(.*?)^```\n', text, re.MULTILINE | re.DOTALL)


class Document(unittest.TestCase):
    def test_examples(self):
        found = examples()
        self.assertEqual(len(found), 3)
        for title, code, expected in found:
            with self.subTest(title):
                self.assertLessEqual(len([line for line in code.splitlines() if line.strip()]), 15)
                self.assertLess(max(map(len, code.splitlines())), 150)
                printed = io.StringIO()
                with contextlib.redirect_stdout(printed):
                    exec(compile(code, title, 'exec'), {})  # pylint: disable=exec-used
                # Other compilers and libraries may round other digits.
                said, should = (re.split(NUMBER, text) for text in (printed.getvalue(), expected))
                self.assertEqual(said, should)
                np.testing.assert_allclose(*(list(map(float, re.findall(NUMBER, text))) for text in (printed.getvalue(), expected)), rtol=.005)

    def test_docstrings(self):
        for name in signorini.__all__:
            item = getattr(signorini, name)
            self.assertTrue(item.__doc__, name)
            for key, member in vars(item).items() if inspect.isclass(item) else ():
                if inspect.isfunction(member) and not key.startswith('_'):
                    self.assertTrue(member.__doc__, f'{name}.{key}')

    def test_every_name_is_in_the_document(self):
        with open(os.path.join(TOP, 'doc', 'python.md'), encoding='utf-8') as f:
            text = f.read()
        for name in signorini.__all__:
            self.assertIn(f'`{name}', text)


if __name__ == '__main__':
    unittest.main()
