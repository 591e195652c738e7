#!/usr/bin/python3
"""Draws columns of curve.csv of a result folder with load steps as curve.png.

usage: plot_curve.py FOLDER [X [Y]] [--power P]
X and Y are names of columns; the first that contains the given words is taken ("t" and "load" if nothing is given). --power
draws the power law through the last point beside it, 1.5 for Hertz' contact, and prints the exponent that fits the second half.
"""
import argparse
import csv
import os
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np


def column(names, words):
    exact = [name for name in names if name == words]
    found = exact or [name for name in names if words in name]
    if not found:
        sys.exit(f'plot_curve.py: no column contains "{words}"; there are: ' + ', '.join(names))
    return found[0]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('folder')
    parser.add_argument('x', nargs='?', default='t')
    parser.add_argument('y', nargs='?', default='load')
    parser.add_argument('--power', type=float)
    args = parser.parse_args()
    path = os.path.join(args.folder, 'curve.csv')
    if not os.path.exists(path):
        sys.exit(f'plot_curve.py: "{path}" does not exist: was the problem run with load steps?')
    with open(path) as f:
        rows = list(csv.DictReader(f))
    names = list(rows[0])
    x_name, y_name = column(names, args.x), column(names, args.y)
    x, y = (np.array([float(row[name]) for row in rows]) for name in (x_name, y_name))
    fig, ax = plt.subplots(figsize=(6, 4.2))
    ax.plot(np.r_[0, x], np.r_[0, y], 'o-', ms=4, label=y_name)
    if args.power:
        s = np.linspace(0, x[-1], 200)
        ax.plot(s, y[-1] * (s / x[-1]) ** args.power, 'k--', lw=1, label=f'power {args.power:g} through the last step')
        half = slice(len(x) // 2, None)
        print(f'exponent of {y_name} over {x_name}: {np.polyfit(np.log(np.abs(x[half])), np.log(np.abs(y[half])), 1)[0]:.4f}')
    ax.set_xlabel(x_name)
    ax.set_ylabel(y_name)
    ax.legend()
    ax.grid(alpha=.3)
    fig.tight_layout()
    fig.savefig(os.path.join(args.folder, 'curve.png'), dpi=130)


if __name__ == '__main__':
    main()
