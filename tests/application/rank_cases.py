"""The examples on other numbers of ranks: the same meshes, active sets, displacements and forces as on one."""
import os
import shutil
import tempfile

from free_body_cases import make_mesh
from geometry_cases import HERTZ_ADAPTIVE
from harness import FAILURES, TOP, Program, check, near

# Parameter file and what makes it small.
EXAMPLES = [
    ('hertz/hertz.prm', HERTZ_ADAPTIVE + ['Refinement/Global cycles=0', 'Refinement/Adaptive cycles=5', 'Refinement/Max dofs=20000']),
    ('hertz/paper.prm', ['Refinement/Regions=ball: (0, 0, 0), 0.3, 1']),
    ('hertz/paper-contact.prm', ['Refinement/Adaptive cycles=1']),
    ('hertz/paper-tetrahedra.prm', ['Refinement/Adaptive cycles=1']),
    ('knee/knee.prm', ['Refinement/Initial global levels=0', 'Refinement/Adaptive cycles=1']),
    ('cubes/cubes.prm', ['Refinement/Global cycles=2']),
    ('obstacle/paraboloid.prm', ['Refinement/Global cycles=2']),
    ('obstacle/resting.prm', ['Refinement/Global cycles=2']),
    ('patch_test/patch_test.prm', ['Refinement/Global cycles=1']),
    ('shapes/line-contact.prm', ['Refinement/Global cycles=0', 'Body cylinder/Round divisions=8, 20, 1', 'Body block/Divisions=10, 1, 8']),
    ('shapes/press-fit.prm', ['Refinement/Global cycles=0']),
    ('ball/ball.prm', []),
    ('lug/lug.prm', ['Refinement/Adaptive cycles=0']),
    ('press/press.prm', ['Refinement/Adaptive cycles=0']),
]


def copy_with_meshes(example, folder):
    """The parameter file of a copy, in which gmsh has made the mesh if the example has none."""
    copy = os.path.join(folder, os.path.dirname(example))
    shutil.copytree(os.path.join(TOP, 'prm', os.path.dirname(example)), copy)
    name = os.path.basename(os.path.splitext(example)[0])
    geometry, mesh = (os.path.join(copy, name + ending) for ending in ('.geo', '.msh'))
    if os.path.exists(geometry) and not os.path.exists(mesh):
        make_mesh(geometry, mesh)
    return os.path.join(folder, example)


def norm(vector):
    return sum(x * x for x in vector) ** .5


def compare(one, many):
    """Meshes and active sets are the same, displacements and forces to 1e-9 of the largest force."""
    for a, b in zip(one['cycles'], many['cycles']):
        for key in ('cells', 'dofs', 'contact_nodes', 'active_nodes'):
            check(a[key] == b[key], f'cycle {a["cycle"]}: {key} {a[key]} became {b[key]}')
        check(b['nonlinear']['iterations'] <= a['nonlinear']['iterations'] + 2, f'cycle {a["cycle"]}: iterations {a["nonlinear"]["iterations"]} became {b["nonlinear"]["iterations"]}')
    check(len(one['cycles']) == len(many['cycles']), 'other meshes')
    largest = max(norm(body[key]) for body in one['bodies'] for key in ('load', 'reaction', 'contact_force'))
    for a, b in zip(one['bodies'], many['bodies']):
        near(b['largest_displacement'], a['largest_displacement'], 1e-9, f'largest displacement of {a["name"]}')
        for key in ('load', 'reaction', 'contact_force'):
            check(norm(x - y for x, y in zip(a[key], b[key])) <= 1e-9 * largest, f'{a["name"]}: {key} {a[key]} became {b[key]}')
    check(one['certificate']['objections'] == many['certificate']['objections'], 'other verdicts')


def examples_on_ranks(p):
    for example, settings in EXAMPLES:
        with tempfile.TemporaryDirectory() as folder:
            prm, before = copy_with_meshes(example, folder), len(FAILURES)
            results = []
            for name, program in (('one', Program(p.command[-1], 1)), ('many', p)):
                results.append(program.solve(prm, *settings, 'Solver/Tolerance=1e-12', 'Output/Report=false', codes=(0, 3), keep=os.path.join(folder, name)))
            counts = [[c['nonlinear']['iterations'] for c in s['cycles']] for s in results]
            print(f'{example}: {results[0]["cycles"][-1]["dofs"]} unknowns, iterations {counts[0]} and {counts[1]}', flush=True)
            compare(*results)
            FAILURES[before:] = [f'{example}: {text}' for text in FAILURES[before:]]
