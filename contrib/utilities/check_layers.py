#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""A file includes its own folder and the layers listed for it only (doc/layers.md), the folders of deal.II listed for its
layer, and foreign libraries where they are at home; includes of tests are free.

usage: check_layers.py [TOP]    TOP is the tree to look at, this one by default"""
import os
import re
import sys

# Layers that a layer may include beside itself, and folders of deal.II: what lies below `mesh` knows no meshes.
ALLOWED = {
    'algebra': [],
    'surface': [],
    'solvers': ['algebra'],
    'mesh': ['algebra', 'surface'],
    'discretization': ['algebra', 'solvers', 'mesh'],
    'mortar': ['algebra', 'surface', 'solvers', 'mesh', 'discretization'],
    'output': ['algebra', 'surface', 'solvers', 'mesh', 'discretization', 'mortar'],
    'application': ['algebra', 'surface', 'solvers', 'mesh', 'discretization', 'mortar', 'output'],
    'python': ['algebra', 'surface', 'solvers', 'mesh', 'discretization', 'mortar', 'output', 'application'],
    'verification': ['algebra', 'surface', 'solvers', 'mesh', 'discretization', 'mortar', 'output', 'application'],
}
DEALII = {
    'algebra': ['base', 'lac'],
    'surface': ['base'],
    'solvers': ['base', 'lac'],
    'mesh': ['base', 'distributed', 'dofs', 'fe', 'grid', 'lac', 'physics'],
    'discretization': ['base', 'lac'],
    'mortar': ['base', 'lac'],
    'output': ['base', 'lac'],
    'application': ['base', 'lac'],
    'python': ['base', 'lac'],
    'verification': ['base', 'lac'],
}

# Foreign libraries: how their headers begin, and the files (without ending) or folders that may include them.
AT_HOME = [
    ('Trilinos', r'deal\.II/lac/trilinos_|ml_|ML_|Epetra|EpetraExt|Teuchos|Tpetra|Ifpack|Amesos|AztecOO|MueLu',
     ['algebra/algebraic_multigrid']),
    ('gmsh', r'gmsh', ['mesh/gmsh_file', 'mesh/gmsh_session']),
    ('CGAL', r'CGAL/', ['mesh/surface_file']),
    ('pybind11', r'pybind11/', ['python/']),
    ('CHOLMOD', r'cholmod|Eigen/CholmodSupport', ['solvers/']),
]

INCLUDE = re.compile(r'\s*#\s*include\s*(?:<([^>]+)>|"([^"]+)")')
LIMITS = {'.h': 300, '.cc': 500}
ROOTS = (os.path.join('include', 'signorini'), 'source')


def layer_of(path):
    """The layer of a path below the top (include/signorini/LAYER/..., source/LAYER/...), or None."""
    for root in ROOTS:
        if path.startswith(root + os.sep):
            words = path[len(root) + 1:].split(os.sep)
            return words[0] if len(words) > 1 else None
    return None


def complaint(path, layer, angled, quoted):
    """What is wrong with an include in a file of a layer, or None."""
    if quoted and not quoted.startswith(('signorini/', 'deal.II/')):
        # Relative to the file's folder: a header that belongs to sources of the same layer.
        target = os.path.normpath(os.path.join(os.path.dirname(path), quoted))
        other = layer_of(target)
        if other == layer:
            return None
        return f'"{quoted}" leaves the layer; write <signorini/...>' if os.sep in quoted else None
    header = angled or quoted
    words = header.split('/')
    if words[0] == 'signorini':
        other = os.path.normpath('/'.join(words[1:])).split('/')[0]
        if other not in ALLOWED:
            return f'{header}: no layer of that name'
        if other != layer and other not in ALLOWED[layer]:
            return f'layer {layer} must not include {other}'
    if words[0] == 'deal.II' and words[1] not in DEALII[layer]:
        return f'layer {layer} must not include deal.II/{words[1]}'
    name = layer + '/' + os.path.splitext(os.path.basename(path))[0]
    for library, pattern, home in AT_HOME:
        if re.match(pattern, header) and name not in home and layer + '/' not in home:
            return f'{library} is at home in {", ".join(home)} only'
    return None


def check(top):
    """All complaints about the tree, and notes on long files."""
    bad, notes = [], []
    for root in ROOTS:
        for folder, _, names in sorted(os.walk(os.path.join(top, root))):
            for name in sorted(names):
                path = os.path.relpath(os.path.join(folder, name), top)
                layer, ending = layer_of(path), os.path.splitext(name)[1]
                if layer is None or ending not in LIMITS:
                    continue  # programs and the precompiled header stand above all layers
                if layer not in ALLOWED:
                    bad.append(f'{path}: folder {layer} has no rule in check_layers.py')
                    continue
                with open(os.path.join(top, path), encoding='utf-8') as f:
                    lines = f.read().splitlines()
                for number, line in enumerate(lines, 1):
                    match = INCLUDE.match(line)
                    problem = match and complaint(path, layer, match.group(1), match.group(2))
                    if problem:
                        bad.append(f'{path}:{number}: {problem}')
                if len(lines) > LIMITS[ending]:
                    notes.append(f'note: {path} has {len(lines)} lines (budget {LIMITS[ending]})')
    return bad, notes


def main():
    own = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    bad, notes = check(sys.argv[1] if len(sys.argv) > 1 else own)
    print('\n'.join(notes + (bad if bad else ['layers: all includes in order'])))
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
