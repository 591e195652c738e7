"""Running the program and checking numbers: what all cases share."""
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(TOP, 'tests'))
from run_environment import run_environment  # noqa: E402
from served.served import server_of  # noqa: E402

FAILURES = []


def check(condition, text):
    if not condition:
        FAILURES.append(text)


def near(value, expected, tolerance, text):
    check(abs(value - expected) <= tolerance * max(abs(expected), 1e-300), f'{text}: {value!r}, expected {expected!r} to {tolerance}')


class Program:
    def __init__(self, program, ranks, served=True):
        """served: where calls need not start the program as users do, down to its loading."""
        self.command = [program] if ranks == 1 else ['mpirun', '-np', str(ranks), program]
        self.served = served

    @property
    def environment(self):
        """For one run."""
        return run_environment()

    def call(self, *arguments, cwd=None):
        # Where one rank ends with an error all do: mpirun would give the others a second.
        environment = dict(self.environment, OMPI_MCA_odls_base_sigkill_timeout='0')
        program, variables = server_of(self.command[-1]).start(environment) if self.served else (self.command[-1], {})
        return subprocess.run(self.command[:-1] + [program, *arguments], env=dict(environment, **variables), cwd=cwd, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, errors='replace', timeout=500)

    def solve(self, prm, *settings, keep=None, codes=(0,)):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, 'out')
            arguments = [os.path.join(TOP, 'prm', prm), '--output', out]
            for setting in settings:
                arguments += ['--set', setting]
            run = self.call(*arguments)
            if run.returncode not in codes:
                print(run.stdout, run.stderr)
                raise SystemExit(f'{prm} {settings}: exit code {run.returncode}')
            for name in ('table.txt', 'convergence.csv', 'pressure.csv', 'parameters.prm', 'bodies.pvtu', 'signorini.log'):
                check(os.path.exists(os.path.join(out, name)), f'{name} is missing')
            check(sorted(os.listdir(folder)) == ['out'], 'temporary folders are left')
            for name in ('table.txt', 'signorini.log', 'summary.json', 'convergence.csv', 'pressure.csv'):
                with open(os.path.join(out, name)) as f:
                    check(not re.search(r'\bnan\b', f.read()), f'{name} has a NaN')
            with open(os.path.join(out, 'summary.json')) as f:
                summary = json.load(f)
            if keep:
                shutil.move(out, keep)
            return summary


def read_pressure(path, side='nonmortar'):
    """The rows of pressure.csv on one side, numbers by column."""
    with open(path, newline='') as f:
        return [{k: float(v) for k, v in row.items() if k not in ('side', 'pair')} for row in csv.DictReader(f) if row['side'] == side]


def certificate(s, equilibrium=1e-8, complementarity=1e-9):
    """The product of pressure and opening counts what is left of the pressure far away as often as the gap there is larger than the displacements."""
    c = s['certificate']
    check(s['converged'], 'not converged')
    for key, bound in (('penetration', 1e-12), ('tension', 1e-9), ('complementarity', complementarity), ('force_balance', 1e-12),
                       ('equilibrium', equilibrium)):
        check(abs(c[key]) <= bound, f'certificate {key}: {c[key]}')


def iterations(s):
    for c in s['cycles']:
        counts = [c[key]['iterations'] for key in ('nonlinear', 'linear', 'linear_cg')]
        # Level 0 alone may take one or two.
        check(counts[0] <= min(counts[1] + 2, counts[2] + 5), f'cycle {c["cycle"]}: %d iterations, linear %d, with CG %d' % tuple(counts))
        check(c['linear_cg']['difference'] <= 1e-9, f'cycle {c["cycle"]}: linear solution differs by {c["linear_cg"]["difference"]}')


def constant_pressure(s, pressure, tolerance=1e-10):
    for pair in s['pairs']:
        near(pair['min_pressure'], pressure, tolerance, f'smallest pressure of {pair["name"]}')
        near(pair['max_pressure'], pressure, tolerance, f'largest pressure of {pair["name"]}')
