"""Cases of conditions and loads: rollers in any direction, total forces, rigid faces, load steps."""
import csv
import math
import os
import tempfile

from geometry_cases import PATCH_TEST, turn
from harness import TOP, certificate, check, constant_pressure, near

AXES = [('1, 2, 3', 33.3), ('0, 0, 1', 90), ('1, -1, 0.2', 147), ('0, 1, 0', 45)]


def rotated(axis, angle, *bodies):
    return [f'Body {b}/Rotation {k}' for b in bodies for k in (f'axis={axis}', f'angle={angle}')]


def vector(v):
    return '(' + ', '.join(repr(c) for c in v) + ')'


def oblique_rollers(p):
    """The patch test held by rollers along the normals of its sides, contact nodes among them, however it lies."""
    tetrahedra = [f'Body {b}/Convert to tetrahedra=true' for b in ('upper', 'lower')]
    hanging = ['Refinement/Regions=ball: (0.4, 0.5, 0.3), 0.31, 1; ball: (0.6, 0.5, -0.3), 0.31, 2']
    background = ['Solver/Coarse levels=background']
    runs = [(axis, angle, more) for axis, angle in AXES for more in ([], tetrahedra + hanging)] + [AXES[0] + (background,)]
    for axis, angle, more in runs if p.command[0] != 'mpirun' else runs[:2] + runs[-1:]:
        point = (.4, .5, .3)
        probe = turn(point, axis, angle)
        s = p.solve(PATCH_TEST, *rotated(axis, angle, 'upper', 'lower'), *more,
                    'Body upper/Dirichlet=left: (normal: 0); front: (normal: 0)', 'Body upper/Pressures=top: 2.5',
                    'Body lower/Dirichlet=left: (normal: 0); front: (normal: 0); bottom: (normal: 0)',
                    f'Body upper/Probes=inside: {vector(probe)}')
        constant_pressure(s, 2.5)
        certificate(s)
        check(all(c['nonlinear']['iterations'] <= 12 for c in s['cycles']), f'{axis}, {angle}, {more}: iterations')
        strain = 2.5e-3
        expected = turn([.3 * strain * point[0], .3 * strain * point[1], -strain * (1 + point[2])], axis, angle)
        for value, wanted in zip(s['probes'][0]['displacement'], expected):
            check(abs(value - wanted) <= 1e-10 * strain, f'{axis}, {angle}, {more}: displacement {value}, expected {wanted}')
    # A quarter of Hertz' ball in a skew place is what it is in a straight one.
    place, ends = rotated('1, 2, 3', 33.3, 'ball', 'block'), []
    turned = {name: vector(turn(v, '1, 2, 3', 33.3)) for name, v in (('down', (0, 0, -1)), ('x', (1, 0, 0)))}
    # Regions choose cells at their border by rounding, and not the same ones in another place.
    few = ['Refinement/Final global cycles=0', 'Refinement/Regions=', 'Refinement/Global cycles=3',
           'Pair contact/First region=4.1 - x^2 - y^2 - z^2', 'Pair contact/Second region=9.1 - x^2 - y^2 - z^2']
    straight = p.solve('hertz/hertz.prm', *few, 'Body ball/Dirichlet=symmetry x: (0, *, *); symmetry y: (*, 0, *); top: (0, 0, -0.2)')
    skew = p.solve('hertz/hertz.prm', *few, *place,
                   'Body ball/Translation=' + vector(turn((0, 0, 8), '1, 2, 3', 33.3))[1:-1],
                   f'Body ball/Dirichlet=symmetry x: (normal: 0); symmetry y: (normal: 0); top: {vector(turn((0, 0, -.2), "1, 2, 3", 33.3))}',
                   f'Body block/Dirichlet=symmetry x: (along {turned["x"]}: 0); symmetry y: (normal: 0); bottom: (0, 0, 0)')
    for a, b in zip(straight['cycles'], skew['cycles']):
        check(abs(a['nonlinear']['iterations'] - b['nonlinear']['iterations']) <= 1,
              f'cycle {a["cycle"]}: {b["nonlinear"]["iterations"]} iterations in a skew place, {a["nonlinear"]["iterations"]} in a straight one')
    near(skew['pairs'][0]['max_pressure'], straight['pairs'][0]['max_pressure'], 1e-8, 'largest pressure')
    check(skew['cycles'][-1]['active_nodes'] == straight['cycles'][-1]['active_nodes'], 'active nodes')
    certificate(skew)


def cylindrical_rollers(p):
    """Two round pieces on each other, squeezed from their sides: the pressure is constant, and so is the strain.

    One of them has tetrahedra: on two distorted quadrilaterals the integrands are no polynomials, and the quadrature is
    good to 5e-9 only."""
    piece = ['Mesh=quarter of cylinder', 'Radius=1', 'Height=1', 'Young modulus=1000', 'Poisson ratio=0.3']
    for axis, angle in AXES[:1] if p.command[0] == 'mpirun' else AXES:
        kind = f'Body {"upper" if angle > 40 else "lower"}/Convert to tetrahedra=true'
        n = turn((0, 0, 1), axis, angle)
        up = vector(n)
        # Nodes of the side lie on the circle up to what the meshing left.
        radius = f'sqrt(x^2 + y^2 + z^2 - ({n[0]!r}*x + {n[1]!r}*y + {n[2]!r}*z)^2)'
        about = f'about (0, 0, 0), {up}'
        sides = f'side: (radial: -0.001*{radius}, tangential: *) {about}; symmetry x: (normal: 0); symmetry y: (normal: 0)'
        bodies = []
        for name, end, lift in (('upper', 'top', 1), ('lower', 'bottom', 0)):
            bodies += [f'Body {name}/{setting}' for setting in piece]
            bodies += [f'Body {name}/Dirichlet={sides}; {end}: (axial: 0) {about}',
                       f'Body {name}/Translation={vector(turn((0, 0, lift), axis, angle))[1:-1]}']
        s = p.solve(PATCH_TEST, *bodies, *rotated(axis, angle, 'upper', 'lower'), kind, 'Refinement/Global cycles=1')
        lame = 1000 * .3 / (1.3 * .4)
        constant_pressure(s, 2 * lame * .001)
        certificate(s)


def total_forces(p):
    """A force that is spread over a boundary, also a curved one on several meshes, and as a tilted one."""
    s = p.solve(PATCH_TEST, 'Body upper/Dirichlet=left: (0, *, *); front: (*, 0, *)', 'Body upper/Forces=top: (0, 0, -2.5)')
    constant_pressure(s, 2.5)
    certificate(s)
    force = (1., -2., -30.)
    s = p.solve('hertz/hertz.prm', 'Refinement/Final global cycles=0', 'Body ball/Dirichlet=top: (0, 0, -0.02)',
                f'Body ball/Forces=sphere: {vector(force)}')
    reactions = [sum(b['reaction'][c] for b in s['boundaries']) for c in range(3)]
    for c in range(3):
        check(abs(reactions[c] + force[c]) <= 1e-9 * math.hypot(*force), f'reactions {reactions} to a force of {force}')


def pressure_moment(s, about):
    """The moment of the contact force on the mortar side, flat at z = 0, about a point."""
    f, m = s['pairs'][0]['force'], s['pairs'][0]['moment']
    return [m[i] - about[i - 2] * f[i - 1] + about[i - 1] * f[i - 2] for i in range(3)]


# A ball with a rigid top, whose contact surface ends at that, on a plate.
RIGID_TOP = '''set Bodies        = ball, plate
set Contact pairs = floor
subsection Body ball
  set Mesh          = quarter of half ball
  set Radius        = 10
  set Young modulus = 1e5
  set Dirichlet     = symmetry x: (0, *, *); symmetry y: (*, 0, *)
  set Rigid         = top: displacement (0, 0, -0.01), rotation (0, 0, 0)
end
subsection Body plate
  set Lower corner  = 0, 0, -14
  set Upper corner  = 8, 8, -10
  set Divisions     = 6, 6, 3
  set Young modulus = 2e5
  set Dirichlet     = left: (0, *, *); front: (*, 0, *); bottom: (*, *, 0)
end
subsection Pair floor
  set First  = ball: sphere
  set Second = plate: top
end
subsection Refinement
  set Initial global levels = 0
end
'''


def beside_rigid_face(p):
    """The softer side is the nonmortar one, but not if nodes of a rigid face would take part, and the other side does without them."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'top.prm')
        with open(path, 'w') as f:
            f.write(RIGID_TOP)
        run = p.call(path, '--output', os.path.join(folder, 'out'), '--set', 'Pair floor/Nonmortar=first')
        check(run.returncode == 1 and 'in common with a rigid face' in run.stderr, f'the ball as nonmortar side: {run.stdout}{run.stderr}')
        chosen, swapped = (p.solve(path, f'Pair floor/Nonmortar={side}') for side in ('second', 'automatic'))
        check(any('its sides are swapped, because nodes that it has in common with a rigid face' in note for note in swapped['notes']), f'sides: {swapped["notes"]}')
        near(swapped['pairs'][0]['load'], chosen['pairs'][0]['load'], 1e-10, 'load')


# A bar with three edges on a plane, pressed by its other end.
TRIANGLE = '''set Bodies        = bar
set Contact pairs = floor
subsection Body bar
  set Mesh            = prism
  set Corners         = (10, 0); (-5, 8.660254037844386); (-5, -8.660254037844386)
  set Height          = 10
  set Round divisions = 4, 0, 8
  set Young modulus   = 1000
  set Rotation axis   = 0, 0, 1
  set Rigid           = end: force (0, 0, -100)
end
subsection Pair floor
  set First    = bar: start
  set Obstacle = plane: (0, 0, 0), (0, 0, 1)
end
'''


def rigid_triangle(p):
    """A force acts at the centre of the area, which turns with the body: not at the middle of a box."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'triangle.prm')
        with open(path, 'w') as f:
            f.write(TRIANGLE)
        pressures = [p.solve(path, f'Body bar/Rotation angle={angle}')['pairs'][0]['max_pressure'] for angle in (0, 20, 45)]
        near(pressures[0], 100 / (75 * math.sqrt(3)), 0.05, 'pressure')
        for pressure in pressures[1:]:
            near(pressure, pressures[0], 1e-8, 'pressure of a turned bar')


def rigid_faces(p):
    """A stamp by force and moment does what one by displacement and rotation does; alone, with symmetry planes, guided."""
    few = p.command[0] == 'mpirun'
    held = 'Body lower/Dirichlet=bottom: (0, 0, 0)'
    probe = 'Body upper/Probes=corner: (1, 1, 1)'
    driven = 'displacement (0, 0, -0.01), rotation (0, 0.004, 0)'
    tetrahedra = 'Body upper/Convert to tetrahedra=true'
    fine = ['Body upper/Divisions=8, 8, 8', 'Body lower/Divisions=9, 9, 9', 'Solver/Coarse levels=background']
    for more in ([tetrahedra], fine) if few else ([], [tetrahedra], fine, ['Refinement/Global cycles=2']):
        prescribed = p.solve(PATCH_TEST, held, probe, 'Body upper/Dirichlet=top: (0, 0, -0.01 - 0.004*(x - 0.5))', *more)
        by_motion = p.solve(PATCH_TEST, held, probe, 'Body upper/Dirichlet=', f'Body upper/Rigid=top: {driven}', *more)
        top = next(b['reaction'] for b in prescribed['boundaries'] if b['name'] == 'top')
        sign = -1 if prescribed['pairs'][0]['nonmortar'].startswith('lower') else 1
        moment = [-sign * m for m in pressure_moment(prescribed, (.5, .5, 1))]
        by_force = p.solve(PATCH_TEST, held, probe, 'Body upper/Dirichlet=', *more,
                           f'Body upper/Rigid=top: force {vector(top)}, moment {vector(moment)}, displacement (0, 0, *), rotation (*, *, 0)')
        for s in (by_motion, by_force):
            certificate(s)
            for a, b in zip(s['probes'][0]['displacement'], prescribed['probes'][0]['displacement']):
                check(abs(a - b) <= 1e-10 * .012, f'{more}: displacement {a}, expected {b}')
            reaction = next(b['reaction'] for b in s['boundaries'] if b['name'] == 'top')
            for a, b in zip(reaction, top):
                check(abs(a - b) <= 1e-10 * abs(top[2]), f'{more}: force {a}, expected {b}')
            body = next(b for b in s['bodies'] if b['name'] == 'upper')
            for load, reaction, force, expected in zip(body['load'], body['reaction'], body['contact_force'], top if s is by_force else (0, 0, 0)):
                check(abs(load - expected) <= 1e-10 * abs(top[2]), f'{more}: load {body["load"]}, expected {expected}')
                check(abs(load + reaction + force) <= 1e-9 * abs(top[2]), f'{more}: {body} is not in balance')
            for a, b in zip(s['cycles'], prescribed['cycles']):
                check(a['nonlinear']['iterations'] <= b['nonlinear']['iterations'] + 3,
                      f'{more}: {a["nonlinear"]["iterations"]} iterations, by displacement {b["nonlinear"]["iterations"]}')
    # A quarter of Hertz' ball: the symmetry planes hold the edges of the top, but it could tilt about these.
    few_cells = ['Refinement/Final global cycles=0']
    symmetry = 'symmetry x: (0, *, *); symmetry y: (*, 0, *)'
    prescribed = p.solve('hertz/hertz.prm', *few_cells)
    force = next(b['reaction'] for b in prescribed['boundaries'] if b['name'] == 'top')
    for how in (', rotation (0, 0, *)', ', along (0, 0, 1)'):
        s = p.solve('hertz/hertz.prm', *few_cells, f'Body ball/Dirichlet={symmetry}', f'Body ball/Rigid=top: force (0, 0, {force[2]!r}){how}')
        certificate(s)
        near(s['pairs'][0]['max_pressure'], prescribed['pairs'][0]['max_pressure'], 1e-9, 'largest pressure of the ball')
        near(-s['pairs'][0]['load'], force[2], 2e-2, 'load')
    run = p.call(os.path.join(TOP, 'prm', PATCH_TEST), '--check', '--set', 'Body upper/Dirichlet=', '--set', 'Body upper/Rigid=top: force (1, 0, -3), along (0, 0, 1)')
    for words in ('load on top, a rigid face: force (1, 0, -3)', 'boundary top: moves as a rigid body, with 1 motion(s) free'):
        check(words in run.stdout, f'{words}: not in {run.stdout}')
    for setting, words in [('top: push (0, 0, -1)', 'should begin with force'), ('top: along (0, 0, 0)', 'must not be zero'),
                           ('top: force (0, 0, -1), force (0, 0, -2)', 'there twice')]:
        refused(p, f'Body upper/Rigid={setting}', words)
    refused(p, 'Body upper/Rigid=left: force (0, 0, -1)', 'in common with a rigid face', 'Pair interface/Nonmortar=second')


def refused(p, setting, words, *more):
    with tempfile.TemporaryDirectory() as folder:
        arguments = [os.path.join(TOP, 'prm', PATCH_TEST), '--output', os.path.join(folder, 'out'), '--set', setting]
        for one in more:
            arguments += ['--set', one]
        run = p.call(*arguments)
        check(run.returncode == 1 and words in run.stderr, f'{setting}: exit code {run.returncode}, {run.stderr}')
        check(os.listdir(folder) == [], f'{setting}: results are left')


BALL_THAT_IS_LET_GO = """set Load steps    = 0.5, 1
set Bodies        = ball, base
set Contact pairs = contact
subsection Body ball
  set Mesh           = quarter of half ball
  set Radius         = 8
  set Translation    = 0, 0, 8
  set Young modulus  = 7000
  set Poisson ratio  = 0.3
  set Initial levels = 2
  set Dirichlet      = symmetry x: (0, *, *); symmetry y: (*, 0, *)
  set Forces         = top: (0, 0, -100*sin(pi*t))
end
subsection Body base
  set Lower corner   = 0, 0, -8
  set Upper corner   = 8, 8, 0
  set Divisions      = 8, 8, 8
  set Young modulus  = 70000
  set Dirichlet      = bottom: (0, 0, 0); left: (0, *, *); front: (*, 0, *)
end
subsection Pair contact
  set First  = ball: sphere
  set Second = base: top
end
"""


def load_that_ends(p):
    """A load that ends at the rounding of zero: gaps of rounding are no objections to a contact that carries rounding."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'ball.prm')
        with open(path, 'w') as f:
            f.write(BALL_THAT_IS_LET_GO)
        s = p.solve(path)
        check(s['pairs'][0]['load'] < 1e-12 and not s['certificate']['objections'], f"{s['pairs'][0]['load']}: {s['certificate']}")
        # Under load a coarse ball of facets is objected to.
        s = p.solve(path, 'Load steps=0.4, 0.5', 'Body ball/Initial levels=1', 'Pair contact/Surface=faceted', 'Body ball/Forces=top: (0, 0, -0.001*sin(pi*t))', codes=(3,))
        check(any('pair contact' in text for text in s['certificate']['objections']), f"{s['certificate']}")
        check(not s['pairs'][0]['pressures_cancel'], f"{s['pairs']}")


def load_steps(p):
    """Twenty steps of Hertz: the last is the single load, the force grows with the power 3/2 of the displacement."""
    few = ['Refinement/Final global cycles=0', 'Solver/Compare linear multigrid=false', 'Output/Measure sweeps=false']
    symmetry = 'symmetry x: (0, *, *); symmetry y: (*, 0, *)'
    down = f'Body ball/Dirichlet={symmetry}; top: (0, 0, -0.02*t)'
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        s = p.solve('hertz/hertz.prm', *few, down, 'Load steps=20', keep=out)
        with open(os.path.join(out, 'curve.csv')) as f:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(f)]
        for name in ('bodies', 'contact-contact', 'contact-contact-mortar'):
            with open(os.path.join(out, f'{name}-steps.pvd')) as f:
                text = f.read()
            for k in range(1, 21):
                check(f'{name}-step-{k:02}.pvtu' in text and os.path.exists(os.path.join(out, f'{name}-step-{k:02}.pvtu')), f'{name}: step {k}')
    certificate(s)
    check([row['t'] for row in rows] == [k / 20 for k in range(1, 21)], 'times')
    one = p.solve('hertz/hertz.prm', *few)
    near(rows[-1]['contact: load'], one['pairs'][0]['load'], 1e-9, 'load of the last step')
    # Each step is what it is alone.
    for k in (4, 13):
        alone = p.solve('hertz/hertz.prm', *few, f'Body ball/Dirichlet={symmetry}; top: (0, 0, {-.02 * (k + 1) / 20!r})')
        near(rows[k]['contact: load'], alone['pairs'][0]['load'], 1e-9, f'load of step {k}')
        check(rows[k]['active nodes'] == alone['cycles'][-1]['active_nodes'], f'active nodes of step {k}')
        check(rows[k]['iterations'] <= alone['cycles'][-1]['nonlinear']['iterations'] + 1, f'iterations of step {k}')
    logs = [(math.log(row['t']), math.log(row['contact: load'])) for row in rows[4:]]
    mean = [sum(v) / len(logs) for v in zip(*logs)]
    slope = sum((a - mean[0]) * (b - mean[1]) for a, b in logs) / sum((a - mean[0]) ** 2 for a, b in logs)
    near(slope, 1.5, .02, 'exponent')
    # Steps of forces, a rigid face, and a body that contact alone holds.
    s = p.solve(PATCH_TEST, 'Body upper/Dirichlet=', 'Body upper/Rigid=top: force (0, 0, -2.5*t^2), displacement (0, 0, *), rotation (0, 0, 0)',
                'Load steps=0.3, 0.6, 2')
    near(s['pairs'][0]['load'], 10., 1e-10, 'load of the stamp')
    certificate(s)
    for setting, words in [('Load steps=0.5, 0.2', 'ascend'), ('Load steps=-3', 'number of steps'), ('Load steps=x', 'Load steps'),
                           ('Load steps=2.5', 'number of steps')]:
        refused(p, setting, words)
