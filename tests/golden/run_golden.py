#!/usr/bin/python3
"""Compares a run of an example with what is stored: meshes and active sets exactly, iterations, energies, forces.

usage: run_golden.py PROGRAM NAME [--update]
"""
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
PRM = os.path.join(HERE, '..', '..', 'prm')
# Name: parameter file, settings.
RUNS = {'patch_test': ('patch_test/patch_test.prm', ()),
        'cubes': ('cubes/cubes.prm', ()),
        'cubes_plain': ('cubes/cubes.prm', ('Solver/Method=truncated newton multigrid',)),
        'hertz': ('hertz/hertz.prm', ('Refinement/Final global cycles=1',)),
        'hertz_plain': ('hertz/hertz.prm', ('Refinement/Final global cycles=1', 'Solver/Method=truncated newton multigrid')),
        'paper': ('hertz/paper.prm', ('Refinement/Global cycles=0',)),
        # The first three meshes of the paper's first example, as many contact nodes as there.
        'paper_contact': ('hertz/paper-contact.prm', ('Refinement/Adaptive cycles=2',))}


def run(program, name):
    prm, settings = RUNS[name]
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        subprocess.run([program, os.path.join(PRM, prm), '--output', out, '--set', 'Output/Verbosity=0']
                       + [a for s in settings for a in ('--set', s)], check=True)
        with open(os.path.join(out, 'summary.json')) as f:
            s = json.load(f)
    return {'cycles': [{'cells': c['cells'], 'dofs': c['dofs'], 'contact_nodes': c['contact_nodes'],
                        'active_nodes': c['active_nodes'], 'energy': c['energy'],
                        'nonlinear': c['nonlinear']['iterations'], 'linear': c['linear']['iterations'], 'linear_cg': c['linear_cg']['iterations']}
                       for c in s['cycles']],
            'pairs': [{'force': p['force'], 'max_pressure': p['max_pressure'], 'coverage': p['coverage']} for p in s['pairs']]}


def differences(new, old, path=''):
    if isinstance(old, dict):
        for key in old:
            yield from differences(new[key], old[key], f'{path}/{key}')
    elif isinstance(old, list):
        if len(new) != len(old):
            yield f'{path}: {len(new)} entries, stored {len(old)}'
        # Components of a vector are compared on the scale of the vector.
        scale = max((abs(x) for x in old), default=0) if any(isinstance(x, float) for x in old) else None
        for i, (a, b) in enumerate(zip(new, old)):
            if scale is not None:
                if abs(a - b) > 1e-8 * scale:
                    yield f'{path}/{i}: {a!r}, stored {b!r}'
            else:
                yield from differences(a, b, f'{path}/{i}')
    elif isinstance(old, float) or isinstance(new, float):  # JSON writes 1.0 as 1
        if abs(new - old) > 1e-8 * abs(old):
            yield f'{path}: {new!r}, stored {old!r}'
    # Rounding may decide whether the last correction is below the tolerance; more would be a change.
    elif new != old and not (path.endswith(('linear', 'linear_cg')) and abs(new - old) <= 1):
        yield f'{path}: {new!r}, stored {old!r}'


def main():
    program, name = sys.argv[1:3]
    stored = os.path.join(HERE, name + '.json')
    result = run(program, name)
    if '--update' in sys.argv:
        with open(stored, 'w') as f:
            json.dump(result, f, indent=1)
            f.write('\n')
        return 0
    with open(stored) as f:
        failures = list(differences(result, json.load(f)))
    for failure in failures:
        print('CHANGED', failure)
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main())
