#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Every public header compiles alone, and all of them in one file: g++ -fsyntax-only with the options of the build.

usage: headers_alone.py BUILD [HEADER]...    BUILD has compile_commands.json; all headers by default

Large headers of deal.II are compiled once and put in front of those headers only that include them anyway, which hides
nothing: a header's own code comes after all that it includes, and a header that is included before them is looked at by
itself, too (148 to 63 s on two cores)."""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
INCLUDE = os.path.join(TOP, 'include')
LARGE = ['deal.II/distributed/tria.h', 'deal.II/lac/la_parallel_vector.h', 'deal.II/base/parameter_handler.h',
         'deal.II/base/mpi.h', 'deal.II/base/point.h']


def options_of(build):
    """The compiler, and definitions, folders and the standard as the layers are compiled with."""
    with open(os.path.join(build, 'compile_commands.json'), encoding='utf-8') as f:
        entry = next(e for e in json.load(f) if e['file'].endswith('source/precompiled.cc'))
    words = shlex.split(entry['command'])
    compiler = next(word for word in words if os.path.basename(word).startswith(('c++', 'g++', 'clang++')))
    kept = [word for word in words if word.startswith(('-D', '-I', '-std='))]
    kept += [word for a, b in zip(words, words[1:]) if a == '-isystem' for word in (a, b)]
    return [compiler, *kept, '-Wall', '-Wextra', '-Werror', '-Winvalid-pch']


def included(header, seen=None):
    """All that a header of ours includes, by way of ours."""
    seen = set() if seen is None else seen
    with open(os.path.join(INCLUDE, header), encoding='utf-8') as f:
        for name in re.findall(r'^\s*#\s*include\s*<([^>]+)>', f.read(), re.M):
            if name not in seen:
                seen.add(name)
                if name.startswith('signorini/'):
                    included(name, seen)
    return seen


def precompile(header, options, folder):
    stub = os.path.join(folder, header.replace('/', '_'))
    with open(stub, 'w', encoding='utf-8') as f:
        f.write(f'#include <{header}>\n')
    subprocess.run([*options, '-x', 'c++-header', stub, '-o', stub + '.gch'], check=True)
    return stub


def main():
    options = options_of(sys.argv[1])
    headers = sys.argv[2:] or sorted(os.path.relpath(os.path.join(folder, name), INCLUDE)
                                     for folder, _, names in os.walk(INCLUDE) for name in names if name.endswith('.h'))
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        stubs = dict(zip(LARGE, pool.map(lambda large: precompile(large, options, folder), LARGE)))

        def compile_only(text, front):
            run = subprocess.run([*options, *(['-include', front] if front else []), '-fsyntax-only', '-x', 'c++', '-'],
                                 input=text, stderr=subprocess.PIPE, text=True, check=False)
            return run.returncode, run.stderr

        def compile_alone(header):
            found = included(header)
            return compile_only(f'#include <{header}>\n', next((stubs[large] for large in LARGE if large in found), None))

        # Two headers may say the same name for different things.
        together = pool.submit(compile_only, ''.join(f'#include <{header}>\n' for header in headers), None)
        failures = 0
        for header, (code, errors) in zip(headers, pool.map(compile_alone, headers)):
            if code != 0:
                failures += 1
                print(f'{header} does not compile alone:\n{errors}')
        clash, errors = together.result()
        if clash:
            print(f'the headers do not compile together:\n{errors}')
    print(f'{len(headers)} headers, {failures} of them do not compile alone')
    return 1 if failures or clash or not headers else 0


if __name__ == '__main__':
    sys.exit(main())
