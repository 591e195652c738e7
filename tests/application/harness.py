"""Running the program and checking numbers: what all cases share."""
import json
import os
import re
import shutil
import subprocess
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FAILURES = []
# Of MPI, for this test alone: where several tests share one, the end of one may take it away while another begins.
SESSIONS = tempfile.TemporaryDirectory(prefix='mpi-')


def check(condition, text):
    if not condition:
        FAILURES.append(text)


def near(value, expected, tolerance, text):
    check(abs(value - expected) <= tolerance * max(abs(expected), 1e-300), f'{text}: {value!r}, expected {expected!r} to {tolerance}')


class Program:
    def __init__(self, program, ranks):
        self.command = [program] if ranks == 1 else ['mpirun', '-np', str(ranks), program]
        # Memory alone, without a search for networks and a daemon at each start (0.3 s); ranks that wait leave the core to others.
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1',
                                OMPI_MCA_rmaps_base_oversubscribe='1', OMPI_MCA_btl_vader_single_copy_mechanism='none',
                                OMPI_MCA_pml='ob1', OMPI_MCA_btl='self,vader', OMPI_MCA_mpi_yield_when_idle='1',
                                OMPI_MCA_ess_singleton_isolated='1', OMPI_MCA_orte_tmpdir_base=SESSIONS.name)

    def call(self, *arguments):
        # Where one rank ends with an error all do: mpirun would give the others a second.
        return subprocess.run(self.command + list(arguments), env=dict(self.environment, OMPI_MCA_odls_base_sigkill_timeout='0'), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, timeout=500)

    def solve(self, prm, *settings, keep=None):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, 'out')
            arguments = [os.path.join(TOP, 'prm', prm), '--output', out]
            for setting in settings:
                arguments += ['--set', setting]
            run = self.call(*arguments)
            if run.returncode != 0:
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


def certificate(s, equilibrium=1e-8):
    c = s['certificate']
    check(s['converged'], 'not converged')
    for key, bound in (('penetration', 1e-12), ('tension', 1e-9), ('complementarity', 1e-9), ('force_balance', 1e-12),
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
