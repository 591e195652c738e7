#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Draws overlay.vtk of step-1 as overlay.png, seen from above: the distance between the surfaces where they face each
other, the cells of the overlay, and the triangles of the ball (heavy lines).

usage: plot.py [overlay.vtk] [overlay.png]"""
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np


def block(words, keyword, count, skip):
    """`count` numbers that follow a keyword, after `skip` words."""
    begin = words.index(keyword) + 1 + skip
    return np.array(words[begin:begin + count], dtype=float)


def main():
    source, image = (sys.argv[1:] + ['overlay.vtk', 'overlay.png'][len(sys.argv) - 1:])[:2]
    with open(source) as f:
        words = f.read().split()
    n_points = int(words[words.index('POINTS') + 1])
    x = block(words, 'POINTS', 3 * n_points, 2).reshape(-1, 3)
    distance = block(words, 'distance', n_points, 3)
    triangle = block(words, 'nonmortar_triangle', n_points // 3, 3).astype(int)
    cells = np.arange(n_points).reshape(-1, 3)

    figure, axes = plt.subplots(figsize=(6.4, 5))
    colours = axes.tripcolor(x[:, 0], x[:, 1], cells, distance, shading='gouraud', cmap='viridis')
    axes.triplot(x[:, 0], x[:, 1], cells, color='white', linewidth=.35)
    # Edges of the overlay with different triangles of the ball on either side, or none on one.
    sides = {}
    for cell, t in zip(cells, triangle):
        for a, b in zip(cell, np.roll(cell, -1)):
            edge = frozenset((tuple(np.round(x[a], 9)), tuple(np.round(x[b], 9))))
            sides.setdefault(edge, []).append(t)
    for edge, triangles in sides.items():
        if len(edge) == 2 and (len(triangles) == 1 or triangles[0] != triangles[1]):
            p, q = edge
            axes.plot([p[0], q[0]], [p[1], q[1]], color='black', linewidth=1.1)
    axes.set_aspect('equal')
    axes.set_axis_off()
    figure.colorbar(colours, label='distance from x to its image')
    figure.savefig(image, dpi=110, bbox_inches='tight')


if __name__ == '__main__':
    main()
