# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""The wheel: CMake builds the module (pyproject.toml says how to call it). Variables of the environment:

SIGNORINI_BUILD        a build folder of CMake that is there already; else all is compiled in a temporary one
SIGNORINI_CMAKE_FLAGS  more options for CMake, "-Ddeal.II_DIR=/opt/deal.II", say"""
import os
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))


class CMakeBuild(build_ext):
    """Builds the target signorini_python and puts what it makes where setuptools wants it."""

    def build_extension(self, ext):
        build = os.environ.get('SIGNORINI_BUILD') or os.path.join(os.path.abspath(self.build_temp), 'cmake')
        subprocess.check_call(['cmake', '-S', TOP, '-B', build, '-DCMAKE_BUILD_TYPE=Release', '-DSIGNORINI_PYTHON=ON', f'-DPython_EXECUTABLE={sys.executable}',
                               *(['-DSIGNORINI_TESTS=OFF'] if 'SIGNORINI_BUILD' not in os.environ else []),
                               *shlex.split(os.environ.get('SIGNORINI_CMAKE_FLAGS', ''))])
        subprocess.check_call(['cmake', '--build', build, '--target', 'signorini_python', '--parallel', str(os.cpu_count() or 1)])
        folder = os.path.join(build, 'python', 'signorini')
        modules = [name for name in os.listdir(folder) if name.startswith('_core') and name.endswith('.so')]
        if len(modules) != 1:
            sys.exit(f'signorini: {folder} has no module; are pybind11-dev and python3-dev installed?')
        target = self.get_ext_fullpath(ext.name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        shutil.copyfile(os.path.join(folder, modules[0]), target)


def version():
    with open(os.path.join(TOP, 'CMakeLists.txt'), encoding='utf-8') as f:
        return re.search(r'project\(Signorini VERSION (\S+)', f.read()).group(1)


setup(version=version(), packages=['signorini'], ext_modules=[Extension('signorini._core', [])], cmdclass={'build_ext': CMakeBuild})
