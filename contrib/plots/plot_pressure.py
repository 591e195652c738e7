#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Draws pressure.csv of a result folder.

  pressure.png            a map of the contact pressure, seen along the direction in which the contact nodes spread least; with
                          --centre or --hertz also the pressure over the distance from the centre of contact
  pressure-unrolled.png   where the contact surface is a cylinder (a bore, a pin, a shrink fit): the pressure over angle and length,
                          and over the angle in the middle of the length; one picture for each such pair
"""
import argparse
import json
import math
import os

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.tri  # noqa: E402
import numpy as np  # noqa: E402
from mpl_toolkits.axes_grid1 import make_axes_locatable  # noqa: E402

import picture  # noqa: E402

TOOL = 'plot_pressure.py'
COLOURS = 'inferno_r'


class Cylinder:
    """Axis, centre and radius of a cylinder through points with normals; is_one says whether they lie on one."""

    # Normals leave the plane across the axis by less than this share of how they spread in it.
    MOST_TILT = .02
    # Distance of points from the cylinder, in radii.
    MOST_OFF = .03
    # Degrees that the normals span at least.
    LEAST_ARC = 15.

    def __init__(self, x, normal, weight):
        self.is_one = False
        spread, directions = np.linalg.eigh((normal * weight[:, None]).T @ normal / weight.sum())
        if spread[0] > self.MOST_TILT * spread[1]:
            return
        self.axis = directions[:, 0] * (1. if directions[np.argmax(np.abs(directions[:, 0])), 0] > 0 else -1.)
        # The angle is counted from a coordinate axis across.
        k = int(np.argmax(np.abs(self.axis) < .3))
        start = np.eye(3)[k]
        self.first = start - (start @ self.axis) * self.axis
        self.first /= np.linalg.norm(self.first)
        self.second = np.cross(self.axis, self.first)
        self.start = 'xyz'[k]
        # x = centre + radius n across the axis; the radius is negative in a bore, whose normals point at the axis.
        flat = np.c_[x @ self.first, x @ self.second]
        n = np.c_[normal @ self.first, normal @ self.second]
        matrix = np.r_[np.c_[np.ones(len(x)), np.zeros(len(x)), n[:, 0]], np.c_[np.zeros(len(x)), np.ones(len(x)), n[:, 1]]]
        scale = np.sqrt(np.r_[weight, weight])
        solution = np.linalg.lstsq(matrix * scale[:, None], np.r_[flat[:, 0], flat[:, 1]] * scale, rcond=None)[0]
        self.centre, self.radius = solution[:2], abs(solution[2])
        self.is_bore = solution[2] < 0
        across = flat - self.centre
        off = np.linalg.norm(across, axis=1) - self.radius
        self.angle = np.degrees(np.arctan2(across[:, 1], across[:, 0]))
        self.length = x @ self.axis
        # The seam lies in the widest gap between the nodes.
        order = np.sort(self.angle)
        gaps = np.diff(np.r_[order, order[0] + 360.])
        widest = int(np.argmax(gaps))
        self.closes = gaps[widest] < 45.
        if not self.closes:
            seam = order[(widest + 1) % len(order)]
            self.angle = seam + (self.angle - seam + 1e-9) % 360. - 1e-9
            if self.angle.mean() > 180.:
                self.angle -= 360.
        self.is_one = (self.radius > 0 and math.sqrt(np.average(off ** 2, weights=weight)) < self.MOST_OFF * self.radius and
                       np.ptp(self.angle) > self.LEAST_ARC and np.ptp(self.length) > 1e-6 * self.radius)

    def text(self):
        along = ', '.join(picture.number(a if abs(a) > 1e-6 else 0.) for a in self.axis)
        return f'{"bore" if self.is_bore else "shaft"} of radius {picture.number(self.radius)}, axis along ({along})'


def label_of(field):
    return 'contact pressure' if field == 'pressure' else 'contact pressure (mean around each node)'


def hertz_values(file):
    with open(file) as f:
        h = json.load(f)
    h.setdefault('centre', [0, 0, 0])
    return h


def draw_hertz(axes, h, table, summary, r, reach):
    force = abs(summary['pairs'][0]['force'][2]) * h['symmetry']
    e_star = 1 / ((1 - h['nu1'] ** 2) / h['E1'] + (1 - h['nu2'] ** 2) / h['E2'])
    a = (3 * force * h['radius'] / (4 * e_star)) ** (1 / 3)
    p0 = 3 * force / (2 * math.pi * a ** 2)
    s = np.linspace(0, reach, 400)
    axes.plot(s, p0 * np.sqrt(np.maximum(0, 1 - (s / a) ** 2)), 'k-', lw=1.2, label=f'Hertz, F = {force:.4g}: a = {a:.4g}, p0 = {p0:.4g}')
    weight = table['area'] * np.maximum(table['pressure'], 0)
    moment = 16 / (3 * math.pi) * (weight * r).sum() / weight.sum()
    print(f'F = {force:.6g}  a (moments) = {moment:.6g}  p0 (from F and a) = {3 * force / (2 * math.pi * moment ** 2):.6g}'
          f'  largest nodal pressure = {table["pressure"].max():.6g}   Hertz: a = {a:.6g}  p0 = {p0:.6g}')


def positions(table):
    return np.c_[table['x'], table['y'], table['z']]


def draw_map(folder, table, summary, arguments):
    x = positions(table)
    pressure = table[arguments.field]
    loaded = pressure > 1e-6 * max(pressure.max(), 0)
    h = hertz_values(arguments.hertz) if arguments.hertz else None
    # With symmetry planes the contact nodes are a part of the contact zone: its centre cannot be told from them.
    has_centre = bool(h or arguments.centre)
    if h:
        centre = np.array(h['centre'], float)
    elif arguments.centre:
        centre = np.array(arguments.centre, float)
    else:
        centre = x[loaded if loaded.any() else slice(None)].mean(0)
    r = np.linalg.norm(x - centre, axis=1)
    reach = 1.6 * r[loaded].max() if loaded.any() else r.max()
    near = r <= reach * (1 + 1e-9)
    # The plane in which the contact nodes spread most.
    across = int(np.argmax(np.abs(np.linalg.svd(x[near] - x[near].mean(0), full_matrices=True)[2][-1])))
    horizontal, vertical = [c for c in range(3) if c != across]
    figure, axes = plt.subplots(1, 2 if has_centre else 1, figsize=(11 if has_centre else 6, 4.5), squeeze=False,
                                gridspec_kw={'width_ratios': [1, 1.25] if has_centre else [1]})
    plan, graph = axes[0, 0], axes[0, -1]
    # The largest on top, and colours from zero on.
    order = np.flatnonzero(near)[np.argsort(pressure[near])]
    shown = plan.scatter(x[order, horizontal], x[order, vertical], c=pressure[order], s=14, cmap=COLOURS, edgecolors='0.6', linewidths=.2,
                         vmin=min(pressure.min(), 0), vmax=pressure.max() or 1)
    bar = make_axes_locatable(plan).append_axes('right', '5%', .1)
    figure.colorbar(shown, cax=bar, label=label_of(arguments.field))
    plan.set_aspect('equal')
    plan.set_xlabel('xyz'[horizontal])
    plan.set_ylabel('xyz'[vertical])
    plan.locator_params(nbins=6)
    if has_centre:
        if h:
            draw_hertz(graph, h, table, summary, r, reach)
        graph.plot(r[near], pressure[near], 'o', ms=3, color='#c0392b', label='contact nodes')
        graph.set_xlabel('distance from the centre of contact')
        graph.set_ylabel('contact pressure')
        graph.legend()
        graph.grid(alpha=.3)
    plan.set_title(summary.get('title', '') or 'contact pressure', fontsize=10, loc='left')
    figure.tight_layout()
    picture.save(figure, folder, 'pressure', TOOL)
    plt.close(figure)


def triangles_of(arc, length):
    """A triangulation of the unrolled nodes without the slivers that close its hull."""
    mesh = matplotlib.tri.Triangulation(arc, length)
    corners = np.c_[arc, length][mesh.triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    mesh.set_mask(longest > 5 * np.median(longest))
    return mesh


def middle_slice(cylinder, angle, length):
    """The nodes, by angle, in the slice of a tenth of the length around its middle, or in one that has some."""
    low, high = cylinder.length.min(), cylinder.length.max()
    middle = .5 * (low + high)
    width = max(.05 * (high - low), 1.01 * np.abs(length - middle).min())
    near = np.flatnonzero(np.abs(length - middle) <= width)
    return near[np.argsort(angle[near])]


def draw_unrolled(folder, file, name, table, cylinder, summary, field):
    pressure, angle, length = table[field], cylinder.angle, cylinder.length
    raw, smooth = table['pressure'], table['recovered_pressure']
    if cylinder.closes:
        # Most of the pressure in the middle; once around and a little more, so that the seam is closed.
        direction = (np.maximum(pressure, 0) * table['area'] * np.exp(1j * np.radians(angle))).sum()
        middle = 90. * round(np.degrees(np.angle(direction)) / 90.) if abs(direction) > 1e-2 * (np.abs(pressure) * table['area']).sum() else 0.
        middle += 360. * (middle < -90.)
        angle = middle + (angle - middle + 180.) % 360. - 180.
        for shift in (360., -360.):
            more = np.flatnonzero((np.abs(angle - middle) <= 180.) & (np.abs(angle + shift - middle) < 200.))
            angle = np.r_[angle, angle[more] + shift]
            length, pressure, raw, smooth = (np.r_[values, values[more]] for values in (length, pressure, raw, smooth))
    figure, (plan, graph) = plt.subplots(2, 1, figsize=(8, 6.4), sharex=True, gridspec_kw={'height_ratios': [1.35, 1]}, constrained_layout=True)
    mesh = triangles_of(np.radians(angle) * cylinder.radius, length)
    shown = plan.tripcolor(matplotlib.tri.Triangulation(angle, length, mesh.triangles, mesh.mask), pressure, shading='gouraud', cmap=COLOURS,
                           vmin=min(pressure.min(), 0), vmax=pressure.max() or 1)
    figure.colorbar(shown, ax=plan, label=label_of(field))
    plan.set_ylabel('length along the axis')
    plan.set_title(f'{summary.get("title", "")}\npair {name}: {cylinder.text()}'.strip(), fontsize=10)
    near = middle_slice(cylinder, angle, length)
    graph.plot(angle[near], raw[near], '.', color='#e59866', ms=4, label='at the nodes')
    graph.plot(angle[near], smooth[near], '-', color='#c0392b', lw=1.2, label='mean around each node')
    graph.set_ylim(bottom=min(0., raw[near].min()))
    graph.legend(fontsize=8)
    graph.set_xlabel(f'angle about the axis [degrees], 0 toward {cylinder.start}')
    graph.set_ylabel('pressure in the middle\nof the length')
    graph.grid(alpha=.3)
    if cylinder.closes:
        plan.set_xlim(middle - 180, middle + 180)
        graph.set_xticks(np.arange(middle - 180, middle + 181, 45))
    else:
        # Where there is pressure and as much again beside it.
        loaded = angle[pressure > 1e-6 * max(pressure.max(), 0)] if pressure.max() > 0 else angle
        room = .5 * max(np.ptp(loaded), 1e-2 * np.ptp(angle))
        plan.set_xlim(max(angle.min(), loaded.min() - room), min(angle.max(), loaded.max() + room))
    picture.save(figure, folder, file, TOOL)
    plt.close(figure)


def vector(text):
    values = [float(x) for x in text.split(',')]
    if len(values) != 3:
        raise argparse.ArgumentTypeError(f'"{text}" should be three numbers X,Y,Z')
    return values


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folder', metavar='FOLDER', help='of the results')
    parser.add_argument('--pair', metavar='NAME', help='draw this contact pair only (default all)')
    parser.add_argument('--field', choices=('pressure', 'recovered_pressure'),
                        help='the multiplier, or its mean around each node, which scatters less on tetrahedra (default: the mean where the run says that nodes scatter)')
    parser.add_argument('--centre', type=vector, metavar='X,Y,Z', help='of contact: draws the pressure over the distance from there')
    parser.add_argument('--hertz', metavar='FILE', help="JSON file with radius, centre (the origin if it is left out), E1, nu1, E2, nu2 and symmetry (the number "
                        "of copies of the model that make up the whole): draws Hertz' solution for the computed force as well")
    parser.add_argument('--no-unrolled', action='store_true', help='no pictures of cylinders unrolled')
    arguments = parser.parse_args(picture.command_line())
    summary = picture.read_summary(arguments.folder, TOOL)
    if not arguments.field:
        arguments.field = 'recovered_pressure' if any(pair.get('scatter_is_told') for pair in summary.get('pairs', [])) else 'pressure'
    table = picture.read_pressure(arguments.folder, TOOL)
    if not table:
        picture.fail(TOOL, 'there are no contact nodes in pressure.csv.')
    names = list(dict.fromkeys(table['pair']))
    if arguments.pair:
        if arguments.pair not in names:
            picture.fail(TOOL, f'there is no pair "{arguments.pair}"; the pairs are {", ".join(names)}.')
        names = [arguments.pair]
        table = {key: values[table['pair'] == arguments.pair] for key, values in table.items()}
    if arguments.hertz and not os.path.exists(arguments.hertz):
        picture.fail(TOOL, f'"{arguments.hertz}" does not exist.')
    draw_map(arguments.folder, table, summary, arguments)
    if arguments.no_unrolled:
        return
    cylinders = []
    for name in names:
        rows = {key: values[table['pair'] == name] for key, values in table.items()}
        cylinder = Cylinder(positions(rows), np.c_[rows['nx'], rows['ny'], rows['nz']], np.maximum(rows['area'], 0) + 1e-300) if len(rows['x']) > 8 else None
        if cylinder and cylinder.is_one:
            cylinders.append((name, rows, cylinder))
    for name, rows, cylinder in cylinders:
        file = 'pressure-unrolled' if len(cylinders) == 1 else 'pressure-unrolled-' + name.replace(' ', '-')
        draw_unrolled(arguments.folder, file, name, rows, cylinder, summary, arguments.field)


if __name__ == '__main__':
    main()
