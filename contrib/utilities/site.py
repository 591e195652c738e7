#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Builds the documents as a site, by Sphinx and MyST; warnings are errors.

usage: site.py PROGRAM FOLDER

FOLDER/site/doc/index.html is the first page. Needs Debian's python3-sphinx, python3-myst-parser, python3-sphinx-rtd-theme.
"""
import glob
import os
import shutil
import subprocess
import sys

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DOCUMENTS = ('*.md', 'CITATION.cff', 'LICENSE', 'doc/*.md', 'doc/*.png', 'doc/images/**/*', 'doc/guide/*', 'doc/tutorial/*/*', 'prm/*/*', 'contrib/meshes/*',
             'contrib/plots/*', 'contrib/quickstart.sh', 'contrib/utilities/*', 'tests/**/*.py', '.ci/run', 'include/signorini/*/*.h')


def main():
    program, folder = sys.argv[1:]
    source, site = os.path.join(folder, 'site-source'), os.path.join(folder, 'site')
    for path in (source, site):
        shutil.rmtree(path, ignore_errors=True)
    for pattern in DOCUMENTS:
        for path in glob.glob(os.path.join(TOP, pattern), recursive=True):
            if os.path.isfile(path):
                target = os.path.join(source, os.path.relpath(path, TOP))
                os.makedirs(os.path.dirname(target), exist_ok=True)
                shutil.copyfile(path, target)
    files = sorted(glob.glob(os.path.join(TOP, 'prm', '*', '*.prm')))
    with open(os.path.join(source, 'doc', 'parameters.md'), 'w') as f:
        subprocess.run(['/usr/bin/python3', os.path.join(TOP, 'contrib', 'utilities', 'parameter_reference.py'), program, *files], stdout=f, check=True)
    shutil.copyfile(os.path.join(TOP, 'doc', 'conf.py'), os.path.join(source, 'conf.py'))
    return subprocess.run(['/usr/bin/python3', '-m', 'sphinx', '-q', '-W', '--keep-going', '-b', 'html', '-j', 'auto', source, site]).returncode


if __name__ == '__main__':
    sys.exit(main())
