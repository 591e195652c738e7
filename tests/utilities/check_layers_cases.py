#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""contrib/utilities/check_layers.py sees what it should: trees with one planted violation each must fail with its
place, and a tree with all that is allowed must pass."""
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CHECK = os.path.join(TOP, 'contrib', 'utilities', 'check_layers.py')

# File, line of the file, a word of the complaint.
VIOLATIONS = [
    ('source/solvers/a.cc', '#include <signorini/mesh/bodies.h>', 'must not include mesh'),
    ('source/solvers/a.cc', '  #include <signorini/mesh/bodies.h>', 'must not include mesh'),
    ('source/solvers/a.cc', '#  include<signorini/mesh/bodies.h>', 'must not include mesh'),
    ('source/solvers/a.cc', '#include "signorini/mesh/bodies.h"', 'must not include mesh'),
    ('source/solvers/a.cc', '#include "../mesh/placed_body.h"', 'leaves the layer'),
    ('source/solvers/a.cc', '#include <signorini/solvers/../mesh/bodies.h>', 'must not include mesh'),
    ('source/solvers/parts/a.cc', '#include <signorini/mesh/bodies.h>', 'must not include mesh'),
    ('include/signorini/solvers/a.h', '#include <signorini/mesh/bodies.h>', 'must not include mesh'),
    ('include/signorini/solvers/a.h', '#include <deal.II/grid/tria.h>', 'deal.II/grid'),
    ('include/signorini/solvers/a.h', '#include "deal.II/grid/tria.h"', 'deal.II/grid'),
    ('source/solvers/a.cc', '#include <deal.II/dofs/dof_handler.h>', 'deal.II/dofs'),
    ('source/solvers/a.cc', '#include <deal.II/distributed/tria.h>', 'deal.II/distributed'),
    ('source/algebra/a.cc', '#include <deal.II/fe/fe_q.h>', 'deal.II/fe'),
    ('source/algebra/a.cc', '#include <deal.II/hp/fe_values.h>', 'deal.II/hp'),
    ('source/algebra/a.cc', '#include <signorini/surface/box_tree.h>', 'must not include surface'),
    ('source/surface/a.cc', '#include <deal.II/grid/tria.h>', 'deal.II/grid'),
    ('source/surface/a.cc', '#include <signorini/algebra/types.h>', 'must not include algebra'),
    ('source/solvers/a.cc', '#include <deal.II/lac/trilinos_sparse_matrix.h>', 'Trilinos'),
    ('source/algebra/a.cc', '#include <Epetra_CrsMatrix.h>', 'Trilinos'),
    ('source/algebra/a.cc', '#include <ml_MultiLevelPreconditioner.h>', 'Trilinos'),
    ('source/mesh/a.cc', '#include <gmsh.h>', 'gmsh'),
    ('source/mesh/a.cc', '#include <CGAL/Simple_cartesian.h>', 'CGAL'),
    ('source/mesh/a.cc', '#include <cholmod.h>', 'CHOLMOD'),
    ('source/mesh/a.cc', '#include <signorini/friction/slip.h>', 'no layer of that name'),
    ('source/friction/a.cc', '#include <vector>', 'friction has no rule'),
    ('include/signorini/friction/a.h', '#include <vector>', 'friction has no rule'),
]

ALLOWED = [
    ('source/solvers/a.cc', '#include <signorini/algebra/types.h>'),
    ('source/solvers/a.cc', '#include <deal.II/lac/vector.h>'),
    ('source/mesh/a.cc', '#include "placed_body.h"'),
    ('source/mesh/a.cc', '#include <deal.II/grid/tria.h>'),
    ('source/mesh/gmsh_file.cc', '#include <gmsh.h>'),
    ('source/algebra/algebraic_multigrid.cc', '#include <ml_MultiLevelPreconditioner.h>'),
    ('source/surface/a.cc', '// #include <signorini/mesh/bodies.h>'),
    ('source/main.cc', '#include <signorini/application/contact_model.h>'),
]


def run(files):
    """The exit code and the output of the check on a tree with these files."""
    with tempfile.TemporaryDirectory() as top:
        for path, line in files:
            path = os.path.join(top, path)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, 'a', encoding='utf-8') as f:
                f.write(line + '\n')
        result = subprocess.run([sys.executable, CHECK, top], stdout=subprocess.PIPE, text=True)
    return result.returncode, result.stdout


def main():
    failures = []
    code, output = run(ALLOWED)
    if code != 0:
        failures.append(f'what is allowed: {output}')
    for path, line, word in VIOLATIONS:
        code, output = run(ALLOWED + [(path, line)])
        if code != 1 or word not in output or path not in output:
            failures.append(f'{path}: {line}: exit code {code}, {output}')
    print('\n'.join(failures) if failures else f'{len(VIOLATIONS)} planted violations seen')
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main())
