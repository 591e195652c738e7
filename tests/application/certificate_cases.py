"""What the certificate sees, and how far bodies move that little holds: problems of users that went wrong with the verdict yes."""
import itertools
import os
import re
import tempfile

from free_body_cases import RING_ON_CONE, make_mesh
from harness import TOP, check, near, read_pressure

# Two roofs, ridge on ridge, along z.
ROOFS = '''set Bodies        = low, up
set Contact pairs = ridge
subsection Body low
  set Mesh            = prism
  set Corners         = (0, 0); (-1, -1); (-1, -2); (1, -2); (1, -1)
  set Height          = 2
  set Round divisions = 3, 1, 6
  set Young modulus   = 1000
  set Dirichlet       = side 3: (0, 0, 0)
end
subsection Body up
  set Mesh            = prism
  set Corners         = (0, 0); (1, 1); (1, 2); (-1, 2); (-1, 1)
  set Height          = 2
  set Round divisions = 3, 1, 5
  set Young modulus   = 1000
  set Dirichlet       = side 3: (0, -0.02, 0)
end
subsection Pair ridge
  set First  = low: side 1 + side 5
  set Second = up: side 1 + side 5
end
subsection Refinement
  set Initial global levels = 0
end
'''

# A block that is pressed onto another one, and beside them a third one that nothing keeps out of the second.
BLOCKS = '''set Bodies        = low, up, wall
set Contact pairs = c
subsection Body low
  set Divisions     = 4, 4, 4
  set Upper corner  = 2, 1, 1
  set Young modulus = 1000
  set Dirichlet     = bottom: (0, 0, 0)
end
subsection Body up
  set Divisions     = 3, 3, 3
  set Lower corner  = 0, 0, 1
  set Upper corner  = 2, 1, 2
  set Young modulus = 1000
  set Dirichlet     = top: (0, 0, -0.02)
end
subsection Body wall
  set Divisions     = 2, 3, 5
  set Lower corner  = 2.05, 0.1, 0.1
  set Upper corner  = 3, 0.9, 0.9
  set Young modulus = 1000
  set Dirichlet     = right: (-0.1, 0, 0)
end
subsection Pair c
  set First  = up: bottom
  set Second = low: top
end
subsection Refinement
  set Initial global levels = 0
end
'''


def unseen_penetration(p):
    """Bodies that lie in each other where no pair looks: an edge on an edge, faces that are not in their pair (NO), bodies without a pair (a note)."""
    with tempfile.TemporaryDirectory() as folder:
        roofs, blocks = (os.path.join(folder, name) for name in ('roofs.prm', 'blocks.prm'))
        for path, text in ((roofs, ROOFS), (blocks, BLOCKS)):
            with open(path, 'w') as f:
                f.write(text)
        s = p.solve(roofs, codes=(3,))
        objections = s['certificate']['objections']
        # 0.02 in its direction, less than a thousandth of a face as its rounding.
        check(len(objections) == 1 and 'deep in body' in objections[0] and 'edges that meet edges' in objections[0], f'{objections}')
        near(float(objections[0].split(' deep')[0].split()[-1]), .02 * .5 ** .5, .04, 'depth')
        check(not p.solve(roofs, 'Body up/Translation=0, 0.021, 0')['certificate']['objections'], 'roofs apart')
        s = p.solve(blocks)
        notes = [note for note in s['notes'] if 'deep in' in note]
        check(len(notes) == 1 and 'no contact pair keeps them apart' in notes[0] and 'wall' in notes[0] and 'low' in notes[0], f'{notes}')
        near(float(notes[0].split(' deep')[0].split()[-1]), .05, .1, 'depth of the wall')
        check(not any('deep in' in note for note in p.solve(blocks, 'Body wall/Translation=0.07, 0, 0')['notes']), 'wall apart')
        # Half of the face is not in the pair.
        s = p.solve(blocks, 'Pair c/First region=0.9 - x', 'Pair c/Second region=0.9 - x', 'Body wall/Translation=1, 0, 0', codes=(3,))
        check(any('deep in body' in text and 'where their pair does not look' in text for text in s['certificate']['objections']), f'{s["certificate"]}')


# A block on a floor by its weight; beside it another problem.
FAR = '''set Bodies        = cube, upper, lower
set Contact pairs = floor, interface
subsection Body cube
  set Divisions     = 4, 4, 4
  set Young modulus = 1000
  set Volume force  = (0, 0, -1)
end
subsection Pair floor
  set First    = cube: bottom
  set Obstacle = plane: (0, 0, -0.3), (0, 0, 1)
end
subsection Body upper
  set Lower corner  = 10, 0, 0
  set Upper corner  = 11, 1, 1
  set Divisions     = 3, 3, 3
  set Young modulus = {young}
  set Dirichlet     = left: (0, *, *); front: (*, 0, *); top: (*, *, -0.01)
end
subsection Body lower
  set Lower corner  = 10, 0, -1
  set Upper corner  = 11, 1, 0
  set Divisions     = 4, 4, 4
  set Young modulus = {young}
  set Dirichlet     = left: (0, *, *); front: (*, 0, *); bottom: (*, *, 0)
end
subsection Pair interface
  set First  = upper: bottom
  set Second = lower: top
end
'''


def far_problem(p):
    """Another problem in the same file, with forces of any size: the weight is carried, or the verdict is NO."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'far.prm')
        for young, codes in ((1e3, (0,)), (1e8, (0,)), (1e12, (0, 3))):
            with open(path, 'w') as f:
                f.write(FAR.format(young=young))
            s = p.solve(path, codes=codes)
            carried = s['pairs'][0]['load']
            print(f'E = {young:g}: {carried} of 1')
            if s['certificate']['contact_conditions_hold']:
                near(carried, 1., 1e-4, f'{young}: the weight')
            else:
                check(any('body cube' in text and 'does not balance' in text for text in s['certificate']['objections']), f'{s["certificate"]}')


RINGS = '''set Bodies        = in, out
set Contact pairs = fit
subsection Body in
  set Mesh            = {mesh}
  set Inner radius    = 5
  set Radius          = 7.003
  set Height          = 1
  set Round divisions = 2, 24, 1
  set Young modulus   = 1000
  set Poisson ratio   = 0.3
  set Dirichlet       = start: (*, *, 0); end: (*, *, 0)
  set Rotation axis   = 0, 0, 1
end
subsection Body out
  set Mesh            = {mesh}
  set Inner radius    = 7
  set Radius          = 10
  set Height          = 1
  set Round divisions = 3, 28, 1
  set Young modulus   = 2000
  set Poisson ratio   = 0.3
  set Dirichlet       = start: (*, *, 0); end: (*, *, 0)
end
subsection Pair fit
  set First  = in: outer
  set Second = out: inner
end
subsection Refinement
  set Initial global levels = 0
end
'''


def turned_rings(p):
    """A press fit that nothing holds in its plane, every node held across it: the same whatever the angle between the meshes."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'rings.prm')
        with open(path, 'w') as f:
            f.write(RINGS.format(mesh='tube'))
        reference = None
        for angle in (0., 1., 3.3, 6.):
            s = p.solve(path, f'Body in/Rotation angle={angle}')
            u = [body['largest_displacement'] for body in s['bodies']]
            reference = reference or u
            print(f'{angle} degrees: {u}')
            for one, other in zip(u, reference):
                check(abs(one - other) <= .02 * reference[0], f'{angle} degrees: displacements {u}, without an angle {reference}')
            check(s['displacements_are_small'], f'{angle} degrees: {s["notes"]}')


# A lug on a pin, with clearance, moved by a force.
CLEARANCE = '''set Bodies        = lug, pin
set Contact pairs = bearing
subsection Body lug
  set Mesh            = tube
  set Inner radius    = 6
  set Radius          = 9
  set Height          = 2
  set Round divisions = 2, 28, 2
  set Young modulus   = 1e5
  set Dirichlet       = start: (*, *, 0)
  set Volume force    = (1, 0, 0)
end
subsection Body pin
  set Mesh            = tube
  set Inner radius    = 2
  set Radius          = 5
  set Height          = 2
  set Round divisions = 2, 24, 2
  set Young modulus   = 1e5
  set Dirichlet       = start: (0, 0, 0); end: (0, 0, 0)
end
subsection Pair bearing
  set First  = lug: inner
  set Second = pin: outer
end
subsection Refinement
  set Initial global levels = 0
end
'''


# A block that nothing holds between two that come nearer to each other.
BETWEEN = '''set Bodies = a, b, c
set Contact pairs = p, q
subsection Body a
  set Upper corner  = 4, 4, 1
  set Divisions     = 5, 5, 1
  set Young modulus = 1000
  set Poisson ratio = 0.3
  set Dirichlet     = bottom: (0, 0, 0)
end
subsection Body b
  set Lower corner  = 0.3, 0.3, 1
  set Upper corner  = 3.4, 3.6, 2
  set Divisions     = 4, 3, 1
  set Young modulus = 2000
  set Poisson ratio = 0.3
end
subsection Body c
  set Lower corner  = 0, 0, 2
  set Upper corner  = 4, 4, 3
  set Divisions     = 3, 4, 1
  set Young modulus = 1500
  set Poisson ratio = 0.3
  set Dirichlet     = top: (1e-10, -5e-11, -5e-10)
end
subsection Pair p
  set First         = b: bottom
  set Second        = a: top
  set Initial gap   = {gap}
end
subsection Pair q
  set First         = c: bottom
  set Second        = b: top
  set Initial gap   = {gap}
end
subsection Refinement
  set Initial global levels = 0
end
'''


def rounding_pressures(p):
    """A block between two that leave it room: the only pressures are rounding, which is no scale of what the solver leaves."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'between.prm')
        for room in ('3e-10', '2.6e-10'):
            with open(path, 'w') as f:
                f.write(BETWEEN.format(gap=room + ' + 2e-10*((x - 0.1)^2 + 0.5*(y + 0.05)^2)'))
            s = p.solve(path, codes=(0, 3))
            print(room, [pair['load'] for pair in s['pairs']], s['certificate'])
            check(all(pair['load'] <= 1e-18 for pair in s['pairs']), f'{room}: {s["pairs"]}')
            check(s['certificate']['contact_conditions_hold'], f'{room}: {s["certificate"]["objections"]}')


# A tube held at its bore, above a plate.
TUBE = '''set Bodies        = tube, plate
set Contact pairs = c
subsection Body tube
  set Mesh            = tube
  set Inner radius    = 0.2
  set Radius          = 0.5
  set Height          = 0.5
  set Round divisions = 2, 9, 1
  set Rotation axis   = 1, 0, 0
  set Rotation angle  = 90
  set Translation     = 0, 0.5, 0.52
  set Young modulus   = 2e5
end
subsection Body plate
  set Lower corner    = -2, -0.5, -1
  set Upper corner    = 2, 1, 0
  set Divisions       = 16, 3, 3
  set Young modulus   = 2e5
  set Dirichlet       = bottom: (0, 0, 0)
end
subsection Pair c
  set First     = tube: outer
  set Second    = plate: top
  set Nonmortar = first
end
subsection Refinement
  set Initial global levels = 0
end
'''


def slides_beside(p):
    """A tube above a plate that is moved sideways by less than half of its radius, less than a face: nodes beside the lowest ones have normals that lean that way, and press. Not one that is moved down."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'tube.prm')
        with open(path, 'w') as f:
            f.write(TUBE)
        for moved, is_small in (('0.2, 0, 0', False), ('0, 0, -0.03', True), ('0.005, 0, -0.03', True)):
            s = p.solve(path, f'Body tube/Dirichlet=inner: ({moved})', codes=(0, 3))
            pair = s['pairs'][0]
            told = [note for note in s['notes'] if 'slide into the other side by the normals' in note]
            print(moved, pair['load'], pair['slip'], pair['slip_in_faces'], s['displacements_are_small'], told)
            check(pair['load'] > 0 and pair['slip_in_faces'] < 1, f'moved by {moved}: {pair}')
            check(s['displacements_are_small'] == is_small and (not told) == is_small, f'moved by {moved}: {s["notes"]}')
            check((pair['pressed_by_slip'] > .25) != is_small, f'moved by {moved}: {pair["pressed_by_slip"]}')
        # With the plane itself instead of the plate nothing presses, and nothing is told.
        with open(path, 'w') as f:
            f.write(re.sub('subsection Body plate.*?end\n', '', TUBE, flags=re.S).replace('tube, plate', 'tube').replace('Second    = plate: top', 'Obstacle  = plane: (0, 0, 0), (0, 0, 1)')
                    .replace('  set Nonmortar = first\n', ''))
        s = p.solve(path, 'Body tube/Dirichlet=inner: (0.2, 0, 0)', codes=(0, 3))
        check(s['pairs'][0]['load'] == 0 and not any('by the normals' in note for note in s['notes']), f'above an obstacle: {s["pairs"]}, {s["notes"]}')


def moved_by_loads(p):
    """A lug moves by its clearance along the load, and does not turn about the point in which it is held because nothing else holds its rotation."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'lug.prm')
        with open(path, 'w') as f:
            f.write(CLEARANCE)
        for side in ('first', 'second'):
            for angle in (0., 5.):
                s = p.solve(path, f'Pair bearing/Nonmortar={side}', 'Body lug/Rotation axis=0, 0, 1', f'Body lug/Rotation angle={angle}', codes=(0, 3))
                u = s['bodies'][0]['largest_displacement']
                print(f'{side}, {angle} degrees: {u}, {[note for note in s["notes"] if "held" in note]}')
                near(u, 1., .03, f'{side}, {angle} degrees: displacement')


SHOULDER = '''set Bodies        = bolt, plate
set Contact pairs = seat
subsection Body bolt
  set Mesh          = shoulder.msh
  set Volumes       = bolt
  set Young modulus = 2.1e5
  set Dirichlet     = bolt x0: (0, *, *); bolt y0: (*, 0, *)
  set Forces        = pull: (0, 0, -1250)
end
subsection Body plate
  set Mesh          = shoulder.msh
  set Volumes       = plate
  set Young modulus = 2.1e5
  set Dirichlet     = plate x0: (0, *, *); plate y0: (*, 0, *); base: (*, *, 0)
end
subsection Pair seat
  set First  = bolt: underside
  set Second = plate: top
end
'''


def shoulder(p):
    """The head of a bolt with one face between shank and rim, given with and without its shank, which has a clearance in the bore: it presses with all of it."""
    with tempfile.TemporaryDirectory() as folder:
        make_mesh(os.path.join(TOP, 'tests', 'application', 'shoulder.geo'), os.path.join(folder, 'shoulder.msh'))
        path = os.path.join(folder, 'shoulder.prm')
        with open(path, 'w') as f:
            f.write(SHOULDER)

        def solve(*settings):
            out = tempfile.mkdtemp(dir=folder)
            os.rmdir(out)
            s = p.solve(path, *settings, keep=out)
            rows = read_pressure(os.path.join(out, 'pressure.csv'))
            force = sum(r['area'] * r['pressure'] for r in rows)
            near(force, 1250., 1e-6, f'{settings}: load')
            return s['bodies'][0]['largest_displacement'], sum(r['area'] * r['pressure'] * (r['x'] ** 2 + r['y'] ** 2) ** .5 for r in rows) / force

        for side in ('first', 'second'):
            alone = solve(f'Pair seat/Nonmortar={side}')
            whole = solve(f'Pair seat/Nonmortar={side}', 'Pair seat/First=bolt: underside + shank', 'Pair seat/Second=plate: top + bore')
            print(f'{side}: displacement, mean radius of the force {whole}, underside and top alone {alone}')
            near(whole[0], alone[0], .15, f'{side}: displacement')
            near(whole[1], alone[1], .15, f'{side}: mean radius of the force')


# A ball between two arms whose ends the loads press together: without friction it is squeezed out towards their wide end.
TWEEZERS = '''set Bodies        = ball, upper, lower
set Contact pairs = above, below
subsection Body ball
  set Mesh          = ball
  set Translation   = 2, 0, 0
  set Young modulus = 1000
end
''' + ''.join(f'''subsection Body {name}
  set Lower corner    = -3, -2, {low}
  set Upper corner    = 3, 2, {high}
  set Divisions       = 24, 8, 2
  set Rotation axis   = 0, 1, 0
  set Rotation angle  = {angle}
  set Young modulus   = 10000
  set Dirichlet       = left: (0, 0, 0)
  set Pressures       = {outside}: 0.06
end
''' for name, low, high, angle, outside in (('upper', 1.1, 1.6, 2, 'top'), ('lower', -1.6, -1.1, -2, 'bottom'))) + '''subsection Pair above
  set First     = ball: sphere
  set Second    = upper: bottom
  set Nonmortar = second
end
subsection Pair below
  set First     = ball: sphere
  set Second    = lower: top
  set Nonmortar = second
end
subsection Refinement
  set Initial global levels = 0
end
'''

# A block a little above a slope, which it is to be moved along.
SLOPE = '''set Bodies        = block, slope
set Contact pairs = c
subsection Body block
  set Lower corner    = -1, -1, 0.02
  set Upper corner    = 1, 1, 1
  set Divisions       = 8, 8, 4
  set Rotation axis   = 0, 1, 0
  set Rotation angle  = 3
  set Young modulus   = 1000
end
subsection Body slope
  set Lower corner    = -3, -2, -1
  set Upper corner    = 3, 2, 0
  set Divisions       = 12, 8, 2
  set Rotation axis   = 0, 1, 0
  set Rotation angle  = 3
  set Young modulus   = 1000
  set Dirichlet       = bottom: (0, 0, 0)
end
subsection Pair c
  set First  = block: bottom
  set Second = slope: top
end
subsection Refinement
  set Initial global levels = 0
end
'''


def slid_apart(p):
    """Surfaces that end up apart after they have slid along each other are told; not those that are lifted off, and not those that are farther apart than they slide."""
    with tempfile.TemporaryDirectory() as folder:
        def solve(text, *settings):
            path = os.path.join(folder, 'problem.prm')
            with open(path, 'w') as f:
                f.write(text)
            s = p.solve(path, *settings, codes=(0, 3))
            told = [note for note in s['notes'] if 'end up apart after they have slid' in note]
            print(settings, [(pair['contact_area'], pair['slip'], pair['slip_in_faces']) for pair in s['pairs']], told)
            check(s['displacements_are_small'] == (not told), f'{settings}: {s["notes"]}')
            return s, told

        s, told = solve(TWEEZERS)
        check(s['bodies'][0]['largest_displacement'] > .6, 'the ball is not squeezed out')
        check(len(told) == 2 and all(pair['slip'] > .6 for pair in s['pairs']), f'a ball is squeezed out: {s["notes"]}')
        for side in ('first', 'second'):
            for moved, is_told in (('2, 0, 0', True), ('2, 0, 0.5', True), ('0.1, 0, 0', False), ('0, 0, 2', False), ('0.1, 0, 2', False), ('2, 0, 2', False)):
                s, told = solve(SLOPE, f'Body block/Dirichlet=top: ({moved})', f'Pair c/Nonmortar={side}')
                check(s['pairs'][0]['contact_area'] == 0 and bool(told) == is_told, f'moved by {moved}: {s["pairs"]}')
        # Above the slope by 1.
        s, told = solve(SLOPE, 'Body block/Dirichlet=top: (0.8, 0, 0)', 'Body block/Translation=0, 0, 1')
        check(not told, f'far away: {s["pairs"]}')
        # Out of the cone that it lies on.
        s, told = solve(RING_ON_CONE, 'Body ring/Forces=', 'Body ring/Dirichlet=end: (0, 0, 0.5)')
        check(s['pairs'][0]['contact_area'] == 0 and not told, f'lifted off a cone: {s["pairs"]}')


def write_cubes(path, size, body_of):
    """Unit cubes of a box in two bodies, each with nodes of its own; body_of(i, j, k) may be None. Faces that meet no cube of the same body inside of the box are
    BODY_joint, those on the planes of coordinates x, y, z, others outside."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    faces = {(-1, 0, 0): (0, 3, 7, 4), (1, 0, 0): (1, 2, 6, 5), (0, -1, 0): (0, 1, 5, 4), (0, 1, 0): (3, 2, 6, 7), (0, 0, -1): (0, 1, 2, 3), (0, 0, 1): (4, 5, 6, 7)}
    names = ['upper', 'lower', 'upper_joint', 'lower_joint', 'x', 'y', 'z', 'outside']
    nodes, elements = {}, []
    for i, j, k in itertools.product(*map(range, size)):
        body = body_of(i, j, k)
        if body is None:
            continue
        number = lambda c: nodes.setdefault((body, i + corners[c][0], j + corners[c][1], k + corners[c][2]), len(nodes) + 1)
        elements.append((5, body, [number(c) for c in range(8)]))
        for direction, face in faces.items():
            beside = (i + direction[0], j + direction[1], k + direction[2])
            if all(0 <= b < s for b, s in zip(beside, size)):
                if body_of(*beside) == body:
                    continue
                name = f'{body}_joint'
            else:
                name = 'xyz'[[abs(d) for d in direction].index(1)] if min(beside) < 0 else 'outside'
            elements.append((3, name, [number(c) for c in face]))
    with open(path, 'w') as f:
        f.write(f'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(names)}\n')
        f.writelines(f'{3 if name in ("upper", "lower") else 2} {1 + names.index(name)} "{name}"\n' for name in names)
        f.write(f'$EndPhysicalNames\n$Nodes\n{len(nodes)}\n')
        f.writelines(f'{number} {x} {y} {z}\n' for (_, x, y, z), number in nodes.items())
        f.write(f'$EndNodes\n$Elements\n{len(elements)}\n')
        for number, (kind, name, corner) in enumerate(elements, 1):
            group = 1 + names.index(name)
            f.write(f'{number} {kind} 2 {group} {group} {" ".join(map(str, corner))}\n')
        f.write('$EndElements\n')


STAIRS = '''set Bodies        = upper, lower
set Contact pairs = joint
subsection Body upper
  set Mesh          = stairs.msh
  set Volumes       = upper
  set Young modulus = 1000
  set Dirichlet     = x: (0, *, *); y: (*, 0, *); z: (*, *, 0)
  set Pressures     = outside: 2
end
subsection Body lower
  set Mesh          = stairs.msh
  set Volumes       = lower
  set Young modulus = 1000
  set Dirichlet     = y: (*, 0, *); z: (*, *, 0)
  set Pressures     = outside: 2
end
subsection Pair joint
  set First         = upper: upper_joint
  set Second        = lower: lower_joint
end
'''


def stairs(p):
    """Pressed from all sides: where steps are one cell wide, nodes have the normals of no face, pressures are wrong, and the verdict says so."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'stairs.prm')
        with open(path, 'w') as f:
            f.write(STAIRS)
        for step, settings, is_right in ((1, (), False), (2, (), True), (1, ('Refinement/Global cycles=1',), True)):
            write_cubes(os.path.join(folder, 'stairs.msh'), (6, 2, 6), lambda i, j, k: 'upper' if k // step >= i // step else 'lower')
            for side in ('first', 'second'):
                s = p.solve(path, f'Pair joint/Nonmortar={side}', *settings, codes=(0,) if is_right else (3,))
                pair = s['pairs'][0]
                print(f'steps of {step} {settings}, {side} nonmortar: {pair["min_pressure"]} to {pair["max_pressure"]}, on edges {pair["share_on_edges"]}')
                error = max(abs(pair['max_pressure'] / 2 - 1), abs(pair['min_pressure'] / 2 - 1))
                check((error < 1e-9) == is_right and (pair['share_on_edges'] == 0) == is_right, f'steps of {step}, {side}: wrong by {error}')
                objections = s['certificate']['objections']
                check(any('acts at sharp edges' in text for text in objections) != is_right, f'{objections}')


CHANNEL = '''set Bodies        = upper, lower
set Contact pairs = joint
subsection Body upper
  set Mesh          = channel.msh
  set Volumes       = upper
  set Young modulus = 1000
  set Dirichlet     = y: (*, 0, *)
  set Tractions     = outside: (0, 0, -2*(z > 3.5))
end
subsection Body lower
  set Mesh          = channel.msh
  set Volumes       = lower
  set Young modulus = 1000
  set Dirichlet     = z: (0, 0, 0); y: (*, 0, *)
end
subsection Pair joint
  set First         = upper: upper_joint
  set Second        = lower: lower_joint
end
'''


def channel(p):
    """A bar of one cell on the floor of a channel whose walls its sides see from afar: nodes of its edges press along the mean of both, and it is carried by too much."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'channel.prm')
        with open(path, 'w') as f:
            f.write(CHANNEL)
        write_cubes(os.path.join(folder, 'channel.msh'), (5, 3, 4), lambda i, j, k: 'lower' if k == 0 or i in (0, 4) else 'upper' if i == 2 else None)
        for side in ('first', 'second'):
            s = p.solve(path, f'Pair joint/Nonmortar={side}', codes=(0, 3))
            pair = s['pairs'][0]
            # The floor is flat.
            is_right = abs(pair['load'] / abs(pair['force'][2]) - 1) < 1e-6
            print(f'{side} nonmortar: load {pair["load"]}, on edges {pair["share_on_edges"]}, {s["certificate"]["objections"]}')
            check(is_right == s['certificate']['contact_conditions_hold'], f'{side}: load {pair["load"]}: {s["certificate"]}')
            check(is_right == (pair['share_on_edges'] < .1), f'{side}: load {pair["load"]}, on edges {pair["share_on_edges"]}')
