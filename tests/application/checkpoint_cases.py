"""Runs that are killed and go on (doc/output.md, interrupted runs).

SIGNORINI_KILLS=50 run_case.py PROGRAM killed_and_resumed 1 has as many runs as are wanted, SIGNORINI_KILL_SEED others,
SIGNORINI_KILL_RANKS="1 2 3 4" other numbers of ranks.
"""
import csv
import json
import os
import random
import re
import shutil
import signal
import subprocess
import tempfile
import time

from geometry_cases import HERTZ_ADAPTIVE
from harness import TOP, Program, check
from heat_cases import STRAPS
from tool_cases import signals_as_usual, wait_until

HERTZ = os.path.join(TOP, 'prm', 'hertz', 'hertz.prm')
PATCH_TEST = os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm')
POINTS = 'a: (0, 0, 0.01); b: (1, 0, 1); c: (0, 1, 2); d: (2, 3, 4); e: (0, 0, 7)'
ADAPTIVE = HERTZ_ADAPTIVE + ['Refinement/Global cycles=0', f'Body ball/Probes={POINTS}']
DOWN = 'Body ball/Dirichlet=symmetry x: (0, *, *); symmetry y: (*, 0, *); top: (0, 0, -0.02*t)'
TETRAHEDRA = 'Convert to tetrahedra=true'
STAMP = ['Body upper/Dirichlet=', 'Body upper/Rigid=top: force (0, 0, -2.5*t^2), displacement (0, 0, *), moment (0, 0.1*t^2, 0), rotation (0, *, 0)',
         'Body upper/Probes=a: (0.2, 0.3, 0.9); b: (1, 1, 0.1)', 'Body lower/Dirichlet=bottom: (0, 0, 0)']
# Name, parameter file (or its text) and settings.
CASES = [
    ('hexahedra', HERTZ, ADAPTIVE + ['Refinement/Adaptive cycles=7', 'Refinement/Max dofs=20000']),
    ('tetrahedra', HERTZ, ADAPTIVE + [f'Body ball/{TETRAHEDRA}', f'Body block/{TETRAHEDRA}', 'Refinement/Adaptive cycles=6', 'Refinement/Max dofs=15000']),
    ('both kinds and steps', HERTZ, ADAPTIVE + [f'Body block/{TETRAHEDRA}', DOWN, 'Refinement/Adaptive cycles=4', 'Refinement/Final global cycles=1',
                                                'Load steps=6']),
    ('bolts and steps', STRAPS, ['Load steps=5', 'Refinement/Global cycles=1', 'Solver/Compare linear multigrid=false',
                                 'Body left/Pretension=strap: region 0.25 - z^2, axis (0, 0, 1), force 3*t, locked after 0.4',
                                 'Body upper/Probes=a: (1, 1, 0.5); b: (3, 0, 1)']),
    ('stamp and steps', PATCH_TEST, STAMP + ['Load steps=0.2, 0.5, 0.7, 1.1, 2', 'Refinement/Adaptive cycles=3']),
]
# What depends on the machine, the number of ranks or the order of sums.
UNEQUAL = {'ranks', 'wall_time_s', 'peak_memory_bytes', 'times_s', 'idle_s', 'sweep_time_s', 'sweep_bytes_per_s', 'read_bytes_per_s', 'history', 'rate', 'difference',
           'time_s', 'worst_tiling_defect', 'hierarchy_updates'}
# They depend on how fast the iteration was, and so a little on the number of ranks.
LESSONS = ('needed_interface_sweeps', 'needed_patches')
# Residuals, that consist of rounding.
SMALL = {'penetration', 'tension', 'complementarity', 'equilibrium', 'force_balance', 'moment_balance', 'body_force_balance', 'body_moment_balance'}
TOLERANCE = 1e-9


def compare(a, b, path, scale=0.):
    """Numbers relative to the largest of their list (or to a scale for what is zero but for rounding)."""
    if isinstance(a, dict):
        check(a.keys() == b.keys(), f'{path}: {sorted(a)} and {sorted(b)}')
        lengths = [abs(x) for key in ('force', 'load', 'reaction', 'contact_force') for x in (a.get(key) if isinstance(a.get(key), list) else [a.get(key)])
                   if isinstance(x, (int, float))]
        for key in a.keys() & b.keys():
            # Places of largest values: symmetric bodies have several.
            if key not in UNEQUAL and not key.endswith('_at'):
                compare(a[key], b[key], f'{path}/{key}', 1e-7 / TOLERANCE if key in SMALL else max(lengths, default=0.))
    elif isinstance(a, list):
        check(len(a) == len(b), f'{path}: {len(a)} and {len(b)} entries')
        numbers = [abs(x) for x in a if isinstance(x, (int, float))]
        for i, (x, y) in enumerate(zip(a, b)):
            compare(x, y, f'{path}/{i}', max(numbers + [scale]))
    elif isinstance(a, float) or isinstance(b, float):
        # Gaps and slips come from displacements of the order 1e-2 to 1.
        check(abs(a - b) <= TOLERANCE * max(abs(a), scale, 1e-2), f'{path}: {a!r} and {b!r}')
    else:
        check(a == b, f'{path}: {a!r} and {b!r}')


def table(path):
    """Its numbers, without those of nodes, which depend on the ranks; the two sides as 0 and 1."""
    with open(path, newline='') as f:
        rows = list(csv.DictReader(f))
    return [{k: float(v == 'mortar' if k == 'side' else v) for k, v in row.items() if k not in ('node', 'pair')} for row in rows]


def compare_tables(a, b, name, keys):
    a, b = (sorted(table(os.path.join(folder, name)), key=lambda row: [round(row[k], 7) for k in keys]) for folder in (a, b))
    check(len(a) == len(b), f'{name}: {len(a)} and {len(b)} rows')
    for column in a[0]:
        if column == 'iterations':
            continue
        largest = max(abs(row[column]) for row in a)
        for x, y in zip(a, b):
            check(abs(x[column] - y[column]) <= TOLERANCE * max(largest, 1e-2), f'{name}, {column}: {x[column]!r} and {y[column]!r}')


def solutions(folder):
    """The nonlinear solutions of the cycles."""
    with open(os.path.join(folder, 'summary.json')) as f:
        return [c['nonlinear'] for c in json.load(f)['cycles']]


def counts(folder):
    """Iterations of cycles and of steps."""
    curve = os.path.join(folder, 'curve.csv')
    return [s['iterations'] for s in solutions(folder)], [int(row['iterations']) for row in table(curve)] if os.path.exists(curve) else []


def lessons(folder, cycle):
    """What the solver has learnt until then, which goes on from mesh to mesh and into checkpoints: what was needed where it was slow."""
    return [{key: s[key] for key in LESSONS} for s in solutions(folder)[:cycle + 1]][-1]


def files(folder):
    """Names without those of pieces, of which each rank writes one."""
    return {name for name in os.listdir(folder) if not re.search(r'\.\d+\.vtu$', name)}


def compare_results(a, b):
    summaries = []
    for folder in (a, b):
        with open(os.path.join(folder, 'summary.json')) as f:
            summaries.append(json.load(f))
        for cycle in summaries[-1]['cycles']:
            for solver in ('nonlinear', 'linear', 'linear_cg'):
                if solver in cycle:
                    cycle[solver].pop('iterations')
            for key in ('start_iterations', *LESSONS):
                cycle['nonlinear'].pop(key, None)
        for bolt in summaries[-1].get('pretension', []):
            bolt.pop('iterations')
    compare(*summaries, 'summary.json')
    compare_tables(a, b, 'pressure.csv', ('side', 'x', 'y', 'z'))
    if os.path.exists(os.path.join(a, 'curve.csv')):
        compare_tables(a, b, 'curve.csv', ('t',))
    check(files(a) == files(b), f'files: {files(a) ^ files(b)}')
    for name in files(b):
        if name.endswith(('.pvtu', '.pvd')):
            with open(os.path.join(b, name)) as f:
                pieces = re.findall(r'(?:Source|file)="([^"]*)"', f.read())
            for piece in pieces:
                check(os.path.exists(os.path.join(b, piece)), f'{name}: {piece} is missing')


def descendants(process):
    parents = {}
    for name in os.listdir('/proc'):
        if name.isdigit():
            try:
                with open(f'/proc/{name}/stat') as f:
                    parents.setdefault(int(f.read().rsplit(')', 1)[1].split()[1]), []).append(int(name))
            except OSError:
                pass
    found, new = [], [process]
    while new:
        new = [child for parent in new for child in parents.get(parent, [])]
        found += new
    return found


def kill(run, how):
    """SIGKILL for all of a run that was started here, or for one rank."""
    below = descendants(run.pid)
    try:
        for process in below[-1:] if how == 'one' and below else [run.pid] + below:
            os.kill(process, signal.SIGKILL)
    except ProcessLookupError:
        pass
    run.communicate(timeout=60)
    # Ranks whose mpirun is gone end a little later.
    for _ in range(200):
        if not any(os.path.exists(f'/proc/{process}/exe') and state(process) != 'Z' for process in below):
            break
        time.sleep(.05)


def state(process):
    try:
        with open(f'/proc/{process}/stat') as f:
            return f.read().rsplit(')', 1)[1].split()[0]
    except OSError:
        return 'Z'


class Case:
    """A problem with its results when nothing interrupts it, by number of ranks."""

    def __init__(self, program, folder, name, prm, settings):
        self.program, self.folder, self.name = program, folder, name
        self.prm = prm
        if '\n' in prm:
            self.prm = os.path.join(folder, name.replace(' ', '-') + '.prm')
            with open(self.prm, 'w') as f:
                f.write(prm)
        self.settings = settings
        self.references, self.times, self.n_kills, self.n_resumed = {}, {}, 0, 0

    def arguments(self, out, *more):
        return [*more, self.prm, '--output', out] + [x for s in self.settings + ['Output/Checkpoint=always', 'Output/Measure sweeps=false'] for x in ('--set', s)]

    def reference(self, ranks):
        if ranks not in self.references:
            out = os.path.join(self.folder, f'{self.name} {ranks}')
            begin = time.time()
            run = Program(self.program, ranks, served=False).call(*self.arguments(out))
            self.times[ranks] = time.time() - begin
            if run.returncode != 0:
                raise SystemExit(f'{self.name}, {ranks} ranks: exit code {run.returncode}: {run.stdout} {run.stderr}')
            check(not os.path.exists(out + '.checkpoint'), f'{self.name}: a checkpoint is left')
            self.references[ranks] = out
        return self.references[ranks]

    def killed(self, chance, n_ranks):
        """One run that is killed until it ends; returns what happened."""
        out = os.path.join(self.folder, 'out')
        ranks = chance.choice(n_ranks)
        story, who = [], []
        resume = False
        for attempt in range(20):
            self.reference(ranks)
            p = Program(self.program, ranks)
            run = subprocess.Popen(p.command + self.arguments(out, *(['--resume'] if resume else [])), env=p.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, universal_newlines=True, preexec_fn=signals_as_usual)
            # The first one is killed for sure, the others half of the time.
            delay = chance.uniform(.05, .95) * self.times[ranks]
            text, begin = '', time.time()
            if attempt == 0 or chance.random() < .5:
                try:
                    text, errors = run.communicate(timeout=delay)
                except subprocess.TimeoutExpired:
                    how = chance.choice(('all', 'one'))
                    kill(run, how)
                    story.append(f'{ranks} ranks killed ({how}) after {delay:.2f} s')
                    self.n_kills += 1
                    run.returncode = None
            else:
                text, errors = run.communicate(timeout=500)
            if text:
                last = re.search(r'goes on after cycle (\d+)(?: and step (\d+))?', text)
                who.append((ranks, last and (int(last[1]), int(last[2] or 0))))
            if run.returncode is not None:
                check(run.returncode == 0, f'{self.name}, {story}: exit code {run.returncode}: {errors}')
                if run.returncode == 0:
                    # The machine may have been busy when it was measured.
                    self.times[ranks] = min(self.times[ranks], time.time() - begin)
                    story.append(f'{ranks} ranks to the end' + (f' from {who[-1][1]}' if who[-1][1] else ''))
                    self.n_resumed += who[-1][1] is not None
                    self.judge(out, who[-1], story)
                    break
                return story
            resume = os.path.exists(out + '.checkpoint/state')
            ranks = chance.choice([n for n in n_ranks if n != ranks])
        # A rank may end later than the next run begins, which then leaves its folder to another.
        for name in os.listdir(self.folder):
            if name.startswith('out.part-'):
                shutil.rmtree(os.path.join(self.folder, name))
        left = [name for name in os.listdir(self.folder) if name.startswith('out')]
        check(left == ['out'], f'{self.name}, {story}: left {left}')
        shutil.rmtree(out, ignore_errors=True)
        return story

    def judge(self, out, last, story):
        from harness import FAILURES
        before = len(FAILURES)
        ranks, place = last
        reference = self.reference(ranks)
        compare_results(reference, out)
        # From where the last run went on its iterations are those of a run without an interruption, if the other number of
        # ranks has taught the solver the same.
        (cycles, steps), (cycles_now, steps_now) = counts(reference), counts(out)
        first_cycle, first_step = (place[0] + 1, place[1]) if place else (0, 0)
        has_learnt_else = place and lessons(reference, place[0]) != lessons(out, place[0])
        allowed = 2 if has_learnt_else else 0
        check(all(abs(a - b) <= allowed for a, b in zip(cycles[first_cycle:], cycles_now[first_cycle:])),
              f'iterations from cycle {first_cycle}: {cycles} and {cycles_now}, the solver has learnt {"other things" if has_learnt_else else "the same"}')
        # The first step starts where another number of ranks came to rest, a little elsewhere within the tolerance, and the last correction of one of the
        # next may be just below or just above it (seen: 1.3e-12 of an iterate of 1.3).
        allowed = 1 if place else 0
        check(len(steps) == len(steps_now) and all(abs(a - b) <= allowed for a, b in zip(steps[first_step:-1], steps_now[first_step:-1])),
              f'iterations from step {first_step}: {steps} and {steps_now}')
        FAILURES[before:] = [f'{self.name}, {story}: {text}' for text in FAILURES[before:]]


    def stopped(self, ranks):
        """A run that ends after each cycle and each step; returns how often."""
        out = os.path.join(self.folder, 'out')
        for attempt in range(40):
            n = ranks[attempt % len(ranks)]
            run = Program(self.program, n).call(*self.arguments(out, *(['--resume'] if attempt else [])), '--set', 'Output/Wall time limit=0.01')
            if run.returncode == 0:
                break
            check(run.returncode == 4, f'{self.name}: exit code {run.returncode}: {run.stderr}')
            check('Go on with --resume' in run.stderr and 'Wall time limit' in run.stderr, f'{self.name}: {run.stderr}')
            check(not os.path.exists(out) and os.path.exists(out + '.checkpoint/state'), f'{self.name}: {os.listdir(self.folder)}')
        place = re.search(r'goes on after cycle (\d+)(?: and step (\d+))?', run.stdout)
        self.judge(out, (n, place and (int(place[1]), int(place[2] or 0))), f'{attempt} stops')
        left = [name for name in os.listdir(self.folder) if name.startswith('out')]
        check(left == ['out'], f'{self.name}: left {left}')
        shutil.rmtree(out, ignore_errors=True)
        return attempt


def stopped_and_resumed(p):
    """The wall time limit after each cycle and each step, and on with another number of ranks: every place where a state is saved."""
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            one = Case(p.command[-1], folder, *case)
            begin = time.time()
            n = one.stopped([1, 2])
            cycles, steps = counts(one.reference(1))
            print(f'{case[0]}: {n} stops, {len(cycles)} cycles, {len(steps)} steps, {time.time() - begin:.1f} s')
            # But where only results are left to be written.
            check(n == len(cycles) - 1 + max(0, len(steps) - 1), f'{case[0]}: {n} stops, {len(cycles)} cycles, {len(steps)} steps')


def refused(p, arguments, words, code=1):
    run = p.call(*arguments)
    check(run.returncode == code, f'{words}: exit code {run.returncode}: {run.stderr}')
    for word in words:
        check(word in run.stderr, f'"{word}" is not in: {run.stderr}')


def tree(folder):
    """All files with what is in them."""
    content = {}
    for place, _, names in os.walk(folder):
        for name in names:
            with open(os.path.join(place, name), 'rb') as f:
                content[os.path.join(place, name)] = f.read()
    return content


def write(path, content):
    with open(path, 'wb') as f:
        f.write(content)


# A single cell.
UPPER = ('*NODE\n' + ''.join(f'{i + 1}, {i & 1}, {i >> 1 & 1}, {i >> 2}\n' for i in range(8)) + '*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 4, 3, 5, 6, 8, 7\n'
         '*SURFACE, NAME=bottom\nE, S1\n*SURFACE, NAME=top\nE, S2\n').encode()


def checkpoint_refused(p):
    """No checkpoint, a torn, changed, foreign or older one, a finished run: one message, and all is as it was."""
    with tempfile.TemporaryDirectory() as folder:
        out, mesh, prm = os.path.join(folder, 'out'), os.path.join(folder, 'upper.inp'), os.path.join(folder, 'case.prm')
        saved = os.path.join(folder, 'out.checkpoint', 'state')
        shutil.copy(PATCH_TEST, prm)
        write(mesh, UPPER)
        settings = ['Refinement/Global cycles=2', 'Body upper/Mesh=upper.inp', 'Body upper/Dirichlet=top: (0, 0, -0.0075)', 'Body lower/Dirichlet=bottom: (0, 0, 0)']
        arguments = [prm, '--output', out] + [x for s in settings for x in ('--set', s)]
        limit, again = ['--set', 'Output/Wall time limit=0.01'], ['--resume', *arguments]
        refused(p, again, ('there is no checkpoint', 'Without --resume'))
        refused(p, ['--check', *again], ('--check',))
        check(p.call(*arguments).returncode == 0, 'not solved')
        refused(p, again, ('there is no checkpoint', 'has ended', 'complete'))
        refused(p, [*arguments, *limit], ('stopped after cycle 0', 'Go on with --resume'), 4)
        before = tree(folder)
        check(saved in before, f'no checkpoint: {sorted(before)}')
        refused(p, [*again, '--set', 'Body upper/Young modulus=1234'], ('another problem', 'Body upper/Young modulus was "', 'is "1234"'))
        refused(p, [*again, '--set', 'Title=other'], ('another problem', 'Title'))
        good = before[saved]
        for content, words in ((good[:-9], ('is torn',)), (good[:60], ('is torn',)), (b'', ('is torn',)), (b'nothing' * 20, ('is no checkpoint',)),
                               (good[:-20] + bytes([good[-20] ^ 4]) + good[-19:], ('is damaged',)),
                               (good[:16] + b'\0' + good[17:], ('older version',)), (good[:16] + b'\x63' + good[17:], ('newer version',))):
            write(saved, content)
            changed = tree(folder)
            refused(p, again, (*words, 'Nothing was changed'))
            check(tree(folder) == changed, f'{words}: something was changed')
        write(saved, good)
        write(mesh, UPPER.replace(b'*ELEMENT', b'** a comment\n*ELEMENT'))
        refused(p, again, ('another problem', 'the file upper.inp was'))
        write(mesh, UPPER)
        check(tree(folder) == before, 'something was changed')
        # A run that begins anew says so, and takes its place.
        run = p.call(*arguments, *limit)
        check(run.returncode == 4 and 'has left the checkpoint' in run.stdout, f'{run.returncode}: {run.stdout}')
        check(p.call(*again).returncode == 0, 'does not go on')
        check(sorted(os.listdir(folder)) == ['case.prm', 'out', 'upper.inp'], f'left: {os.listdir(folder)}')


def checkpoint_lacks_files(p):
    """The files of load steps that a checkpoint speaks of: one that is gone, one that is shorter."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        arguments = [PATCH_TEST, '--output', out, *[x for s in ('Refinement/Global cycles=0', 'Load steps=3') for x in ('--set', s)]]
        limit = ['--set', 'Output/Wall time limit=0.01']
        check(p.call(*arguments, *limit).returncode == 4, 'not stopped after the first solution')
        check(p.call('--resume', *arguments, *limit).returncode == 4, 'not stopped after a load step')
        lost = sorted(name for name in tree(folder) if not name.endswith('/state'))
        check(lost, f'no files of load steps: {sorted(tree(folder))}')
        content = tree(folder)[lost[0]]
        for change in (os.remove, lambda name: write(name, content[:-1])):
            change(lost[0])
            refused(p, ['--resume', *arguments], ('lacks the file', os.path.basename(lost[0]), 'as a load step wrote it'))
        write(lost[0], content)
        check(p.call('--resume', *arguments).returncode == 0, 'does not go on')


def checkpoint_and_signal(p):
    """SIGTERM: the last words say where the state is."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        arguments = [PATCH_TEST, '--output', out, '--set', 'Refinement/Global cycles=4', '--set', 'Output/Checkpoint=always']
        run = subprocess.Popen(p.command + arguments, env=p.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, universal_newlines=True,
                               preexec_fn=signals_as_usual)
        check(wait_until(lambda: os.path.exists(out + '.checkpoint/state'), 60), 'no checkpoint')
        run.send_signal(signal.SIGTERM)
        errors = run.communicate(timeout=60)[1]
        check(run.returncode != 0, f'exit code {run.returncode}')
        if len(p.command) == 1:
            check('is saved in' in errors and '--resume goes on from it' in errors, f'last words: {errors}')
        wait_until(lambda: os.listdir(folder) == ['out.checkpoint'], 5)
        check(os.listdir(folder) == ['out.checkpoint'], f'left: {os.listdir(folder)}')
        check(p.call('--resume', *arguments).returncode == 0, 'does not go on')
        check(os.listdir(folder) == ['out'], f'left: {os.listdir(folder)}')


def killed_and_resumed(p):
    """SIGKILL at random moments, then --resume on another number of ranks: the results of a run that nobody disturbed."""
    n, seed = int(os.environ.get('SIGNORINI_KILLS', 5)), int(os.environ.get('SIGNORINI_KILL_SEED', 1))
    n_ranks = [int(r) for r in os.environ.get('SIGNORINI_KILL_RANKS', '1 2').split()]
    chance = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        cases = [Case(p.command[-1], folder, *case) for case in CASES]
        for i in range(n):
            case = cases[i % len(cases)]
            print(f'{i}: {case.name}: ' + ', '.join(case.killed(chance, n_ranks)), flush=True)
        kills = sum(case.n_kills for case in cases)
        resumed = sum(case.n_resumed for case in cases)
        print(f'{n} runs, {kills} kills, {resumed} went on from a checkpoint')
        # On a busy machine a run may end before its time to be killed comes, or be killed before it has saved a state.
        check(kills > 0 and resumed > 0, f'{n} runs: {kills} kills, {resumed} went on from a checkpoint')
