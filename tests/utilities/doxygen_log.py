#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Doxygen has nothing to complain about: every public class and function is documented, and no reference is broken.

usage: doxygen_log.py DOXYGEN DOXYFILE    the Doxyfile names the folder and the log"""
import os
import re
import subprocess
import sys


def main():
    doxygen, doxyfile = sys.argv[1:3]
    with open(doxyfile, encoding='utf-8') as f:
        text = f.read()
    setting = {name: re.search(rf'^{name}\s*=\s*(\S+)', text, re.M).group(1) for name in ('OUTPUT_DIRECTORY', 'WARN_LOGFILE')}
    os.makedirs(setting['OUTPUT_DIRECTORY'], exist_ok=True)
    if os.path.exists(setting['WARN_LOGFILE']):
        os.remove(setting['WARN_LOGFILE'])
    subprocess.run([doxygen, doxyfile], check=True)
    with open(setting['WARN_LOGFILE'], encoding='utf-8') as f:
        warnings = f.read()
    print(warnings or 'no warnings')
    # Nothing to complain about, because it looked at nothing?
    page = os.path.join(setting['OUTPUT_DIRECTORY'], 'html', 'classSignorini_1_1ContactMapping.html')
    return 0 if not warnings and os.path.exists(page) else 1


if __name__ == '__main__':
    sys.exit(main())
