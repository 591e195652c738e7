#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Every source of a unity build compiles alone, too: what one forgets to include another one of its ten may have.

usage: sources_alone.py BUILD [PART]...    BUILD has compile_commands.json; sources with one of the parts in their path, all by default

The commands are those of the build, with its precompiled header, for each source that CMake has put into a common one."""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys


def sources_of(entry):
    file = os.path.join(entry['directory'], entry['file'])
    if f'{os.sep}Unity{os.sep}' not in file:
        return []
    with open(file, encoding='utf-8') as f:
        return re.findall(r'^#include "(.+)"', f.read(), re.M)


def compile_alone(entry, source):
    words = shlex.split(entry['command'])
    output = words.index('-o')
    command = [w for w in words[:output] + words[output + 2:] if w not in ('-c', entry['file'])]
    run = subprocess.run([*command, '-fsyntax-only', source], cwd=entry['directory'], stderr=subprocess.PIPE, text=True, check=False)
    return run.returncode, run.stderr


def main():
    with open(os.path.join(sys.argv[1], 'compile_commands.json'), encoding='utf-8') as f:
        tasks = [(entry, source) for entry in json.load(f) for source in sources_of(entry)]
    tasks = [(entry, source) for entry, source in tasks if not sys.argv[2:] or any(part in source for part in sys.argv[2:])]
    failures = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for (_, source), (code, errors) in zip(tasks, pool.map(lambda task: compile_alone(*task), tasks)):
            if code != 0:
                failures += 1
                print(f'{source} does not compile alone:\n{errors}', flush=True)
    print(f'{len(tasks)} sources, {failures} of them do not compile alone')
    return 1 if failures or not tasks else 0


if __name__ == '__main__':
    sys.exit(main())
