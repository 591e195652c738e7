"""Problems with closed solutions: orders of convergence in displacement, energy, pressure, contact radius and force."""
import csv
import math
import os
import tempfile

from harness import certificate, check, near


def solve_with_pressure(p, prm, *settings):
    """The summary, and pressure.csv as rows of numbers."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        s = p.solve(prm, 'Solver/Compare linear multigrid=false', *settings, keep=out)
        with open(os.path.join(out, 'pressure.csv')) as f:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(f)]
    return s, rows


def exact_errors(cycle):
    """Relative errors of the displacement of all bodies together: L2 norm, energy norm."""
    bodies = cycle['exact'].values()
    return [math.sqrt(sum(e[f'{k}_error'] ** 2 for e in bodies) / sum(e[f'{k}_norm'] ** 2 for e in bodies)) for k in ('l2', 'energy')]


def pressure_error(rows, pressure):
    """Relative L2 error of the nodal pressures, with the areas of the nodes as weights."""
    exact = [pressure(r['x'], r['y'], r['z']) for r in rows]
    return math.sqrt(sum(r['area'] * (r['pressure'] - q) ** 2 for r, q in zip(rows, exact)) / sum(r['area'] * q ** 2 for r, q in zip(rows, exact)))


def check_orders(name, errors, least):
    """Errors on meshes that are halved from one to the next: prints them, and the last order is at least the bar."""
    for kind, bar in least.items():
        values = [e[kind] for e in errors]
        orders = [math.log2(a / b) for a, b in zip(values, values[1:])]
        print(f'{name}, {kind}: ' + ', '.join(f'{v:.3e}' for v in values) + '; orders ' + ', '.join(f'{o:.2f}' for o in orders))
        check(orders[-1] >= bar, f'{name}: order {orders[-1]} of the {kind}, at least {bar} is expected')


def tetrahedra_in(*bodies):
    return [f'Body {b}/Convert to tetrahedra=true' for b in bodies]


# A pressure (-s)^3 inside of the circle s = x^2 + y^2 - r0^2 = 0, and outside of it a gap OPENING s^3; body forces make them the solution.
RADIUS, OPENING = .6, 2e-3


def manufactured(young, poisson, opens):
    """Displacement and volume force of a body beside the plane z = 0: pressed inside of the circle, and outside of it lifted
    by the gap (if it opens) or at rest."""
    lame, mu = young * poisson / (1 + poisson) / (1 - 2 * poisson), young / 2 / (1 + poisson)
    s, r2, wave, a = f'(x^2+y^2-{RADIUS ** 2!r})', '(x^2+y^2)', lame + 2 * mu, OPENING if opens else 0.
    outside = ([f'{-6 * a!r}*{c}*z*{s}^2' for c in 'xy'] + [f'{a!r}*{s}^3'],
               [f'{48 * a * wave!r}*{c}*z*(3*{r2}-{2 * RADIUS ** 2!r})' for c in 'xy'] + [f'{12 * a * lame!r}*{s}*(3*{r2}-{RADIUS ** 2!r})'])
    inside = (['0', '0', f'{1 / wave!r}*z*{s}^3'],
              [f'{-6 * (lame + mu) / wave!r}*{c}*{s}^2' for c in 'xy'] + [f'{-12 * mu / wave!r}*z*{s}*(3*{r2}-{RADIUS ** 2!r})'])
    return ['(' + ', '.join(f'if({s} < 0, {i}, {o})' for i, o in zip(*parts)) + ')' for parts in zip(inside, outside)]


def manufactured_body(name, young, poisson, opens, contact_face, divisions):
    low = 0. if contact_face == 'bottom' else -.5
    displacement, force = manufactured(young, poisson, opens)
    others = [b for b in ('left', 'right', 'front', 'back', 'bottom', 'top') if b != contact_face]
    values = {'Lower corner': f'-1, -1, {low}', 'Upper corner': f'1, 1, {low + .5}', 'Divisions': divisions, 'Young modulus': young, 'Poisson ratio': poisson,
              'Dirichlet': '; '.join(f'{b}: {displacement}' for b in others), 'Volume force': force, 'Exact displacement': displacement}
    return [f'Body {name}/{key}={value}' for key, value in values.items()]


def check_manufactured(p, name, prm, settings, cycles, width):
    """Orders; width: of the cells of the contact surface before any refinement."""
    errors = []
    for cycle in cycles:
        s, rows = solve_with_pressure(p, prm, *settings, f'Refinement/Global cycles={cycle}')
        certificate(s)
        h, pair = width / 2 ** cycle, s['pairs'][0]
        l2, energy = exact_errors(s['cycles'][-1])
        weights = [r['area'] * r['pressure'] for r in rows]
        # The mean of the squared radius, weighted with the pressure, is r0^2 / 5.
        radius = math.sqrt(5 * sum(w * (r['x'] ** 2 + r['y'] ** 2) for w, r in zip(weights, rows)) / sum(weights))
        errors.append({'L2': l2, 'energy': energy, 'pressure': pressure_error(rows, lambda x, y, z: max(0., RADIUS ** 2 - x * x - y * y) ** 3),
                       'force': abs(abs(pair['force'][2]) / (math.pi * RADIUS ** 8 / 4) - 1), 'radius': abs(radius - RADIUS)})
        check(abs(radius - RADIUS) <= h, f'{name}: contact radius {radius} at h = {h}')
        # An error of h^2 in pressure and gap, both of the third power in the distance from the circle, moves its border by h^(2/3).
        closed = max(math.hypot(r['x'], r['y']) for r in rows if r['active'])
        opened = min(math.hypot(r['x'], r['y']) for r in rows if not r['active'])
        print(f'{name}: {s["cycles"][-1]["dofs"]} unknowns, h {h}, closed to {closed:.4f}, open from {opened:.4f}, radius {radius:.5f}')
        check(closed <= RADIUS + h ** (2 / 3) and opened >= RADIUS - h, f'{name}: closed to {closed}, open from {opened} at h = {h}')
    check_orders(name, errors, {'L2': 1.9, 'energy': .95, 'pressure': 1.5, 'force': 1.9, 'radius': 1.8})
    return s


def manufactured_obstacle(p):
    """One body on a rigid plane."""
    for name, kind, divisions in (('hexahedra', [], '5, 4, 1'), ('tetrahedra', tetrahedra_in('cube'), '4, 3, 1')):
        check_manufactured(p, name, 'obstacle/paraboloid.prm',
                           [*manufactured_body('cube', 1., .3, True, 'bottom', divisions), *kind, 'Pair bottom/Obstacle=plane: (0, 0, 0), (0, 0, 1)',
                            'Pair bottom/Gap=weighted'], (1, 2, 3), 2 / 3 if kind else .5)


def manufactured_two_bodies(p, name, kind, side):
    """Two bodies of different materials."""
    s = check_manufactured(p, name, 'patch_test/patch_test.prm',
                           [*manufactured_body('upper', 1., .3, True, 'bottom', '4, 3, 1'), *manufactured_body('lower', 4., .2, False, 'top', '3, 4, 1'),
                            *kind, f'Pair interface/Nonmortar={side}'], (1, 2, 3), 2 / 3)
    # 32 x 24 quadrilaterals, two triangles each, on either side.
    check(s['mappings'][0]['cells'] > 4 * 2 * 32 * 24, f'{name}: the meshes match: {s["mappings"][0]["cells"]} overlay cells')


def manufactured_hexahedra(p):
    manufactured_two_bodies(p, 'hexahedra', [], 'first')
    manufactured_two_bodies(p, 'hexahedra, stiff side', [], 'second')


def manufactured_tetrahedra_above(p):
    manufactured_two_bodies(p, 'tetrahedra on hexahedra', tetrahedra_in('upper'), 'first')


def manufactured_tetrahedra_below(p):
    manufactured_two_bodies(p, 'hexahedra on tetrahedra', tetrahedra_in('lower'), 'first')


def manufactured_tetrahedra(p):
    manufactured_two_bodies(p, 'tetrahedra', tetrahedra_in('upper', 'lower'), 'first')
