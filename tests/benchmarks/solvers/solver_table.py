#!/usr/bin/python3
"""All solvers on the example problems: iterations on every level, and the cost of the finest solve.

usage: solver_table.py PROGRAM [--large] [--tolerance T] [--repeat N] [--methods NAME,...]

Costs are those of the finest solve with its hierarchy (spaces and interpolation of the levels, Galerkin products, updates), in seconds and in sweeps (time of a Gauss-Seidel sweep in the same run,
doc/algorithm.md, chapter 16). With --repeat the smallest of each time over N runs: what others do on the machine only adds. --large refines once more: 0.4 to 0.5 million unknowns (some minutes, 2 GB).
"""
import argparse
import json
import os
import subprocess
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
METHODS = ('accelerated', 'truncated newton multigrid', 'monotone multigrid', 'active set amg')
# Name, parameter file, settings, settings of the large run.
PROBLEMS = (('patch test', 'patch_test/patch_test.prm', ('Refinement/Global cycles=3',), ('Refinement/Global cycles=4',)),
            ('M1', 'cubes/cubes.prm', (), ('Refinement/Global cycles=4',)),
            ('S1', 'obstacle/paraboloid.prm', (), ('Refinement/Global cycles=5',)),
            ('hertz', 'hertz/hertz.prm', ('Refinement/Final global cycles=1',), ()),
            ('paper', 'hertz/paper.prm', (), ()))


def solve(program, prm, settings):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        command = [program, os.path.join(TOP, 'prm', prm), '--output', out]
        for setting in ('Output/Verbosity=0', 'Output/Bodies=false', 'Output/Contact surfaces=false') + tuple(settings):
            command += ['--set', setting]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(out, 'summary.json')) as f:
            return json.load(f)


def solve_repeatedly(program, prm, settings, n):
    runs = [solve(program, prm, settings) for _ in range(n)]
    result = runs[0]
    last = result['cycles'][-1]
    for name in last['times_s']:
        last['times_s'][name] = min(run['cycles'][-1]['times_s'][name] for run in runs)
    last['sweep_time_s'] = min(run['cycles'][-1]['sweep_time_s'] for run in runs)
    for name in ('sweep_bytes_per_s', 'read_bytes_per_s'):
        last[name] = max(run['cycles'][-1][name] for run in runs)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('program')
    parser.add_argument('--large', action='store_true')
    parser.add_argument('--tolerance', default='1e-12')
    parser.add_argument('--repeat', type=int, default=1)
    parser.add_argument('--methods', default=','.join(METHODS))
    options = parser.parse_args()
    print(f'{"problem":<11}{"dofs":>9}  {"method":<28}{"iterations per level (linear multigrid, with cg)":<80}{"solve":>8}{"sweeps":>8}{"/linear":>9}{"/cg":>7}{"GB/s":>7}{"read":>6}')
    for name, prm, settings, large in PROBLEMS:
        for method in options.methods.split(','):
            s = solve_repeatedly(options.program, prm, (large if options.large else settings) + ('Output/Measure sweeps=true', f'Solver/Method={method}', f'Solver/Tolerance={options.tolerance}'),
                                 options.repeat)
            last = s['cycles'][-1]
            counts = []
            for c in s['cycles']:
                linear = f'({c["linear"]["iterations"]},{c["linear_cg"]["iterations"]})' if 'linear' in c and method != 'active set amg' else ''
                amg = f'[{c["nonlinear"].get("amg_cycles", 0)}]' if method == 'active set amg' else ''
                counts.append(f'{c["nonlinear"]["iterations"]}{linear}{amg}')
            times = last['times_s']
            time = times['solve'] + (0 if method == 'active set amg' else times['levels'] + times['hierarchy'])
            ratios = [f'{"-":>9}', f'{"-":>7}']
            if 'linear' in last and method != 'active set amg':
                setup = times['levels'] + times['linear_hierarchy']
                ratios = [f'{time / (setup + times["linear_solve"]):9.2f}', f'{time / (setup + times["linear_cg_solve"]):7.2f}']
            print(f'{name:<11}{last["dofs"]:>9}  {method:<28}{" ".join(counts):<80}{time:8.2f}{time / last["sweep_time_s"]:8.0f}{ratios[0]}{ratios[1]}{last["sweep_bytes_per_s"] / 1e9:7.1f}{last["read_bytes_per_s"] / 1e9:6.1f}', flush=True)


if __name__ == '__main__':
    main()
