#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""signorini.map_surfaces(): overlays that tile, matrices with known properties, errors."""
import unittest

import numpy as np
import signorini


def grid(n, size, height, turn=0., up=True, centre=(0., 0.), lift=lambda x, y: 0 * x):
    """A square of n x n cells, turned by an angle, in two triangles each."""
    s, t = np.meshgrid(np.linspace(-size / 2, size / 2, n + 1), np.linspace(-size / 2, size / 2, n + 1), indexing='ij')
    x, y = centre[0] + np.cos(turn) * s - np.sin(turn) * t, centre[1] + np.sin(turn) * s + np.cos(turn) * t
    vertices = np.column_stack([x.ravel(), y.ravel(), (height + lift(x, y)).ravel()])
    p = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    triangles = np.vstack([np.column_stack([p, p + n + 1, p + n + 2]), np.column_stack([p, p + n + 2, p + 1])])
    return vertices, triangles if up else triangles[:, ::-1]


def bowl(x, y):
    return .1 * (x ** 2 + y ** 2)


class Overlay(unittest.TestCase):
    def test_planes(self):
        below, above = grid(7, 2., 0.), grid(9, 4., .3, turn=.4, up=False)
        mapping = signorini.map_surfaces(below, above)
        self.assertEqual(mapping.errors, '')
        self.assertAlmostEqual(mapping.areas.sum(), 4., 12)
        self.assertAlmostEqual(mapping.report['coverage_nonmortar'], 1., 12)
        self.assertAlmostEqual(mapping.report['min_gap'], .3, 12)
        self.assertTrue((mapping.nonmortar >= 0).all() and (mapping.mortar >= 0).all())
        # The image lies over the point.
        here, there = mapping.points(), mapping.points(mortar=True)
        np.testing.assert_allclose(there - here, np.broadcast_to((0, 0, .3), here.shape), atol=1e-13)
        # Each nonmortar triangle is tiled, by triangles and by polygons.
        tiles = np.bincount(mapping.parents[:, 0], mapping.areas, len(below[1]))
        np.testing.assert_allclose(tiles, 2. / 49., rtol=1e-12)
        self.assertEqual(len(mapping.polygon_start), len(mapping.polygon_parents) + 1)
        self.assertEqual(mapping.polygon_start[-1], len(mapping.polygon_nonmortar))
        corners = np.diff(mapping.polygon_start)
        self.assertTrue((corners >= 3).all())
        area = 0.
        for (a, _), begin, end in zip(mapping.polygon_parents, mapping.polygon_start, mapping.polygon_start[1:]):
            x = mapping.polygon_nonmortar[begin:end] @ below[0][below[1][a]]
            area += .5 * sum(np.cross(x[i] - x[0], x[i + 1] - x[0])[2] for i in range(1, len(x) - 1))
        self.assertAlmostEqual(area, 4., 12)

    def test_part(self):
        """Half of the surface faces nothing."""
        mapping = signorini.map_surfaces(grid(6, 2., 0.), grid(5, 2., .1, up=False, centre=(1., 0.)))
        self.assertAlmostEqual(mapping.areas.sum(), 2., 12)
        self.assertAlmostEqual(mapping.report['coverage_mortar'], .5, 12)
        self.assertEqual(len(mapping.unmapped), sum(mapping.report['unmapped'].values()))
        self.assertTrue(all(isinstance(reason, str) for _, reason in mapping.unmapped))

    def test_matrices(self):
        below, above = grid(7, 2., 0., lift=bowl), grid(9, 4., .3, turn=.4, up=False, lift=bowl)
        mapping = signorini.map_surfaces(below, above)
        for dual in (False, True):
            D, M = mapping.matrices(dual=dual)
            self.assertEqual((D.shape, M.shape), ((64, 64), (64, 100)))
            # Constants are kept: forces balance.
            np.testing.assert_allclose(D.sum(axis=1), M.sum(axis=1), rtol=1e-9)
            self.assertAlmostEqual(D.sum() / mapping.areas.sum(), 1., 12)
        self.assertEqual(D.nnz, 64)
        hats, _ = mapping.matrices()
        np.testing.assert_allclose(hats.toarray(), hats.toarray().T, atol=1e-15)
        np.testing.assert_allclose(D.diagonal(), np.asarray(hats.sum(axis=1)).ravel(), rtol=1e-9)
        # Linear functions in the plane are transferred exactly.
        flat = signorini.map_surfaces(grid(7, 2., 0.), grid(9, 4., .3, turn=.4, up=False))
        D, M = flat.matrices(dual=True)
        np.testing.assert_allclose((M @ grid(9, 4., .3, turn=.4)[0][:, 0]) / D.diagonal(), grid(7, 2., 0.)[0][:, 0], atol=1e-12)

    def test_images(self):
        below, above = grid(7, 2., 0.), grid(9, 4., .3, turn=.4, up=False)
        mapping = signorini.map_surfaces(below, above)
        triangles, weights = np.arange(98), np.full((98, 3), 1 / 3)
        at, coordinates = mapping.image(triangles, weights)
        self.assertTrue((at >= 0).all())
        points = np.einsum('ij,ijk->ik', coordinates, above[0][above[1][at]])
        np.testing.assert_allclose(points, below[0][below[1]].mean(axis=1) + (0, 0, .3), atol=1e-12)
        back, there = mapping.preimage(at, coordinates)
        np.testing.assert_array_equal(back, triangles)
        np.testing.assert_allclose(there, weights, atol=1e-9)
        # The corners are places, too, and what lies outside has none.
        self.assertTrue((mapping.image(triangles, np.tile((1., 0., 0.), (98, 1)))[0] >= 0).all())
        outside, _ = mapping.preimage(np.arange(162), np.full((162, 3), 1 / 3))
        self.assertTrue((outside == -1).any())

    def test_normals(self):
        """A ball and the shell around it: the gap with the normals of the spheres is that between the facets at least."""
        below, above = grid(8, 1., 0.), grid(11, 1.6, 0., up=False)
        ball, shell = (np.column_stack([s[0][:, :2], np.ones(len(s[0]))]) for s in (below, above))
        ball, shell = (x / np.linalg.norm(x, axis=1)[:, None] for x in (ball, shell))
        mapping = signorini.map_surfaces((ball, below[1]), (1.2 * shell, above[1]), nonmortar_normals=ball, mortar_normals=-shell)
        self.assertEqual(mapping.errors, '')
        self.assertAlmostEqual(mapping.report['coverage_nonmortar'], 1., 10)
        here, there = mapping.points(), mapping.points(mortar=True)
        along = np.cross(here, there)
        np.testing.assert_allclose(along[(mapping.nonmortar == 1.).any(axis=2)], 0., atol=1e-2)

    def test_errors(self):
        vertices, triangles = grid(2, 1., 0.)
        good = vertices, triangles
        for bad, text in (((vertices[:, :2], triangles), 'nonmortar vertices: an array of shape'), ((vertices, triangles.astype(float)), 'expected integers'),
                          ((vertices, triangles + 5), 'has a corner that is none of its 9 vertices'), ((vertices, triangles - 1), 'has a corner that is none'),
                          ((vertices * np.nan, triangles), 'no finite coordinates'), ((vertices, triangles[:0]), 'has no triangles')):
            with self.assertRaisesRegex(signorini.InputError, text):
                signorini.map_surfaces(bad, good)
        with self.assertRaisesRegex(signorini.InputError, 'no unit vector'):
            signorini.map_surfaces(good, good, mortar_normals=2 * vertices)
        mapping = signorini.map_surfaces(good, grid(2, 1., .1, up=False))
        with self.assertRaisesRegex(signorini.InputError, 'no triangle 99'):
            mapping.image([99], [[1., 0., 0.]])
        with self.assertRaisesRegex(signorini.InputError, 'barycentric'):
            mapping.image([0], [[1., 1., 0.]])
        # Surfaces that do not face each other are no error, but nothing is covered.
        self.assertEqual(len(signorini.map_surfaces(good, grid(2, 1., .1, up=False, centre=(5., 0.))).areas), 0)


if __name__ == '__main__':
    unittest.main()
