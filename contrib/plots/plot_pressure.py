#!/usr/bin/python3
"""Draws pressure.csv of a result folder as pressure.png: a map of the contact pressure on the surface, seen along its mean
normal, and, where the centre of contact is given, the pressure over the distance from it.

usage: plot_pressure.py FOLDER [--centre X,Y,Z] [--hertz FILE.json]
The JSON file gives radius, centre (the origin if it does not), E1, nu1, E2, nu2, and symmetry (the number of copies of the model that make up the whole):
then Hertz' solution for the computed force is drawn as well.
"""
import argparse
import json
import math
import os

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('folder')
    parser.add_argument('--centre')
    parser.add_argument('--hertz')
    args = parser.parse_args()
    table = np.genfromtxt(os.path.join(args.folder, 'pressure.csv'), delimiter=',', names=True)
    with open(os.path.join(args.folder, 'summary.json')) as f:
        summary = json.load(f)
    table = np.atleast_1d(table)
    x = np.c_[table['x'], table['y'], table['z']]
    weight = table['area'] * np.maximum(table['pressure'], 0)
    # With symmetry planes the contact nodes are a part of the contact zone: its centre cannot be told from them.
    has_centre = args.hertz or args.centre
    fig, axes = plt.subplots(1, 2 if has_centre else 1, figsize=(11 if has_centre else 6, 4.5), squeeze=False,
                             gridspec_kw={'width_ratios': [1, 1.25] if has_centre else [1]})
    plan, ax = axes[0, 0], axes[0, -1]
    loaded = table['pressure'] > 1e-6 * max(table['pressure'].max(), 0)
    if args.hertz:
        with open(args.hertz) as f:
            h = json.load(f)
        centre = np.array(h.get('centre', [0, 0, 0]), float)
    elif args.centre:
        centre = np.array(args.centre.split(','), float)
    else:
        centre = x[loaded if loaded.any() else slice(None)].mean(0)
    r = np.linalg.norm(x - centre, axis=1)
    reach = 1.6 * r[loaded].max() if loaded.any() else r.max()
    if args.hertz:
        force = abs(summary['pairs'][0]['force'][2]) * h['symmetry']
        e_star = 1 / ((1 - h['nu1'] ** 2) / h['E1'] + (1 - h['nu2'] ** 2) / h['E2'])
        a = (3 * force * h['radius'] / (4 * e_star)) ** (1 / 3)
        p0 = 3 * force / (2 * math.pi * a ** 2)
        s = np.linspace(0, reach, 400)
        ax.plot(s, p0 * np.sqrt(np.maximum(0, 1 - (s / a) ** 2)), 'k-', lw=1.2,
                label=f'Hertz, F = {force:.4g}: a = {a:.4g}, p0 = {p0:.4g}')
        moment = 16 / (3 * math.pi) * (weight * r).sum() / weight.sum()
        print(f'F = {force:.6g}  a (moments) = {moment:.6g}  p0 (from F and a) = {3 * force / (2 * math.pi * moment ** 2):.6g}'
              f'  largest nodal pressure = {table["pressure"].max():.6g}   Hertz: a = {a:.6g}  p0 = {p0:.6g}')
    near = r <= reach
    # The plane in which the contact nodes spread most.
    directions = np.linalg.svd(x[near] - x[near].mean(0), full_matrices=False)[2]
    across = int(np.argmax(np.abs(directions[-1])))
    horizontal, vertical = [c for c in range(3) if c != across]
    points = plan.scatter(x[near, horizontal], x[near, vertical], c=table['pressure'][near], s=14, cmap='inferno_r',
                          edgecolors='0.6', linewidths=.2)
    fig.colorbar(points, ax=plan, label='contact pressure')
    plan.set_aspect('equal')
    plan.set_xlabel('xyz'[horizontal])
    plan.set_ylabel('xyz'[vertical])
    if has_centre:
        ax.plot(r[near], table['pressure'][near], 'o', ms=3, color='#c0392b', label='contact nodes')
        ax.set_xlabel('distance from the centre of contact')
        ax.set_ylabel('contact pressure')
        ax.legend()
        ax.grid(alpha=.3)
    fig.suptitle(summary.get('title', ''))
    fig.tight_layout()
    fig.savefig(os.path.join(args.folder, 'pressure.png'), dpi=150)


if __name__ == '__main__':
    main()
