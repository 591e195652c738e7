"""How the program behaves as a tool: results are never lost, input that makes no sense is refused, and the end of a run
says what a person looks for."""
import base64
import csv
import json
import math
import os
import re
import resource
import signal
import subprocess
import tempfile
import time
import xml.etree.ElementTree
import zlib

from harness import TOP, check, near, server_of

PATCH_TEST = os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm')
CUBES = os.path.join(TOP, 'prm', 'cubes', 'cubes.prm')


def tree(folder):
    """Names and texts of all files below a folder."""
    result = {}
    for path, _, names in os.walk(folder):
        for name in names:
            with open(os.path.join(path, name), 'rb') as f:
                result[os.path.relpath(os.path.join(path, name), folder)] = f.read()
    return result


def earlier_results(p, folder):
    """Results of a small run in FOLDER/out, which all that follows has to leave as they are."""
    run = p.call(PATCH_TEST, '--output', os.path.join(folder, 'out'), '--set', 'Refinement/Global cycles=0')
    check(run.returncode == 0, f'earlier results: {run.stderr}')
    return tree(folder)


def wait_until(condition, seconds=30):
    """Whether it comes true in this time."""
    end = time.time() + seconds
    while not condition() and time.time() < end:
        time.sleep(.02)
    return condition()


def begun(folder):
    """Whether a run has begun to write beside the results of another."""
    return any('.part-' in name for name in os.listdir(folder))


def signals_as_usual():
    """Shells ignore signals for those whom they start in the background."""
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def ended(p, folder, number, delay):
    """Ends a run by a signal some time after it has begun, long before it is done; returns its exit code and what it said."""
    command = p.command + [CUBES, '--output', os.path.join(folder, 'out'), '--set', 'Refinement/Global cycles=5', '--set', 'Output/Checkpoint=never']
    run = subprocess.Popen(command, env=p.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, universal_newlines=True,
                           preexec_fn=signals_as_usual)
    check(wait_until(lambda: begun(folder)), 'the run does not begin')
    time.sleep(delay)
    run.send_signal(number)
    errors = run.communicate(timeout=60)[1]
    return run.returncode, errors


def signals(p):
    """SIGTERM, SIGINT and SIGHUP in each phase: nothing left, earlier results kept."""
    with tempfile.TemporaryDirectory() as folder:
        before = earlier_results(p, folder)
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            for delay in (0., .3, 2.5):
                code, errors = ended(p, folder, number, delay)
                check(code != 0, f'{number} after {delay} s: exit code {code}')
                if len(p.command) == 1:
                    check(code == -number, f'{number} after {delay} s: exit code {code}')
                check(wait_until(lambda: tree(folder) == before, 5), f'{number} after {delay} s: changed {sorted(os.listdir(folder))}')
                if len(p.command) == 1:
                    check('earlier results' in errors, f'{number}: {errors}')
        # One that cannot be caught leaves its folder, and the next run cleans up.
        if len(p.command) == 1:
            ended(p, folder, signal.SIGKILL, 1.)
            left = [name for name in os.listdir(folder) if name != 'out']
            check(len(left) == 1 and '.part-' in left[0], f'after SIGKILL: {left}')
            p.call(PATCH_TEST, '--output', os.path.join(folder, 'out'), '--set', 'Refinement/Global cycles=0')
            check(os.listdir(folder) == ['out'], f'not cleaned up: {os.listdir(folder)}')


def children(process):
    try:
        with open(f'/proc/{process}/task/{process}/children') as f:
            return [int(child) for child in f.read().split()]
    except (FileNotFoundError, ProcessLookupError):
        return []


def served(p):
    """Runs that tests start without loading the program end as the program does, by its own will or not, and with whom they stand for."""
    server = server_of(p.command[-1])
    check(server.usable, 'the server of the program is missing or older than the program')
    program, variables = server.start(p.environment)
    check(program != p.command[-1], 'the program itself is started')
    with tempfile.TemporaryDirectory() as folder:
        def start(*options):
            return subprocess.Popen([program, os.path.relpath(CUBES, folder), '--output', 'out', *options], env=dict(p.environment, **variables), cwd=folder,
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)

        def running():
            """The process that computes: the server's child waits for it."""
            return [child for waiting in children(server.process.pid) for child in children(waiting)]

        for option, code in ((['--set', 'Refinement/Global cycles=0'], 0), (['--set', 'Solver/Method=none'], 1)):
            run = start(*option)
            out, err = run.communicate(timeout=60)
            check(run.returncode == code and ('results in ' + os.path.realpath(folder) in out, 'error: ' in err)[code], f'{option}: {run.returncode} {out} {err}')
        long = ['--set', 'Refinement/Global cycles=5', '--set', 'Output/Checkpoint=never', '--output', 'long']
        for who, number in (('program', signal.SIGSEGV), ('program', signal.SIGKILL), ('client', signal.SIGKILL), ('client', signal.SIGTERM)):
            run = start(*long)
            begun_ones = []
            wait_until(lambda: begun_ones.extend(process for process in running() if f'long.part-{process}' in os.listdir(folder)) or begun_ones)
            if not begun_ones:
                raise SystemExit('the run does not begin')
            os.kill(begun_ones[0] if who == 'program' else run.pid, number)
            run.communicate(timeout=60)
            check(run.returncode == -number, f'{who} ended by {number}: exit code {run.returncode}')
            check(wait_until(lambda: not running()), f'{who} ended by {number}: it goes on')


def grouped_files(p):
    """Neighbouring ranks write one file where there are to be fewer of them; all cells are there."""
    # The two bodies have files of their own.
    for most, expected in ((2, 2), (0, 3), (64, 3), (4, 3)):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, 'out')
            s = p.solve(PATCH_TEST, 'Refinement/Global cycles=1', f'Output/Most files={most}', keep=out)
            for name in ('bodies', 'contact-interface', 'contact-interface-mortar'):
                with open(os.path.join(out, f'{name}.pvtu')) as f:
                    pieces = re.findall(r'Source="([^"]*)"', f.read())
                there = {file for file in os.listdir(out) if re.fullmatch(name + r'\.\d+\.vtu', file)}
                n = expected if name != 'bodies' else 2 * min(3, most // 2 or 1) if most > 0 else 6
                check(set(pieces) == there and len(pieces) == n, f'{most}: {pieces}, {there}')
                cells = 0
                for piece in there:
                    with open(os.path.join(out, piece), 'rb') as f:
                        cells += sum(int(n) for n in re.findall(rb'NumberOfCells="(\d+)"', f.read()))
                check(name != 'bodies' or cells == s['cycles'][-1]['cells'], f'{most}: {cells} cells')
                check(cells > 0, f'{most}, {name}: no cells')


def lost_readers(p):
    """Nobody reads the lines to the end, or they cannot be written: the results come all the same."""
    for command in (f'{" ".join(p.command)} {PATCH_TEST} --output OUT | head -1', f'{" ".join(p.command)} {PATCH_TEST} --output OUT > /dev/full'):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(command.replace('OUT', os.path.join(folder, 'out')), shell=True, env=p.environment, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL, timeout=300)
            # The shell waits for the last process of a pipe only.
            check(wait_until(lambda: os.listdir(folder) == ['out'], 100), f'{command}: {os.listdir(folder)}')
            if os.path.exists(os.path.join(folder, 'out')):
                with open(os.path.join(folder, 'out', 'summary.json')) as f:
                    check(json.load(f)['converged'], f'{command}: not converged')


    # What is asked for on standard output may be cut short, but not be lost without a word.
    for option in (['--print-parameters'], ['--version'], ['--help'], ['--check', PATCH_TEST], ['--print-parameters', PATCH_TEST]):
        words = ' '.join(p.command + option)
        run = subprocess.run(words + ' > /dev/full', shell=True, env=p.environment, stderr=subprocess.PIPE, universal_newlines=True, timeout=300)
        check(run.returncode == 1 and 'error: standard output cannot be written: No space left' in run.stderr, f'{option}: {run.returncode}, {run.stderr}')
        run = subprocess.run(f'({words}; echo $? >&2) | true', shell=True, env=p.environment, stderr=subprocess.PIPE, universal_newlines=True, timeout=300)
        check(run.stderr.strip() == '0', f'{option} into a pipe that nobody reads: {run.stderr}')


FOUR_BLOCKS = """
set Bodies = a, b, c, d
set Contact pairs = fit, fit-mortar, fit mortar
set Load steps = 2
subsection Body a
  set Upper corner = 1, 1, 1
  set Dirichlet = -z: (0, 0, 0)
  set Probes = tip, "left": (0, 0, 1)
end
subsection Body b
  set Lower corner = 0, 0, 1
  set Upper corner = 1, 1, 2
  set Dirichlet = -x: (0, *, *); -y: (*, 0, *)
end
subsection Body c
  set Lower corner = 0, 0, 2
  set Upper corner = 1, 1, 3
  set Dirichlet = -x: (0, *, *); -y: (*, 0, *)
end
subsection Body d
  set Lower corner = 0, 0, 3
  set Upper corner = 1, 1, 4
  set Dirichlet = -x: (0, *, *); -y: (*, 0, *); +z: (*, *, -0.001*t)
end
subsection Pair fit
  set First = b: -z
  set Second = a: +z
end
subsection Pair fit-mortar
  set First = c: -z
  set Second = b: +z
end
subsection Pair fit mortar
  set First = d: -z
  set Second = c: +z
end
"""


def names_of_files(p):
    """Pairs whose names differ by a space, or by what sides are called, have files of their own; names with commas do not shift columns."""
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, 'four.prm'), os.path.join(folder, 'out')
        with open(path, 'w') as f:
            f.write(FOUR_BLOCKS)
        s = p.solve(path, keep=out)
        with open(os.path.join(out, 'results.pvd')) as f:
            files = re.findall(r'file="(contact-[^"]*)"', f.read())
        print(files)
        check(len(files) == len(set(files)) == 2 * len(s['pairs']), f'files of {len(s["pairs"])} pairs: {files}')
        with open(os.path.join(out, 'curve.csv')) as f:
            heading, *rows = csv.reader(f)
        check(len(rows) == 2 and all(len(row) == len(heading) for row in rows), f'{len(heading)} headings, {[len(row) for row in rows]} numbers')
        check('a: tip, "left": displacement z' in heading, f'headings: {heading}')


def full_disk(p):
    """Files that cannot grow any more (a limit of their size stands for the disk), in each phase of writing."""
    with tempfile.TemporaryDirectory() as folder:
        before = earlier_results(p, folder)
        none = ['--set', 'Output/Bodies=false', '--set', 'Output/Contact surfaces=false']
        # Bodies; contact surfaces; texts; the last word about what the results are worth.
        for limit, settings in ((8192, []), (2048, none[:2]), (1024, none), (0, none)):
            run = subprocess.Popen(p.command + [CUBES, '--output', os.path.join(folder, 'out'), *settings], env=p.environment,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, universal_newlines=True)
            # MPI wants files of its own at the beginning.
            check(wait_until(lambda: begun(folder)), 'the run does not begin')
            resource.prlimit(run.pid, resource.RLIMIT_FSIZE, (limit, limit))
            errors = run.communicate(timeout=300)[1]
            check(run.returncode == 1, f'limit {limit}: exit code {run.returncode}')
            check('is the disk full?' in errors and errors.count('signorini: error:') == 1, f'limit {limit}: {errors}')
            check(tree(folder) == before, f'limit {limit}: changed {sorted(os.listdir(folder))}')


def results_kept(p):
    """--output ., runs that do not converge, and folders of others."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        before = earlier_results(p, folder)
        with open(os.path.join(out, 'remarks.txt'), 'w') as f:
            f.write('mine')
        small = ['--set', 'Refinement/Global cycles=0']
        run = subprocess.run(p.command + [PATCH_TEST, '--output', '.', *small], env=p.environment, cwd=out, stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, universal_newlines=True, timeout=300)
        check(run.returncode == 0, f'--output .: exit code {run.returncode}: {run.stderr}')
        check(set(os.listdir(out)) == {os.path.relpath(n, 'out') for n in before} | {'remarks.txt'}, f'--output .: {os.listdir(out)}')
        check(os.listdir(folder) == ['out'], f'--output .: {os.listdir(folder)}')
        good = tree(out)
        run = p.call(CUBES, '--output', out, '--set', 'Solver/Maximal iterations=1', '--set', 'Solver/Compare linear multigrid=false', *small)
        check(run.returncode == 1 and 'did not converge' in run.stderr and 'out-not-converged' in run.stderr, f'{run.returncode}: {run.stderr}')
        check(tree(out) == good, 'results that did not converge have replaced others')
        with open(os.path.join(folder, 'out-not-converged', 'summary.json')) as f:
            check(not json.load(f)['converged'], 'summary of the run that did not converge')


def senseless_numbers(p):
    """One clear message, at once, for what makes no sense."""
    cases = [(['=', ], 'Section/Name=value'), (['=5'], 'Section/Name=value'), (['Title'], 'Section/Name=value'), (['/Title=a'], 'Section/Name=value'),
             (['Refinement/Global cycles=-1'], 'Global cycles'), (['Refinement/Adaptive cycles=-1'], 'Adaptive cycles'),
             (['Refinement/Final global cycles=-3'], 'Final global cycles'), (['Refinement/Initial global levels=-1'], 'Initial global levels'),
             (['Refinement/Global cycles=1e3'], 'Global cycles'), (['Solver/Pre-smoothing steps=-1'], 'Pre-smoothing steps'),
             (['Solver/Post-smoothing steps=-1'], 'Post-smoothing steps'), (['Solver/Interface sweeps=-1'], 'Interface sweeps'),
             (['Solver/Maximal iterations=-1'], 'Maximal iterations'), (['Solver/Maximal iterations=99999999999'], 'Maximal iterations'),
             (['Solver/Level 0 steps=-1'], 'Level 0 steps'), (['Solver/Tolerance=-1'], 'Tolerance'), (['Refinement/Max dofs=-1'], 'Max dofs'),
             (['Output/Verbosity=3'], 'Verbosity'), (['Body upper/Initial levels=-1'], 'Initial levels'), (['Body upper/Initial levels=two'], 'Initial levels'),
             (['Body upper/Young modulus=1e300'], 'Young modulus'), (['Body upper/Young modulus=-1'], 'Young modulus'),
             (['Body upper/Young modulus=nan'], 'Young modulus'), (['Body upper/Upper corner=1e300, 1e300, 1e300'], 'Body upper'),
             (['Body upper/Translation=1e200, 0, 0'], 'Body upper/Mesh'),
             (['Body upper/Divisions=-1, 1, 1'], 'Divisions'), (['Body upper/Divisions=1000, 1000, 1000'], 'GB of memory'),
             (['Refinement/Initial global levels=20'], 'GB of memory'), (['Refinement/Global cycles=20'], 'GB of memory'),
             (['Body upper/Initial levels=20'], 'GB of memory'), (['Refinement/Initial global levels=21'], 'Initial global levels'),
             (['Refinement/Regions=ball: (0, 0, 0), 1, -1'], 'levels must be between'), (['Refinement/Regions=ball: (0, 0, 0), 1, 30'], 'levels must be between'),
             (['Refinement/Regions=middle: ball: (0, 0, 0), 1, 1'], 'there is no body "middle"'),
             (['Contact pairs=a/b'], 'must not contain "/"'), (['Contact pairs=../../b'], 'must not contain'), (['Bodies=a:b, lower'], 'must not contain ":"'),
             (['Contact pairs=.hidden'], 'begin with a dot'), (['Output/Folder='], 'Output folder')]
    with tempfile.TemporaryDirectory() as folder:
        for settings, word in cases:
            output = [] if settings == ['Output/Folder='] else ['--output', os.path.join(folder, 'out')]
            begin = time.time()
            run = p.call(PATCH_TEST, *[a for s in settings for a in ('--set', s)], *output)
            check(run.returncode == 1, f'{settings}: exit code {run.returncode}')
            check(word in run.stderr, f'{settings}: the message does not name "{word}": {run.stderr}')
            check(run.stderr.count('signorini: error:') == 1, f'{settings}: not one message: {run.stderr}')
            check(len(run.stderr) < 1000, f'{settings}: a long message: {run.stderr}')
            check(time.time() - begin < 20, f'{settings}: {time.time() - begin} s')
            check(os.listdir(folder) == [], f'{settings}: left {os.listdir(folder)}')


def described_options(text):
    """(section, name, description) of all options that --print-parameters prints."""
    section, words = '', ''
    for line in text.splitlines():
        line = line.strip()
        if line.startswith('subsection '):
            section = line[len('subsection '):] + '/'
        elif line == 'end':
            section = ''
        elif line.startswith('#'):
            words += ' ' + line[1:].strip()
        elif line.startswith('set '):
            yield section, line[4:].split('=')[0].strip(), words.strip()
            words = ''


def own_words(p):
    """Every alternative that the description of an option names is accepted, with small letters or capital ones."""
    text = p.call('--print-parameters', PATCH_TEST).stdout
    n_words = n_options = 0
    for section, name, description in described_options(text):
        if 'One of: ' not in description:
            continue
        n_options += 1
        words = description[description.index('One of: ') + 8:].rstrip('.').split(', ')
        # What is explained, "word: ..." at the beginning of a sentence or after a semicolon, is one of them.
        explained = re.findall(r'(?:^|[.;] )([A-Za-z0-9 ]+?): ', description[:description.index('One of: ')])
        explained = [w for phrase in explained for w in phrase.split(' and ')]
        every = words + explained + [w.upper() for w in words]
        n_words += len(every)
        run = p.call('--print-parameters', PATCH_TEST, *[a for w in every for a in ('--set', f'{section}{name}={w}')])
        check(run.returncode == 0, f'{section}{name} = {every}: {run.stderr}')
        run = p.call('--print-parameters', PATCH_TEST, '--set', f'{section}{name}=nonsense')
        check(run.returncode == 1 and words[0] in run.stderr, f'{section}{name} = nonsense: {run.stderr}')
    check(n_options >= 10 and n_words > 60, f'{n_options} options with {n_words} words')
    for word in ('auto', 'automatic', 'Automatic'):
        run = p.call('--print-parameters', PATCH_TEST, '--set', f'Pair interface/Nonmortar={word}')
        check(run.returncode == 0, f'Nonmortar = {word}: {run.stderr}')
    # Generated meshes, as the description lists them.
    description = next(d for s, n, d in described_options(text) if n == 'Mesh')
    kinds = description[description.index('generated mesh: ') + len('generated mesh: '):].rstrip('.').split(', ')
    check(len(kinds) >= 20, f'kinds: {kinds}')
    with tempfile.TemporaryDirectory() as folder:
        prm = os.path.join(folder, 'all.prm')
        with open(prm, 'w') as f:
            f.write('set Bodies = ' + ', '.join(kinds) + '\n')
            for kind in kinds:
                f.write(f'subsection Body {kind}\n set Mesh = {kind}\n set Corners = (0, 0); (1, 0); (0, 1)\nend\n')
        run = p.call('--check', prm)
        for kind in kinds:
            check(f'body {kind}: ' in run.stdout, f'Mesh = {kind}: {run.stderr}')
    # Obstacles, shapes and regions, as theirs have them.
    for setting in ('Pair bottom/Obstacle=plane: (0, 0, 0), (0, 0, 1)', 'Pair bottom/Obstacle=sphere: (0.5, 0.5, -5), 5',
                    'Pair bottom/Obstacle=cylinder: (0.5, 0, -5), (0, 1, 0), 5', 'Pair bottom/Obstacle=paraboloid: (0.5, 0.5, 0), (0, 0, 1), 2',
                    'Pair bottom/Obstacle=function: z + 0.01', 'Pair bottom/Obstacle=hollow sphere: (0.5, 0.5, 50), 50',
                    'Pair bottom/Obstacle=hollow cylinder: (0.5, 0, 50), (0, 1, 0), 50', 'Body cube/Boundary shapes=top: plane: (0, 0, 1), (0, 0, 1)',
                    'Body cube/Boundary shapes=top: sphere: (0.5, 0.5, -99), 100.0025', 'Refinement/Regions=ball: (0, 0, 0), 0.1, 1; box: (0, 0, 0), (1, 1, 1), 1',
                    'Refinement/Regions=cube: ball: (0, 0, 0), 0.1, 1', 'Pair bottom/Initial gap=geometry'):
        run = p.call('--check', os.path.join(TOP, 'prm', 'obstacle', 'paraboloid.prm'), '--set', setting)
        check(run.returncode == 0, f'{setting}: {run.stderr}')


def arrays_of(path):
    """The arrays of a .vtu file (base64, compressed), by name, with "points"; lists of numbers."""
    import numpy
    kinds = {'Float32': numpy.float32, 'Float64': numpy.float64, 'Int32': numpy.int32, 'UInt8': numpy.uint8, 'Int64': numpy.int64, 'UInt64': numpy.uint64}
    result = {}
    for array in xml.etree.ElementTree.parse(path).iter('DataArray'):
        text = ''.join(array.text.split())
        head = numpy.frombuffer(base64.b64decode(text[:24])[:16], numpy.uint32)
        n = 4 * (3 + int(head[0]))
        length = 4 * math.ceil(n / 3)
        sizes = numpy.frombuffer(base64.b64decode(text[:length])[:n], numpy.uint32)[3:]
        data, at, raw = base64.b64decode(text[length:]), 0, b''
        for size in sizes:
            raw += zlib.decompress(data[at:at + int(size)])
            at += int(size)
        values = numpy.frombuffer(raw, kinds[array.get('type')])
        name = array.get('Name') or 'points'
        result[name] = values.reshape(-1, int(array.get('NumberOfComponents') or 1))
    return result


def check_body_words(s, folder, name):
    """Largest displacement and stress of the summary against those of the files."""
    import numpy
    pieces = [arrays_of(os.path.join(folder, f)) for f in os.listdir(folder) if re.fullmatch(r'bodies\.\d+\.vtu', f)]
    for piece in pieces:
        # Points belong to the body of their cells.
        of_cells = numpy.repeat(piece['body'][:, 0], numpy.diff(piece['offsets'][:, 0], prepend=0))
        piece['body'] = numpy.full((len(piece['points']), 1), -1)
        piece['body'][piece['connectivity'][:, 0], 0] = of_cells
    data = {key: numpy.concatenate([piece[key] for piece in pieces]) for key in ('points', 'displacement', 'von_Mises', 'body')}
    for number, body in enumerate(s['bodies']):
        mine = data['body'][:, 0] == number
        points = data['points'][mine]
        for key, values in (('largest_displacement', numpy.linalg.norm(data['displacement'][mine].astype(float), axis=1)),
                            ('largest_von_mises', data['von_Mises'][mine, 0].astype(float))):
            # The files have single precision.
            near(body[key], values.max(), 1e-6, f'{name}, {body["name"]}, {key}')
            place = numpy.array(body[key + '_at'])
            size = numpy.linalg.norm(points.max(axis=0) - points.min(axis=0))
            at = numpy.linalg.norm(points - place, axis=1).argmin()
            check(numpy.linalg.norm(points[at] - place) < 1e-6 * size, f'{name}, {body["name"]}: no node at {place}')
            check(values[at] > (1 - 1e-6) * values.max(), f'{name}, {body["name"]}, {key}: {values[at]} at {place}')


# An example; what is changed; whether all forces must balance (obstacles are no bodies); whether displacements are small.
FIVE = (('patch_test/patch_test.prm', ['Body upper/Pressures=back: 1'], True, True), ('cubes/cubes.prm', ['Refinement/Global cycles=2'], True, False),
        ('obstacle/paraboloid.prm', ['Refinement/Global cycles=2', 'Body cube/Volume force=(0, 0, -0.01)'], False, False),
        ('shapes/press-fit.prm', [], True, True), ('hertz/hertz.prm', ['Refinement/Final global cycles=0', 'Refinement/Global cycles=0'], True, True))


def words_at_the_end(p):
    """The summary of five examples: extrema are those of the files, loads and reactions balance, and the terminal says so."""
    for prm, settings, closed, small in FIVE:
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, 'results')
            run = p.call(os.path.join(TOP, 'prm', prm), '--output', out, *[a for t in settings for a in ('--set', t)])
            check(run.returncode == 0, f'{prm}: exit code {run.returncode}: {run.stderr}')
            with open(os.path.join(out, 'summary.json')) as f:
                s = json.load(f)
            check_body_words(s, out, prm)
        total = [0., 0., 0.]
        for body in s['bodies']:
            scale = max(abs(f) for key in ('load', 'reaction', 'contact_force') for f in body[key])
            check(scale > 0, f'{prm}: no force on {body["name"]}')
            for c in range(3):
                rest = body['load'][c] + body['reaction'][c] + body['contact_force'][c]
                check(abs(rest) <= 1e-9 * scale, f'{prm}, {body["name"]}: {rest} of {scale} is left in direction {c}')
                total[c] += body['load'][c] + body['reaction'][c]
        if closed:
            for c in range(3):
                check(abs(total[c]) <= 1e-9 * scale, f'{prm}: loads and reactions leave {total}')
        check(s['displacements_are_small'] == small, f'{prm}: displacements are {s["displacements_are_small"]}')
        for words in ('largest displacement', 'largest von Mises stress', 'reactions', 'contact area', 'largest pressure', 'displacements are small: ' + ('yes' if small else 'NO'),
                      'contact conditions hold: yes'):
            check(words in run.stdout, f'{prm}: "{words}" is not said: {run.stdout}')
        check(not re.search(r'^ +iteration ', run.stdout, re.M) and len(run.stdout.splitlines()) < 30, f'{prm}: {len(run.stdout.splitlines())} lines')
    # Iterations on request.
    run = p.call('--check', PATCH_TEST, '--set', 'Output/Verbosity=2')
    with tempfile.TemporaryDirectory() as folder:
        run = p.call(PATCH_TEST, '--output', os.path.join(folder, 'out'), '--set', 'Output/Verbosity=2')
        check(re.search(r'^ +iteration ', run.stdout, re.M) and 'equilibrium' in run.stdout, f'Verbosity 2: {run.stdout}')
        # A body that is turned by 20 degrees.
        turn = '(-0.35*(y-0.5), 0.35*(x-0.5), 0)'
        turned = ['Body upper/Translation=0, 0, 1', f'Body upper/Dirichlet=bottom: {turn}; top: {turn}']
        run = p.call(PATCH_TEST, '--output', os.path.join(folder, 'out'), *[a for t in turned for a in ('--set', t)])
        check('displacements are small: NO' in run.stdout and 'rotates by 20 degrees' in run.stdout, f'turned: {run.stdout} {run.stderr}')


def check_says(p):
    """--check: loads with their resultants, constraints, free motions, and the smallest distance."""
    run = p.call('--check', PATCH_TEST, '--set', 'Body upper/Pressures=right: 2', '--set', 'Body lower/Volume force=(0, 0, -3)', '--set',
                 'Body upper/Translation=0, 0, 0.25')
    check(run.returncode == 0, f'--check: {run.stderr}')
    for line in ('load on body upper, boundary "right": force (-2, 0, 0), moment about the origin (0, -1.5, 1)', 'load on body lower, volume: force (0, 0, -3)',
                 'all loads on body upper: force (-2, 0, 0)', 'constraint on body upper, boundary top: u_z = -0.01, ', 'free motions: none',
                 'smallest distance of the true surfaces: 0.25'):
        found = re.sub(r'[-+0-9.]+e-1[5-9]', '0', run.stdout)
        check(line in found, f'--check does not say "{line}": {found}')
    run = p.call('--check', PATCH_TEST, '--set', 'Body upper/Probes=far: (9, 9, 9)')
    check(run.returncode == 1 and 'outside of the body' in run.stderr, f'--check, a probe: {run.stdout}{run.stderr}')
    run = p.call('--check', os.path.join(TOP, 'prm', 'ball/ball.prm'), '--set', 'Body ball/Rigid=top: force (0, 0, -1000)')
    check(run.returncode == 0 and 'ends at a plane across' in run.stdout, f'--check, half a stamp: {run.stdout}{run.stderr}')
    run = p.call('--check', PATCH_TEST, '--set', 'Body upper/Dirichlet=')
    check('body upper: the constraints leave 6 rigid motion(s) free' in run.stdout, f'--check: {run.stdout}')
    run = p.call('--check', PATCH_TEST, '--set', 'Body upper/Dirichlet=', '--set', 'Body lower/Dirichlet=', '--set', 'Pair interface/Contact=tied')
    check(run.returncode == 1 and 'no boundary of what moves belongs to a contact pair' in run.stderr and 'rigid motion(s) free' in run.stdout,
          f'--check, nothing holds: {run.returncode} {run.stdout}{run.stderr}')
