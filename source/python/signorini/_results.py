# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Running problems, and their results as arrays."""
import csv
import io
import json
import os
import warnings
from collections.abc import Mapping

import numpy as np

from . import _core, _problem


class NotConverged(RuntimeError):
    """The iteration did not converge. `result` has what there is: a Result of run(), or an ObstacleSolution."""

    def __init__(self, message, result):
        super().__init__(message)
        self.result = result


class CertificateWarning(UserWarning):
    """The contact conditions do not hold in a result; the text says why and what to try (doc/output.md, the certificate)."""


class _Fields:
    """Something with fields, each also an attribute: fields['von_Mises'] is von_mises."""

    def __getattr__(self, name):
        for key, values in self.__dict__.get('fields', {}).items():
            if key.lower().replace(' ', '_') == name:
                return values
        raise AttributeError(f'{type(self).__name__} has no attribute {name!r}; its fields are {list(self.__dict__.get("fields", {}))}')

    def __dir__(self):
        return [*super().__dir__(), *(key.lower().replace(' ', '_') for key in self.fields)]


class Body(_Fields):
    """A body on its last mesh: n nodes. Lengths and stresses are in the units of the problem.

    name              of the body
    nodes             (n, 3), undeformed positions (length)
    hexahedra         (m, 8), tetrahedra (k, 4): numbers of nodes, in the order of VTK (meshio: "hexahedron", "tetra")
    displacement      (n, 3) (length)
    stress            (n, 6): xx, yy, zz, xy, yz, zx, averaged at nodes (unit of Young's modulus)
    von_mises         (n,), principal_stress (n, 3), largest first, likewise
    fields            all of them by name"""

    def __init__(self, name, nodes, hexahedra, tetrahedra, fields):
        self.name, self.nodes, self.hexahedra, self.tetrahedra, self.fields = name, nodes, hexahedra, tetrahedra, fields

    def __repr__(self):
        return f'<Body {self.name}: {len(self.nodes)} nodes, {len(self.hexahedra)} hexahedra, {len(self.tetrahedra)} tetrahedra>'


class Surface(_Fields):
    """One side of a contact pair: n vertices. Lengths and stresses are in the units of the problem.

    name                "body: boundary"
    vertices            (n, 3), undeformed positions (length)
    faces               (m, 4): numbers of vertices, counterclockwise from outside; a triangle has its first one again in the fourth place
    triangles           (k, 3): the same surface in triangles, with hanging vertices
    displacement        (n, 3) (length)
    pressure            (n,), positive where the surfaces press on each other (force per area)
    traction            (n, 3): what the other side does to this one (force per area)
    normal              (n, 3), outward unit vectors

    Of the nonmortar side, which carries the multipliers, also

    recovered_pressure  (n,): smoother than the pressure (doc/output.md)
    gap                 (n,): opening that is left (length); 0 also at vertices without a multiplier
    active              (n,): 1 where it touches, else 0
    area                (n,): the sum of area * pressure is the load; 0 at vertices without a multiplier
    mortar_image        (n, 3): the way to the other side before the bodies move (length)
    fields              all of them by name"""

    def __init__(self, name, vertices, faces, triangles, fields):
        self.name, self.vertices, self.faces, self.triangles, self.fields = name, vertices, faces, triangles, fields

    def __repr__(self):
        return f'<Surface {self.name}: {len(self.vertices)} vertices, {len(self.faces)} faces>'


class Pair:
    """A contact pair: its nonmortar Surface, whose attributes the pair has, too (pair.pressure, pair.vertices, ...), and

    name                of the pair
    nonmortar, mortar   the two surfaces; mortar is None with a rigid obstacle
    summary             what summary.json says of the pair; empty for a step of a series
    force               (3,): on the nonmortar side, of summary (force)
    contact_area        of summary (area)"""

    def __init__(self, name, nonmortar, mortar, summary):
        self.name, self.nonmortar, self.mortar, self.summary = name, nonmortar, mortar, summary

    @property
    def force(self):
        return np.array(self.summary['force'])

    @property
    def contact_area(self):
        return self.summary['contact_area']

    def __getattr__(self, name):
        if name.startswith('__') or 'nonmortar' not in self.__dict__:
            raise AttributeError(name)
        return getattr(self.nonmortar, name)

    def __dir__(self):
        return sorted({*super().__dir__(), *dir(self.nonmortar)})

    def __repr__(self):
        return f'<Pair {self.name}: {self.nonmortar.name} on {self.mortar.name if self.mortar else "an obstacle"}>'


class Step:
    """One load step: time, and bodies and pairs as in Result (they share nodes, cells, vertices and faces with it)."""

    def __init__(self, time, bodies, pairs):
        self.time, self.bodies, self.pairs = time, bodies, pairs

    def __repr__(self):
        return f'<Step at t = {self.time}>'


class Result:
    """What run() returns, of the last mesh and the last load.

    summary         summary.json as a dictionary (doc/output.md)
    bodies, pairs   {name: Body}, {name: Pair}
    steps           list of Step, with load steps
    curve           curve.csv as {column: array}, an entry a step; empty without load steps
    pressure_table  pressure.csv as {column: array}, an entry a row (doc/output.md)
    converged       whether the iteration did; certified: whether the contact conditions hold; objections: why not
    notes           list of remarks and warnings
    parameters      all parameters, as text
    folder          where files are, if there was an output folder"""

    def __init__(self, given):
        self.summary = json.loads(given['summary'])
        self.bodies = {body['name']: Body(**body) for body in given['bodies']}
        summaries = {pair['name']: pair for pair in self.summary['pairs']}
        self.pairs = {pair['name']: Pair(pair['name'], Surface(**pair['nonmortar']), Surface(**pair['mortar']) if len(pair['mortar']['vertices']) else None,
                                         summaries.get(pair['name'], {})) for pair in given['pairs']}
        self.steps = [self._step(**step) for step in given['steps']]
        self.pressure_table, self.curve = columns(given['pressure']), columns(given['curve'])
        self.converged, self.objections = given['converged'], given['objections']
        self.certified = self.converged and not self.objections
        self.notes = self.summary['notes']
        self.parameters, self.folder = given['parameters'], given['folder'] or None

    def _step(self, time, bodies, nonmortar, mortar):
        return Step(time, {b.name: Body(b.name, b.nodes, b.hexahedra, b.tetrahedra, fields) for b, fields in zip(self.bodies.values(), bodies)},
                    {p.name: Pair(p.name, *(s and Surface(s.name, s.vertices, s.faces, s.triangles, fields) for s, fields in ((p.nonmortar, first), (p.mortar, second))), {})
                     for p, first, second in zip(self.pairs.values(), nonmortar, mortar)})

    def __repr__(self):
        verdict = 'contact conditions hold' if self.certified else 'not converged' if not self.converged else 'contact conditions do NOT hold'
        return f'<Result: bodies {", ".join(self.bodies)}; pairs {", ".join(self.pairs) or "none"}; {verdict}>'


def columns(text):
    """The columns of a table with commas: numbers where all entries are, else texts."""
    rows = list(csv.reader(io.StringIO(text)))
    result = {}
    for i, name in enumerate(rows[0] if rows else []):
        entries = [row[i] for row in rows[1:]]
        try:
            result[name] = np.array([float(entry) for entry in entries])
        except ValueError:
            result[name] = np.array(entries)
    return result


def run(problem, overrides=None, *, output=None, folder=None, verbosity=0, steps=True, ranks='all'):
    """Solves a contact problem as the program signorini does, with the same numbers.

    problem    the name of a parameter file (.prm) or of a deck (.inp); or a dictionary with the same names as a parameter file,
                   {"Title": ..., "Bodies": {"ball": {...}, "block": {...}}, "Contact pairs": {"contact": {...}}, "Solver": {...}, ...}
               ("Body ball": {...} at the top is the same). Values are numbers, texts as in the file, sequences (1, 2, 3), and for named
               entries dictionaries: "Dirichlet": {"top": (0, 0, -0.02), "symmetry x": (0, None, None)}, None for a free component.
    overrides  a dictionary {"Section": {"Name": value}} of parameters that replace those of the problem, as --set does
    output     a folder for the files that the program writes; none without it
    folder     where the files are that a dictionary names (meshes); the current directory by default
    verbosity  0 to 2, lines on sys.stdout
    steps      whether fields of each load step are kept (three numbers a node for the displacement, ten for stresses)
    ranks      under mpirun: 'all' solve the problem together (then all must call run, and all get the whole result); 'one': each rank on
               its own, for studies with a problem a rank

    Returns a Result. Lengths, forces and stresses are in the units of the problem.
    Raises InputError for what cannot be understood, NotConverged (with the result) where the iteration did not converge, and
    KeyboardInterrupt on Ctrl-C, which leaves no files. Warns with CertificateWarning where the contact conditions do not hold."""
    if ranks not in ('all', 'one'):
        raise _core.InputError(f"ranks: {ranks!r} should be 'all' or 'one'.")
    file, text, places = '', ('', '', ''), []
    if isinstance(problem, Mapping):
        lines, places = _problem.parameter_text(problem)
        text = (lines, _problem.NAME, os.fspath(folder) if folder is not None else '')
    else:
        file = os.fspath(problem)
        if folder is not None:
            raise _core.InputError('folder: files are looked for where the parameter file is; it is for dictionaries.')
    settings = _problem.override_list(overrides) + [f'Output/Verbosity={verbosity}']
    try:
        given = _core.run(file, text, settings, '' if output is None else os.fspath(output), bool(steps), ranks == 'all')
    except _core.InputError as error:
        raise _core.InputError(_problem.explain(str(error), places)) from None
    result = Result(given)
    if not result.converged:
        raise NotConverged('the iteration did not converge; see the notes of the result.', result)
    if result.objections and (ranks == 'one' or _core.rank() == 0):
        warnings.warn('contact conditions do not hold: ' + ' '.join(result.objections), CertificateWarning, stacklevel=2)
    return result
