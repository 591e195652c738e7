"""How the program behaves as a tool: results are never lost, input that makes no sense is refused, and the end of a run
says what a person looks for."""
import json
import os
import resource
import signal
import subprocess
import tempfile
import time

from harness import TOP, check

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
    """Ends a run by a signal some time after it has begun; returns its exit code and what it said."""
    command = p.command + [CUBES, '--output', os.path.join(folder, 'out'), '--set', 'Refinement/Global cycles=4']
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
