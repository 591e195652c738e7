#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""signorini.run(): the numbers of the program to the last digit, arrays that fit together, errors, interruption, ranks."""
import concurrent.futures
import importlib.util
import json
import os
import signal
import subprocess
import sys
import tempfile
import textwrap
import unittest

import numpy as np
import signorini
from harness import ENVIRONMENT, TOP, lasting, patch_test, program, program_results

HERTZ = os.path.join(TOP, 'prm', 'hertz', 'hertz.prm')
SMALL_HERTZ = {'Refinement': {'Global cycles': 1, 'Final global cycles': 0}}
STEPS = {'Load steps': 3, 'Body ball': {'Dirichlet': 'symmetry x: (0, *, *); symmetry y: (*, 0, *); top: (0, 0, -0.02*t)'}, **SMALL_HERTZ}


def settings(overrides):
    return [f'{section}/{name}={value}' if isinstance(entry, dict) else f'{section}={entry}' for section, entry in overrides.items()
            for name, value in (entry.items() if isinstance(entry, dict) else [(None, None)])]


def same_numbers(case, table, columns):
    case.assertEqual(table[0], list(columns))
    for i, name in enumerate(table[0]):
        texts = [row[i] for row in table[1:]]
        np.testing.assert_array_equal(columns[name], texts if columns[name].dtype.kind == 'U' else np.array([float(text) for text in texts]), name)


class SameNumbers(unittest.TestCase):
    def test_parameter_file(self):
        summary, pressure, _ = program_results(HERTZ, *settings(SMALL_HERTZ))
        result = signorini.run(HERTZ, SMALL_HERTZ)
        self.assertEqual(lasting(result.summary), lasting(summary))
        self.assertEqual(result.summary['parameter_file'], HERTZ)
        same_numbers(self, pressure, result.pressure_table)
        self.assertTrue(result.certified and result.converged)
        self.assertIsNone(result.folder)

    def test_dictionary(self):
        summary, pressure, _ = program_results(os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm'))
        flat = patch_test()
        for name, kind in (('Bodies', 'Body '), ('Contact pairs', 'Pair ')):
            flat.update({kind + key: section for key, section in flat.pop(name).items()})
        for problem in (patch_test(), flat):
            result = signorini.run(problem)
            self.assertEqual(lasting(result.summary), lasting(summary))
            same_numbers(self, pressure, result.pressure_table)

    def test_load_steps(self):
        summary, pressure, curve = program_results(HERTZ, *settings(STEPS))
        result = signorini.run(HERTZ, STEPS)
        self.assertEqual(lasting(result.summary), lasting(summary))
        same_numbers(self, pressure, result.pressure_table)
        same_numbers(self, curve, result.curve)
        self.assertEqual([step.time for step in result.steps], [1 / 3, 2 / 3, 1])
        last = result.steps[-1]
        np.testing.assert_array_equal(last.bodies['ball'].displacement, result.bodies['ball'].displacement)
        np.testing.assert_array_equal(last.pairs['contact'].pressure, result.pairs['contact'].pressure)
        for step, load in zip(result.steps, result.curve['contact: load']):
            self.assertAlmostEqual(step.pairs['contact'].area @ step.pairs['contact'].pressure / load, 1, 9)
        self.assertEqual(signorini.run(HERTZ, STEPS, steps=False).steps, [])

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, 'out')
            result = signorini.run(patch_test(), output=out)
            self.assertEqual(os.path.realpath(result.folder), os.path.realpath(out))
            with open(os.path.join(out, 'summary.json'), encoding='utf-8') as f:
                self.assertEqual(json.load(f), result.summary)
            self.assertIn('bodies.pvtu', os.listdir(out))
            # What the program makes of the parameters that were written.
            repeated = program_results(os.path.join(out, 'parameters.prm'))[0]
            self.assertEqual(lasting(repeated), lasting(result.summary))


class Arrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = signorini.run(HERTZ, {'Refinement': {'Final global cycles': 1}})

    def test_bodies(self):
        for body, summary in zip(self.result.bodies.values(), self.result.summary['bodies']):
            n = len(body.nodes)
            self.assertEqual((body.nodes.shape, body.displacement.shape, body.stress.shape, body.von_mises.shape), ((n, 3), (n, 3), (n, 6), (n,)))
            # The cells fill the body: corners in the order of VTK, right-handed.
            a, b, d, e = (body.nodes[body.hexahedra[:, k]] for k in (0, 1, 3, 4))
            self.assertTrue((np.einsum('ij,ij->i', np.cross(b - a, d - a), e - a) > 0).all())
            self.assertEqual(set(body.hexahedra.ravel()), set(range(n)))
            length = np.linalg.norm(body.displacement, axis=1)
            self.assertAlmostEqual(length.max(), summary['largest_displacement'], 15)
            np.testing.assert_array_equal(body.nodes[length.argmax()], summary['largest_displacement_at'])
            self.assertEqual(body.von_mises.max(), summary['largest_von_mises'])
            xx, yy, zz, xy, yz, zx = body.stress.T
            np.testing.assert_allclose(np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * (xy ** 2 + yz ** 2 + zx ** 2)), body.von_mises,
                                       rtol=1e-9)
            self.assertIn('von_mises', dir(body))

    def test_pairs(self):
        pair, summary = self.result.pairs['contact'], self.result.summary['pairs'][0]
        n = len(pair.vertices)
        self.assertEqual((pair.pressure.shape, pair.recovered_pressure.shape, pair.gap.shape, pair.normal.shape, pair.area.shape),
                         ((n,), (n,), (n,), (n, 3), (n,)))
        self.assertAlmostEqual(pair.area @ pair.pressure / summary['load'], 1, 9)
        np.testing.assert_allclose(-(pair.area * pair.pressure) @ pair.normal, pair.force, rtol=1e-9)
        self.assertEqual(pair.pressure.max(), summary['max_pressure'])
        # The rows of the table are vertices.
        table = self.result.pressure_table
        side = table.get('side', np.full(len(table['x']), 'nonmortar'))
        rows = {tuple(x): i for i, x in enumerate(np.column_stack([table[c] for c in 'xyz'])) if side[i] == 'nonmortar'}
        at = [v for v in range(n) if tuple(pair.vertices[v]) in rows]
        self.assertEqual(len(at), len(rows))
        order = [rows[tuple(pair.vertices[v])] for v in at]
        for name in ('pressure', 'recovered_pressure', 'gap', 'area', 'active'):
            np.testing.assert_array_equal(getattr(pair, name)[at], table[name][order], name)
        self.assertEqual(pair.mortar.pressure.shape, (len(pair.mortar.vertices),))
        np.testing.assert_allclose(np.linalg.norm(pair.mortar.normal, axis=1), 1, rtol=1e-12)
        # The surface is that of the body.
        body = {tuple(x): u for x, u in zip(self.result.bodies['ball'].nodes, self.result.bodies['ball'].displacement)}
        np.testing.assert_array_equal([body[tuple(x)] for x in pair.vertices], pair.displacement)

    def test_obstacle_and_tetrahedra(self):
        result = signorini.run(os.path.join(TOP, 'prm', 'obstacle', 'resting.prm'))
        self.assertTrue(all(pair.mortar is None for pair in result.pairs.values()))
        result = signorini.run(os.path.join(TOP, 'prm', 'hertz', 'paper-tetrahedra.prm'), {'Refinement': {'Adaptive cycles': 0}})
        for body in result.bodies.values():
            a, b, c, d = (body.nodes[body.tetrahedra[:, k]] for k in range(4))
            self.assertTrue(len(a) > 0 and (np.einsum('ij,ij->i', np.cross(b - a, c - a), d - a) > 0).all())


class Threads(unittest.TestCase):
    def test_one_after_the_other(self):
        problems = [patch_test(), HERTZ, patch_test(), HERTZ]
        overrides = [{}, SMALL_HERTZ, {'Body upper': {'Young modulus': 2e3}}, SMALL_HERTZ]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            results = list(pool.map(signorini.run, problems, overrides))
        self.assertTrue(all(result.certified for result in results))
        self.assertEqual(lasting(results[1].summary), lasting(results[3].summary))
        self.assertNotEqual(results[0].summary['pairs'][0]['force'], results[2].summary['pairs'][0]['force'])


class Errors(unittest.TestCase):
    def message(self, problem, *arguments, **options):
        with self.assertRaises(signorini.InputError) as caught:
            signorini.run(problem, *arguments, **options)
        return str(caught.exception)

    def test_same_message(self):
        wrong = ({'Pair interface': {'First': 'upper: nowhere'}}, {'Body upper': {'Young modulus': -1}}, {'Body upper': {'Mesh': 'missing.msh'}},
                 {'Solver': {'Method': 'magic'}}, {'Solver': {'Nothing': 1}})
        file = os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm')
        for overrides in wrong:
            run = program(file, '--output', '/nonexistent/never', *(word for s in settings(overrides) for word in ('--set', s)), '--check')
            self.assertEqual(run.returncode, 1)
            self.assertEqual('signorini: error: ' + self.message(file, overrides) + '\n', run.stderr)
        self.assertIsInstance(signorini.InputError('x'), ValueError)

    def test_dictionary(self):
        def changed(section, **values):
            problem = patch_test()
            problem[section] = {**problem.get(section, {}), **values}
            return problem
        self.assertIn('Solver/Tolerance', self.message(changed('Solver', Tolerance='small')))
        self.assertIn('Solver/Tolerance: nan', self.message(changed('Solver', Tolerance=float('nan'))))
        self.assertIn('Refinement/Regions: a set is no value', self.message(changed('Refinement', Regions={1, 2})))
        self.assertIn('line breaks', self.message(changed('Refinement', Regions='a\nend')))
        self.assertIn('Bodies', self.message({}))
        self.assertIn('cannot be opened', self.message('/nonexistent.prm'))
        self.assertIn('Wall time limit', self.message(patch_test(), {'Output': {'Wall time limit': 100}}))
        self.assertIn('ranks', self.message(patch_test(), ranks='some'))

    def test_not_converged(self):
        with self.assertRaises(signorini.NotConverged) as caught:
            signorini.run(HERTZ, {**SMALL_HERTZ, 'Solver': {'Maximal iterations': 2}})
        self.assertFalse(caught.exception.result.summary['converged'])

    def test_certificate(self):
        # Facets of two shells that fit: the gap is not known as well as it would have to be.
        fit = os.path.join(TOP, 'prm', 'shapes', 'press-fit.prm')
        with self.assertWarns(signorini.CertificateWarning):
            result = signorini.run(fit, {'Pair fit': {'Surface': 'faceted'}, 'Refinement': {'Global cycles': 0}})
        self.assertFalse(result.certified)
        self.assertTrue(result.converged)


class Processes(unittest.TestCase):
    def python(self, script, *command, **options):
        return subprocess.run([*command, sys.executable, '-c', textwrap.dedent(script)], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, timeout=100, cwd=os.path.dirname(os.path.abspath(__file__)), check=False, **options)

    def test_after_the_end_of_mpi(self):
        """As other packages end it: by the library that this process has loaded."""
        run = self.python('''
            import ctypes, signorini
            from harness import patch_test
            mpi = ctypes.CDLL(next(line.split()[-1] for line in open("/proc/self/maps") if "/libmpi.so" in line))
            mpi.MPI_Init(None, None)
            mpi.MPI_Finalize()
            try:
                signorini.run(patch_test())
            except signorini.InputError as error:
                print(error)''')
        self.assertEqual((run.returncode, run.stdout), (0, 'MPI has ended; nothing can be computed any more in this process.\n'), run.stderr)

    def test_interrupt(self):
        with tempfile.TemporaryDirectory() as folder:
            run = self.python(f'''
                import os, signal, threading, signorini
                threading.Timer(2, os.kill, (os.getpid(), signal.SIGINT)).start()
                try:
                    signorini.run({HERTZ!r}, {{"Refinement": {{"Final global cycles": 4}}}}, output={os.path.join(folder, "out")!r})
                except KeyboardInterrupt:
                    print("interrupted", os.listdir({folder!r}))
                    print(signorini.run({HERTZ!r}, {SMALL_HERTZ!r}).certified)
                ''')
            self.assertEqual((run.returncode, run.stdout), (0, 'interrupted []\nTrue\n'), run.stderr)

    def test_signals_end_a_process(self):
        run = self.python(f'''
            import os, signal, threading, signorini
            threading.Timer(2, os.kill, (os.getpid(), signal.SIGTERM)).start()
            signorini.run({HERTZ!r}, {{"Refinement": {{"Final global cycles": 4}}}})''')
        self.assertEqual(run.returncode, -signal.SIGTERM)

    def test_verbosity(self):
        script = '''
            import io, contextlib, signorini
            from harness import patch_test
            text = io.StringIO()
            with contextlib.redirect_stdout(text):
                signorini.run(patch_test(), verbosity={})
            assert ("contact conditions hold: yes" in text.getvalue()) == {}, text.getvalue()'''
        for verbosity, output, expected in ((0, None, False), (1, 'out', True)):
            with tempfile.TemporaryDirectory() as folder:
                call = f'{verbosity}' + (f', output={os.path.join(folder, output)!r}' if output else '')
                run = self.python(script.format(call, expected))
                self.assertEqual((run.returncode, run.stdout), (0, ''), run.stderr)

    def test_ranks(self):
        alone = signorini.run(HERTZ, SMALL_HERTZ)
        run = self.python(f'''
            import json, numpy as np, signorini
            assert signorini.n_ranks() == 2
            together = signorini.run({HERTZ!r}, {SMALL_HERTZ!r})
            pair, ball = together.pairs["contact"], together.bodies["ball"]
            assert together.summary["ranks"] == 2
            assert abs(pair.area @ pair.pressure / together.summary["pairs"][0]["load"] - 1) < 1e-9
            own = signorini.run({HERTZ!r}, {{**{SMALL_HERTZ!r}, "Body ball": {{"Young modulus": 7e3 * (1 + signorini.rank())}}}}, ranks="one")
            assert own.summary["ranks"] == 1
            try:
                signorini.run({HERTZ!r}, {{"Body ball": {{"Radius": -1}}}})
                assert False
            except signorini.InputError:
                pass
            print(json.dumps([signorini.rank(), len(ball.nodes), len(pair.vertices), np.abs(pair.pressure).max(), list(pair.force), list(own.pairs["contact"].force),
                              float(ball.displacement[:, 2].sum())]))
            ''', 'mpirun', '-np', '2')
        self.assertEqual(run.returncode, 0, run.stderr)
        lines = sorted(json.loads(line) for line in run.stdout.splitlines())
        ball, pair = alone.bodies['ball'], alone.pairs['contact']
        self.assertEqual([line[:3] for line in lines], [[rank, len(ball.nodes), len(pair.vertices)] for rank in (0, 1)])
        for line in lines:
            np.testing.assert_allclose(line[3:5][1], pair.force, rtol=1e-8)
            np.testing.assert_allclose((line[3], line[6]), (pair.pressure.max(), ball.displacement[:, 2].sum()), rtol=1e-8)
        np.testing.assert_array_equal(lines[0][5], pair.force)
        self.assertGreater(abs(lines[1][5][2]), 1.5 * abs(pair.force[2]))

    def test_error_of_one_rank(self):
        """The other rank would wait for ever."""
        run = self.python(f'''
            import signorini
            signorini.run({HERTZ!r}, {{**{SMALL_HERTZ!r}, **({{"Solver": {{"Method": "magic"}}}} if signorini.rank() == 1 else {{}})}})
            ''', 'mpirun', '-np', '2')
        self.assertNotEqual(run.returncode, 0)
        self.assertIn('signorini: error: --set "Solver/Method=magic"', run.stderr)

    @unittest.skipUnless(importlib.util.find_spec('mpi4py'), 'mpi4py is not there')
    def test_mpi4py(self):
        """Whichever module comes first."""
        for first, second in (('from mpi4py import MPI', 'import signorini'), ('import signorini; signorini.rank()', 'from mpi4py import MPI')):
            run = self.python(f'''
                {first}
                {second}
                from harness import patch_test
                result = signorini.run(patch_test())
                print(MPI.COMM_WORLD.allreduce(1), result.certified)
                ''')
            self.assertEqual((run.returncode, run.stdout), (0, '1 True\n'), run.stderr)


if __name__ == '__main__':
    unittest.main()
