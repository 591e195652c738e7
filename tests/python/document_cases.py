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
import textwrap
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

    def test_readme(self):
        with open(os.path.join(TOP, 'README.md'), encoding='utf-8') as f:
            code = re.search(r'^## Python\n\n((?: {4}[^\n]+\n)+)', f.read(), re.MULTILINE).group(1)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(textwrap.dedent(code).replace('"prm/', f'"{TOP}/prm/'), {})  # pylint: disable=exec-used
        pressure, stress = map(float, printed.getvalue().split())
        # That of Lame for an interference of 0.02 (prm/shapes/README.md).
        self.assertAlmostEqual(pressure / 66.007, 1, delta=.005)
        self.assertGreater(stress, pressure)

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
