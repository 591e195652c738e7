#!/usr/bin/python3
"""Times CalculiX (Debian package calculix-ccx) on benchmark H1, material M1, beside Signorini at about the same size.

usage: hertz_calculix.py MESH.npz SIGNORINI HERTZ.prm [WORKDIR]
MESH.npz is the mesh of H1 that other programs were run on (doc/verification.md; 51,735 unknowns): arrays X (nodes),
E (hexahedra), body, F and T (boundary faces and their tags: 11 ball candidate, 13 ball top, 14 ball x = 0, 15 ball y = 0,
21 block candidate, 23 block bottom, 24, 25 block x = 0, y = 0). Prints CPU seconds, peak memory and the force of both.
"""
import json
import os
import re
import resource
import subprocess
import sys
import tempfile

import numpy as np

FACES = ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))


def write_input(mesh, path):
    """Surface-to-surface penalty contact, C3D8, linear geometry. CalculiX reads at most 20 characters of a number."""
    x, cells, body, faces, tags = (mesh[k] for k in ('X', 'E', 'body', 'F', 'T'))
    side = {}
    for e, cell in enumerate(cells):
        for s, f in enumerate(FACES):
            side[tuple(sorted(cell[list(f)]))] = (e + 1, s + 1)
    nodes = {t: np.unique(faces[tags == t]) + 1 for t in np.unique(tags)}
    with open(path, 'w') as f:
        def lines(values):
            for v in values:
                f.write(f'{v},\n')
        f.write('*NODE, NSET=ALL\n')
        for i, p in enumerate(x):
            f.write(f'{i + 1},{p[0]:.12g},{p[1]:.12g},{p[2]:.12g}\n')
        for b, name in ((body.min(), 'BALL'), (body.max(), 'BLOCK')):
            f.write(f'*ELEMENT, TYPE=C3D8, ELSET={name}\n')
            for e in np.where(body == b)[0]:
                f.write(f'{e + 1},' + ','.join(str(n + 1) for n in cells[e]) + '\n')
        for t, n in nodes.items():
            f.write(f'*NSET, NSET=N{t}\n')
            lines(n)
        for t, name in ((11, 'SLAVE'), (21, 'MASTER')):
            f.write(f'*SURFACE, NAME={name}, TYPE=ELEMENT\n')
            for face in faces[tags == t]:
                e, s = side[tuple(sorted(face))]
                f.write(f'{e},S{s}\n')
        for name, young, poisson in (('BALL', 7e3, .3), ('BLOCK', 6.896e5, .45)):
            f.write(f'*MATERIAL, NAME=M{name}\n*ELASTIC\n{young},{poisson}\n*SOLID SECTION, ELSET={name}, MATERIAL=M{name}\n')
        f.write('*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n7.E6\n'
                '*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n'
                '*BOUNDARY\nN14,1,1\nN24,1,1\nN15,2,2\nN25,2,2\nN23,1,3\n'
                '*STEP\n*STATIC\n1.,1.\n*BOUNDARY\nN13,1,2,0.\nN13,3,3,-0.02\n'
                '*NODE PRINT, NSET=N23, TOTALS=ONLY\nRF\n*END STEP\n')


def measure(command, **options):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, **options)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    mesh, program, prm = sys.argv[1:4]
    folder = sys.argv[4] if len(sys.argv) > 4 else tempfile.mkdtemp()
    write_input(np.load(mesh), os.path.join(folder, 'h1.inp'))
    environment = dict(os.environ, OMP_NUM_THREADS='1', CCX_NPROC_EQUATION_SOLVER='1', CCX_NPROC_RESULTS='1')
    ours = []
    for k in range(3):
        out = os.path.join(folder, 'signorini')
        ours.append(measure([program, prm, '--output', out, '--set', 'Refinement/Final global cycles=1', '--set',
                             'Solver/Compare linear multigrid=false', '--set', 'Output/Verbosity=0']))
    with open(os.path.join(out, 'summary.json')) as f:
        s = json.load(f)
    print(f'Signorini: {s["cycles"][-1]["dofs"]} unknowns, CPU {min(ours):.2f} s (of {", ".join(f"{t:.2f}" for t in ours)}), '
          f'{s["peak_memory_bytes"] / 2 ** 20:.0f} MiB, F/4 = {s["pairs"][0]["force"][2]:.4f}', flush=True)
    with open(os.path.join(folder, 'ccx.log'), 'w') as log:
        theirs = measure(['/usr/bin/time', '-v', '-o', os.path.join(folder, 'ccx.time'), 'ccx', 'h1'], cwd=folder,
                         env=environment, stdout=log)
    with open(os.path.join(folder, 'ccx.time')) as f:
        memory = int(re.search(r'Maximum resident set size.*: (\d+)', f.read()).group(1)) / 1024
    with open(os.path.join(folder, 'h1.dat')) as f:
        force = float(f.read().split()[-1])
    print(f'CalculiX: {3 * len(np.load(mesh)["X"])} unknowns, CPU {theirs:.1f} s, {memory:.0f} MiB, F/4 = {abs(force):.4f}')
    print(f'ratio of CPU times: {theirs / min(ours):.1f}')


if __name__ == '__main__':
    main()
