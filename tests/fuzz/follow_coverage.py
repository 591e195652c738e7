#!/usr/bin/python3
"""Damages files of the corpus with AFL++, which keeps those that reach new lines of our sources, and judges all that it kept as mutate.py does.

usage: follow_coverage.py BUILD [--minutes M] [--kinds parameters,deck,mesh,surface] [--folder FOLDER] [--keep FOLDER]

BUILD is a folder of the preset fuzz (package afl++). Each kind has M minutes of one core, shared by the endings of its files. --folder keeps what AFL++
writes, and a later call goes on from there. Prints figures; --keep saves what must not be. Exit code 1 if there is any.
"""
import argparse
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

import mutate

TOP = os.path.dirname(os.path.dirname(mutate.HERE))
# Where the words stand that a reader knows.
READERS = {'parameters': ('application/parameter*.cc', 'mesh/body_parameters.cc', 'mesh/expression.cc'), 'deck': ('mesh/deck*.cc', 'application/deck*.cc', 'mesh/abaqus*.cc'),
           'mesh': ('mesh/gmsh*.cc', 'mesh/mesh_input.cc'), 'surface': ('mesh/surface_file.cc', 'mesh/gmsh*.cc')}
# Milliseconds (of the wall: others use the machine, too) after which AFL++ ends a reader.
HANG = 20000
MOST_WORDS = 1500


def corpus(kind):
    folder = os.path.join(mutate.HERE, 'corpus', kind)
    return {os.path.join(folder, name) for name in os.listdir(folder)}


def write_words(path, kind):
    """A dictionary of AFL++: words of the corpus, and texts in the sources of the readers."""
    words = set()
    for name in corpus(kind):
        with open(name, 'rb') as f:
            words.update(re.findall(rb'[*$]?[A-Za-z_][\w ]{2,40}', f.read()))
    for pattern in READERS[kind]:
        for name in glob.glob(os.path.join(TOP, 'source', pattern)):
            with open(name, 'rb') as f:
                words.update(re.findall(rb'"([*$]?[A-Za-z][\w ]{1,40})"', f.read()))
    words.update(number for number in mutate.NUMBERS if number)
    with open(path, 'w') as f:
        for word in sorted(words)[:MOST_WORDS]:
            f.write('"' + ''.join(chr(c) if 32 < c < 127 and c not in b'"\\' else f'\\x{c:02x}' for c in word) + '"\n')


def run_afl(build, kind, ending, seconds, folder):
    """Its folder, with queue, crashes and hangs."""
    start, out = os.path.join(folder, f'{kind}{ending}.start'), os.path.join(folder, f'{kind}{ending}')
    os.makedirs(start, exist_ok=True)
    for name in corpus(kind):
        if name.endswith(ending):
            shutil.copy(name, start)
    words = os.path.join(folder, f'{kind}.words')
    write_words(words, kind)
    environment = dict(mutate.ENVIRONMENT, AFL_NO_UI='1', AFL_SKIP_CPUFREQ='1', AFL_NO_AFFINITY='1', AFL_AUTORESUME='1', AFL_I_DONT_CARE_ABOUT_MISSING_CRASHES='1',
                       AFL_FORKSRV_INIT_TMOUT='60000')
    with open(out + '.log', 'w') as log:
        code = subprocess.run(['afl-fuzz', '-V', str(int(seconds)), '-i', start, '-o', out, '-e', ending[1:], '-m', 'none', '-t', str(HANG), '-x', words, '--',
                               os.path.join(build, 'tests', 'follow_coverage'), kind, '@@'], env=environment, stdin=subprocess.DEVNULL, stdout=log,
                              stderr=subprocess.STDOUT).returncode
    if code != 0:
        raise SystemExit(f'afl-fuzz ended with {code}: {out}.log')
    return os.path.join(out, 'default')


def figures(folder):
    with open(os.path.join(folder, 'fuzzer_stats')) as f:
        values = dict(line.split(':', 1) for line in f)
    values = {key.strip(): value.strip() for key, value in values.items()}
    return (f'{int(values["run_time"]) / 60:.0f} minutes, {values["execs_done"]} files, {values["corpus_count"]} kept, {values["edges_found"]} of {values["total_edges"]} edges, '
            f'{values["saved_crashes"]} crashes, {values["saved_hangs"]} hangs')


def judge(build, kind, ending, folder, keep):
    """Number of findings among all files that AFL++ kept, read once more by read_files."""
    n = 0
    with tempfile.TemporaryDirectory() as copies:
        lines = ''
        for what in ('queue', 'crashes', 'hangs'):
            for name in sorted(glob.glob(os.path.join(folder, what, 'id:*'))):
                copy = os.path.join(copies, f'{kind}-{what}-{os.path.basename(name)[3:9]}{ending}')
                shutil.copy(name, copy)
                lines += f'{kind} {copy}\n'
        for outcome, seconds, size, path, message in mutate.run_reader(os.path.join(build, 'tests', 'read_files'), lines):
            wrong = mutate.finding(outcome, seconds, size, message)
            if wrong:
                n += 1
                print(f'{os.path.basename(path)}: {wrong}, {seconds:.1f} s, {size / 1e6:.0f} MB: {message[:300]}', flush=True)
                if keep:
                    os.makedirs(os.path.join(keep, kind), exist_ok=True)
                    shutil.copy(path, os.path.join(keep, kind))
    return n


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument('build')
    parser.add_argument('--minutes', type=float, default=60.)
    parser.add_argument('--kinds', default=','.join(mutate.KINDS))
    parser.add_argument('--folder')
    parser.add_argument('--keep')
    arguments = parser.parse_args()
    n = 0
    with tempfile.TemporaryDirectory() as temporary:
        for kind in arguments.kinds.split(','):
            endings = sorted({os.path.splitext(name)[1] for name in corpus(kind)})
            for ending in endings:
                folder = run_afl(arguments.build, kind, ending, arguments.minutes * 60 / len(endings), arguments.folder or temporary)
                print(f'{kind} {ending}: {figures(folder)}', flush=True)
                n += judge(arguments.build, kind, ending, folder, arguments.keep)
    return 1 if n else 0


if __name__ == '__main__':
    sys.exit(main())
