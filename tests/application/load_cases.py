"""Cases of conditions and loads: rollers in any direction, total forces, rigid faces, load steps."""
import math

from geometry_cases import PATCH_TEST, turn
from harness import certificate, check, constant_pressure, near

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
