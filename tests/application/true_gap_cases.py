"""Surfaces that fit into each other: the gap is that of the true bodies. The meshes come from files, do not match, and no option says what they stand
for unless a case gives shapes."""
import json
import math
import os
import tempfile

import verification_cases as v
from free_body_cases import make_mesh
from harness import TOP, check, near, read_pressure
from verification_cases import PRESCRIBED_GAP, PRESCRIBED_INTERFERENCE, INTERFERENCE, tetrahedra_in

GEOMETRIC = ['Pair contact/Initial gap=geometry']


def check_fit(p, name, settings, pressure_order, sizes=(6, 12), whole=False):
    """With the gap between the bodies errors are those with the exact gap prescribed: at most 1.2 times with shapes, 1.5 times without."""
    reference = v.check_shells(p, f'{name}, prescribed', settings, PRESCRIBED_GAP, pressure_order, sizes, whole)
    v.check_shells(p, f'{name}, shapes', settings, GEOMETRIC + v.SHELL_SHAPES, pressure_order, sizes, whole, reference, 1.2)
    v.check_shells(p, f'{name}, mesh alone', settings, GEOMETRIC, pressure_order, sizes, whole, reference, 1.5)


def fitting_shells(p):
    check_fit(p, 'hexahedra', [], 1.)


def fitting_shells_tetrahedra_inside(p):
    check_fit(p, 'tetrahedra inside', tetrahedra_in('inner'), 1.)


def fitting_shells_tetrahedra_outside(p):
    check_fit(p, 'tetrahedra outside', tetrahedra_in('outer'), 1.)


def fitting_shells_tetrahedra(p):
    check_fit(p, 'tetrahedra', tetrahedra_in('inner', 'outer'), 1.)


def fitting_shells_turned(p):
    check_fit(p, 'turned', ['Body inner/Rotation axis=1, 2, 3', 'Body inner/Rotation angle=25'], 1., (3, 6), True)


def fitting_press(p):
    """Interference that only the sizes of the bodies have."""
    for name, kind in (('hexahedra', []), ('tetrahedra', tetrahedra_in('inner', 'outer'))):
        v.check_press_fit(p, name, kind, GEOMETRIC, INTERFERENCE)


def tight_fit(p):
    """Rings from files with 24 and 28 faces around that do not match, the inner one too large by a ten thousandth of its radius: Lame's pressure at every
    node. The facets are up to 86 times as far from the circle."""
    oversize = 1e-4 * v.RINGS[1]
    pressure = v.ring_solution()[1] * oversize / INTERFERENCE
    with tempfile.TemporaryDirectory() as folder:
        settings = []
        for body, (low, high), n, (young, poisson) in (('inner', (v.RINGS[0], v.RINGS[1] + oversize), 6, v.RING_MATERIALS[0]), ('outer', v.RINGS[1:], 7, v.RING_MATERIALS[1])):
            mesh = os.path.join(folder, f'{body}.msh')
            v.write_ring(mesh, low, high, n, 4, 2)
            settings += [f'Body {body}/Mesh={mesh}', f'Body {body}/Young modulus={young}', f'Body {body}/Poisson ratio={poisson}', f'Body {body}/Pressures=',
                         f'Body {body}/Dirichlet=x0: (0, *, *); y0: (*, 0, *); bottom: (*, *, 0); top: (*, *, 0)']
        settings += ['Refinement/Global cycles=0', 'Pair contact/First=inner: outside', 'Pair contact/Second=outer: inside', *GEOMETRIC]
        for side in ('first', 'second'):
            pair = p.solve(v.SHELLS, *settings, f'Pair contact/Nonmortar={side}')['pairs'][0]
            print(f'nonmortar {side}: {pair["min_pressure"] / pressure - 1:+.2%} to {pair["max_pressure"] / pressure - 1:+.2%}')
            near(pair['initial_penetration'], oversize, .01, f'{side}: interference')
            for key in ('min_pressure', 'max_pressure'):
                near(pair[key], pressure, .02, f'{side}: {key}')


COARSE_FIT = '''set Bodies        = shaft, hub
set Contact pairs = fit
subsection Body shaft
  set Mesh          = quarter of cylinder
  set Radius        = 10
  set Height        = 4
  set Dirichlet     = symmetry x: (0, *, *); symmetry y: (*, 0, *); bottom: (*, *, 0)
  set Young modulus = 2.1e5
end
subsection Body hub
  set Mesh            = quarter of tube
  set Inner radius    = 9.999
  set Radius          = 20
  set Height          = 4
  set Round divisions = 6, 24, 4
  set Translation     = 0, 0, -4
  set Dirichlet       = symmetry x: (0, *, *); symmetry y: (*, 0, *); start: (*, *, 0)
  set Young modulus   = 2.1e5
end
subsection Pair fit
  set First  = shaft: side
  set Second = hub: inner
end
subsection Refinement
  set Initial global levels = 0
end
'''


def coarse_fit(p):
    """A shaft with 8 faces around, in a hub with 96 that is smaller by a ten thousandth of its radius: both are the cylinders that they stand for,
    whatever their facets."""
    pressure = .001 * 2.1e5 * (20 ** 2 - 10 ** 2) / (2 * 10 * 20 ** 2)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'fit.prm')
        with open(path, 'w') as f:
            f.write(COARSE_FIT)
        # From the fine side; from the coarse one as near as its cells allow, or NO.
        for side, level, tolerance in (('second', 0, .01), ('second', 1, .01), ('first', 1, .1), ('first', 2, .03)):
            settings = [f'Pair fit/Nonmortar={side}', f'Body shaft/Initial levels={level}']
            pair = p.solve(path, *settings)['pairs'][0]
            near(pair['initial_penetration'], .001, .01, f'{side}, {level}: interference')
            near(pair['load'] / pair['contact_area'], pressure, tolerance, f'{side}, {level}: mean pressure')
            # Its end beside it, which the side meets over the chords of the rim.
            ended = p.solve(path, *settings, 'Pair fit/First=shaft: side + bottom', 'Body shaft/Boundary shapes=bottom: plane: (0, 0, -4), (0, 0, 1)', codes=(0, 3))['pairs'][0]
            near(ended['initial_penetration'], .001, .01, f'{side}, {level}: interference with the end')
            near(ended['load'] / ended['contact_area'], pressure, tolerance, f'{side}, {level}: mean pressure with the end')
            loose = p.solve(path, *settings, 'Body hub/Inner radius=10.0005')
            check(loose['pairs'][0]['load'] == 0. == loose['pairs'][0]['initial_penetration'], f'{side}, {level}: clearance')


def wrong_gap(p):
    """Facets in place of the surfaces: the same problem gets the verdict NO, and exit code 3, with the results written."""
    with tempfile.TemporaryDirectory() as folder:
        settings = []
        for body, (low, high), n in (('inner', (v.RINGS[0], v.RINGS[1] + INTERFERENCE), 12), ('outer', v.RINGS[1:], 16)):
            mesh = os.path.join(folder, f'{body}.msh')
            v.write_ring(mesh, low, high, n, n // 2, n // 6 if body == 'inner' else n // 4)
            settings += [f'Body {body}/Mesh={mesh}', f'Body {body}/Pressures=', f'Body {body}/Dirichlet=x0: (0, *, *); y0: (*, 0, *); bottom: (*, *, 0); top: (*, *, 0)']
        settings += ['Refinement/Global cycles=0', 'Pair contact/First=inner: outside', 'Pair contact/Second=outer: inside', *GEOMETRIC]
        for surface, code in (('automatic', 0), ('faceted', 3)):
            out = os.path.join(folder, surface)
            arguments = [a for s in settings + [f'Pair contact/Surface={surface}'] for a in ('--set', s)]
            run = p.call(v.SHELLS, '--output', out, *arguments)
            check(run.returncode == code, f'{surface}: exit code {run.returncode}\n{run.stdout[-600:]}{run.stderr}')
            with open(os.path.join(out, 'summary.json')) as f:
                s = json.load(f)
            c = s['certificate']
            check(c['contact_conditions_hold'] == (code == 0), f'{surface}: verdict {c}')
            check(('contact conditions hold: yes' in run.stdout) == (code == 0), f'{surface}: {run.stdout[-600:]}')
            if code:
                check(any('pair contact' in text and 'Surface' in text for text in c['objections']), f'{surface}: {c["objections"]}')
            # The recovered pressure beside the raw one: the same force.
            rows = read_pressure(os.path.join(out, 'pressure.csv'))
            raw, smooth = ([r['area'] * r[k] for r in rows] for k in ('pressure', 'recovered_pressure'))
            near(sum(smooth), sum(raw), 2e-2 if code else 1e-3, f'{surface}: force of the recovered pressure')
            check(min(r['recovered_pressure'] for r in rows) >= -1e-9 * max(r['pressure'] for r in rows), f'{surface}: recovered tension')


MISSED = '''set Bodies        = block, roller
set Contact pairs = c
subsection Body block
  set Upper corner  = 30, 20, 20
  set Divisions     = 5, 3, 3
  set Dirichlet     = bottom: (0, 0, 0)
  set Young modulus = 2e5
end
subsection Body roller
  set Mesh           = half cylinder
  set Radius         = 10
  set Height         = 20
  set Rotation axis  = 1, 0, 0
  set Rotation angle = 90
  set Translation    = 15, 20, 30
  set Dirichlet      = flat: (0, 0, -0.1)
  set Young modulus  = 2e5
end
subsection Pair c
  set First     = block: top
  set Second    = roller: outer
  set Nonmortar = first
end
subsection Refinement
  set Global cycles = 0
end
'''


def missed_contact(p):
    """A roller that enters faces much wider than the contact: the gap of the faces stays open, there is no force, and the verdict is NO."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'roller.prm')
        with open(path, 'w') as f:
            f.write(MISSED)
        s = p.solve(path, codes=(3,))
        pair, objections = s['pairs'][0], s['certificate']['objections']
        check(pair['contact_area'] == 0 and not s['certificate']['contact_conditions_hold'], f'{pair}')
        near(pair['missed_penetration'], .1, .1, 'missed penetration')
        check(len(objections) == 1 and 'no contact force' in objections[0] and 'Nonmortar' in objections[0], f'{objections}')
        check(not any('separated' in note for note in s['notes']), f'{s["notes"]}')
        # Raised by as much as it goes down it touches nothing.
        s = p.solve(path, 'Body roller/Translation=15, 20, 30.11')
        check(s['pairs'][0]['missed_penetration'] == 0 and any('separated' in note for note in s['notes']), f'{s["pairs"][0]}')
        for settings in (['Pair c/Nonmortar=second'], ['Refinement/Initial global levels=2']):
            pair = p.solve(path, *settings)['pairs'][0]
            check(pair['load'] > 8e4 and pair['missed_penetration'] == 0, f'{settings}: {pair}')


# A block of one layer on a wide roller and one of radius 1 at x, higher by h than the block.
TWO_ROLLERS = '''set Bodies        = block
set Contact pairs = c
subsection Body block
  set Lower corner  = -10, 0, 0
  set Upper corner  = 10, 1, 6
  set Divisions     = 20, 1, 6
  set Dirichlet     = front: (*, 0, *); back: (*, 0, *); top: (0, *, -0.1)
  set Young modulus = 1000
end
subsection Pair c
  set First    = block: bottom
  set Obstacle = function: if(x<0, (sqrt((x+5)^2+(z+200)^2)-200), (sqrt((x-{x})^2+(z+{h})^2)-1))
end
subsection Refinement
  set Global cycles = 0
end
'''


BIG = '''subsection Body big
  set Lower corner  = -100, 100, 0
  set Upper corner  = 100, 300, 100
  set Divisions     = 8, 8, 4
  set Dirichlet     = top: (0, 0, -3)
  set Young modulus = 1000
end
subsection Pair big
  set First    = big: bottom
  set Obstacle = plane: (0, 0, 0), (0, 0, 1)
end
'''


# A plate on a shallow dome with bumps between its nodes.
BUMPS = '''set Bodies        = block
set Contact pairs = c
subsection Body block
  set Lower corner  = -10, -10, 0
  set Upper corner  = 10, 10, 6
  set Divisions     = 20, 20, 3
  set Dirichlet     = top: (0, 0, -0.05)
  set Young modulus = 1000
end
subsection Pair c
  set First    = block: bottom
  set Obstacle = function: z+((x-2)^2+(y-1)^2)/200-0.06*(sin(pi*x)*sin(pi*y))^4
end
subsection Refinement
  set Global cycles = 0
end
'''


def bumps_beside_contact(p):
    """What penetrates beside the contact, and what away from it, is the same on any number of ranks."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'bumps.prm')
        with open(path, 'w') as f:
            f.write(BUMPS)
        pair = p.solve(path, codes=(0, 3))['pairs'][0]
        near(pair['missed_penetration'], 0.00436711, 1e-5, 'missed penetration')
        near(pair['spot_penetration'], 0.06803275, 1e-5, 'penetration of the spot')
        near(pair['spot_approach'], 0.05665768, 1e-5, 'approach of the spot')
        check(math.dist(pair['missed_at'], (-2.5, 0.5, 0)) < 1e-9 and math.dist(pair['spot_at'], (3.5, 2.5, 0)) < 1e-9, f'{pair}')


def two_rollers(p):
    """One pair with two contacts of which the mesh is fine enough for one: the other one is judged by what it carries itself, whether it is missed or carries half."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'rollers.prm')
        for x, h, words, share in ((5.5, 1.075, 'no contact force', 0), (5.25, 1.05, 'between the nodes', 1.9)):
            with open(path, 'w') as f:
                f.write(TWO_ROLLERS.format(x=x, h=h))
            s = p.solve(path, codes=(3,))
            pair, objections = s['pairs'][0], s['certificate']['objections']
            check(len(objections) == 1 and words in objections[0], f'{objections}')
            check(pair['max_penetration'] < 0.5 * pair['approach'], f'of the whole pair: {pair}')
            if share > 0:
                near(pair['spot_penetration'] / pair['spot_approach'], share, 0.05, 'penetration of the spot')
                near(s['certificate']['geometric_penetration'], share, 0.05, 'the same')
            check(math.dist(pair['spot_at' if share > 0 else 'missed_at'], (x, 0, 0)) < 0.5, f'{pair}')
        # Fine enough for both.
        s = p.solve(path, 'Refinement/Initial global levels=3')
        check(s['pairs'][0]['missed_penetration'] == 0, f'{s["pairs"][0]}')
        # A body that is pressed far more is none of its business.
        with open(path, 'a') as f:
            f.write(BIG)
        for h in (1.0, 0.95):
            s = p.solve(path, 'Bodies=block, big', 'Contact pairs=c, big', f'Pair c/Obstacle=function: if(x<0, sqrt((x+5)^2+(z+200)^2)-200, sqrt((x-5.5)^2+(z+{h})^2)-1)',
                        'Body block/Dirichlet=front: (*, 0, *); back: (*, 0, *); top: (0, *, -0.04)', codes=(3,))
            check(s['certificate']['geometric_penetration'] > 0.5, f'{s["certificate"]}')


FILLETS = '''set Bodies        = block, pocket
set Contact pairs = seat
subsection Body block
  set Mesh          = fillets.msh
  set Volumes       = block
  set Young modulus = 2000
  set Forces        = top: (300, 0, -500)
end
subsection Body pocket
  set Mesh          = fillets.msh
  set Volumes       = pocket
  set Young modulus = 3000
  set Dirichlet     = base: (0, 0, 0)
end
subsection Pair seat
  set First  = block: skin
  set Second = pocket: inner
end
'''


def fillets(p):
    """A block with rounded edges and corners in a pocket with the same rounding, two and three faces around each: the gap is that of the roundings, where flat
    parts, cylinders and spheres go over into each other, and either side as nonmortar finds the same."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'fillets.prm')
        with open(path, 'w') as f:
            f.write(FILLETS)
        for size in (2, 1.3):
            make_mesh(os.path.join(TOP, 'tests', 'application', 'fillets.geo'), os.path.join(folder, 'fillets.msh'), '-setnumber', 'h', str(size))
            loads = []
            for side in ('first', 'second'):
                s = p.solve(path, f'Pair seat/Nonmortar={side}')
                pair = s['pairs'][0]
                near(pair['force'][0], -300. if side == 'first' else 300., 1e-6, 'force along x')
                near(abs(pair['force'][2]), 500., 1e-6, 'force along z')
                check(pair['gap_doubt'] < 1e-5 and pair['initial_penetration'] < 1e-5, f'{size}, {side}: {pair}')
                loads.append(pair['load'])
            near(loads[0], loads[1], .01, f'{size}: load by either side')


ELLIPSES = '''set Bodies        = shaft, ring
set Contact pairs = fit
subsection Body shaft
  set Mesh          = ellipses.msh
  set Volumes       = shaft
  set Young modulus = 210000
  set Dirichlet     = shaft ends: (*, *, 0)
end
subsection Body ring
  set Mesh          = ellipses.msh
  set Volumes       = ring
  set Young modulus = 70000
  set Dirichlet     = ring ends: (*, *, 0); outside: (0, 0, *)
end
subsection Pair fit
  set First  = shaft: skin
  set Second = ring: bore
end
'''


def elliptic_fit(p):
    """Refining a fit of surfaces that are neither spheres nor cylinders resolves no ripples of the start mesh. By a start mesh four times as fine
    pressures are 223 to 263 around the ends of the long axis; refined ripples made them 131 to 315."""
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, 'ellipses.prm'), os.path.join(folder, 'out')
        with open(path, 'w') as f:
            f.write(ELLIPSES)
        make_mesh(os.path.join(TOP, 'tests', 'application', 'ellipses.geo'), os.path.join(folder, 'ellipses.msh'))
        s = p.solve(path, 'Refinement/Initial global levels=2', keep=out)
        pressures = [r['pressure'] for r in read_pressure(os.path.join(out, 'pressure.csv')) if abs(r['x']) > 9.3]
        print(f'{len(pressures)} nodes: {min(pressures)} to {max(pressures)}, doubt {s["pairs"][0]["gap_doubt"]}')
        check(min(pressures) > 217. and s['pairs'][0]['max_pressure'] < 270., f'pressures from {min(pressures)} to {max(pressures)}')
        check(s['certificate']['contact_conditions_hold'], f'{s["certificate"]["objections"]}')
