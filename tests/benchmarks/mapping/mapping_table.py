#!/usr/bin/python3
"""The contact mapping beside dune-grid-glue's ContactMerge and libpsurface, as a table.

usage: mapping_table.py BUILD SURFACES [PAIR ...]

BUILD is a build folder made with -DSIGNORINI_BENCHMARKS=ON, SURFACES a folder with pairs NAME_non.off, NAME_mor.off, named
CASE_TRIANGLES. All programs run one after the other in one go, each three times; the table has the best of them.
"""
import glob
import json
import math
import os
import re
import subprocess
import sys
import tempfile

LIMIT_PSURFACE = 10000


def ours(build, non, mor):
    with tempfile.NamedTemporaryFile(suffix='.json') as f:
        subprocess.run([os.path.join(build, 'signorini-map'), non, mor, '--json', f.name], check=True)
        s = json.load(open(f.name))
    return s['time_s'], s['coverage_nonmortar'], s['peak_memory_bytes'], s['worst_tiling_defect']


def other(build, name, non, mor):
    program = os.path.join(build, name)
    if not os.path.exists(program):
        return None
    run = subprocess.run([program, non, mor], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, universal_newlines=True)
    numbers = run.stdout.split()[-3:]
    return (float(numbers[0]), float(numbers[1])) if run.returncode == 0 and len(numbers) == 3 else None


def best(results):
    results = [r for r in results if r]
    return min(results) if results else None


def main():
    build, folder = sys.argv[1:3]
    names = sys.argv[3:] or sorted((os.path.basename(f)[:-8] for f in glob.glob(os.path.join(folder, '*_non.off'))),
                                   key=lambda n: (n.rsplit('_', 1)[0], int(n.rsplit('_', 1)[1])))
    print(f'{"pair":>16} {"signorini":>11} {"coverage":>18} {"defect":>8} {"memory":>8} {"ContactMerge":>13} {"ratio":>6} '
          f'{"coverage":>18} {"psurface":>9} {"ratio":>7}')
    times = {}
    for name in names:
        non, mor = (os.path.join(folder, f'{name}_{side}.off') for side in ('non', 'mor'))
        n = int(name.rsplit('_', 1)[1])
        repeats = 3 if n < 1000000 else 2
        a = best([ours(build, non, mor) for _ in range(repeats)])
        b = best([other(build, 'bench_contact_merge', non, mor) for _ in range(repeats)])
        c = other(build, 'bench_psurface', non, mor) if n <= LIMIT_PSURFACE else None
        times.setdefault(re.sub(r'_\d+$', '', name), []).append((n, a[0]))
        row = f'{name:>16} {a[0]:9.4f} s {a[1]:18.15f} {a[3]:8.1e} {a[2] / 2**20:4.0f} MiB'
        row += f' {b[0]:11.4f} s {b[0] / a[0]:6.1f} {b[1]:18.15f}' if b else ' ' * 40
        row += f' {c[0]:7.2f} s {c[0] / a[0]:7.0f}' if c else ''
        print(row, flush=True)
    for case, rows in times.items():
        large = [r for r in rows if r[0] >= 10000]
        if len(large) > 1:
            slope = math.log(large[-1][1] / large[0][1]) / math.log(large[-1][0] / large[0][0])
            print(f'{case}: slope of log time over log n from {large[0][0]} to {large[-1][0]}: {slope:.3f}')


if __name__ == '__main__':
    main()
