#!/usr/bin/python3
"""Force, contact radius and pressure of benchmark H1 over refinement, both materials, as a markdown table.

usage: table.py PROGRAM [options of the program]
"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
# Name, block material, (F/4, a, p0) of the axisymmetric reference, the same with the gap along the normals of the block.
MATERIALS = (('M1', ('6.896e5', '0.45'), (20.820, 0.4031, 244.63), (20.8412, 0.40357, 244.39)),
             ('M2', ('7e3', '0.3'), (10.638, 0.4047, 124.01), (10.6440, 0.40505, 123.90)))


def figures(folder):
    """F/4 from the contact force, radius from moments, p0 from both (doc/verification.md, H1)."""
    with open(os.path.join(folder, 'summary.json')) as f:
        summary = json.load(f)
    force = summary['pairs'][0]['force'][2]
    with open(os.path.join(folder, 'pressure.csv')) as f:
        rows = [{k: float(row[k]) for k in ('x', 'y', 'area', 'pressure')} for row in csv.DictReader(f) if row['side'] == 'nonmortar']
    weights = [row['pressure'] * row['area'] for row in rows]
    radius = 16 / (3 * math.pi) * sum(w * math.hypot(r['x'], r['y']) for w, r in zip(weights, rows)) / sum(weights)
    return summary, (force, radius, 3 * 4 * force / (2 * math.pi * radius ** 2))


def main():
    program, options = sys.argv[1], sys.argv[2:]
    print('| material | dofs | iterations | F/4 | a | p0 | errors | errors, gap along the block\'s normals | time | memory |')
    print('|---|---|---|---|---|---|---|---|---|---|')
    for name, (young, poisson), reference, matched in MATERIALS:
        for final in (0, 1, 2):
            with tempfile.TemporaryDirectory() as folder:
                out = os.path.join(folder, 'out')
                settings = (f'Body block/Young modulus={young}', f'Body block/Poisson ratio={poisson}',
                            f'Refinement/Final global cycles={final}', 'Solver/Compare linear multigrid=false', 'Output/Verbosity=0')
                subprocess.run([program, os.path.join(HERE, 'hertz.prm'), '--output', out, *options]
                               + [a for s in settings for a in ('--set', s)], check=True)
                summary, values = figures(out)
            cycle = summary['cycles'][-1]
            errors = [' '.join(f'{100 * (v / r - 1):+.2f} %' for v, r in zip(values, ref)) for ref in (reference, matched)]
            print(f'| {name} | {cycle["dofs"]:,} | {cycle["nonlinear"]["iterations"]} | {values[0]:.4f} | {values[1]:.4f} | '
                  f'{values[2]:.2f} | {errors[0]} | {errors[1]} | {summary["wall_time_s"]:.1f} s | '
                  f'{summary["peak_memory_bytes"] / 2 ** 20:.0f} MiB |', flush=True)


if __name__ == '__main__':
    main()
