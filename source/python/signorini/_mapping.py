# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""The contact mapping between two triangulated surfaces."""
import json

import numpy as np

from . import _core


def array(values, name, shape, kind):
    """Numbers as an array of some kind and shape (None: any length)."""
    result = np.asarray(values)
    if result.size == 0:
        result = result.reshape([0 if n is None else n for n in shape])
    if result.ndim != len(shape) or any(n not in (None, m) for n, m in zip(shape, result.shape)):
        raise _core.InputError(f'{name}: an array of shape {result.shape}, expected ({", ".join("n" if n is None else str(n) for n in shape)}).')
    if not (np.issubdtype(result.dtype, np.integer) if kind is np.int64 else np.issubdtype(result.dtype, np.number) and not np.iscomplexobj(result)) and result.size:
        raise _core.InputError(f'{name}: an array of {result.dtype}, expected {"integers" if kind is np.int64 else "real numbers"}.')
    return result.astype(kind)


class Mapping:
    """The mapping Phi from a nonmortar to a mortar surface: its overlay of p polygons in k triangles. Made by map_surfaces().

    parents         (k, 2): the nonmortar and the mortar triangle in which an overlay triangle lies
    nonmortar       (k, 3, 3): barycentric coordinates of its three corners in its nonmortar triangle (each three numbers, sum 1)
    mortar          (k, 3, 3): those of their images in its mortar triangle
    areas           (k,): on the nonmortar side (length squared); negative where the mapping is turned
    polygon_parents (p, 2), polygon_start (p + 1,), polygon_nonmortar (c, 3), polygon_mortar (c, 3): the same for the polygons in which two
                    triangles meet; the corners of polygon i are those from polygon_start[i] on, before polygon_start[i + 1]
    report          dictionary: coverage of both sides (0 to 1), area, cells, worst_tiling_defect, angles (degrees), gaps (length), unmapped ...
    errors          what is wrong with the mapping, in words; empty where all is well
    unmapped        list of (mortar vertex, reason): those without an image"""

    def __init__(self, core, surfaces):
        self._core, self._surfaces = core, surfaces
        self.__dict__.update(core.arrays())
        self.report, self.errors, self.unmapped = json.loads(core.report), core.errors, core.unmapped()

    def points(self, mortar=False):
        """(k, 3, 3): the corners of the overlay triangles in space, on the nonmortar or the mortar surface (length)."""
        vertices, triangles = self._surfaces[1 if mortar else 0]
        return (self.mortar if mortar else self.nonmortar) @ vertices[triangles[self.parents[:, 1 if mortar else 0]]]

    def matrices(self, dual=False):
        """The mortar matrices D (n x n) and M (n x m) for n nonmortar and m mortar vertices, as scipy.sparse.csr_matrix (area):
        D_pq = int psi_p phi_q, M_pq = int psi_p (theta_q o Phi) over the covered part, with hat functions phi, theta. psi are hat functions,
        too, or with dual=True those that make D diagonal (doc/algorithm.md). Rows of D and M have the same sum. Exact to rounding."""
        from scipy.sparse import coo_matrix
        n, m = (len(vertices) for vertices, _ in self._surfaces)
        D, M = (coo_matrix((values, (rows, columns)), shape).tocsr() for (rows, columns, values), shape in zip(self._core.coupling(bool(dual)), ((n, n), (n, m))))
        if dual:
            # What is beside the diagonal is rounding.
            from scipy.sparse import diags
            D = diags(D.diagonal(), format='csr')
        return D, M

    def image(self, triangles, coordinates):
        """Phi at n points of nonmortar triangles, given by their numbers (n,) and barycentric coordinates (n, 3). Returns the mortar triangles
        (n,), -1 where a point faces nothing, and the coordinates there (n, 3)."""
        return self._core.images(array(triangles, 'triangles', (None,), np.int64), array(coordinates, 'coordinates', (len(triangles), 3), np.float64), False)

    def preimage(self, triangles, coordinates):
        """The inverse of Phi at n points of mortar triangles, as image()."""
        return self._core.images(array(triangles, 'triangles', (None,), np.int64), array(coordinates, 'coordinates', (len(triangles), 3), np.float64), True)

    def __repr__(self):
        return f'<Mapping: {len(self.areas)} overlay triangles, {self.report["coverage_nonmortar"]:.1%} of the nonmortar side covered>'


def map_surfaces(nonmortar, mortar, *, nonmortar_normals=None, mortar_normals=None):
    """The contact mapping from a nonmortar to a mortar surface (doc/contact-mapping.md). There is no search distance.

    nonmortar, mortar   (vertices, triangles): arrays (n, 3) of numbers (length) and (m, 3) of vertex numbers. Triangles are oriented: the normals of
                        the two surfaces point out of their bodies, towards each other; neighbours share their vertices.
    ..._normals         (n, 3): unit normals at the vertices; made from the triangles where they are missing

    Returns a Mapping; its `errors` tell whether it can be trusted. Raises InputError for arrays that are no surfaces."""
    surfaces = [(array(vertices, f'{side} vertices', (None, 3), np.float64), array(triangles, f'{side} triangles', (None, 3), np.int64))
                for side, (vertices, triangles) in (('nonmortar', nonmortar), ('mortar', mortar))]
    normals = [np.zeros((0, 3)) if given is None else array(given, f'{side}_normals', (len(vertices), 3), np.float64)
               for side, given, (vertices, _) in zip(('nonmortar', 'mortar'), (nonmortar_normals, mortar_normals), surfaces)]
    return Mapping(_core.Overlay([s[0] for s in surfaces], [s[1] for s in surfaces], normals), surfaces)
