"""`signorini verify`: the built-in problems with known solutions."""
import json
import math
import os
import tempfile

import browser
from harness import check
from report_cases import as_number, is_quiet, skip


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
                                (['--report'], '--report'), (['separation', '--json', os.path.join(folder, 'none', 'x.json')], 'cannot be written'),
                                (['separation', '--report', os.path.join(folder, 'none', 'x.html')], 'cannot be written')):
            run = p.call('verify', *arguments)
            check(run.returncode == 1 and word in run.stderr and run.stdout == '', f'{arguments}: {run.returncode}, {run.stdout}{run.stderr}')


# Of each problem the verdict, and the cells of its table but for the head: texts, notes (bars, orders) apart.
PROBLEMS = '''[...document.querySelectorAll('section[id^="problem-"]')].map(s => [s.querySelector('h2').textContent, [...s.querySelectorAll('tbody tr')].map(r => [...r.children].map(
  c => [[...c.childNodes].filter(n => !n.classList || !n.classList.contains('note')).map(n => n.textContent).join(''), [...c.querySelectorAll('.note')].map(n => n.textContent.trim())])),
  s.querySelectorAll('svg .line').length, [...s.querySelectorAll('li.warning')].map(e => e.textContent)])'''


def close(text, value):
    return text == '\u2013' if value is None else math.isclose(as_number(text), value, rel_tol=5.1e-3, abs_tol=0)


def page_agrees(b, report):
    """Verdict, errors, orders, bars and failures on the page are those of the numbers."""
    check(b.evaluate('document.querySelector("#verdict .verdict").className') == f'verdict {"good" if report["passes"] else "bad"}', 'verdict of the page')
    shown = b.evaluate(PROBLEMS)
    check([name for name, *_ in shown] == [p['name'] for p in report['problems']], f'problems of the page: {shown}')
    for (name, rows, n_lines, failures), problem in zip(shown, report['problems']):
        check(failures == problem['failures'], f'{name}: {failures}')
        rows = [row for row in rows if row[0][0] not in ('unknowns', 'iterations')]
        check([r[0][0] for r in rows] == [q['name'] for q in problem['quantities']], f'{name}: quantities')
        for row, q in zip(rows, problem['quantities']):
            check(row[-1][0] == ('passes' if q['passes'] else 'FAILS'), f'{name}, {q["name"]}: {row[-1]}')
            for k, (error, most) in enumerate(zip(q['errors'], q['most'])):
                text, notes = row[1 + k]
                expected = ([f'at most {most:g}'] if most is not None else []) + ([f'order {q["orders"][k - 1]:.3g}'] if k and q['least_order'] is not None else [])
                check(close(text, error) and len(notes) == len(expected), f'{name}, {q["name"]}: {row[1 + k]}, expected {error} {expected}')
                check(all(n.split()[:-1] == e.split()[:-1] and close(n.split()[-1], float(e.split()[-1])) for n, e in zip(notes, expected)), f'{name}: {notes}, expected {expected}')
        check(n_lines == sum(q['least_order'] is not None and sum((e or 0) > 0 for e in q['errors']) > 1 for q in problem['quantities']), f'{name}: {n_lines} curves')


def verify_report(p):
    """The page of --report in a browser."""
    if skip():
        return
    with tempfile.TemporaryDirectory() as folder, browser.Browser() as b:
        files = [os.path.join(folder, name) for name in ('verify.json', 'report.html')]
        run = p.call('verify', '--quick', 'manufactured-obstacle', 'mapping', 'separation', 'shells-lame', '--json', files[0], '--report', files[1])
        check(run.returncode == 0 and sorted(os.listdir(folder)) == ['report.html', 'verify.json'], f'{run.returncode}, {os.listdir(folder)}: {run.stderr}')
        b.open(files[1])
        page_agrees(b, read_json(folder))
        is_quiet(b, folder)


def verify_broken(p):
    """A program that is broken on purpose (tests/application/broken.cmake): problems that pass otherwise fail."""
    with tempfile.TemporaryDirectory() as folder:
        run = p.call('verify', '--quick', 'patch', 'press', 'corner', 'shells-lame', 'obstacle-cubes', 'hertz-spheres', '--json', os.path.join(folder, 'verify.json'),
                     '--report', os.path.join(folder, 'report.html'))
        report = read_json(folder)
        if browser.PROGRAM:
            with browser.Browser() as b:
                b.open(os.path.join(folder, 'report.html'))
                page_agrees(b, report)
    print(run.stdout, run.stderr)
    check(run.returncode == 3, f'exit code {run.returncode}')
    failed = [problem for problem in report['problems'] if not problem['passes']]
    check(len(failed) == report['failed'] > 0 and not report['passes'], 'nothing fails')
    check(f'{report["passed"]} of {len(report["problems"])} problems pass' in run.stdout, run.stdout)
    for problem in failed:
        check(problem['failures'] and f'FAIL  {problem["name"]}' in run.stdout and problem['failures'][0] in run.stdout, problem['name'])
