#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Draws all generated meshes, once refined, as a table: doc/images/shapes.png.

usage: shapes.py PROGRAM PICTURE

The kinds are those that the program names itself (signorini --print-parameters). Needs VTK, numpy and matplotlib.
"""
import os
import re
import subprocess
import sys
import tempfile

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402
import vtk  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402
from vtk.util.numpy_support import vtk_to_numpy  # noqa: E402

# What differs from the defaults; a graded block and a graded half cylinder come at the end.
SETTINGS = {'block': ['Divisions=2, 2, 2'], 'prism': ['Corners=(0, 0); (1.4, 0); (1.1, 0.9); (0.3, 1)'], 'annulus': ['Height=0.15'],
            'half annulus': ['Height=0.15'], 'quarter of annulus': ['Height=0.15']}
EXTRA = [('block, graded', 'block', ['Divisions=8, 8, 8', 'Grading=(0, 0, 1), 8']),
         ('half cylinder, graded', 'half cylinder', ['Round divisions=6, 16, 4', 'Grading=(0, -1, 0), 8'])]


def surface(program, kind, settings, levels):
    """Quadrilaterals of the boundary: points (n, 4, 3)."""
    with tempfile.TemporaryDirectory() as folder:
        prm = os.path.join(folder, 'shape.prm')
        with open(prm, 'w') as f:
            f.write('set Bodies = shape\nsubsection Body shape\n' + f' set Mesh = {kind}\n' + ''.join(f' set {s}\n' for s in settings) +
                    f'end\nsubsection Refinement\n set Initial global levels = {levels}\nend\n')
        subprocess.run([program, '--mesh-only', prm, '--output', os.path.join(folder, 'out'), '--set', 'Output/Verbosity=0'], check=True)
        reader = vtk.vtkXMLPUnstructuredGridReader()
        reader.SetFileName(os.path.join(folder, 'out', 'bodies.pvtu'))
        reader.Update()
    join = vtk.vtkStaticCleanUnstructuredGrid() if hasattr(vtk, 'vtkStaticCleanUnstructuredGrid') else None
    if join:
        join.SetInputConnection(reader.GetOutputPort())
    skin = vtk.vtkGeometryFilter()
    if join:
        skin.SetInputConnection(join.GetOutputPort())
    else:
        skin.SetInputConnection(reader.GetOutputPort())
    skin.Update()
    mesh = skin.GetOutput()
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    faces, seen = [], {}
    for c in range(mesh.GetNumberOfCells()):
        ids = mesh.GetCell(c).GetPointIds()
        face = points[[ids.GetId(i) for i in range(ids.GetNumberOfIds())]]
        # Across ranks cells have points of their own: faces inside may come twice.
        seen.setdefault(tuple(numpy.round(face.mean(axis=0), 5)), []).append(face)
    for same in seen.values():
        if len(same) == 1:
            faces.append(same[0])
    return numpy.array(faces)


def draw(axes, title, faces):
    normals = numpy.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1])
    normals /= numpy.linalg.norm(normals, axis=1)[:, None]
    light = numpy.abs(normals @ numpy.array([.35, -.55, .76]))
    colours = (.45 + .55 * light)[:, None] * numpy.array([[.62, .78, .93]])
    axes.add_collection3d(Poly3DCollection(faces, facecolors=colours, edgecolors=(.1, .15, .25), linewidths=.35))
    low, high = faces.reshape(-1, 3).min(axis=0), faces.reshape(-1, 3).max(axis=0)
    middle, half = (low + high) / 2, numpy.linalg.norm(high - low) / 2
    for setter, m in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), middle):
        setter(m - half, m + half)
    axes.set_box_aspect((1, 1, 1), zoom=1.75)
    axes.view_init(elev=28, azim=-62)
    axes.set_axis_off()
    axes.set_title(title, fontsize=9, y=-.02)


def main():
    program, picture = sys.argv[1:3]
    text = subprocess.run([program, '--print-parameters'], stdout=subprocess.PIPE, universal_newlines=True, check=True).stdout
    description = ' '.join(re.sub(r'\n\s*#', ' ', text).split())
    kinds = re.search(r'generated mesh: (.*?)\. set Mesh', description).group(1).split(', ')
    shapes = [(kind, kind, SETTINGS.get(kind, [])) for kind in kinds] + EXTRA
    columns = 5
    rows = -(-len(shapes) // columns)
    figure = plt.figure(figsize=(2.1 * columns, 2.1 * rows))
    for i, (title, kind, settings) in enumerate(shapes):
        draw(figure.add_subplot(rows, columns, i + 1, projection='3d'), title, surface(program, kind, settings, 0 if 'graded' in title else 1))
    figure.subplots_adjust(left=0, right=1, bottom=.02, top=1, wspace=0, hspace=.05)
    figure.savefig(picture, dpi=100)


if __name__ == '__main__':
    main()
