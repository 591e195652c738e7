#!/usr/bin/python3
"""Damages files of the corpus and has them read: no crash, no hang, no gigabytes.

usage: mutate.py READER [--count N] [--seed S] [--kinds parameters,deck,mesh,surface] [--keep FOLDER]

READER is build/release/tests/read_files (milliseconds a file), or the folder of the programs, build/release: then these
are run (half a second a file). The same seed and count make the same files. Prints for each kind of file how
many were read, refused with a message, and what must not be; --keep saves those files. Exit code 1 if there are any.
"""
import argparse
import collections
import concurrent.futures
import os
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.dirname(HERE))
from run_environment import session_folder  # noqa: E402

KINDS = ('parameters', 'deck', 'mesh', 'surface')
NUMBERS = [b'0', b'-1', b'1', b'2', b'-0.', b'255', b'65536', b'2147483647', b'2147483648', b'-2147483648', b'4294967295', b'4294967296',
           b'9223372036854775807', b'-9223372036854775808', b'18446744073709551615', b'99999999999999999999999', b'1e308', b'-1e308', b'1e-308',
           b'5e-324', b'1e400', b'nan', b'-inf', b'0x10', b'1e', b'--1', b'1.5', b'']
BYTES = [b'\0', b'\xff', b'\n', b'\r', b' ', b',', b'*', b'$', b'(', b')', b'"', b'-', b'\xc3\xa4', b'\x1a', b'#', b'=']
# Reading takes milliseconds; what is more was not bounded by the size of the file.
SECONDS, BYTES_OF_MEMORY = 5., 1.5e9


def numbers_of(data):
    return [m.span() for m in re.finditer(rb'[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?', data)]


def place(rng, data):
    return rng.randrange(len(data) + 1)


def piece(rng, data, longest=64):
    begin = place(rng, data)
    return begin, min(len(data), begin + rng.randint(1, longest))


def flip(rng, data, _):
    at = rng.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << rng.randrange(8)]) + data[at + 1:]


def put_byte(rng, data, _):
    at = place(rng, data)
    return data[:at] + rng.choice(BYTES) + data[at + rng.randrange(2):]


def cut(rng, data, _):
    return data[:rng.randrange(len(data))]


def leave_out(rng, data, _):
    begin, end = piece(rng, data)
    return data[:begin] + data[end:]


def repeat(rng, data, _):
    begin, end = piece(rng, data)
    return data[:end] + data[begin:end] * rng.choice((1, 1, 2, 50)) + data[end:]


def other_number(rng, data, _):
    spans = numbers_of(data)
    if not spans:
        return flip(rng, data, _)
    begin, end = rng.choice(spans)
    return data[:begin] + rng.choice(NUMBERS) + data[end:]


def near_number(rng, data, _):
    """A count that is wrong by a little."""
    spans = [s for s in numbers_of(data) if data[s[0]:s[1]].isdigit() and s[1] - s[0] < 10]
    if not spans:
        return flip(rng, data, _)
    begin, end = rng.choice(spans)
    return data[:begin] + str(int(data[begin:end]) + rng.choice((-2, -1, 1, 2, 10))).encode() + data[end:]


def other_integer(rng, data, _):
    """Four or eight bytes of a binary file."""
    size, value = rng.choice(((4, 'i'), (8, 'q'), (4, 'f'), (8, 'd')))
    if len(data) < size:
        return flip(rng, data, _)
    at = rng.randrange(len(data) - size + 1)
    kinds = {'i': (0, -1, 1, 5, 31, 2**31 - 1, -2**31, 1 << 24), 'q': (0, -1, 2**63 - 1, -2**63, 2**32, 1 << 40),
             'f': (float('nan'), float('inf'), 3e38, 1e-45), 'd': (float('nan'), float('-inf'), 1e308, 5e-324)}
    return data[:at] + struct.pack(rng.choice('<>') + value, rng.choice(kinds[value])) + data[at + size:]


def swap_lines(rng, data, _):
    lines = data.split(b'\n')
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[i], lines[j] = lines[j], lines[i]
    return b'\n'.join(lines)


def repeat_line(rng, data, _):
    lines = data.split(b'\n')
    lines.insert(rng.randrange(len(lines) + 1), rng.choice(lines))
    return b'\n'.join(lines)


def remove_line(rng, data, _):
    lines = data.split(b'\n')
    del lines[rng.randrange(len(lines))]
    return b'\n'.join(lines)


def other_word(rng, data, others):
    """A word of another file of the kind."""
    words, there = re.findall(rb'[^\s,;:=()]+', rng.choice(others)), [m.span() for m in re.finditer(rb'[^\s,;:=()]+', data)]
    if not words or not there:
        return flip(rng, data, others)
    begin, end = rng.choice(there)
    return data[:begin] + rng.choice(words) + data[end:]


def splice(rng, data, others):
    other = rng.choice(others)
    return data[:place(rng, data)] + other[place(rng, other):]


def insert_piece(rng, data, others):
    other = rng.choice(others)
    begin, end = piece(rng, other)
    at = place(rng, data)
    return data[:at] + other[begin:end] + data[at:]


MUTATIONS = (flip, flip, put_byte, cut, leave_out, repeat, other_number, other_number, other_number, near_number, near_number, other_integer,
             other_integer, swap_lines, repeat_line, remove_line, other_word, other_word, splice, insert_piece)


def damaged(rng, data, others):
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        if data:
            data = rng.choice(MUTATIONS)(rng, data, others)
    return data[:100000]


class Corpus:
    """Names and contents by kind; those of one ending are mixed with each other."""

    def __init__(self):
        self.files = {}
        for kind in KINDS:
            folder = os.path.join(HERE, 'corpus', kind)
            for name in sorted(os.listdir(folder)):
                with open(os.path.join(folder, name), 'rb') as f:
                    self.files[kind, name] = f.read()

    def mutant(self, kind, rng):
        name = rng.choice([n for k, n in self.files if k == kind])
        ending = os.path.splitext(name)[1]
        others = [data for (k, n), data in self.files.items() if k == kind and n.endswith(ending)]
        return ending, damaged(rng, self.files[kind, name], others)


def finding(outcome, seconds, size, message):
    """What is wrong with it, or None."""
    if outcome not in ('read', 'refused'):
        return outcome
    if seconds > SECONDS:
        return 'time'
    if size > BYTES_OF_MEMORY:
        return 'memory'
    if outcome == 'refused' and not 10 <= len(message) <= 2500:
        return 'message'
    return None


ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1', OMPI_MCA_ess_singleton_isolated='1',
                   OMPI_MCA_pml='ob1', OMPI_MCA_btl='self')


def set_limits():
    resource.setrlimit(resource.RLIMIT_CPU, (20, 21))
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def command_for(programs, kind, path):
    """The program that reads such a file."""
    if kind == 'surface':
        return [os.path.join(programs, 'signorini-map'), path, os.path.join(os.path.dirname(path), 'roof.off')]
    program = [os.path.join(programs, 'signorini'), '--check']
    if kind == 'mesh':
        return program + [os.path.join(os.path.dirname(path), '..', 'parameters', 'blocks.prm'), '--set', f'Body lower/Mesh={path}']
    return program + [path]


def run_program(programs, kind, path):
    """As read_files says it, from exit code and messages of a program."""
    with tempfile.TemporaryDirectory() as session, tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command_for(programs, kind, path), stdin=subprocess.DEVNULL, stdout=said, stderr=errors,
                                   env=dict(ENVIRONMENT, **session_folder(session)), preexec_fn=set_limits)
        timer = threading.Timer(120, process.kill)
        timer.start()
        _, status, used = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = status
        errors.seek(0)
        message = errors.read().decode(errors='replace').replace('\n', ' ')
    if os.WIFSIGNALED(status):
        outcome = 'time' if os.WTERMSIG(status) in (signal.SIGXCPU, signal.SIGKILL) else f'signal {os.WTERMSIG(status)}'
    else:
        code = os.WEXITSTATUS(status)
        outcome = 'read' if code == 0 else 'refused' if code == 1 and message.count(': error: ') == 1 else f'exit code {code}'
    return outcome, used.ru_utime + used.ru_stime, 1024. * used.ru_maxrss, path, message


def run_programs(programs, lines):
    """Two at a time."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        yield from pool.map(lambda line: run_program(programs, *line.split(' ', 1)), lines.splitlines())


def run_reader(reader, lines):
    if os.path.isdir(reader):
        yield from run_programs(reader, lines)
        return
    run = subprocess.run([reader], input=lines.encode(), stdout=subprocess.PIPE, env=ENVIRONMENT)
    # Messages may quote any character.
    for line in run.stdout.decode(errors='replace').split('\n')[:-1]:
        outcome, seconds, size, file, message = line.split('\t', 4)
        yield outcome, float(seconds), float(size), file, message
    if run.returncode != 0:
        raise SystemExit(f'{reader} ended with {run.returncode}')


class Figures:
    def __init__(self):
        self.counts, self.slowest, self.largest = collections.defaultdict(collections.Counter), {}, {}
        self.n_findings = 0

    def add(self, key, outcome, seconds, size, wrong):
        self.counts[key][wrong or outcome] += 1
        self.slowest[key] = max(seconds, self.slowest.get(key, 0.))
        self.largest[key] = max(size, self.largest.get(key, 0.))
        self.n_findings += wrong is not None

    def print(self):
        for key in sorted(self.counts):
            wrong = {k: n for k, n in self.counts[key].items() if k not in ('read', 'refused')}
            print(f'{key}: {sum(self.counts[key].values())} files, {self.counts[key]["read"]} read, {self.counts[key]["refused"]} refused, '
                  f'slowest {self.slowest[key]:.2f} s, largest {self.largest[key] / 1e6:.0f} MB, '
                  + ('; '.join(f'{n} {k}' for k, n in sorted(wrong.items())) if wrong else 'nothing wrong'))


def batches(corpus, kinds, seed, count, size=200):
    """(kind, numbers) of the files, a few hundred at a time."""
    for kind in kinds:
        for begin in range(0, count, size):
            yield kind, range(begin, min(count, begin + size))


def read_batch(corpus, reader, seed, kind, numbers, figures, keep):
    with tempfile.TemporaryDirectory() as folder:
        for other in KINDS:
            shutil.copytree(os.path.join(HERE, 'corpus', other), os.path.join(folder, other))
        lines = ''
        for n in numbers:
            ending, data = corpus.mutant(kind, random.Random(f'{seed} {kind} {n}'))
            path = os.path.join(folder, kind, f'{seed}-{n}{ending}')
            with open(path, 'wb') as f:
                f.write(data)
            lines += f'{kind} {path}\n'
        n_lines = 0
        for outcome, seconds, size, path, message in run_reader(reader, lines):
            n_lines += 1
            wrong = finding(outcome, seconds, size, message)
            figures.add(f'{kind} {os.path.splitext(path)[1]}', outcome, seconds, size, wrong)
            if wrong:
                print(f'{kind} {os.path.basename(path)}: {wrong}, {seconds:.1f} s, {size / 1e6:.0f} MB: {message[:300]}', flush=True)
                if keep:
                    os.makedirs(os.path.join(keep, kind), exist_ok=True)
                    shutil.copy(path, os.path.join(keep, kind))
        if n_lines != len(numbers):
            raise SystemExit(f'{reader} read {n_lines} of {len(numbers)} files')


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument('reader')
    parser.add_argument('--count', type=int, default=1000, help='files of each kind')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--kinds', default=','.join(KINDS))
    parser.add_argument('--keep')
    arguments = parser.parse_args()
    corpus, figures = Corpus(), Figures()
    for kind, numbers in batches(corpus, arguments.kinds.split(','), arguments.seed, arguments.count):
        read_batch(corpus, arguments.reader, arguments.seed, kind, numbers, figures, arguments.keep)
    figures.print()
    return 1 if figures.n_findings else 0


if __name__ == '__main__':
    sys.exit(main())
