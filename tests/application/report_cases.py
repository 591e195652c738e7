"""report.html in a browser: what it shows, that it asks for nothing, and that the pictures move. Skipped without Chromium."""
import csv
import json
import math
import os
import re
import subprocess
import tempfile
import urllib.parse

import browser
from harness import TOP, check

HERTZ = os.path.join(TOP, 'prm', 'hertz', 'hertz.prm')
OBSTACLE = os.path.join(TOP, 'prm', 'obstacle', 'paraboloid.prm')
RESTING = os.path.join(TOP, 'prm', 'obstacle', 'resting.prm')
PATCH_TEST = os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm')

# A driver in software says how slow it is when a picture is taken.
SLOW_DRIVER = re.compile('GPU stall due to ReadPixels')

# The canvas of a panel as numbers: how many colours it has, and a sum that changes with the picture.
LOOK = '''(selector => {
  const from = document.querySelector(selector + ' canvas'), to = document.createElement('canvas');
  to.width = 160; to.height = 120;
  const pen = to.getContext('2d');
  pen.drawImage(from, 0, 0, 160, 120);
  const data = pen.getImageData(0, 0, 160, 120).data, colours = new Set();
  let sum = 0;
  for (let i = 0; i < data.length; i += 4) {
    const c = (data[i] << 16) + (data[i + 1] << 8) + data[i + 2];
    colours.add(c);
    sum = (31 * sum + c) % 2147483647;
  }
  return [colours.size, sum];
})'''

# Points of a picture with colours from the upper half of the scale: green to yellow, neither the axes nor white.
BRIGHT = LOOK.replace('colours.add(c)', 'if (data[i + 1] > 85 && data[i + 2] < data[i + 1] && data[i] < 250) colours.add(i)')

NUMBERS = '''[...document.querySelectorAll('[data-key]')].map(e => [e.dataset.key, e.dataset.value, e.textContent])'''


def run(p, folder, *arguments, code=0):
    out = os.path.join(folder, 'out')
    result = p.call(*arguments, '--output', out)
    check(result.returncode == code, f'{arguments}: exit code {result.returncode}: {result.stderr}')
    return out


def skip():
    if browser.PROGRAM is None:
        print('SKIPPED: chromium is not installed')
    return browser.PROGRAM is None


def entry(summary, path):
    for key in path.split('.'):
        if summary is None:
            return None
        summary = summary[int(key)] if isinstance(summary, list) else summary.get(key)
    return summary


def as_number(text):
    """The number that a page shows, or None for a dash."""
    text = text.replace('\u202f', '').replace('\u2212', '-')
    return None if text == '\u2013' else float(text)


def numbers_agree(b, out):
    """All numbers of the page are those of summary.json, to the digit in what it keeps and to five (three) in what it shows."""
    with open(os.path.join(out, 'summary.json')) as f:
        summary = json.load(f)
    shown = b.evaluate(NUMBERS)
    check(len(shown) > 60, f'{out}: only {len(shown)} numbers')
    for path, value, text in shown:
        expected = entry(summary, path)
        if value in (None, 'undefined'):
            check(expected is None, f'{path} is not shown')
            continue
        check(json.loads(value) == expected, f'{path}: {value}, expected {expected}')
        if isinstance(expected, list):
            shown_numbers = [as_number(t) for t in text.strip('()').split(', ')]
        elif isinstance(expected, (int, float)) and not isinstance(expected, bool):
            shown_numbers, expected = [as_number(text)], [expected]
        else:
            continue
        check(all(math.isclose(s, e, rel_tol=5.1e-3) for s, e in zip(shown_numbers, expected)), f'{path}: {text}, expected {expected}')
    return summary, {path for path, _, _ in shown}


def is_quiet(b, out):
    path = os.path.realpath(os.path.join(out, 'report.html'))
    messages = [m for m in b.messages if not SLOW_DRIVER.search(m)]
    check(not messages, f'{out}: the console says {messages}')
    check([r for r in b.requests if not r.startswith('data:')] == ['file://' + urllib.parse.quote(path)], f'{out}: the page asks for {b.requests}')


def moves(b, panel, action):
    """Whether a picture is no plain surface, and changes."""
    b.rest()
    colours, before = b.evaluate(f'{LOOK}("{panel}")')
    check(colours > 20, f'{panel} has {colours} colours')
    action()
    b.rest()
    after = b.evaluate(f'{LOOK}("{panel}")')[1]
    check(before != after, f'{panel} does not change')


def slide(b, panel, name, value):
    b.evaluate(f'(e => {{ e.value = {value}; e.dispatchEvent(new Event("input")); }})(document.querySelector("{panel} input.{name}"))')


def report_hertz(p):
    if skip():
        return
    with tempfile.TemporaryDirectory() as folder, browser.Browser() as b:
        units = [f'Output/{k} unit={v}' for k, v in (('Length', 'mm'), ('Force', 'N'), ('Stress', '<b>MPa</script>'))]
        out = run(p, folder, HERTZ, '--set', 'Refinement/Final global cycles=0', *[a for u in units for a in ('--set', u)],
                  '--set', 'Title=A "title" with <i>marks</i> & </script><script>alert(1)</script>')
        size = os.path.getsize(os.path.join(out, 'report.html'))
        check(size < 5e6, f'the report has {size} bytes')
        b.open(os.path.join(out, 'report.html'))
        summary, paths = numbers_agree(b, out)
        for path in ('pairs.0.max_pressure', 'bodies.1.largest_von_mises', 'cycles.0.linear.iterations', 'mappings.0.coverage_nonmortar', 'certificate.equilibrium',
                     'wall_time_s', 'pairs.0.centre_of_pressure', 'boundaries.0.reaction'):
            check(path in paths, f'{path} is not on the page')
        check(b.evaluate('document.querySelector("h1").textContent') == summary['title'] == 'A "title" with <i>marks</i> & </script><script>alert(1)</script>', 'title')
        check('[<b>MPa</script>]' in b.evaluate('document.querySelector(".legend b").textContent'), 'the unit is not on the scale')
        check(b.evaluate('document.querySelector(".verdict").className') == 'verdict good', 'verdict')
        # Both pictures have the same deformation.
        for panel, deformation in (('#contact-panel', 4), ('#bodies-panel', 0)):
            moves(b, panel, lambda: b.drag(f'{panel} canvas', 120, 40))
            moves(b, panel, lambda: slide(b, panel, 'deformation', deformation))
        for choice in ('displacement length', 'pressure', 'gap', 'von_Mises'):
            moves(b, '#bodies-panel', lambda: b.evaluate(f'(e => {{ e.value = "{choice}"; e.dispatchEvent(new Event("change")); }})(document.querySelector("#bodies-panel select"))'))
        moves(b, '#bodies-panel', lambda: b.evaluate('document.querySelector("#bodies-panel input[data-body]").click()'))
        # Through the corner of a quarter of the zone: lines in other directions only touch it there.
        pieces = b.evaluate('[...document.querySelectorAll(".profiles svg.chart .line")].map(e => (e.getAttribute("d") || "").split("M").length - 1)')
        check(len(pieces) >= 2 and min(pieces) > 5, f'pressure over a line: {pieces} pieces')
        is_quiet(b, out)
    with tempfile.TemporaryDirectory() as folder, browser.Browser(webgl=False) as b:
        out = run(p, folder, HERTZ, '--set', 'Refinement/Global cycles=0', '--set', 'Refinement/Final global cycles=0')
        b.open(os.path.join(out, 'report.html'))
        numbers_agree(b, out)
        check(b.evaluate('document.querySelectorAll(".without-webgl").length') == 2, 'without WebGL there is no word about it')
        out = run(p, folder, PATCH_TEST, '--set', 'Output/Report=false')
        check(not os.path.exists(os.path.join(out, 'report.html')), 'a report that is not wanted')


def shown_pressure(b):
    """What the picture of the contact surfaces begins with."""
    return b.evaluate('[...document.querySelectorAll("#contact-panel select")].find(e => [...e.options].some(o => o.value === "gap")).value')


def told(out):
    """Whether the run says that pressures scatter."""
    with open(os.path.join(out, 'summary.json')) as f:
        return any(pair['scatter_is_told'] for pair in json.load(f)['pairs'])


def report_kinds(p):
    """Load steps, an obstacle, a tied pair, separated bodies, a run that did not converge."""
    if skip():
        return
    with tempfile.TemporaryDirectory() as folder, browser.Browser() as b:
        steps = run(p, folder, HERTZ, '--set', 'Refinement/Global cycles=1', '--set', 'Refinement/Final global cycles=0', '--set', 'Load steps=3',
                    '--set', 'Body ball/Dirichlet=symmetry x: (0, *, *); symmetry y: (*, 0, *); top: (0, 0, -0.06*t)')
        check(not [n for n in os.listdir(steps) if n.startswith('report-step')], 'files of steps are left')
        b.open(os.path.join(steps, 'report.html'))
        numbers_agree(b, steps)
        for panel in ('#contact-panel', '#bodies-panel'):
            moves(b, panel, lambda: slide(b, panel, 'state', 0))
            slide(b, panel, 'state', 2)
        with open(os.path.join(steps, 'curve.csv')) as f:
            rows = list(csv.reader(f))
        shown = b.evaluate('[...document.querySelectorAll("table.curve tr")].map(r => [...r.children].map(c => c.textContent))')
        check(shown[0] == rows[0] and len(shown) == 4, 'the curve has other columns')
        check(all(math.isclose(as_number(s), float(e), rel_tol=1e-4) for a, c in zip(shown[1:], rows[1:]) for s, e in zip(a, c)), 'the curve has other numbers')
        is_quiet(b, steps)
        begins_with = {'pressure': [], 'recovered_pressure': []}
        others = [(0, 'obstacle', [OBSTACLE]), (0, 'tied', [PATCH_TEST, '--set', 'Pair interface/Contact=tied']),
                  (0, 'separated', [PATCH_TEST, '--set', 'Body upper/Dirichlet=top: (0, 0, 0.01)']),
                  (0, 'on tetrahedra', [RESTING, '--set', 'Body cube/Convert to tetrahedra=true']),
                  (1, 'not converged', [HERTZ, '--set', 'Refinement/Global cycles=1', '--set', 'Refinement/Final global cycles=0', '--set', 'Solver/Maximal iterations=2', '--set', 'Solver/Safety net=false'])]
        for code, name, arguments in others:
            place = os.path.join(folder, name)
            os.mkdir(place)
            out = run(p, place, *arguments, code=code)
            b.open(os.path.join(out, 'report.html'))
            numbers_agree(b, out)
            is_quiet(b, out)
            check(('bad' in b.evaluate('document.querySelector(".verdict").className')) == (code == 1), f'{name}: verdict')
            begins_with[shown_pressure(b)].append(told(out))
            moves(b, '#bodies-panel', lambda: b.drag('#bodies-panel canvas', 100, 30))
        check(begins_with == {'pressure': [False] * len(begins_with['pressure']), 'recovered_pressure': [True] * len(begins_with['recovered_pressure'])}
              and all(begins_with.values()), f'whether scatter is told where pictures begin with a pressure: {begins_with}')
        # One looks into a bore, not at the unloaded half of it from behind.
        settings = ['eye/Mesh=tube', 'eye/Convert to tetrahedra=false', 'eye/Round divisions=3, 44, 5', 'eye/Dirichlet=outer: (0, -0.05, 0)', 'pin/Mesh=tube', 'pin/Round divisions=2, 36, 4']
        bore = run(p, folder, os.path.join(TOP, 'tests', 'application', 'eye.prm'), '--set', 'Pair bearing/First region=1', *[a for s in settings for a in ('--set', f'Body {s}')])
        b.open(os.path.join(bore, 'report.html'))
        b.rest()
        bright = b.evaluate(f'{BRIGHT}("#contact-panel")')[0]
        check(bright > 100, f'{bright} points of the picture show pressure')
        is_quiet(b, bore)


def report_ranks(p):
    """The pictures do not depend on the number of ranks: elements of the page but times, to rounding."""
    pages = []
    with tempfile.TemporaryDirectory() as folder:
        for program in (p, type(p)(p.command[-1], 1)):
            out = run(program, folder, HERTZ, '--set', 'Refinement/Global cycles=1', '--set', 'Refinement/Final global cycles=0', '--set', 'Load steps=2')
            with open(os.path.join(out, 'report.html'), encoding='utf8') as f:
                pages.append(dict(re.findall(r'<script type="[a-z/]*" id="([a-zA-Z0-9_-]*)"[^>]*>([^<]*)<', f.read())))
    check(set(pages[0]) == set(pages[1]) and 'body-1-triangles' in pages[0], f'other elements: {set(pages[0]) ^ set(pages[1])}')
    for name in pages[0]:
        if name == 'scene' or re.fullmatch(r'(body|side)-\d-(points|triangles)', name):
            check(pages[0][name] == pages[1][name], f'{name} depends on the ranks')
