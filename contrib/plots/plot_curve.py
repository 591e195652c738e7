#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Draws columns of curve.csv of a result folder with load steps, one over the other: curve.png."""
import argparse
import csv
import os

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import picture  # noqa: E402

TOOL = 'plot_curve.py'


def column(names, words):
    exact = [name for name in names if name == words]
    found = exact or [name for name in names if words in name]
    if not found:
        picture.fail(TOOL, f'no column contains "{words}"; there are: ' + ', '.join(names))
    return found[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('folder', metavar='FOLDER', help='of the results')
    parser.add_argument('x', nargs='?', default='t', metavar='X', help='column, or a part of its name: the first that has it is taken (default t)')
    parser.add_argument('y', nargs='?', default='load', metavar='Y', help='the same for the vertical axis (default load)')
    parser.add_argument('--power', type=float, metavar='P', help="draws the power law through the last point beside it, 1.5 for Hertz' contact, and prints the "
                        'exponent that fits the second half')
    arguments = parser.parse_args()
    path = os.path.join(arguments.folder, 'curve.csv')
    if not os.path.exists(path):
        picture.fail(TOOL, f'"{path}" does not exist: was the problem run with load steps?')
    with open(path, newline='') as f:
        rows = list(csv.DictReader(f))
    if not rows:
        picture.fail(TOOL, f'"{path}" has no rows.')
    names = list(rows[0])
    x_name, y_name = column(names, arguments.x), column(names, arguments.y)
    x, y = (np.array([float(row[name]) for row in rows]) for name in (x_name, y_name))
    figure, axes = plt.subplots(figsize=(6, 4.2))
    axes.plot(np.r_[0, x], np.r_[0, y], 'o-', ms=4, label=y_name)
    if arguments.power:
        s = np.linspace(0, x[-1], 200)
        axes.plot(s, y[-1] * (s / x[-1]) ** arguments.power, 'k--', lw=1, label=f'power {arguments.power:g} through the last step')
        half = slice(len(x) // 2, None)
        print(f'exponent of {y_name} over {x_name}: {np.polyfit(np.log(np.abs(x[half])), np.log(np.abs(y[half])), 1)[0]:.4f}')
    axes.set_xlabel(x_name)
    axes.set_ylabel(y_name)
    axes.legend()
    axes.grid(alpha=.3)
    picture.save(figure, arguments.folder, 'curve', TOOL)
    plt.close(figure)


if __name__ == '__main__':
    main()
