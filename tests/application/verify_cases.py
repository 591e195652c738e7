"""`signorini verify`: the built-in problems with known solutions."""
import json
import math
import os
import tempfile

from harness import check


def read_json(folder):
    with open(os.path.join(folder, 'verify.json')) as f:
        return json.load(f)


def judged(quantity):
    """Whether the bars of a quantity are met, from the errors alone."""
    errors = quantity['errors']
    orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])] if quantity['least_order'] is not None else []
    return (all(e is not None and (most is None or e <= most) for e, most in zip(errors, quantity['most'])) and
            (not orders or orders[-1] >= quantity['least_order']))


def verify(p):
    """All problems pass, from any folder, with orders on the terminal; the file says the same, and its numbers do."""
    with tempfile.TemporaryDirectory() as folder:
        run = p.call('verify', '--quick', '--json', os.path.join(folder, 'verify.json'))
        check(run.returncode == 0, f'exit code {run.returncode}\n{run.stdout}{run.stderr}')
        check(os.listdir(folder) == ['verify.json'], f'{os.listdir(folder)}')
        report = read_json(folder)
    print(run.stdout)
    lines = run.stdout.splitlines()
    n = len(report['problems'])
    check(n >= 25 and lines[-1].startswith(f'{n} of {n} problems pass') and len(lines) == n + 1, lines[-1])
    check(report['passes'] and report['quick'] and report['passed'] == n and report['failed'] == 0, 'verdict of the file')
    for problem, line in zip(report['problems'], lines):
        check(line.startswith(f'pass  {problem["name"]} '), line)
        check(problem['what'] and problem['reference'] and problem['passes'] and not problem['failures'], problem['name'])
        for quantity in problem['quantities']:
            check(quantity['name'] in line, f'{quantity["name"]} is not in: {line}')
            check(len(quantity['errors']) == len(problem['meshes']) and quantity['passes'] and judged(quantity), f'{problem["name"]}: {quantity}')
            # Nothing is measured with a bar that is always met.
            check(quantity['least_order'] is not None or any(most is not None for most in quantity['most']), f'{problem["name"]}: no bar of {quantity["name"]}')
            if quantity['least_order'] is not None:
                check(len(quantity['orders']) > 0 and f'(order {quantity["orders"][-1]:.2f})' in line, f'order of {quantity["name"]} in: {line}')
    families = {problem['name'].split('-')[0] for problem in report['problems']}
    check(families >= {'patch', 'separation', 'shells', 'press', 'manufactured', 'hertz', 'mapping', 'obstacle'}, f'{families}')


def verify_options(p):
    """Lists, selections, and what cannot be understood."""
    run = p.call('verify', '--list')
    names = [line.split()[0] for line in run.stdout.splitlines()]
    check(run.returncode == 0 and len(names) == len(set(names)) >= 25, f'{names}')
    run = p.call('verify', '--quick', '--details', 'mapping', 'separation')
    chosen = [line.split()[1] for line in run.stdout.splitlines() if line.startswith('pass')]
    check(run.returncode == 0 and chosen == [name for name in names if name.startswith(('mapping', 'separation'))], f'{chosen}')
    check('order 2.0' in run.stdout and 'reference: ' in run.stdout and 'at most 1.0e-12' in run.stdout, run.stdout)
    check('signorini verify' in p.call('--help').stdout and '--json' in p.call('verify', '--help').stdout, 'help')
    with tempfile.TemporaryDirectory() as folder:
        for arguments, word in ((['hertzz'], 'hertzz'), (['--fast'], '--fast'), (['--json'], '--json'), ([''], 'no problem ""'),
                                (['separation', '--json', os.path.join(folder, 'none', 'x.json')], 'cannot be written')):
            run = p.call('verify', *arguments)
            check(run.returncode == 1 and word in run.stderr and run.stdout == '', f'{arguments}: {run.returncode}, {run.stdout}{run.stderr}')


def verify_broken(p):
    """A program that is broken on purpose (tests/application/broken.cmake): problems that pass otherwise fail."""
    with tempfile.TemporaryDirectory() as folder:
        run = p.call('verify', '--quick', 'patch', 'press', 'corner', 'shells-lame', 'obstacle-cubes', 'hertz-spheres', '--json', os.path.join(folder, 'verify.json'))
        report = read_json(folder)
    print(run.stdout, run.stderr)
    check(run.returncode == 3, f'exit code {run.returncode}')
    failed = [problem for problem in report['problems'] if not problem['passes']]
    check(len(failed) == report['failed'] > 0 and not report['passes'], 'nothing fails')
    check(f'{report["passed"]} of {len(report["problems"])} problems pass' in run.stdout, run.stdout)
    for problem in failed:
        check(problem['failures'] and f'FAIL  {problem["name"]}' in run.stdout and problem['failures'][0] in run.stdout, problem['name'])
