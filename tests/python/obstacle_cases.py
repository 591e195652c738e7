#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""signorini.solve_obstacle(): against an active set method on dense matrices, and against itself on finer meshes."""
import os
import subprocess
import sys
import textwrap
import unittest

import numpy as np
import scipy.sparse as sp
import signorini
from harness import ENVIRONMENT


def laplace(n):
    """The five-point Laplacian on n x n inner points of the square (-1, 1)^2."""
    line = sp.diags([-1, 2, -1], [-1, 0, 1], shape=(n, n))
    return (sp.kron(line, sp.identity(n)) + sp.kron(sp.identity(n), line)).tocsr()


def interpolation(n):
    """From n x n to (2n + 1) x (2n + 1) inner points."""
    line = sp.diags([.5, 1, .5], [0, -1, -2], shape=(2 * n + 1, 2 * n + 1)).tocsc()[:, :2 * n:2]
    return sp.kron(line, line).tocsr()


def membrane(levels):
    """Matrix, load, prolongations (finest first) and positions of an n x n membrane, n = 2^levels - 1."""
    n = 2 ** levels - 1
    h = 2 / (n + 1)
    x, y = (-1 + h * (1 + g.ravel()) for g in np.meshgrid(np.arange(n), np.arange(n), indexing='ij'))
    return laplace(n), np.full(n * n, -10 * h * h), [interpolation(2 ** k - 1) for k in range(levels - 1, 1, -1)], x, y


def stairs(x):
    return np.select([x < -.5, x < 0, x < .5], [-.2, -.4, -.6], -.8)


def active_set(A, f, normals, bounds):
    """The minimizer under n_p . u_p <= g_p, by a primal-dual active set method on dense matrices (all nodes have a half-space)."""
    A, k = A.toarray(), normals.shape[1]
    B = np.zeros((len(bounds), len(f)))
    for p, normal in enumerate(normals):
        B[p, k * p:k * p + k] = normal
    active = np.zeros(len(bounds), dtype=bool)
    for _ in range(100):
        C = B[active]
        solution = np.linalg.solve(np.block([[A, C.T], [C, np.zeros((len(C), len(C)))]]), np.concatenate([f, bounds[active]]))
        u, force = solution[:len(f)], np.zeros(len(bounds))
        force[active] = solution[len(f):]
        now = force + np.abs(A).max() * (B @ u - bounds) > 1e-13
        if (now == active).all():
            return u, np.flatnonzero(active)
        active = now
    raise RuntimeError('the active set does not settle')


class Scalar(unittest.TestCase):
    def test_against_active_set(self):
        A, f, prolongations, x, _ = membrane(4)
        expected, active = active_set(A, f, -np.ones((len(f), 1)), -stairs(x))
        for P in (prolongations, ()):
            solution = signorini.solve_obstacle(A, f, P, lower=stairs(x))
            np.testing.assert_allclose(solution.u, expected, atol=1e-10)
            np.testing.assert_array_equal(solution.active, active)
            self.assertTrue((solution.u >= stairs(x) - 1e-12).all())
            self.assertTrue((solution.force[active] > 0).all())
            rest = np.setdiff1d(np.arange(len(f)), active)
            np.testing.assert_allclose(solution.force[rest], 0, atol=1e-10)
            self.assertAlmostEqual(solution.energy, expected @ (A @ expected) / 2 - f @ expected, 10)
        mirrored = signorini.solve_obstacle(A, -f, prolongations, upper=-stairs(x))
        np.testing.assert_allclose(mirrored.u, -expected, atol=1e-10)

    def test_soft_beside_stiff(self):
        """Two membranes that know nothing of each other; the second one has the same solution, however soft it is."""
        A, f, prolongations, x, _ = membrane(4)
        alone, n = signorini.solve_obstacle(A, f, prolongations, lower=stairs(x)), len(f)
        both = [sp.block_diag([P, P]) for P in prolongations]
        for ratio in (1e-3, 5e-7, 1e-9, 1e-12):
            for P in (both, ()):
                solution = signorini.solve_obstacle(sp.block_diag([A, ratio * A]), np.concatenate([f, ratio * f]), P, lower=np.tile(stairs(x), 2))
                np.testing.assert_allclose(solution.u, np.tile(alone.u, 2), atol=1e-9)
                np.testing.assert_array_equal(solution.active, np.concatenate([alone.active, n + alone.active]))

    def test_iterations_do_not_grow(self):
        iterations = []
        for levels in (5, 6, 7):
            A, f, prolongations, x, _ = membrane(levels)
            solution = signorini.solve_obstacle(A, f, prolongations, lower=stairs(x), tolerance=1e-10)
            iterations.append(solution.iterations)
            self.assertEqual(len(solution.history), solution.iterations)
            self.assertLess(solution.history[-1], 1e-10)
        print('iterations', iterations)
        self.assertLessEqual(max(iterations), 10)

    def test_without_obstacle(self):
        A, f, prolongations, *_ = membrane(5)
        exact = sp.linalg.spsolve(A.tocsc(), f)
        for method in ('accelerated', 'truncated newton multigrid', 'multigrid', 'multigrid cg'):
            solution = signorini.solve_obstacle(A, f, prolongations, solver={'Method': method})
            np.testing.assert_allclose(solution.u, exact, atol=1e-9)
            self.assertEqual(len(solution.active), 0)

    def test_prescribed(self):
        """The membrane with its border among the unknowns, held at a height."""
        n = 33
        line = sp.diags([-1, 2, -1], [-1, 0, 1], shape=(n, n))
        A = (sp.kron(line, sp.identity(n)) + sp.kron(sp.identity(n), line)).tocsr()
        refine = [sp.diags([.5, 1, .5], [1, 0, -1], shape=(m, m)).tocsc()[:, ::2] for m in (33, 17, 9)]
        P = [sp.kron(r, r) for r in refine]
        x, y = (g.ravel() for g in np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n), indexing='ij'))
        border, f = np.maximum(np.abs(x), np.abs(y)) > .999, np.full(n * n, -10 * (2 / (n - 1)) ** 2)
        height = .1 * x + .05
        free = np.flatnonzero(~border)
        reduced = signorini.solve_obstacle(A[free][:, free], f[free] - A[free] @ np.where(border, height, 0), lower=stairs(x)[free])
        for fixed in (border, np.flatnonzero(border)):
            solution = signorini.solve_obstacle(A, f, P, lower=np.where(border, -np.inf, stairs(x)), fixed=fixed, values=height)
            np.testing.assert_array_equal(solution.u[border], height[border])
            np.testing.assert_allclose(solution.u[free], reduced.u, atol=1e-10)
            np.testing.assert_array_equal(solution.active, free[reduced.active])
            self.assertLess(solution.iterations, 15)
        # A start that is the solution.
        again = signorini.solve_obstacle(A, f, P, lower=np.where(border, -np.inf, stairs(x)), fixed=border, values=height, start=solution.u)
        self.assertLessEqual(again.iterations, 2)


class Vectors(unittest.TestCase):
    """Springs between nodes in space: each component a membrane, coupled at the nodes."""

    def setUp(self):
        self.scalar, load, self.prolongations, x, y = membrane(3)
        block = np.array([[2, .3, .1], [.3, 1, .2], [.1, .2, 1.5]])
        self.A = sp.kron(self.scalar, block).tobsr((3, 3))
        self.f = np.kron(load, (1, .5, 2))
        normals = np.column_stack([.3 * x, .3 * y, -np.ones(len(x))])
        self.normals = normals / np.linalg.norm(normals, axis=1)[:, None]
        self.bounds = 1. + x * y

    def test_against_active_set(self):
        expected, active = active_set(self.A, self.f, self.normals, self.bounds)
        self.assertTrue(0 < len(active) < len(self.bounds))
        by_dof = [sp.kron(P, sp.identity(3)) for P in self.prolongations]
        for P in (self.prolongations, by_dof, ()):
            solution = signorini.solve_obstacle(self.A, self.f, P, normals=7 * self.normals, bounds=7 * self.bounds)
            np.testing.assert_allclose(solution.u, expected, atol=1e-10)
            np.testing.assert_array_equal(solution.active, active)
        shuffled = np.random.default_rng(1).permutation(len(self.bounds))
        solution = signorini.solve_obstacle(self.A, self.f, self.prolongations, nodes=shuffled, normals=self.normals[shuffled], bounds=self.bounds[shuffled])
        np.testing.assert_allclose(solution.u, expected, atol=1e-10)

    def test_two_components(self):
        A, f = sp.kron(self.scalar, [[2, .5], [.5, 1]]), np.kron(np.full(49, -.3), (1, .5))
        normals = -np.ones((49, 2)) / np.sqrt(2)
        expected, _ = active_set(A, f, normals, np.full(49, .2))
        np.testing.assert_allclose(signorini.solve_obstacle(A, f, self.prolongations, normals=normals, bounds=.2).u, expected, atol=1e-10)

    def test_held_components(self):
        """Of nodes that touch and of others."""
        fixed = np.array([3, 5, 70])
        free = np.setdiff1d(np.arange(147), fixed)
        # A dense method: held by stiff springs.
        stiff = self.A + sp.diags(np.where(np.isin(np.arange(147), fixed), 1e7, 0.))
        expected, _ = active_set(stiff, self.f, self.normals, self.bounds)
        for P in (self.prolongations, ()):
            solution = signorini.solve_obstacle(self.A, self.f, P, normals=self.normals, bounds=self.bounds, fixed=fixed)
            np.testing.assert_allclose(solution.u[free], expected[free], atol=1e-6)
            np.testing.assert_array_equal(solution.u[fixed], 0)

    def test_without_half_spaces(self):
        solution = signorini.solve_obstacle(self.A, self.f, self.prolongations, components=3)
        np.testing.assert_allclose(solution.u, sp.linalg.spsolve(self.A.tocsc(), self.f), atol=1e-10)


class Errors(unittest.TestCase):
    def test_input(self):
        A, f, prolongations, x, _ = membrane(3)
        half = sp.diags(np.where(np.arange(49) == 3, -1., 4.))
        lopsided = A.tolil()
        lopsided[0, 1] = 5
        for text, arguments, options in (
                ('expected a square one', (A[:3], f), {}), ('not symmetric', (lopsided, f), {}), ('f: an array of shape', (A, f[:3]), {}),
                ('diagonal is not positive at dof 3', (half, f), {}), ('not finite', (A, f * np.nan), {}), ('not finite', (A * np.inf, f), {}),
                (r'prolongations\[1\]: 49 rows, expected 9', (A, f, [prolongations[0]] * 2), {}), ('one obstacle', (A, f), {'lower': 0, 'upper': 1}),
                ('is no number', (A, f), {'lower': np.nan}), ('do not fit to 49 dofs', (A, f), {'components': 3}),
                ('has a normal and a bound', (A, f), {'bounds': 1.}), ('numbers of dofs are from 0 to 48', (A, f), {'fixed': [49]}),
                ('prescribed where its obstacle', (A, f), {'lower': 1., 'fixed': [0]}), ('Method', (A, f), {'solver': {'Method': 'magic'}}),
                ('without obstacles', (A, f), {'lower': 0., 'solver': {'Method': 'multigrid'}}),
                ('normals on all levels', (A, f), {'lower': 0., 'solver': {'Method': 'monotone multigrid'}}),
                ('each once', (A, f), {'normals': [[1.], [1.]], 'bounds': 0., 'nodes': [3, 3]}),
                ('finite and not zero', (A, f), {'normals': np.zeros((49, 1)), 'bounds': 0.})):
            with self.subTest(text), self.assertRaisesRegex(signorini.InputError, text):
                signorini.solve_obstacle(*arguments, **options)
        with self.assertRaises(signorini.NotConverged) as caught:
            signorini.solve_obstacle(A, f, prolongations, lower=stairs(x), solver={'Maximal iterations': 1})
        self.assertEqual(caught.exception.result.iterations, 1)

    def test_not_positive_definite(self):
        A, f, prolongations, *_ = membrane(3)
        with self.assertRaisesRegex(signorini.InputError, 'not positive definite'):
            signorini.solve_obstacle(A - sp.diags(np.asarray(A.sum(axis=1)).ravel()), f, prolongations)
        with self.assertRaisesRegex(signorini.NotConverged, 'positive definite'):
            signorini.solve_obstacle(np.array([[1., 2.], [2., 1.]]), np.ones(2))

    def test_interrupt(self):
        """Sweeps alone would go on for minutes."""
        run = subprocess.run([sys.executable, '-c', textwrap.dedent('''
            import os, signal, threading
            import signorini
            from obstacle_cases import membrane
            A, f, P, x, y = membrane(7)
            threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT)).start()
            try:
                signorini.solve_obstacle(A, f, lower=-.5, tolerance=1e-15, solver={"Method": "projected gauss seidel", "Maximal iterations": 10**6})
            except KeyboardInterrupt:
                print("interrupted")''')], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=100,
                             cwd=os.path.dirname(os.path.abspath(__file__)), check=False)
        self.assertEqual((run.returncode, run.stdout), (0, 'interrupted\n'), run.stderr)


if __name__ == '__main__':
    unittest.main()
