"""Cases of thermal and initial strains and of pretension."""
import contextlib
import csv
import math
import os
import tempfile

from harness import TOP, certificate, check, near

BLOCK = '''set Bodies = block
subsection Body block
  set Divisions = 3, 2, 2
  set Young modulus = 2e5
  set Poisson ratio = 0.3
  set Thermal expansion = 1.2e-5
end
subsection Refinement
  set Global cycles = 1
end
'''
KINDS = (['Body block/Element=standard'], ['Body block/Element=mean dilatation'], ['Body block/Convert to tetrahedra=true'])
SHELLS = os.path.join(TOP, 'tests', 'application', 'shells.prm')


@contextlib.contextmanager
def written(text):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'case.prm')
        with open(path, 'w') as f:
            f.write(text)
        yield path


def solve(p, text, *settings, keep=None):
    with written(text) as path:
        return p.solve(path, *settings, keep=keep)


def no_stress(s, scale, text):
    check(s['converged'] and s['certificate']['contact_conditions_hold'], f'{text}: {s["certificate"]["objections"]}')
    for body in s['bodies']:
        check(body['largest_von_mises'] <= 1e-10 * scale, f'{text}: stress {body["largest_von_mises"]}')
        # Rounding is no error of stresses.
        check(body['stress_error'] == 0, f'{text}: error of stresses {body["stress_error"]}')
    for boundary in s['boundaries']:
        check(max(map(abs, boundary['reaction'])) <= 1e-10 * scale, f'{text}: reaction {boundary["reaction"]}')


def thermal(p):
    """Free and held expansion: exact, whatever the cells are."""
    e, grow = 2e5, 1.2e-5 * 80
    ball = ['Body block/Mesh=eighth of ball', 'Body block/Dirichlet=symmetry x: (0, *, *); symmetry y: (*, 0, *); symmetry z: (*, *, 0)']
    free = ['Body block/Dirichlet=left: (0, *, *); front: (*, 0, *); bottom: (*, *, 0)']
    exact = [f'Body block/Exact displacement=({grow}*x, {grow}*y, {grow}*z)', 'Body block/Temperature=80']
    for kind in KINDS:
        for shape in (ball, free):
            s = solve(p, BLOCK, *kind, *shape, *exact)
            no_stress(s, e * grow, f'{kind} {shape[0]}')
            for c in s['cycles']:
                errors = c['exact']['block']
                check(errors['l2_error'] <= 1e-10 * errors['l2_norm'], f'{kind} {shape[0]}: {errors}')
        # Held at both ends in x; the temperature of t = 1.
        s = solve(p, BLOCK, *kind, 'Body block/Dirichlet=left: (0, *, *); right: (0, *, *); front: (*, 0, *); bottom: (*, *, 0)',
                  'Body block/Volume temperatures=volume: 80*t', 'Body block/Temperature=1', 'Body block/Probes=corner: (0.5, 1, 1)')
        near(s['bodies'][0]['largest_von_mises'], e * grow, 1e-10, f'{kind}: stress of the bar')
        forces = {b['name']: b['reaction'][0] for b in s['boundaries']}
        near(forces['left'], e * grow, 1e-10, f'{kind}: force of the bar')
        near(forces['right'], -e * grow, 1e-10, f'{kind}: force of the bar')
        near(s['probes'][0]['displacement'][1], 1.3 * grow, 1e-10, f'{kind}: the bar grows across')
        near(s['certificate']['potential_energy'], .5 * e * grow**2, 1e-9, f'{kind}: energy')
        # Strains of all components, held on one side.
        u = '(1e-3*x + 2e-4*y - 3e-4*z, 2e-4*x - 5e-4*y + 4e-4*z, -3e-4*x + 4e-4*y + 2e-3*z)'
        for name, section in (('Initial strain=', ''), ('Volume initial strains=', 'volume: ')):
            s = solve(p, BLOCK, *kind, f'Body block/{name}{section}(1e-3, -5e-4, 2e-3, 2e-4, 4e-4, -3e-4)', f'Body block/Dirichlet=left: {u}',
                      f'Body block/Exact displacement={u}')
            no_stress(s, e * 2e-3, f'{kind}: initial strain')
            errors = s['cycles'][-1]['exact']['block']
            check(errors['l2_error'] <= 1e-10 * errors['l2_norm'], f'{kind}: initial strain')
        for of_body, words in (('Temperature=80', 'Temperature'), ('Temperature=1e6', 'no small one'), ('Temperature=two', 'Temperature'),
                               ('Initial strain=(1, 2, 3)', 'six entries'), ('Volume temperatures=nowhere: 2', 'no volume'),
                               ('Pretension=volume: axis (0, 0, 0), force 1', 'axis'), ('Pretension=volume: force 1', 'axis'),
                               ('Pretension=bolt: axis (0, 0, 1), force 1', 'no volume'), ('Pretension=volume: axis (0, 0, 1), force -1', 'negative'),
                               ('Pretension=none: axis (0, 0, 1), force 1, region -1', 'no cell')):
            more = ['Body block/Thermal expansion='] if of_body == 'Temperature=80' else []
            with written(BLOCK) as path:
                run = p.call(path, '--output', os.path.join(os.path.dirname(path), 'out'), *sum((['--set', t] for t in [*free, *kind, f'Body block/{of_body}', *more]), []))
                check(run.returncode != 0 and words in run.stderr, f'{of_body}: {run.returncode}, {run.stderr}')


def thermal_gradient(p):
    """A linear temperature strains a free body without stress: errors and their estimate fall with the cells."""
    a = 1.2e-5 * 100
    u = f'({a / 2}*(x^2 - y^2 - z^2), {a}*x*y, {a}*x*z)'
    for kind in KINDS:
        s = solve(p, BLOCK, *kind, 'Body block/Temperature=100*x', f'Body block/Dirichlet=left: {u}', f'Body block/Exact displacement={u}',
                  'Body block/Divisions=2, 2, 2', 'Refinement/Global cycles=0', 'Refinement/Adaptive cycles=2', 'Refinement/Marking fraction=1',
                  'Refinement/Initial global levels=1')
        cycles = [(c['exact']['block'], c['indicator'], c['cells']) for c in s['cycles']]
        for errors, indicator, cells in cycles:
            print(f'{kind}: {cells} cells, error {errors["l2_error"]:.3e}, energy {errors["energy_error"]:.3e}, indicator {indicator:.3e}')
            check(.5 * errors['energy_error'] <= indicator <= 20 * errors['energy_error'], f'{kind}: the indicator {indicator} is not the error {errors["energy_error"]}')
        check(cycles[-1][0]['energy_error'] <= .3 * cycles[0][0]['energy_error'], f'{kind}: energy norm')
        check(cycles[-1][0]['l2_error'] <= .1 * cycles[0][0]['l2_error'], f'{kind}: L2 norm')


def tube_pressure(growth, young, hub, a=5, b=10, c=16, nu=.3):
    """Lamé in plane strain: the pressure of a shaft that is too large by `growth` (length, radial)."""
    inner = (1 + nu) / young * ((1 - 2 * nu) * b**2 + a**2) / (b**2 - a**2)
    outer = (1 + nu) / hub * ((1 - 2 * nu) * b**2 + c**2) / (c**2 - b**2)
    return growth / (b * (inner + outer))


def shell_compliance(young, nu, loaded, other):
    """Change of the radius `loaded` of a shell by a unit pressure on it, over the radius."""
    k, m = young / (1 - 2 * nu), 2 * young / (1 + nu)
    # sigma_r = k A - m B / r^3: 0 at one radius, -1 at the other.
    b = 1 / (m * (loaded**-3 - other**-3))
    return abs(m * b / (k * other**3) + b / loaded**3)


def shrink_fit(p):
    """A warm shaft in a cold hub, and a warm shell in a shell, by steps of the temperature."""
    warm = ['Body shaft/Radius=10', 'Body shaft/Thermal expansion=1.2e-5', 'Body shaft/Temperature=80*t', 'Load steps=4']
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'kept')
        s = p.solve('shapes/press-fit.prm', *warm, 'Body hub/Thermal expansion=1e-5', 'Body hub/Temperature=20*t', keep=out)
        with open(os.path.join(out, 'curve.csv')) as f:
            curve = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(f)]
    certificate(s, 1e-7)
    pair = s['pairs'][0]
    expected = tube_pressure(1.3 * 10 * (1.2e-5 * 80 - 1e-5 * 20), 2e5, 1e5)
    print('shaft:', pair['min_pressure'], pair['max_pressure'], 'Lamé:', expected)
    for key in ('min_pressure', 'max_pressure'):
        near(pair[key], expected, .01, f'shaft: {key}')
    check(len(curve) == 4, 'four steps')
    for row in curve:
        near(row['fit: largest pressure'], row['t'] * expected, .01, f'pressure at t = {row["t"]}')
    # Contact does not change: the pressure is a line, but for what the gap of the meshes is off at the start.
    steps = [row['fit: largest pressure'] for row in curve]
    for k in (1, 2):
        near(2 * steps[k], steps[k - 1] + steps[k + 1], 1e-9, f'pressure at t = {curve[k]["t"]}')
    s = p.solve(SHELLS, 'Body inner/Pressures=', 'Body inner/Thermal expansion=1e-5', 'Body inner/Temperature=100', 'Refinement/Global cycles=2')
    certificate(s, 1e-7)
    expected = 1e-3 / (shell_compliance(1000, .3, 1.5, 1) + shell_compliance(2000, .25, 1.5, 2.5))
    pair = s['pairs'][0]
    print('shells:', pair['load'] / pair['contact_area'], pair['min_pressure'], pair['max_pressure'], 'Lamé:', expected)
    near(pair['load'] / pair['contact_area'], expected, .01, 'shells: mean pressure')


def write_grid(path, x, y, z, volume_of, boundary_of):
    """Hexahedra of a grid, as gmsh writes them. volume_of(centre): a name or None; boundary_of(centre, normal): a name."""
    axes, volumes, surfaces, nodes = (x, y, z), [], [], {}
    number = lambda i: nodes.setdefault(i, len(nodes) + 1)
    middle = lambda i, c: .5 * (axes[c][i[c]] + axes[c][i[c] + 1])
    shape = [len(a) - 1 for a in axes]
    cells = {}
    for i in ((i, j, k) for i in range(shape[0]) for j in range(shape[1]) for k in range(shape[2])):
        name = volume_of([middle(i, c) for c in range(3)])
        if name:
            cells[i] = name
    corner = ((0, 0), (1, 0), (1, 1), (0, 1))
    for i, name in cells.items():
        volumes.append((name, [number((i[0] + a, i[1] + b, i[2] + c)) for c in (0, 1) for a, b in corner]))
        for c in range(3):
            for side in (0, 1):
                if tuple(i[d] + (2 * side - 1) * (d == c) for d in range(3)) not in cells:
                    centre = [axes[d][i[d] + side] if d == c else middle(i, d) for d in range(3)]
                    vertices = []
                    for a, b in corner:
                        v = list(i)
                        v[c] += side
                        v[(c + 1) % 3] += a
                        v[(c + 2) % 3] += b
                        vertices.append(number(tuple(v)))
                    surfaces.append((boundary_of(centre, [(2 * side - 1) * (d == c) for d in range(3)]), vertices))
    names = sorted({(3, v[0]) for v in volumes} | {(2, s[0]) for s in surfaces})
    with open(path, 'w') as f:
        f.write(f'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(names)}\n')
        for n, (dim, name) in enumerate(names):
            f.write(f'{dim} {n + 1} "{name}"\n')
        f.write(f'$EndPhysicalNames\n$Nodes\n{len(nodes)}\n')
        for i, n in nodes.items():
            f.write(f'{n} {x[i[0]]} {y[i[1]]} {z[i[2]]}\n')
        f.write(f'$EndNodes\n$Elements\n{len(volumes) + len(surfaces)}\n')
        for n, (kind, dim, (name, vertices)) in enumerate([(5, 3, v) for v in volumes] + [(3, 2, s) for s in surfaces]):
            tag = names.index((dim, name)) + 1
            f.write(f'{n + 1} {kind} 2 {tag} {tag} ' + ' '.join(map(str, vertices)) + '\n')
        f.write('$EndElements\n')


def plane_name(centre, normal):
    if normal[0] < 0 and centre[0] == 0:
        return 'symmetry x'
    if normal[1] < 0 and centre[1] == 0:
        return 'symmetry y'
    return {1: 'above', -1: 'below', 0: 'side'}[normal[2]]


# A quarter of a bolt with head and nut through two plates.
BOLT = '''set Bodies = bolt, upper, lower
set Contact pairs = joint, head, nut
subsection Body bolt
  set Mesh = bolt.msh
  set Young modulus = 2e5
  set Dirichlet = symmetry x: (0, *, *); symmetry y: (*, 0, *)
  set Pretension = shank: axis (0, 0, 2), force 500*t
end
subsection Body upper
  set Mesh = upper.msh
  set Young modulus = 7e4
  set Dirichlet = symmetry x: (0, *, *); symmetry y: (*, 0, *)
end
subsection Body lower
  set Mesh = lower.msh
  set Young modulus = 7e4
  set Dirichlet = symmetry x: (0, *, *); symmetry y: (*, 0, *); side: (*, *, 0)
end
subsection Pair joint
  set First = upper: below
  set Second = lower: above
end
subsection Pair head
  set First = bolt: under head
  set Second = upper: above
  set Contact = tied
end
subsection Pair nut
  set First = bolt: under nut
  set Second = lower: below
  set Contact = tied
end
subsection Refinement
  set Global cycles = 1
end
'''


def write_bolt(folder):
    def boundary(centre, normal):
        if abs(centre[2]) == 2 and normal[2] * centre[2] < 0:
            return 'under head' if centre[2] > 0 else 'under nut'
        return plane_name(centre, normal)

    def volume(centre):
        inside = max(centre[:2]) < 1
        return 'head' if abs(centre[2]) > 2 else 'shank' if inside else None
    write_grid(os.path.join(folder, 'bolt.msh'), [0, .5, 1, 1.5, 2], [0, .5, 1, 1.5, 2], [-3, -2.5, -2, -1.5, -1, -.5, 0, .5, 1, 1.5, 2, 2.5, 3],
               volume, boundary)
    for name, z in (('upper', [0, .5, 1, 1.5, 2]), ('lower', [-2, -4 / 3, -2 / 3, 0])):
        write_grid(os.path.join(folder, f'{name}.msh'), [0, .6, 1.2, 2, 3, 4], [0, .6, 1.2, 2, 3, 4], z,
                   lambda centre: None if max(centre[:2]) < 1.2 else 'plate',
                   lambda centre, normal: 'hole' if normal[2] == 0 and max(centre[:2]) <= 1.2 and 0 < min(centre[:2]) else
                   'side' if normal[2] == 0 and max(centre[:2]) == 4 else plane_name(centre, normal))


# Nothing but the head moves the upper plate.
LOOSE = [f'Pair {pair}/Contact=unilateral' for pair in ('head', 'nut')]


@contextlib.contextmanager
def bolt_of_plates():
    with tempfile.TemporaryDirectory() as folder:
        write_bolt(folder)
        prm = os.path.join(folder, 'bolt.prm')
        with open(prm, 'w') as f:
            f.write(BOLT)
        yield folder, prm


def pretension(p):
    """A bolt of two plates: its section carries the force, and so does the joint."""
    with bolt_of_plates() as (folder, prm):
        kinds = ([], LOOSE, ['Load steps=3'], [f'Body {b}/Convert to tetrahedra=true' for b in ('bolt', 'upper', 'lower')])
        for settings in kinds:
            out = os.path.join(folder, f'out{len(os.listdir(folder))}')
            s = p.solve(prm, *settings, keep=out)
            check(s['converged'], f'{settings}: not converged')
            bolt = s['pretension'][0]
            print(settings, bolt, 'joint', s['pairs'][0]['force'][2])
            near(bolt['force'], 500, 1e-6, f'{settings}: section force')
            near(abs(s['pairs'][0]['force'][2]), bolt['force'], 1e-6, f'{settings}: clamping force')
            near(s['pairs'][0]['load'], bolt['force'], 1e-6, f'{settings}: clamping force')
            near(bolt['shortening'], 4 * bolt['strain'], 1e-10, f'{settings}: shortening')
            # Plates give way.
            check(bolt['strain'] > 500 / 2e5, f'{settings}: strain {bolt["strain"]}')
            check(len(bolt['iterations']) <= 6, f'{settings}: {bolt["iterations"]}')
            check(not s['certificate']['objections'], f'{settings}: {s["certificate"]["objections"]}')
            with open(os.path.join(out, 'signorini.log')) as f:
                check('pretension bolt: shank: section force 500' in f.read(), 'no line of the bolt at the end')
            if 'Load steps=3' in settings:
                with open(os.path.join(out, 'curve.csv')) as f:
                    for row in csv.DictReader(f):
                        near(float(row['bolt: shank: section force']), 500 * float(row['t']), 1e-6, 'section force of a step')
                        near(abs(float(row['joint: force z'])), 500 * float(row['t']), 1e-6, 'clamping force of a step')
            # Other plates were softer in compression: the strain at which the section would carry the force between rigid plates is known.
        # A bolt that should carry nothing while others load the joint.
        for force, wanted in (('0', 0), ('500*max(0, 2*t - 1)', 500)):
            s = p.solve(prm, f'Body bolt/Pretension=shank: axis (0, 0, 1), force {force}', 'Body upper/Forces=side: (0, 0, -300)', 'Refinement/Global cycles=0',
                        *(['Load steps=2'] if wanted else []))
            bolt = s['pretension'][0]
            check(abs(bolt['force'] - wanted) < 1e-6 * 300, f'force {force}: {bolt}')
            check(s['converged'] and len(bolt['iterations']) <= 6, f'force {force}: {bolt["iterations"]}')
        # Ends that are no planes: stairs of hexahedra, also with hanging nodes, and the rugged ends of a region among tetrahedra.
        for settings in (['Body bolt/Pretension=rugged: axis (0, 0, 1), force 500, region 1 - (z + 0.4*x - 0.3*y)^2'],
                         ['Body bolt/Pretension=rugged: axis (0, 0, -1), force 500, region 1 - (z + 0.4*x - 0.3*y)^2', 'Refinement/Global cycles=0', 'Refinement/Adaptive cycles=1'],
                         ['Body bolt/Pretension=rugged: axis (0, 0, 1), force 500, region 1.3 - z^2', 'Body bolt/Convert to tetrahedra=true']):
            s = p.solve(prm, *LOOSE, *settings)
            bolt = s['pretension'][0]
            print(settings, bolt, 'joint', s['pairs'][0]['force'][2])
            near(bolt['force'], 500, 1e-6, f'{settings}: section force')
            for pair in s['pairs']:
                near(pair['load'], 500, 1e-6, f'{settings}: force of {pair["name"]}')


def locked_pretension(p):
    """A bolt is tightened and locked, then the plate is pulled: with or without load steps as with the force that the section has in the end."""
    with bolt_of_plates() as (folder, prm):
        pulled = [*LOOSE, 'Body upper/Forces=side: (0, 0, 300*max(0, 2*t-1))']
        lock = lambda force: [f'Body bolt/Pretension=shank: axis (0, 0, 1), force {force}, locked after 0.5']
        runs = []
        for settings in ([], ['Load steps=2'], ['Load steps=0.3, 0.5, 0.8, 1'], ['Refinement/Global cycles=0', 'Refinement/Adaptive cycles=1', 'Refinement/Marking fraction=1']):
            out = os.path.join(folder, f'out{len(runs)}')
            s = p.solve(prm, *pulled, *lock(500), *settings, keep=out)
            certificate(s)
            bolt, joint = s['pretension'][0], s['pairs'][0]['load']
            print(settings, bolt, 'joint', joint)
            check(bolt['wanted'] == 500 and bolt['locked_after'] == .5, f'{settings}: {bolt}')
            near(bolt['force'], joint + 300, 1e-6, f'{settings}: balance')
            check(505 < bolt['force'] < 795, f'{settings}: {bolt}')
            if len(settings) == 1:
                with open(os.path.join(out, 'curve.csv')) as f:
                    for row in csv.DictReader(f):
                        t, force = float(row['t']), float(row['bolt: shank: section force'])
                        near(force, float(row['joint: load']) + 300 * max(0, 2 * t - 1), 1e-6, f't = {t}: balance')
                        check((abs(force - 500) < 1e-3) == (t <= .5), f't = {t}: {force}')
            runs.append((bolt['force'], bolt['strain']))
        for force, strain in runs[1:]:
            near(force, runs[0][0], 1e-6, 'section force, other load steps or cycles')
            near(strain, runs[0][1], 1e-6, 'strain, other load steps or cycles')
        s = p.solve(prm, *pulled, f'Body bolt/Pretension=shank: axis (0, 0, 1), force {runs[0][0]!r}')
        near(s['pretension'][0]['strain'], runs[0][1], 1e-6, 'strain, not locked')
        s = p.solve(prm, 'Body bolt/Pretension=shank: axis (0, 0, 1), force 500, locked after 1', 'Refinement/Global cycles=0')
        check(any('it is not locked' in note for note in s['notes']) and 'locked_after' not in s['pretension'][0], f'{s["notes"]}')
        run = p.call(prm, '--output', os.path.join(folder, 'out'), '--set', 'Body bolt/Pretension=shank: axis (0, 0, 1), force 500, locked at 0.5')
        check(run.returncode != 0 and 'locked after' in run.stderr, f'{run.returncode}, {run.stderr}')


# Two blocks, held together by straps that are glued to their ends, the middle of which is shortened.
STRAPS = '''set Bodies = left, right, upper, lower
set Contact pairs = joint, lu, ll, ru, rl
''' + ''.join(f'''subsection Body {name}
  set Lower corner = {low}
  set Upper corner = {high}
  set Divisions = {divisions}
  set Young modulus = {young}
  set Dirichlet = {hold}
  set Pretension = {bolt}
end
''' for name, low, high, divisions, young, hold, bolt in (
    ('left', '-0.5, 0, -1', '0, 1, 1', '2, 2, 8', 2e3, 'front: (*, 0, *)', 'strap: region 0.25 - z^2, axis (0, 0, 1), force 3*t'),
    ('right', '3, 0, -1', '3.5, 1, 1', '2, 2, 8', 1e3, 'front: (*, 0, *)', 'strap: region 0.25 - z^2, axis (0, 0, -1), force 5*t'),
    ('upper', '0, 0, 0', '3, 1, 1', '6, 2, 4', 1e3, 'front: (*, 0, *)', ''),
    ('lower', '0, 0, -1', '3, 1, 0', '9, 3, 3', 1e3, 'front: (*, 0, *); bottom: (0, *, 0)', ''))) + ''.join(f'''subsection Pair {strap[0]}{block[0]}
  set First = {strap}: {'right' if strap == 'left' else 'left'}
  set First region = {'z' if block == 'upper' else '-z'} - 0.55
  set Second = {block}: {strap}
  set Contact = tied
end
''' for strap in ('left', 'right') for block in ('upper', 'lower')) + '''subsection Pair joint
  set First = upper: bottom
  set Second = lower: top
end
subsection Refinement
  set Global cycles = 1
end
'''


def pretension_of_two(p):
    """Two at a time, each of which loosens the other, on blocks of generated meshes."""
    s = solve(p, STRAPS, 'Load steps=0.5, 1')
    check(s['converged'], 'not converged')
    print(s['pretension'], s['pairs'][0]['force'])
    for bolt, force in zip(s['pretension'], (3, 5)):
        near(bolt['force'], force, 1e-6, 'section force')
        check(len(bolt['iterations']) <= 12, f'{bolt["iterations"]}')
    near(abs(s['pairs'][0]['force'][2]), 8, 1e-6, 'clamping force')
    # Locked one after the other, then the joint is pressed together; the one that is still to be tightened loosens the other.
    strap = lambda body, axis, force, lock: f'Body {body}/Pretension=strap: region 0.25 - z^2, axis (0, 0, {axis}), force {force}{lock}'
    pressed = ['Refinement/Global cycles=0', 'Body upper/Forces=top: (0, 0, -4*max(0, t - 0.6))']
    for last, locks in (('locked', (', locked after 0.3', ', locked after 0.6')), ('open', (', locked after 0.3', ''))):
        bolts = [strap('left', 1, '3*t', locks[0]), strap('right', -1, '5*t', locks[1])]
        ends = []
        for steps in ([], ['Load steps=0.3, 0.6, 1'], ['Load steps=0.2, 0.5, 0.8, 1']):
            with tempfile.TemporaryDirectory() as folder:
                out = os.path.join(folder, 'out')
                s = solve(p, STRAPS, *pressed, *bolts, *steps, keep=out)
                certificate(s)
                print(last, steps, s['pretension'], s['pairs'][0]['load'])
                ends.append([bolt['force'] for bolt in s['pretension']])
                near(s['pairs'][0]['load'], sum(ends[-1]) + 1.6, 1e-6, f'{last}, {steps}: balance')
                if steps:
                    with open(os.path.join(out, 'curve.csv')) as f:
                        forces = {float(row['t']): [float(row[f'{body}: strap: section force']) for body in ('left', 'right')] for row in csv.DictReader(f)}
                    for a, b in zip(forces[1], ends[0]):
                        near(a, b, 1e-6, f'{last}, {steps}: section force of the last step')
                    for t, (left, right) in forces.items():
                        check((abs(left - 3 * t) < 1e-5) == (t <= .3), f'{last}, {steps}: left {left} at t = {t}')
                        check((abs(right - 5 * t) < 1e-5) == (last == 'open' or t <= .6), f'{last}, {steps}: right {right} at t = {t}')
        check(ends[0][0] < .9 and (last == 'open') == (abs(ends[0][1] - 5) < 1e-5), f'{last}: {ends[0]}')
        for end in ends[1:]:
            for a, b in zip(end, ends[0]):
                near(a, b, 1e-6, f'{last}: section force, other load steps')


def symmetric_parts(p):
    """A hot ball between six walls, and an eighth of it between three: stresses, their error, and what the certificate measures by are the same."""
    walls = {sign + axis: [(1 if sign == 'p' else -1) * (axis == a) for a in 'xyz'] for axis in 'xyz' for sign in 'pm'}

    def model(names):
        pairs = ''.join(f'''subsection Pair {name}
  set First    = ball: sphere
  set Obstacle = plane: ({", ".join(str(1.002 * c) for c in walls[name])}), ({", ".join(str(-c) for c in walls[name])})
end
''' for name in names)
        return f'''set Bodies        = ball
set Contact pairs = {", ".join(names)}
subsection Body ball
  set Mesh              = ball
  set Young modulus     = 1000
  set Temperature       = 100
  set Thermal expansion = 1e-4
end
{pairs}subsection Refinement
  set Initial global levels = 1
  set Global cycles         = 1
end
'''

    whole = solve(p, model(walls))
    eighth = solve(p, model(['px', 'py', 'pz']), 'Body ball/Mesh=eighth of ball',
                   'Body ball/Dirichlet=symmetry x: (0, *, *); symmetry y: (*, 0, *); symmetry z: (*, *, 0)')
    for s in (whole, eighth):
        certificate(s)
    for key in ('largest_von_mises', 'largest_displacement', 'stress_error'):
        near(eighth['bodies'][0][key], whole['bodies'][0][key], 1e-7, key)
    near(eighth['pairs'][0]['approach'], whole['pairs'][0]['approach'], 1e-7, 'approach')
    near(4 * eighth['pairs'][0]['load'], whole['pairs'][0]['load'], 1e-7, 'force')
    for key in ('geometric_penetration', 'gap_doubt'):
        near(eighth['certificate'][key], whole['certificate'][key], 1e-6, key)
    check(eighth['certificate']['contact_conditions_hold'] == whole['certificate']['contact_conditions_hold'], 'verdicts')
    check(eighth['meshes_are_fine'] == whole['meshes_are_fine'], 'meshes')
