"""Problems with known answers whose bodies have known shapes: generated ones (prm/shapes), and a cone."""
import math
import os
import tempfile

from free_body_cases import make_mesh
from harness import TOP, certificate, check, near, read_pressure


def line_contact(p):
    """Plane strain Hertz: half width and largest pressure within a percent of the formulas for the computed force."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'results')
        s = p.solve('shapes/line-contact.prm', keep=out)
        rows = read_pressure(os.path.join(out, 'pressure.csv'))
    certificate(s, 1e-7)
    radius, modulus, depth = 10., 1000. / (1 - .3 ** 2) / 2, .2
    forces = [row['area'] * row['pressure'] for row in rows]
    # Half of the line, a slab of some depth. For p0 sqrt(1 - (x/a)^2) the mean of x^2 is (a/2)^2.
    force = 2 * sum(forces) / depth
    width = 2 * math.sqrt(sum(f * row['x'] ** 2 for f, row in zip(forces, rows)) / sum(forces))
    peak = max(row['pressure'] for row in rows)
    from_area = s['pairs'][0]['contact_area'] / depth
    expected = math.sqrt(4 * force * radius / (math.pi * modulus)), math.sqrt(force * modulus / (math.pi * radius))
    print(f'{s["cycles"][-1]["dofs"]} unknowns, {s["cycles"][-1]["nonlinear"]["iterations"]} iterations, force {force:.5g}: half width '
          f'{width / expected[0] - 1:+.2%} (from the active nodes {from_area / expected[0] - 1:+.2%}), p0 {peak / expected[1] - 1:+.2%}')
    check(abs(width / expected[0] - 1) < .01, f'half width {width}, expected {expected[0]}')
    check(abs(peak / expected[1] - 1) < .01, f'largest pressure {peak}, expected {expected[1]}')
    check(abs(s['pairs'][0]['force'][2]) > 0 and s['bodies'][0]['name'] == 'cylinder', 'bodies')


def press_fit_of_tubes(p):
    """Lame's pressure within a percent at every node."""
    s = p.solve('shapes/press-fit.prm')
    certificate(s)
    a, b, c, nu = 5., 10., 16., .3

    def compliance(young, other):
        """Radial displacement of the interface of one tube for the pressure 1, without sign, in plane strain."""
        return b * (1 + nu) / young * ((1 - 2 * nu) * b ** 2 + other ** 2) / abs(other ** 2 - b ** 2)
    pressure = .01 / (compliance(2e5, a) + compliance(1e5, c))
    pair = s['pairs'][0]
    print(f'{s["cycles"][-1]["dofs"]} unknowns, {s["cycles"][-1]["nonlinear"]["iterations"]} iterations: pressure '
          f'{pair["min_pressure"] / pressure - 1:+.2%} to {pair["max_pressure"] / pressure - 1:+.2%}')
    for key in ('min_pressure', 'max_pressure'):
        check(abs(pair[key] / pressure - 1) < .01, f'{key}: {pair[key]}, expected {pressure}')


CONE = """set Bodies        = plug, socket
set Contact pairs = seat
subsection Body plug
  set Mesh          = cone.msh
  set Volumes       = plug
  set Young modulus = 210e3
  set Poisson ratio = 0.3
  set Dirichlet     = at y: (*, 0, *); at x: (0, *, *)
  set Forces        = head: (0, 0, -1000)
end
subsection Body socket
  set Mesh          = cone.msh
  set Volumes       = socket
  set Young modulus = 210e3
  set Poisson ratio = 0.3
  set Dirichlet     = at y: (*, 0, *); at x: (0, *, *); foot: (*, *, 0)
end
subsection Pair seat
  set First     = plug: taper
  set Second    = socket: seat
  set Nonmortar = SIDE
end
"""


def cone_in_socket(p):
    """A conical plug in a socket of the same shape, on coarse meshes that do not match: nothing overlaps, all of the seat carries, and the pressure has the axial force."""
    angle = math.radians(20)
    with tempfile.TemporaryDirectory() as folder:
        make_mesh(os.path.join(TOP, 'tests', 'application', 'cone.geo'), os.path.join(folder, 'cone.msh'))
        # By the radius at the lower end, and by the apex.
        shapes = {'plug': 'taper: cone: (0, 0, 0), (0, 0, 1), 5, 20', 'socket': f'seat: cone: (0, 0, {-5 / math.tan(angle)}), (0, 0, 2), 0, 20'}
        low, high = 5 + math.tan(angle), 5 + 9 * math.tan(angle)
        area = math.pi / 4 * (high ** 2 - low ** 2) / math.sin(angle)
        moved = {}
        for side in ('first', 'second'):
            path = os.path.join(folder, 'cone.prm')
            with open(path, 'w') as f:
                f.write(CONE.replace('SIDE', side))
            # The facets overlap.
            facets = p.solve(path, 'Pair seat/Surface=faceted', codes=(0, 3))['pairs'][0]['initial_penetration']
            check(facets > .02, f'{side}: facets overlap by {facets}')
            for cycles in (0, 1):
                s = p.solve(path, *(f'Body {body}/Boundary shapes={shape}' for body, shape in shapes.items()), f'Refinement/Global cycles={cycles}')
                certificate(s)
                pair, moved[side, cycles] = s['pairs'][0], s['bodies'][0]['largest_displacement']
                print(f'{side}, {cycles} cycles: overlap {pair["initial_penetration"]}, load {pair["load"]}, force {pair["force"]}, '
                      f'contact area {pair["contact_area"] / area - 1:+.2%}, displacement {moved[side, cycles]}')
                check(pair['initial_penetration'] <= 5e-4 * facets and pair['gap_doubt'] == 0, f'{side}: the gap is not that of the cones: {pair}')
                check(s['certificate']['contact_conditions_hold'], f'{side}: {s["certificate"]["objections"]}')
                near(abs(pair['force'][2]), 1000, 1e-8, 'axial force')
                near(pair['load'], 1000 / math.sin(angle), 1e-6, 'load')
                check(abs(pair['contact_area'] / area - 1) < .01, f'{side}: contact area {pair["contact_area"]}, of the seat {area}')
        for cycles in (0, 1):
            near(moved['first', cycles], moved['second', cycles], .02, 'displacement, by the side')
        run = p.call(path, '--check', '--set', 'Body plug/Boundary shapes=taper: cone: (0, 0, 0), (0, 0, -1), 5, 20')
        check(run.returncode == 1 and 'Does it belong to this boundary' in run.stderr, f'a cone that narrows: {run.returncode}, {run.stderr}')


TAPER = '''set Bodies        = implant, abutment
set Contact pairs = seat
subsection Body implant
  set Mesh            = taper.msh
  set Volumes         = implant
  set Young modulus   = 1.1e5
  set Dirichlet       = foot: (0, 0, 0)
  set Boundary shapes = seat: cone: (0, 0, 0), (0, 0, 1), 1.2, 5.5
end
subsection Body abutment
  set Mesh            = taper.msh
  set Volumes         = abutment
  set Young modulus   = 1.1e5
  set Rigid           = top: force (0, 0, -200), along (0, 0, 1)
  set Boundary shapes = seat: cone: (0, 0, 0), (0, 0, 1), 1.2, 5.5
end
subsection Pair seat
  set First           = implant: seat
  set Second          = abutment: seat
end
'''


def taper(p):
    """A cone of 5.5 degrees holds an abutment that nothing else does, though the normals of its faces turn by more than that: around it, not along its axis. The mesh alone shows that it is a cone, and where it ends: the shank beside it is no crease."""
    with tempfile.TemporaryDirectory() as folder:
        make_mesh(os.path.join(TOP, 'tests', 'application', 'taper.geo'), os.path.join(folder, 'taper.msh'))
        path = os.path.join(folder, 'taper.prm')
        with open(path, 'w') as f:
            f.write(TAPER)
        of_mesh = [f'Body {body}/Boundary shapes=' for body in ('implant', 'abutment')]
        for settings, precision in ((), 1e-6), (of_mesh, 1e-4):
            s = p.solve(path, *settings)
            near(s['pairs'][0]['load'], 200 / math.sin(math.radians(5.5)), precision, 'load')
            check(not any('facets of the surfaces' in note for note in s['notes']), f'{s["notes"]}')
