#!/usr/bin/python3
"""Runs the program on small problems with known answers and checks summary.json.

usage: run_case.py PROGRAM CASE RANKS
"""
import json
import math
import os
import subprocess
import sys
import tempfile

import certificate_cases
import checkpoint_cases
import deck_cases
import finished_mesh_cases
import free_body_cases
import geometry_cases
import hardening_cases
import heat_cases
import load_cases
import output_cases
import random_pair_cases
import rank_cases
import report_cases
import seam_cases
import shape_cases
import slender_cases
import tool_cases
import true_gap_cases
import verification_cases
import verify_cases
import whole_boundary_cases
from harness import FAILURES, TOP, Program, certificate, check, constant_pressure, iterations, near, read_pressure


def patch_test(p):
    s = p.solve('patch_test/patch_test.prm', 'Body upper/Probes=corner: (1, 1, 0.5)')
    constant_pressure(s, 5.)
    certificate(s)
    iterations(s)
    # sigma_zz = -5: u_z = -0.005 z / 1 - 0.005, u_x = nu * 5 / E x.
    u = s['probes'][0]['displacement']
    for value, expected in zip(u, (0.3 * 5e-3, 0.3 * 5e-3, -0.0075)):
        near(value, expected, 1e-10, 'displacement')


# A linear field u = -c x gives the pressure c E / (1 - 2 nu) on any plane: rotate the blocks, fix all sides.
LINEAR = '(-1e-3*x, -1e-3*y, -1e-3*z)'
HYDROSTATIC = ['Body upper/Dirichlet=' + '; '.join(f'{b}: {LINEAR}' for b in ('left', 'right', 'front', 'back', 'top')),
               'Body lower/Dirichlet=' + '; '.join(f'{b}: {LINEAR}' for b in ('left', 'right', 'front', 'back', 'bottom'))]
ROTATED = [f'Body {b}/Rotation {k}' for b in ('upper', 'lower') for k in ('axis=1, 2, 3', 'angle=25')]


def inclined(p):
    s = p.solve('patch_test/patch_test.prm', *HYDROSTATIC, *ROTATED)
    constant_pressure(s, 2.5)
    certificate(s)


def hanging_nodes(p):
    for z in (0.3, -0.3):
        for sides in ([], HYDROSTATIC + ROTATED):
            s = p.solve('patch_test/patch_test.prm', *sides, f'Refinement/Regions=ball: (0.4, 0.5, {z}), 0.31, 1')
            constant_pressure(s, 2.5 if sides else 5.)
            certificate(s)


def corner(p):
    s = p.solve(os.path.join(TOP, 'tests', 'application', 'corner.prm'), 'Body block/Probes=middle: (0.4, 0.5, 0.3)')
    constant_pressure(s, 2.5)
    certificate(s)
    iterations(s)
    for pair, direction in zip(s['pairs'], (2, 0)):
        near(pair['force'][direction], 2.5, 1e-10, f'force of {pair["name"]}')
        near(pair['contact_area'], 1., 1e-10, f'contact area of {pair["name"]}')
        # Both sides of the constant pressure have the centre (1/2, 1/2) of the face.
        near(pair['moment'][1], (-1.25, 1.25)[direction == 0], 1e-10, f'moment of {pair["name"]}')
    for value, expected in zip(s['probes'][0]['displacement'], (-4e-4, -5e-4, -3e-4)):
        near(value, expected, 1e-10, 'displacement')
    check(any('another surface in contact' in note for note in s['notes']), 'dropped nodes are not reported')


def swapped_sides(p):
    s = p.solve('patch_test/patch_test.prm', 'Pair interface/Nonmortar=first')
    constant_pressure(s, 5.)
    certificate(s)


def volume_materials(p):
    """The nonmortar side is chosen by the materials at the surfaces, not by those of bodies without a cell of them."""
    settings = ['Body upper/Young modulus=1000', 'Body lower/Young modulus=100000', 'Body lower/Volume materials=volume: 10, 0.3',
                'Refinement/Global cycles=0', 'Solver/Compare linear multigrid=false']
    s = p.solve('patch_test/patch_test.prm', *settings)
    check(s['pairs'][0]['nonmortar'] == 'lower: top', f'nonmortar: {s["pairs"][0]["nonmortar"]}')
    # What contact does is that of the materials, too: 1/E* = (1 - nu^2) (1 / 1000 + 1 / 10) on the area 1, which two planes of symmetry cut off.
    near(s['pairs'][0]['approach'], 2 * 4 / 3 * s['pairs'][0]['load'] * .91 * (1e-3 + .1), 1e-8, 'approach')
    certificate(s)


def written_parameters(p):
    """parameters.prm in the results says what was computed, to the last digit."""
    with tempfile.TemporaryDirectory() as folder:
        prm, out = os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm'), os.path.join(folder, 'out')
        run = p.call('--mesh-only', prm, '--output', out, '--set', 'Solver/Method=truncated newton multigrid', '--set', 'Refinement/Global cycles=0',
                     '--set', 'Body upper/Radius=1.23456789012')
        check(run.returncode == 0, f'exit code {run.returncode}: {run.stderr}')
        with open(os.path.join(out, 'parameters.prm')) as f:
            text = f.read()
        for value in ('truncated newton multigrid', '1.23456789012', out):
            check(value in text, f'parameters.prm does not have "{value}"')


# The same linear field with the planes x and y and the right side loaded by its pressure 2.5 instead of held.
PARTLY_FIXED = [f'Body {b}/{k}' for b, end in (('upper', 'top'), ('lower', 'bottom')) for k in
                (f'Dirichlet=left: {LINEAR}; {end}: {LINEAR}', 'Pressures=right: 2.5; front: 2.5; back: 2.5')]


def partly_fixed(p):
    # Only one side of the border of the contact surfaces is held: its nodes carry no multiplier.
    for rotation in ([], ROTATED):
        for side in ('first', 'second'):
            s = p.solve('patch_test/patch_test.prm', *PARTLY_FIXED, *rotation, f'Pair interface/Nonmortar={side}')
            constant_pressure(s, 2.5)
            certificate(s)


def overhang(p):
    # One body sticks out in x; the strip that is not covered is loaded with the pressure of the contact.
    for wide, narrow, strip, boundary in (('upper', 'lower', 'x > 0.75', 'bottom'), ('lower', 'upper', 'x > 0.75', 'top')):
        corner = 'Upper corner=0.75, 1, ' + ('0' if narrow == 'lower' else '1')
        for side in ('first', 'second'):
            for divisions in ('3, 4, 4', '2, 3, 3'):
                s = p.solve('patch_test/patch_test.prm', f'Body {narrow}/{corner}', f'Body {narrow}/Divisions={divisions}',
                            f'Body {wide}/Divisions=4, 5, 4', f'Body {wide}/Pressures={boundary}: 5*({strip})',
                            f'Pair interface/Nonmortar={side}')
                constant_pressure(s, 5.)
                certificate(s)
                near(abs(s['pairs'][0]['force'][2]), 3.75, 1e-10, 'force')


def pulled(p):
    s = p.solve('patch_test/patch_test.prm', 'Body upper/Dirichlet=left: (0, *, *); front: (*, 0, *); top: (*, *, 0.01)')
    check(s['converged'], 'not converged')
    check(s['cycles'][-1]['active_nodes'] == 0, 'active nodes')
    check(max(abs(f) for f in s['pairs'][0]['force']) < 1e-10, f'contact force {s["pairs"][0]["force"]}')
    check(any('separated' in note for note in s['notes']), 'no note that the surfaces separated')


def cubes(p):
    # doc/verification.md, problem M1.
    s = p.solve('cubes/cubes.prm')
    certificate(s)
    iterations(s)
    for cycle, active, energy in ((2, 13, -1.395805179203e2), (3, 49, -2.810125018392e2)):
        check(s['cycles'][cycle]['active_nodes'] == active, f'active nodes {s["cycles"][cycle]["active_nodes"]}')
        near(s['cycles'][cycle]['energy'], energy, 2e-10, 'energy')
    near(s['pairs'][0]['force'][2], 8.32696552e1, 1e-8, 'force')


def ranks(p):
    """Displacement, pressure and active set do not depend on the number of ranks."""
    settings = ('cubes/cubes.prm', 'Refinement/Global cycles=2', 'Refinement/Regions=ball: (0.5, 0.5, 0), 0.2, 1',
                'Body upper/Probes=a: (0.3, 0.4, 0.1); b: (0.5, 0.5, 0); c: (0.9, 0.1, 0.5)')
    with tempfile.TemporaryDirectory() as folder:
        results = []
        for name, program in (('one', Program(p.command[-1], 1)), ('many', p)):
            s = program.solve(*settings, keep=os.path.join(folder, name))
            rows = sorted(([row[k] for k in ('x', 'y', 'z', 'pressure', 'active')] for side in ('nonmortar', 'mortar')
                           for row in read_pressure(os.path.join(folder, name, 'pressure.csv'), side)), key=lambda row: [round(c, 9) for c in row[:3]])
            results.append((s, rows))
    (one, rows_one), (many, rows_many) = results
    scale = max(row[3] for row in rows_one)
    check(len(rows_one) == len(rows_many), 'contact nodes')
    for a, b in zip(rows_one, rows_many):
        check(max(abs(x - y) for x, y in zip(a[:3], b[:3])) < 1e-12, f'node {a} became {b}')
        check(abs(a[3] - b[3]) <= 1e-9 * scale, f'pressure {a} became {b}')
        check(a[4] == b[4], f'active {a} became {b}')
    for a, b in zip(one['probes'], many['probes']):
        size = max(abs(c) for c in a['displacement'])
        check(max(abs(x - y) for x, y in zip(a['displacement'], b['displacement'])) <= 1e-9 * size, f'displacement {a} became {b}')
    for a, b in zip(one['cycles'], many['cycles']):
        check(a['active_nodes'] == b['active_nodes'], 'active nodes')
        check(abs(a['nonlinear']['iterations'] - b['nonlinear']['iterations']) <= 2, 'iterations')


def half_model(p):
    # Symmetric about x = 0.5: the half x >= 0.5 with a symmetry plane through the contact zone.
    full = p.solve('cubes/cubes.prm', 'Refinement/Global cycles=2', 'Body upper/Divisions=4, 4, 4')
    half = p.solve('cubes/cubes.prm', 'Refinement/Global cycles=2', 'Body upper/Divisions=2, 4, 4', 'Body lower/Divisions=1, 2, 2',
                   'Body upper/Lower corner=0.5, 0, 0', 'Body lower/Lower corner=0.5, 0, -1',
                   'Body upper/Dirichlet=left: (0, *, *); top: (0, 0, -0.05)', 'Body lower/Dirichlet=left: (0, *, *); bottom: (0, 0, 0)')
    near(2 * half['pairs'][0]['force'][2], full['pairs'][0]['force'][2], 1e-9, 'force')
    near(half['pairs'][0]['max_pressure'], full['pairs'][0]['max_pressure'], 1e-9, 'pressure')


# doc/verification.md, S1: cells a side, active nodes, energy, force.
S1 = ((8, 9, 2.110394093511e-4, 1.14727827e-2), (16, 21, 2.328860217949e-4, 1.17543487e-2), (32, 89, 2.360079949137e-4, 1.18747437e-2))


def obstacle(p):
    for cycle, (n, active, energy, force) in zip((2, 3, 4) if p.command[0] != 'mpirun' else (2, 3), S1):
        s = p.solve('obstacle/paraboloid.prm', f'Refinement/Global cycles={cycle}')
        last = s['cycles'][-1]
        check(last['active_nodes'] == active, f'S1, {n}: {last["active_nodes"]} active nodes instead of {active}')
        near(last['energy'], energy, 1e-10, f'S1, {n}: energy')
        near(s['pairs'][0]['force'][2], force, 1e-8, f'S1, {n}: force')
        certificate(s)
        iterations(s)
        check(last['nonlinear']['iterations'] <= 10, f'S1, {n}: {last["nonlinear"]["iterations"]} iterations')
        # Algebraic multigrid on a large level 0 does as well as the geometric levels.
        s = p.solve('obstacle/paraboloid.prm', 'Refinement/Global cycles=1', f'Body cube/Divisions={n // 2}, {n // 2}, {n // 2}',
                    'Solver/Level 0=amg')
        near(s['cycles'][-1]['energy'], energy, 1e-10, f'S1, {n}, amg: energy')
        iterations(s)
    # All obstacles that are the same surface, weighted and nodal: the same result.
    same = [f'Pair bottom/Obstacle={o}' for o in ('paraboloid: (0.5, 0.5, 0.05), (0, 0, 1), 0.5',
                                                  'function: z - 0.05 + (x-0.5)^2 + (y-0.5)^2')]
    for gap in ('nodal', 'weighted'):
        a, b = (p.solve('obstacle/paraboloid.prm', 'Refinement/Global cycles=2', f'Pair bottom/Gap={gap}', o) for o in same)
        near(b['cycles'][-1]['energy'], a['cycles'][-1]['energy'], 1e-10, f'function, {gap}')
    # A plane pressed by a constant pressure.
    pressed = ('Body cube/Dirichlet=left: (0, *, *); front: (*, 0, *); top: (*, *, -0.01)', 'Body cube/Young modulus=1000',
               'Refinement/Global cycles=1', 'Pair bottom/Obstacle=plane: (0, 0, 0), (0, 0, 1)')
    for gap in ('nodal', 'weighted'):
        s = p.solve('obstacle/paraboloid.prm', f'Pair bottom/Gap={gap}', *pressed)
        constant_pressure(s, 10.)
        certificate(s)
    # A ball that is nearly a plane, from below, and the same from inside.
    for o in ('sphere: (0.5, 0.5, -1e5), 1e5', 'hollow sphere: (0.5, 0.5, 1e5), 1e5', 'cylinder: (0.5, 0, -1e5), (0, 1, 0), 1e5'):
        s = p.solve('obstacle/paraboloid.prm', *pressed, f'Pair bottom/Obstacle={o}')
        near(s['pairs'][0]['force'][2], 10., 1e-2, o)
    for setting, word in (('Pair bottom/Obstacle=cone: (0, 0, 0), 1', 'cone'), ('Pair bottom/Second=cube: top', 'either'),
                          ('Pair bottom/Obstacle=plane: (0, 0, 5), (0, 0, -1)', 'does not face'),
                          ('Pair bottom/Initial gap=0.1', 'obstacle')):
        with tempfile.TemporaryDirectory() as folder:
            run = p.call(os.path.join(TOP, 'prm', 'obstacle/paraboloid.prm'), '--output', os.path.join(folder, 'out'), '--set', setting)
            check(run.returncode == 1 and word in run.stderr, f'{setting}: {run.returncode}, {run.stderr}')
            check(os.listdir(folder) == [], f'{setting}: something was written')


S2 = ((8, 9, 2.957341002694e-4), (16, 45, 3.056666932133e-4), (32, 145, 3.089038702110e-4))


def write_bowl(name, n):
    """The mesh of S2: a cube whose nodes are moved by z -> z + 0.6 r^2 (1 - z)."""
    def node(i, j, k):
        return (k * (n + 1) + j) * (n + 1) + i + 1
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    elements = [f'3 2 {t} {t} ' + ' '.join(str(node(i + a, j + b, k)) for a, b in corners) for t, k in ((1, 0), (2, n)) for j in range(n) for i in range(n)]
    elements += ['5 2 3 3 ' + ' '.join(str(node(i + a, j + b, k + c)) for c in (0, 1) for a, b in corners)
                 for k in range(n) for j in range(n) for i in range(n)]
    with open(name, 'w') as f:
        f.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 "bottom"\n2 2 "top"\n3 3 "cube"\n$EndPhysicalNames\n')
        f.write(f'$Nodes\n{(n + 1) ** 3}\n')
        for k in range(n + 1):
            for j in range(n + 1):
                for i in range(n + 1):
                    x, y, z = i / n, j / n, k / n
                    f.write('%d %.17g %.17g %.17g\n' % (node(i, j, k), x, y, z + .6 * ((x - .5) ** 2 + (y - .5) ** 2) * (1 - z)))
        f.write(f'$EndNodes\n$Elements\n{len(elements)}\n' + ''.join(f'{e + 1} {text}\n' for e, text in enumerate(elements)) + '$EndElements\n')


def bowl(p):
    """S2 of the solver problems: normals that vary (planes would push along their own, functions do not), a mesh file that is level 0. Its gaps are those
    of the facets.
    With level 0 solved to three digits, and with background levels, whose correction is not exact."""
    with tempfile.TemporaryDirectory() as folder:
        for n, active, energy in S2[:3 if p.command[0] != 'mpirun' else 2]:
            mesh = os.path.join(folder, f'{n}.msh')
            write_bowl(mesh, n)
            for method, levels, bound in (('accelerated', 'none', 10), ('monotone multigrid', 'none', 10), ('accelerated', 'background', 12),
                                          ('monotone multigrid', 'background', 15)):
                s = p.solve('obstacle/paraboloid.prm', f'Body cube/Mesh={mesh}', f'Solver/Coarse levels={levels}', 'Refinement/Global cycles=0', 'Pair bottom/Obstacle=function: z - 0.05', 'Pair bottom/Surface=faceted',
                            f'Solver/Method={method}')
                last = s['cycles'][-1]
                near(last['energy'], energy, 1e-10, f'S2, {n}, {method}: energy')
                check(last['active_nodes'] == active, f'S2, {n}, {method}: {last["active_nodes"]} active nodes')
                check(last['nonlinear']['iterations'] <= bound, f'S2, {n}, {method}, {levels}: {last["nonlinear"]["iterations"]} iterations')


def bounded_iterations(p, text, bound, *settings, prm='cubes/cubes.prm', nonmortar='auto'):
    s = p.solve(prm, f'Pair interface/Nonmortar={nonmortar}', *settings)
    check(s['converged'], f'{text}: not converged')
    worst = max(c['nonlinear']['iterations'] for c in s['cycles'])
    print(f'{text}: {worst} iterations')
    check(worst <= bound, f'{text}: {worst} iterations')
    return s


def stretched(p):
    """Cells of aspect ratio 20 (and 10 in the other body), flat or long. Blocks end at the borders between ranks."""
    bound = 30 if '4' in p.command else 25
    bounded_iterations(p, 'flat cells', bound, 'Body upper/Upper corner=1, 1, 0.05', 'Body lower/Young modulus=7e3', 'Refinement/Global cycles=2')
    bounded_iterations(p, 'long cells', bound, 'Body upper/Divisions=1, 20, 20', 'Body lower/Divisions=1, 15, 15', 'Body lower/Young modulus=7e3',
                       'Refinement/Global cycles=1')


def thin_slabs(p):
    """Slabs of one layer of cells of aspect ratio 50, three meshes: what sweeps by node do not see, and bending that coarse meshes of such cells do not have."""
    upper = ('Body upper/Upper corner=1, 1, 0.005', 'Body upper/Divisions=4, 4, 1')
    lower = ('Body lower/Lower corner=0, 0, -0.006', 'Body lower/Divisions=3, 3, 1')
    on_block = ('Body upper/Dirichlet=left: (0, 0, 0)', 'Body upper/Tractions=top: (0, 0, -1e-3)')
    bending = (*lower, 'Body upper/Dirichlet=left: (0, 0, 0)', 'Body lower/Dirichlet=left: (0, 0, 0); right: (0, 0, 0)', 'Body upper/Tractions=top: (0, 0, -1e-5)',
               'Body lower/Divisions=4, 4, 1')
    bulged = (*lower, 'Body upper/Dirichlet=left: (0, 0, 0); right: (0, 0, 0)', 'Body lower/Dirichlet=bottom: (0, 0, 0)', 'Body upper/Tractions=top: (0, 0, -1e-4)',
              'Pair interface/Initial gap=1e-4*(x-0.5)^2')
    two = ('Refinement/Global cycles=2', 'Solver/Compare linear multigrid=false')
    for tetrahedra in ('false', 'true'):
        kind = [f'Body {b}/Convert to tetrahedra={tetrahedra}' for b in ('upper', 'lower')]
        for text, settings in (('slab on a block', on_block), ('two slabs that bend', bending), ('bulged slab', bulged)):
            s = bounded_iterations(p, f'{text}, tetrahedra {tetrahedra}', 35, *upper, *settings, *kind, *two, prm='patch_test/patch_test.prm')
            other = [o for o in s['certificate']['objections'] if 'refine the contact surfaces' not in o]
            check(len(s['cycles']) == 3 and not other, f'{text}: {len(s["cycles"])} meshes, {other}')
            nets = [c['nonlinear']['safety_net'] for c in s['cycles'] if 'safety_net' in c['nonlinear']]
            check(all(n['failed_attempts'] == 0 and n['linear_solver'] == 'sparse factors' for n in nets), f'{text}: {nets}')
            patches = sum(c['nonlinear'].get('patches_after_iterations', 0) > 0 for c in s['cycles'])
            check(len(nets) + patches == sum('the iteration was slow' in n for n in s['notes']), f'{text}: notes of the safety net: {s["notes"]}')


def slow_and_large(p):
    """What is slow and not small: sparse factors where they are cheap, else active-set steps with V-cycles."""
    s = bounded_iterations(p, 'slab of stretched tetrahedra', 60, 'Body upper/Upper corner=1, 1, 0.005', 'Body upper/Divisions=4, 4, 1', 'Body upper/Convert to tetrahedra=true',
                           'Body upper/Dirichlet=left: (0, 0, 0)', 'Body upper/Tractions=top: (0, 0, -1e-3)', 'Body lower/Divisions=5, 5, 5', 'Refinement/Global cycles=2',
                           'Solver/Compare linear multigrid=false', prm='patch_test/patch_test.prm')
    check(s['cycles'][-1]['dofs'] > 30000, f'{s["cycles"][-1]["dofs"]} unknowns')
    check(s['cycles'][-1]['nonlinear']['safety_net']['linear_solver'] == 'sparse factors', 'no sparse factors')
    s = bounded_iterations(p, 'block of stretched tetrahedra', 160, 'Body upper/Upper corner=0.5555, 1.9099, 1.5194', 'Body upper/Divisions=9, 4, 13', 'Body upper/Convert to tetrahedra=true',
                           'Body upper/Young modulus=0.1084', 'Body upper/Poisson ratio=0.4868', 'Body lower/Divisions=2, 4, 4', 'Body lower/Young modulus=6.8e5',
                           'Refinement/Global cycles=2', 'Solver/Compare linear multigrid=false', prm='patch_test/patch_test.prm')
    net = s['cycles'][-1]['nonlinear']['safety_net']
    check(net['linear_solver'] == 'conjugate gradients with the V-cycle' and net['failed_attempts'] == 0, f'{net}')


def stiff_nonmortar(p):
    """The stiffer body chosen as nonmortar side, its mesh finer or coarser than the other."""
    two = 'Refinement/Global cycles=2'
    for ratio in ('1e-1', '1e-2', '1e-4', '1e-6'):
        stiff = ('Body upper/Young modulus=1', f'Body lower/Young modulus={ratio}', two)
        bounded_iterations(p, f'ratio {ratio}, finer', 25, *stiff, nonmortar='first')
        if ratio == '1e-4':
            bounded_iterations(p, f'ratio {ratio}, coarser', 25, *stiff, 'Body upper/Divisions=2, 2, 2', 'Body lower/Divisions=3, 3, 3', nonmortar='first')
    # Without interface sweeps the active set goes to and fro while the solver takes it to rest.
    s = bounded_iterations(p, 'no interface sweeps', 40, 'Body upper/Young modulus=1', 'Body lower/Young modulus=1e-3', 'Refinement/Global cycles=0',
                           'Solver/Interface sweeps=0', 'Solver/Check monotonicity=true', nonmortar='first')
    rise = max(c['nonlinear']['monotonicity']['largest_energy_rise'] for c in s['cycles'])
    check(rise <= 1e-12, f'the energy rises by {rise}')


def robust(p):
    """Iterations where solvers use to fail."""
    def run(text, bound, *settings, prm='cubes/cubes.prm'):
        bounded_iterations(p, text, bound, *settings, prm=prm)

    two = 'Refinement/Global cycles=2'
    for ratio in ('1e-6', '1e-3', '1', '1e3', '1e6'):
        run(f'stiffness ratio {ratio}', 15, 'Body upper/Young modulus=1', f'Body lower/Young modulus={ratio}', two)
    soft = ('Body upper/Poisson ratio=0.49', 'Body lower/Poisson ratio=0.49', 'Body lower/Young modulus=7e3')
    run('nu = 0.49', 25, *soft, 'Body upper/Element=standard', two)
    run('nu = 0.49, mean dilatation', 28, *soft, 'Body lower/Element=automatic', two)
    # Bulk contact on six levels, equal materials, the border of the contact surface in contact.
    run('whole interface, six levels', 12, 'Body upper/Divisions=1, 1, 1', 'Body lower/Divisions=1, 1, 1', 'Body lower/Lower corner=-0.25, -0.25, -1',
        'Body lower/Upper corner=1.25, 1.25, 0', f'Refinement/Global cycles={4 if p.command[0] == "mpirun" else 5}', prm='patch_test/patch_test.prm')
    run('a single node', 15, 'Pair interface/Initial gap=10*((x-0.5)^2 + (y-0.5)^2) - 0.001', 'Body upper/Divisions=2, 2, 2',
        'Body upper/Dirichlet=top: (0, 0, 0)', two)
    run('separation', 15, 'Pair interface/Initial gap=1', two)
    run('initial penetration', 15, 'Pair interface/Initial gap=-0.1', 'Pair interface/Initial penetration=resolve', two)
    run('fixed border', 15, 'Body upper/Dirichlet=top: (0, 0, -0.05); left: (0, 0, 0)', 'Body lower/Dirichlet=bottom: (0, 0, 0); left: (0, 0, 0)', two)


def nested(p):
    """Nested iteration: two cycles a level reach far below the discretization error, and the active set hardly moves."""
    for prm, settings in (('cubes/cubes.prm', ()), ('obstacle/paraboloid.prm', ()), ('hertz/hertz.prm', ('Refinement/Final global cycles=1',))):
        rough = p.solve(prm, 'Solver/Tolerance=1e-2', *settings)
        exact = p.solve(prm, *settings)
        for i, (a, b) in enumerate(zip(rough['cycles'], exact['cycles'])):
            # While a single node of a curved surface is in contact the mesh is too coarse for the gap, and a poor start for the next one.
            resolved = b['active_nodes'] > 1
            check(i == 0 or a['nonlinear']['iterations'] <= (2 if resolved else 3), f'{prm}, level {i}: {a["nonlinear"]["iterations"]} iterations')
            near(a['energy'], b['energy'], 1e-6 if resolved else 1e-5, f'{prm}, level {i}: energy')
            check(a['active_nodes'] == b['active_nodes'], f'{prm}, level {i}: {a["active_nodes"]} active nodes, not {b["active_nodes"]}')
            check(b['nonlinear']['hierarchy_updates'] <= 3, f'{prm}, level {i}: {b["nonlinear"]["hierarchy_updates"]} changes of the active set')


def from_zero(p):
    """Without coarser meshes solved before: a start from the levels below, in hardly more iterations and with the same solution."""
    serial = p.command[0] != 'mpirun'
    problems = (('S1', 10, 'obstacle/paraboloid.prm', 4 if serial else 3, ()), ('S1, weighted gaps', 10, 'obstacle/paraboloid.prm', 3, ('Pair bottom/Gap=weighted',)),
                ('M1', 14, 'cubes/cubes.prm', 3 if serial else 2, ()), ('whole interface', 12, 'patch_test/patch_test.prm', 3, ()),
                # Conjugate gradients take 24 on the linear problem.
                ('nu = 0.49', 29, 'cubes/cubes.prm', 2, ('Body upper/Poisson ratio=0.49', 'Body upper/Element=standard', 'Body lower/Poisson ratio=0.49', 'Body lower/Young modulus=7e3')),
                ('soft below', 15, 'cubes/cubes.prm', 2, ('Body upper/Young modulus=1', 'Body lower/Young modulus=1e-6', 'Pair interface/Nonmortar=auto')),
                ('soft above', 15, 'cubes/cubes.prm', 2, ('Body upper/Young modulus=1', 'Body lower/Young modulus=1e6')),
                ('separation', 15, 'cubes/cubes.prm', 2, ('Pair interface/Initial gap=1',)),
                ('initial penetration', 15, 'cubes/cubes.prm', 2, ('Pair interface/Initial gap=-0.1', 'Pair interface/Initial penetration=resolve')),
                ('rough gap', 15, 'cubes/cubes.prm', 2, ('Pair interface/Initial gap=0.01*sin(50*x)*sin(70*y)',)),
                ('fixed border', 15, 'cubes/cubes.prm', 2, ('Body upper/Dirichlet=top: (0, 0, -0.05); left: (0, 0, 0)', 'Body lower/Dirichlet=bottom: (0, 0, 0); left: (0, 0, 0)')))
    for text, bound, prm, levels, settings in problems:
        last = p.solve(prm, f'Refinement/Global cycles={levels}', *settings)['cycles'][-1]
        fine = ('Refinement/Global cycles=0', f'Refinement/Initial global levels={levels}') + settings
        s = p.solve(prm, 'Solver/Check monotonicity=true', *fine)
        # A stiffness a million times that of the other body loses six digits of the equilibrium, with or without a start; a body that moves rigidly has no forces
        # to measure it by.
        if text not in ('soft below', 'separation'):
            certificate(s)
        check(max(s['certificate'][c] for c in ('penetration', 'tension', 'complementarity')) < 1e-7, f'{text}: certificate {s["certificate"]}')
        cycle = s['cycles'][-1]
        solver = cycle['nonlinear']
        check(solver['iterations'] <= bound, f'{text}: {solver["iterations"]} iterations')
        # A solution that a coarser mesh has already takes no iterations in nested iteration.
        if text not in ('separation', 'whole interface'):
            check(solver['iterations'] <= last['nonlinear']['iterations'] + 5, f'{text}: {solver["iterations"]} iterations, {last["nonlinear"]["iterations"]} in nested iteration')
        start = solver.get('start_iterations', [])
        check(len(start) == levels - 1 and max(start) <= 6, f'{text}: iterations of the start {start}')
        check(solver['monotonicity']['largest_energy_rise'] <= 1e-13, f'{text}: energy')
        near(cycle['energy'], last['energy'], 1e-10, f'{text}: energy')
        check(cycle['active_nodes'] == last['active_nodes'], f'{text}: active nodes')
        # The methods of the papers go without.
        other = p.solve(prm, 'Solver/Method=truncated newton multigrid', *fine)['cycles'][-1]
        check('start_iterations' not in other['nonlinear'], f'{text}: a start for truncated newton multigrid')
        near(other['energy'], last['energy'], 1e-10, f'{text}: energy of truncated newton multigrid')


def free_bodies(p):
    """Bodies that only contact holds."""
    # The weight is carried; sliding and turning on the floor are undetermined and said to be.
    s = p.solve('obstacle/resting.prm')
    check(s['converged'], 'not converged')
    near(s['pairs'][0]['force'][2], 1., 1e-9, 'weight')
    free = [n for n in s['notes'] if 'nothing determines body cube' in n]
    check(len(free) == 2 and any('translation in any direction normal to (0, 0, 1):' in n for n in free) and
          any('rotation about the axis through (' in n and ' along (0, 0, 1)' in n for n in free), f'notes: {s["notes"]}')
    for c in s['cycles']:
        check(c['nonlinear']['iterations'] <= 25, f'cycle {c["cycle"]}: {c["nonlinear"]["iterations"]} iterations')
    # An eccentric weight, inside of the base.
    s = p.solve('obstacle/resting.prm', 'Body cube/Volume force=(0, 0, -1*(x > 0.5))', 'Refinement/Global cycles=2')
    near(s['pairs'][0]['force'][2], .5, 1e-8, 'eccentric weight')
    # In a bowl only a part touches.
    s = p.solve('obstacle/resting.prm', 'Pair floor/Obstacle=hollow sphere: (0.5, 0.5, 5), 5.3', 'Refinement/Global cycles=2')
    near(s['pairs'][0]['force'][2], 1., 1e-8, 'weight in a bowl')
    # A body between two others passes the force on.
    s = p.solve('../tests/application/stack.prm')
    certificate(s)
    iterations(s)
    check(s['cycles'][-1]['nonlinear']['iterations'] <= 12, f'stack: {s["cycles"][-1]["nonlinear"]["iterations"]} iterations')
    below, above = (next(q for q in s['pairs'] if q['name'] == name) for name in ('below', 'above'))
    near(below['force'][2], -above['force'][2], 1e-9, 'force through the middle')
    # Loads that contact cannot hold.
    for setting, word in (('Body cube/Volume force=(0, 0, 1)', 'translation (0, 0, 1)'), ('Body cube/Volume force=(0.1, 0, -1)', 'translation (1, 0, 0)'),
                          ('Solver/Method=active set amg', 'rigid motion')):
        with tempfile.TemporaryDirectory() as folder:
            run = p.call(os.path.join(TOP, 'prm', 'obstacle/resting.prm'), '--output', os.path.join(folder, 'out'), '--set', setting)
            check(run.returncode == 1 and word in run.stderr, f'{setting}: {run.returncode}, {run.stderr}')
            check(os.listdir(folder) == [], f'{setting}: something was written')


def held_by_contact(p):
    """Bodies that only contact holds, on each other and on curved surfaces: few iterations, forces that balance the loads."""
    loads = {'blocks': ('floor', (0, 0, 2.392)), 'socket': ('seat', None), 'plate': ('first', (0, 0, -2.16)), 'rollers': ('on left', None), 'weight': ('floor', None)}
    # What nothing determines is as small as contact allows, whatever the sweeps round: values of one rank.
    displacements = {'blocks': (.0122223076, .0140418980, .0141812209, .0148454589, .0150874017), 'socket': (.0266970715, .0020191055),
                     'plate': (.0431779457, .0196185190), 'rollers': (.0738644403, .0051191262, .0051136212), 'weight': (1.044195690e-05,)}
    for name, (pair, force) in loads.items():
        s = p.solve(f'../tests/application/{name}.prm')
        counts = [c['nonlinear']['iterations'] for c in s['cycles']]
        print(f'{name}: {counts} iterations')
        check(s['converged'] and max(counts) <= 25, f'{name}: {counts} iterations')
        check(s['certificate']['equilibrium'] <= 1e-8, f'{name}: equilibrium {s["certificate"]["equilibrium"]}')
        for body, largest in zip(s['bodies'], displacements[name]):
            near(body['largest_displacement'], largest, 1e-6, f'{name}: displacement of body {body["name"]}')
        found = next(q for q in s['pairs'] if q['name'] == pair)['force']
        for c in range(3 if force else 0):
            check(abs(found[c] - force[c]) <= 1e-9 * max(map(abs, force)), f'{name}: force {found}, expected {force}')
        if name == 'weight':
            # The mesh is a little smaller than the ball.
            near(found[2], 7.7e-5 * 4 / 3 * math.pi * 1e3, .07, 'weight of the ball')
            check(max(abs(found[0]), abs(found[1])) <= 1e-9 * found[2], f'weight: force {found}')
        if name == 'plate':
            check(any('nothing determines body plate, rotation about the axis through (0, 0, 1.5) along (0, 0, 1)' in n for n in s['notes']), f'notes: {s["notes"]}')
            for ball, centre in (('one', '(2, 0, 0)'), ('two', '(-1.5, 1.5, 0)'), ('three', '(-1.5, -1.5, 0)')):
                check(sum(f'nothing determines body {ball}, rotation' in n for n in s['notes']) == 1 and
                      any(f'nothing determines body {ball}, rotation about any axis through {centre}:' in n for n in s['notes']), f'notes: {s["notes"]}')
        if name == 'rollers':
            check(any('body shaft, rotation about the axis through (0, 0, 0)' in n or 'body shaft, translation (0, 0, 1)' in n for n in s['notes']),
                  f'notes: {s["notes"]}')


def eye_on_pin(p):
    """A finished mesh whose pulled boundary is held, may slide, moves as a rigid face: as many iterations; what is idle is said and stays small."""
    eye = '../tests/application/eye.prm'
    few = ['Body eye/Round divisions=4, 20, 5', 'Body pin/Round divisions=3, 18, 6'] if len(p.command) > 1 else []

    def solve(setting):
        s = p.solve(eye, f'Body eye/{setting}', *few, 'Solver/Maximal iterations=60')
        n = s['cycles'][0]['nonlinear']['iterations']
        print(f'{setting}: {n} iterations, largest displacement {s["bodies"][0]["largest_displacement"]}')
        certificate(s)
        return s, n, s['pairs'][0]['force'][1], s['bodies'][0]['largest_displacement']

    held, usual, force, _ = solve('Dirichlet=symmetry y: (0, -0.1, 0)')
    idle = 'nothing determines body eye'
    check(not any(idle in note for note in held['notes']), f'held: {held["notes"]}')
    for setting, same_as in [('Dirichlet=symmetry y: (0, -0.1, *)', 1e-2), ('Rigid=symmetry y: displacement (0, -0.1, *), rotation (0, 0, 0)', 1e-9),
                             ('Rigid=symmetry y: displacement (0, -0.1, 0), rotation (0, 0, *)', 1e-9),
                             (f'Rigid=symmetry y: force (0, {-force!r}, 0), along (0, 1, 0)', 1e-9),
                             (f'Rigid=symmetry y: force (0, {-force!r}, 0)', 1e-9)]:
        s, n, found, largest = solve(setting)
        check(n <= usual + 3, f'{setting}: {n} iterations, held {usual}')
        near(found, force, same_as, f'{setting}: force')
        check(largest <= .11, f'{setting}: displacement {largest}')
        check(any(idle in note for note in s['notes']) == ('along' not in setting), f'{setting}: {s["notes"]}')


# doc/verification.md, H1: F/4, a, p0 of this geometry (M1, M2) and the bars at about 50,000 and 400,000 unknowns.
H1 = {'M1': (('6.896e5', '0.45'), (20.820, 0.4031, 244.63)), 'M2': (('7e3', '0.3'), (10.638, 0.4047, 124.01))}
COARSE_BARS, FINE_BARS = (1e-2, 2e-2, 3e-2), (3e-3, 7e-3, 1.5e-2)


def hertz_errors(p, material, final_cycles, comparison):
    (young, poisson), reference = H1[material]
    with tempfile.TemporaryDirectory() as folder:
        s = p.solve('hertz/hertz.prm', f'Body block/Young modulus={young}', f'Body block/Poisson ratio={poisson}',
                    f'Refinement/Final global cycles={final_cycles}', f'Solver/Compare linear multigrid={comparison}',
                    keep=os.path.join(folder, 'out'))
        rows = read_pressure(os.path.join(folder, 'out', 'pressure.csv'))
    certificate(s)
    for cycle in s['cycles']:
        # While a single node is in contact the meshes are too coarse for the ball between their nodes: a solution is a poor start for the next mesh
        # (the first correction is 0.63 of the iterate, later 0.05), conjugate gradients on the linear problem take as many.
        bound = 13 if cycle['active_nodes'] > 1 else 14
        check(cycle['nonlinear']['iterations'] <= bound, f'{material}: {cycle["nonlinear"]["iterations"]} iterations')
    force = s['pairs'][0]['force'][2]
    weights = [row['pressure'] * row['area'] for row in rows]
    radius = 16 / (3 * math.pi) * sum(w * math.hypot(r['x'], r['y']) for w, r in zip(weights, rows)) / sum(weights)
    values = (force, radius, 6 * force / (math.pi * radius ** 2))
    return s, [abs(v / r - 1) for v, r in zip(values, reference)]


def hertz(p):
    for material in H1:
        _, before = hertz_errors(p, material, 0, 'false')
        s, errors = hertz_errors(p, material, 1, 'true')
        iterations(s)
        for name, old, new, bar in zip(('force', 'radius', 'pressure'), before, errors, COARSE_BARS):
            check(new < bar, f'{material}, {name}: error {new}, bar {bar}')
            check(new < old, f'{material}, {name}: error {new} on the finer, {old} on the coarser mesh')


def hertz_fine(p):
    for material in H1:
        s, errors = hertz_errors(p, material, 2, 'false')
        for name, error, bar in zip(('force', 'radius', 'pressure'), errors, FINE_BARS):
            check(error < bar, f'{material}, {name}: error {error}, bar {bar}')
        cycle = s['cycles'][-1]
        check(s['peak_memory_bytes'] < 3000 * cycle['dofs'], f'{s["peak_memory_bytes"] / cycle["dofs"]} bytes per unknown')


def paper(p):
    s = p.solve('hertz/paper.prm')
    certificate(s)
    iterations(s)
    radius = math.sqrt(s['pairs'][0]['contact_area'] / math.pi)
    check(0.05 < radius < 0.1, f'a/R = {radius}')


def units(p):
    base = p.solve('cubes/cubes.prm', 'Refinement/Global cycles=2')
    for length, young in ((1e-6, 1.), (1e6, 1.), (1., 1e-6), (1., 1e12)):
        s = p.solve('cubes/cubes.prm', 'Refinement/Global cycles=2', f'Body upper/Upper corner={length}, {length}, {length}',
                    f'Body lower/Lower corner=0, 0, {-length}', f'Body lower/Upper corner={length}, {length}, 0',
                    f'Body upper/Dirichlet=top: (0, 0, {-0.05 * length})',
                    f'Pair interface/Initial gap=((x/{length}-0.5)^2 + (y/{length}-0.5)^2)*{length}',
                    f'Body upper/Young modulus={7e3 * young}', f'Body lower/Young modulus={6.896e5 * young}')
        near(s['pairs'][0]['force'][2], base['pairs'][0]['force'][2] * young * length ** 2, 1e-8, f'force at {length}, {young}')
        for a, b in zip(s['cycles'], base['cycles']):
            check(a['nonlinear']['iterations'] == b['nonlinear']['iterations'], f'iterations at {length}, {young}')
            check(a['active_nodes'] == b['active_nodes'], f'active nodes at {length}, {young}')


def errors(p):
    prm = os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm')
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        cases = [(['missing.prm'], 'missing.prm'),
                 ([prm, '--set', 'Body upper/Colour=red'], 'Colour'),
                 ([prm, '--set', 'Body upper/Neumann=top: (0, 0, 1)'], 'Perhaps "Tractions" or "Forces" is meant.'),
                 ([prm, '--set', 'Body upper/Poison ratio=0.3'], 'Perhaps "Poisson ratio" is meant.'),
                 ([prm, '--set', 'Tolerance=1e-3'], 'It is a parameter of subsection "Solver".'),
                 ([prm, '--set', 'Body uper/Mesh=block'], 'Perhaps "Body upper" or'),
                 ([prm, '--set', 'Pair interface/Colour=red'], '"Contact"'),
                 ([prm, '--set', 'Body upper/Dirichlet=lid: (0, 0, 0)'], 'Body upper/Dirichlet: body upper has no boundary "lid"'),
                 ([prm, '--set', 'Body upper/Poisson ratio=0.5'], 'Poisson ratio'),
                 ([prm, '--set', 'Body upper/Young modulus=0'], 'Young modulus'),
                 ([prm, '--set', 'Body upper/Volume force=(1, 0, 0)', '--set', 'Body upper/Dirichlet=top: (*, *, -0.01)'], 'fly away'),
                 ([prm, '--set', 'Body lower/Translation=5, 0, 0'], 'overlay cell'),
                 ([prm, '--set', 'Body lower/Translation=5, 0'], '3 numbers separated by commas'),
                 ([prm, '--set', 'Body upper/Divisions=1, 0, 1'], '3 integers from 1'),
                 ([prm, '--set', 'Body upper/Mesh=missing.msh'], 'missing.msh'),
                 ([prm, '--set', 'Pair interface/First=upper: lid'], 'Pair interface/First: body upper has no boundary "lid"'),
                 ([prm, '--set', 'Body upper/Dirichlet=top: (0, 0, bla(x))'], 'bla'),
                 ([prm, '--set', 'Body upper/Dirichlet=top: (1/(x-1), 0, 0)'], 'finite'),
                 ([prm, '--set', 'Solver/Level 0=algebraic monotone'], '"algebraic shortened"'),
                 ([prm, '--set', 'Solver/Level 0=cholsky'], 'only algebraic shortened, amg, automatic, cholesky'),
                 ([prm, '--set', 'Solver/Method=multigrid cg'], 'Pair interface/Contact: the solvers multigrid'),
                 ([prm, '--set', 'Body upper/Tractions=lid: (0, 0, 1)'], 'Body upper/Tractions: body upper has no boundary'),
                 ([prm, '--wrong'], '--wrong')]
        for arguments, word in cases:
            run = p.call(*arguments, '--output', out)
            check(run.returncode not in (0, 2) and run.returncode > 0, f'{arguments[1:]}: exit code {run.returncode}')
            check(word in run.stderr, f'{arguments}: the message does not name "{word}": {run.stderr}')
            check(run.stderr.count('signorini: error:') == 1, f'{arguments}: not one message: {run.stderr}')
            check(os.listdir(folder) == [], f'{arguments}: left {os.listdir(folder)}')
    # Names that are not in UTF-8 (AFL++): the error is said, without suggestions.
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'latin.prm')
        with open(os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm'), 'rb') as f:
            text = f.read().replace(b'upper', b'k\xf6rper') + b'set Load sreps = 2\n'
        with open(path, 'wb') as f:
            f.write(text)
        run = subprocess.run([*p.command, path, '--check'], env=p.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        check(run.returncode == 1 and b'No entry with name <Load sreps>' in run.stderr, f'not UTF-8: {run.returncode}, {run.stderr}')
        # Zero bytes end a message (AFL++): UTF-16.
        with open(path, 'wb') as f:
            f.write(text.decode('latin-1').encode('utf-16'))
        run = subprocess.run([*p.command, path, '--check'], env=p.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        check(run.returncode == 1 and b'has zero bytes, as texts in UTF-16 have: save it in UTF-8.' in run.stderr, f'UTF-16: {run.returncode}, {run.stderr}')


def command_line(p):
    prm = os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm')
    check('usage' in p.call('--help').stdout, 'no usage')
    check('signorini 0' in p.call('--version').stdout, 'no version')
    check('Young modulus' in p.call('--print-parameters').stdout, 'no parameters')
    run = p.call('--check', prm)
    check(run.returncode == 0 and 'boundary top: area 1,' in run.stdout, f'check: {run.stdout} {run.stderr}')
    with tempfile.TemporaryDirectory() as folder:
        run = p.call('--mesh-only', prm, '--output', folder + '/out')
        check(run.returncode == 0 and os.path.exists(folder + '/out/contact-interface.pvtu'), f'mesh-only: {run.stderr}')
        check(os.path.exists(folder + '/out/mapping-interface.0.vtu'), 'no mapping graph')
        check('covered          100 %' in run.stdout, f'no mapping report: {run.stdout}')
        with open(folder + '/out/summary.json') as f:
            mapping = json.load(f)['mappings'][0]
        check(mapping['pair'] == 'interface' and mapping['unmapped'] == {}, f'mapping: {mapping}')
        near(mapping['coverage_nonmortar'], 1, 1e-12, 'coverage')


def write_square(path, n, low, high, heights, up, front_end=None):
    """Triangulated squares [low, high]^2 above each other as an OFF file; the first one may end elsewhere in x."""
    vertices, triangles = [], []
    for layer, z in enumerate(heights):
        end = high if front_end is None or layer > 0 else front_end
        vertices += [(low + (end - low) * i / (n + layer), low + (high - low) * j / (n + layer), z) for j in range(n + layer + 1) for i in range(n + layer + 1)]
        first = len(vertices) - (n + layer + 1) ** 2
        for j in range(n + layer):
            for i in range(n + layer):
                a, b = (first + k * (n + layer + 1) + i for k in (j, j + 1))
                for t in ((a, a + 1, b + 1), (a, b + 1, b)):
                    triangles.append(t if up else (t[0], t[2], t[1]))
    with open(path, 'w') as f:
        f.write(f'OFF\n{len(vertices)} {len(triangles)} 0\n')
        f.writelines('%.17g %.17g %.17g\n' % v for v in vertices)
        f.writelines('3 %d %d %d\n' % t for t in triangles)


def surface_map(p):
    """signorini-map, which stands beside the program."""
    def call(name, *arguments):
        return subprocess.run([os.path.join(os.path.dirname(p.command[0]), name), *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, timeout=100)
    with tempfile.TemporaryDirectory() as folder:
        non, mor, out, vtu = (os.path.join(folder, name) for name in ('non.off', 'mor.off', 'out.json', 'out.vtu'))
        write_square(non, 3, 0, 1, (0,), True)
        write_square(mor, 4, .5, 1.5, (.25,), False)
        run = call('signorini-map', non, mor, '--report', '--strict', '--json', out, '--vtu', vtu)
        check(run.returncode == 0, f'exit code {run.returncode}: {run.stderr}')
        check('covered          25 % of the nonmortar, 25 % of the mortar' in run.stdout, f'report: {run.stdout}')
        check('gap              from 0.25 to 0.25' in run.stdout, f'report: {run.stdout}')
        with open(out) as f:
            s = json.load(f)
        for key in ('coverage_nonmortar', 'coverage_mortar', 'area'):
            near(s[key], .25, 1e-12, key)
        check(s['worst_tiling_defect'] <= 1e-12, f'tiling: {s}')
        check(s['unmapped'] == {'no hit': 9, 'outside the rim': 7}, f'unmapped: {s["unmapped"]}')
        check(s['time_s'] > 0 and s['peak_memory_bytes'] > 1e6 and s['cells'] >= s['pairs'] > 0, f'figures: {s}')
        check(os.path.getsize(vtu) > 1000, 'no image file')
        # A second plate behind the first is left out.
        write_square(mor, 3, 0, 1, (.25, .5), False)
        run = call('signorini-map', non, mor, '--strict', '--json', out)
        check(run.returncode == 0, f'exit code {run.returncode}: {run.stderr}')
        with open(out) as f:
            s = json.load(f)
        near(s['area'], 1, 1e-12, 'area')
        check(s['unmapped'] == {'behind another layer': 25}, f'unmapped: {s["unmapped"]}')
        # Cut in the middle of a cell, the first one hides half of cells of the second: that is no mapping, and that is said.
        write_square(mor, 3, 0, 1, (.25, .5), False, front_end=.5)
        for options, code in (([], 0), (['--strict'], 1)):
            run = call('signorini-map', non, mor, '--report', *options)
            check(run.returncode == code, f'{options}: exit code {run.returncode}: {run.stderr}')
            check('errors' in run.stdout and 'not one-to-one' in run.stdout, f'{options}: {run.stdout}')
            check(f'signorini-map: {"error" if code else "WARNING"}: the mapping has errors: ' in run.stderr, f'{options}: {run.stderr}')
        # Nobody misses it who asks for figures alone.
        run = call('signorini-map', non, mor, '--json', out)
        with open(out) as f:
            s = json.load(f)
        check('WARNING: the mapping has errors' in run.stderr and s['errors'] != '', f'{run.stderr}, {s["errors"]}')
        check(s['worst_tiling_defect'] > 1e-9 or s['lost_edges'] + s['lost_triangles'] + s['torn_edges'] > 0, f'figures: {s}')
        write_square(mor, 4, .5, 1.5, (.25,), False)
        for arguments, word in [((non,), 'two surface files'), ((non, mor, '--colour'), '--colour'), ((non, 'no.off'), 'no.off'),
                                ((non, mor, '--json'), '--json'), ((non, non), 'face each other')]:
            run = call('signorini-map', *arguments)
            check(run.returncode == 1 and word in run.stderr, f'{arguments}: {run.returncode}, {run.stderr}')


if __name__ == '__main__':
    modules = (sys.modules[__name__], certificate_cases, checkpoint_cases, deck_cases, geometry_cases, hardening_cases, heat_cases, finished_mesh_cases, free_body_cases, load_cases, output_cases, random_pair_cases, rank_cases, report_cases, seam_cases, shape_cases, slender_cases,
               tool_cases, true_gap_cases, verification_cases, verify_cases, whole_boundary_cases)
    case = next(getattr(m, sys.argv[2]) for m in modules if hasattr(m, sys.argv[2]))
    case(Program(sys.argv[1], int(sys.argv[3])))
    for failure in FAILURES:
        print('FAILED:', failure)
    sys.exit(1 if FAILURES else 0)
