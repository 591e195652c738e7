#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Installs a build into a folder and works with that folder alone, as a stranger would: builds and runs all tutorials
and calls the installed programs. Archives that are meant to stand alone have all that they use.

usage: run_install.py BUILD WORK    WORK is emptied"""
import concurrent.futures
import json
import os
import shlex
import shutil
import subprocess
import sys
import time

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def call(*command, **options):
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if run.returncode != 0:
        sys.exit(f'{shlex.join(command)}\n{run.stdout}\nFAILED: exit code {run.returncode}')
    return run.stdout


def check_view(build, prefix):
    """Signorini's headers come from the installed folder, and nothing from the tree that it was built in."""
    with open(os.path.join(build, 'compile_commands.json')) as f:
        commands = [shlex.split(entry['command']) for entry in json.load(f)]
    seen = set()
    for words in commands:
        for word, following in zip(words, words[1:] + ['']):
            if word.startswith(('-I', '-isystem')):
                seen.add(os.path.realpath(word[2:] if word.startswith('-I') and word != '-I' else following))
    inside = [path for path in seen if path.startswith(TOP + os.sep) and not path.startswith(prefix + os.sep)]
    if inside or os.path.join(prefix, 'include') not in seen:
        sys.exit(f'FAILED: {build} looks for headers in {sorted(seen)}')


def run_outside(source, work, prefix):
    """A copy of a project, configured with the installed folder, built and run. Returns what it prints."""
    name = os.path.basename(source)
    copy, build = os.path.join(work, name), os.path.join(work, name, 'build')
    shutil.copytree(source, copy)
    call('cmake', '-G', 'Ninja', '-S', copy, '-B', build, f'-DCMAKE_PREFIX_PATH={prefix}', '-DCMAKE_EXPORT_COMPILE_COMMANDS=ON',
         '-DCMAKE_BUILD_TYPE=Release')
    check_view(build, prefix)
    call('cmake', '--build', build)
    return call(os.path.join(build, name), cwd=build)


def check_closed(folder, *names):
    """What some archives use of namespace Signorini they have: the mapping needs no algebra, the solvers no mesh."""
    archives = [os.path.join(folder, '_'.join(filter(None, ['libsignorini', name])) + '.a') for name in names]
    defined, used = set(), set()
    for line in call('nm', '--no-sort', *archives).splitlines():
        kind, _, symbol = line[17:].partition(' ')
        if '9Signorini' in symbol:
            (used if kind == 'U' else defined).add(symbol)
    if used - defined:
        missing = call('c++filt', *sorted(used - defined)[:5])
        sys.exit(f'FAILED: {archives} are not closed; among what they lack:\n{missing}')


def check_python(prefix, work):
    """The module for Python, if it was built, from the installed folder."""
    library = os.path.join(prefix, 'lib')
    folders = [os.path.join(library, name, 'dist-packages') for name in os.listdir(library) if name.startswith('python')]
    if folders:
        script = 'import signorini as s; t = [[0, 1, 2]]; print(s.__file__, s.map_surfaces(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], t), ([[0, 0, 1], [0, 1, 1], [1, 0, 1]], t)))'
        said = call('/usr/bin/python3', '-c', script, cwd=work, env=dict(os.environ, PYTHONPATH=folders[0], OMPI_MCA_ess_singleton_isolated='1'))
        if prefix not in said or '100.0%' not in said:
            sys.exit(f'FAILED: the installed module says {said}')


def main():
    build_folder, work = sys.argv[1], os.path.realpath(sys.argv[2])
    prefix = os.path.join(work, 'prefix')
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)

    start = time.time()

    def done(what):
        print(f'{time.time() - start:6.1f} s  {what}', flush=True)

    call('cmake', '--install', build_folder, '--prefix', prefix)
    done('installed')
    tutorials = os.path.join(prefix, 'share', 'signorini', 'tutorial')
    steps = sorted(name for name in os.listdir(tutorials) if name.startswith('step-'))
    if not steps:
        sys.exit('FAILED: no tutorial was installed.')
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        for said in pool.map(lambda name: run_outside(os.path.join(tutorials, name), work, prefix), steps):
            print(said)
    done('tutorials built and run')
    lib = next(folder for folder, _, names in os.walk(prefix) if 'libsignorini.a' in names)
    check_closed(lib, 'surface')
    check_closed(lib, 'solvers')
    check_closed(lib, '', 'surface', 'solvers')
    done('each archive needs what it may')
    example = os.path.join(prefix, 'share', 'signorini', 'prm', 'patch_test', 'patch_test.prm')
    call(os.path.join(prefix, 'bin', 'signorini'), '--check', example, cwd=work)
    call(os.path.join(prefix, 'bin', 'signorini-map'), '--version')
    # Problems with known solutions need no file beside the program, which may lie anywhere.
    alone = os.path.join(work, 'alone')
    os.makedirs(alone)
    shutil.copy(os.path.join(prefix, 'bin', 'signorini'), alone)
    print(call(os.path.join(alone, 'signorini'), 'verify', '--quick', 'patch', 'press-fit-rings', 'mapping', cwd=alone))
    if os.listdir(alone) != ['signorini']:
        sys.exit(f'FAILED: signorini verify left {os.listdir(alone)}')
    done('programs run')
    check_python(prefix, work)
    done('module for Python')


if __name__ == '__main__':
    main()
