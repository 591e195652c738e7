# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Contact between elastic bodies, from Python (doc/python.md).

run()             a contact problem from a dictionary or a parameter file; results as arrays
map_surfaces()    the contact mapping between two triangulated surfaces
solve_obstacle()  the multigrid method for obstacle problems in matrices of scipy

Units are those of the input; nothing knows millimetres. MPI is started by the first call that needs it, unless mpi4py has started it, and
ended when the interpreter ends."""
import atexit

from . import _core
from ._core import InputError, n_ranks, rank
from ._mapping import Mapping, map_surfaces
from ._obstacle import ObstacleSolution, solve_obstacle
from ._results import Body, CertificateWarning, NotConverged, Pair, Result, Step, Surface, run

InputError.__module__ = 'signorini'
InputError.__doc__ = 'Input that cannot be understood: what is wrong, where, what to do. The text is that of the program.'
__version__ = _core.version().split()[1]
__all__ = ['Body', 'CertificateWarning', 'InputError', 'Mapping', 'NotConverged', 'ObstacleSolution', 'Pair', 'Result', 'Step', 'Surface',
           'map_surfaces', 'n_ranks', 'rank', 'run', 'solve_obstacle']

atexit.register(_core.finish)
