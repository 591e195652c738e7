# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""What all tests of the module share: calls of the program, and problems."""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(TOP, 'tests'))
from run_environment import run_environment  # noqa: E402

ENVIRONMENT = run_environment()
# Not the same in two runs of anything, or not of the same program.
FLEETING = re.compile(r'.*_s|peak_memory_bytes|parameter_file')


def program(*arguments):
    """Runs signorini (SIGNORINI_PROGRAM); returns what subprocess does."""
    return subprocess.run([os.environ['SIGNORINI_PROGRAM'], *arguments], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=200, check=False)


def program_results(prm, *settings):
    """summary.json and the rows of pressure.csv and curve.csv (None without load steps) of a run of the program."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        run = program(prm, '--output', out, *(word for setting in settings for word in ('--set', setting)))
        if run.returncode not in (0, 3):
            raise RuntimeError(run.stdout + run.stderr)
        with open(os.path.join(out, 'summary.json'), encoding='utf-8') as f:
            summary = json.load(f)
        tables = []
        for name in ('pressure.csv', 'curve.csv'):
            path = os.path.join(out, name)
            tables.append(None)
            if os.path.exists(path):
                with open(path, encoding='utf-8', newline='') as f:
                    tables[-1] = list(csv.reader(f))
        return summary, *tables


def lasting(value):
    """A summary without times, memory and the name of the parameter file."""
    if isinstance(value, dict):
        return {key: lasting(entry) for key, entry in value.items() if not FLEETING.fullmatch(key)}
    return [lasting(entry) for entry in value] if isinstance(value, list) else value


def patch_test():
    """prm/patch_test/patch_test.prm as a dictionary."""
    sides = {'left': (0, None, None), 'front': (None, 0, None)}
    elastic = {'Mesh': 'block', 'Young modulus': 1000, 'Poisson ratio': 0.3}
    return {'Title': 'Patch test',
            'Bodies': {'upper': {**elastic, 'Upper corner': (1, 1, 1), 'Divisions': (3, 3, 3), 'Dirichlet': {**sides, 'top': (None, None, -0.01)}},
                       'lower': {**elastic, 'Lower corner': (0, 0, -1), 'Upper corner': (1, 1, 0), 'Divisions': [4, 4, 4],
                                 'Dirichlet': {**sides, 'bottom': (None, None, 0)}}},
            'Contact pairs': {'interface': {'First': 'upper: bottom', 'Second': 'lower: top'}},
            'Refinement': {'Global cycles': 1}, 'Solver': {'Compare linear multigrid': True}}
