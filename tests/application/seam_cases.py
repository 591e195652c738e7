"""Several bodies beside each other that touch one face of another body."""
import os
import tempfile

from harness import check, near


def block(name, low, high, divisions, *lines):
    corners = [', '.join(f'{x:g}' for x in corner) for corner in (low, high, divisions)]
    return (f'subsection Body {name}\n  set Lower corner = {corners[0]}\n  set Upper corner = {corners[1]}\n  set Divisions = {corners[2]}\n  set Young modulus = 1000\n' +
            ''.join(f'  set {line}\n' for line in lines) + 'end\n')


def pair(name, first, second, *lines):
    other = f'Obstacle = plane: {second}' if second.startswith('(') else f'Second = {second}'
    return f'subsection Pair {name}\n  set First = {first}\n  set {other}\n' + ''.join(f'  set {line}\n' for line in lines) + 'end\n'


def heading(bodies, pairs):
    return f'set Bodies = {", ".join(bodies)}\nset Contact pairs = {", ".join(pairs)}\n'


def t_joint():
    """Three blocks with meshes that do not match, under a pressure of 3 from all sides: planes hold the other ones."""
    sides = {'b0': 'Pressures = +x: 3; +y: 3', 'b1': 'Pressures = +y: 3; +z: 3', 'b2': 'Pressures = +x: 3; +y: 3; +z: 3'}
    text = block('b0', (0, 0, -1), (2, 1, 0), (8, 5, 4), sides['b0']) + block('b1', (0, 0, 0), (1, 1, 1), (5, 4, 5), sides['b1'])
    text += block('b2', (1, 0, 0), (2, 1, 1), (6, 7, 6), sides['b2'])
    planes = [('x0', 'b0: -x', '(0, 0, -1), (1, 0, 0)'), ('x1', 'b1: -x', '(0, 0, -1), (1, 0, 0)'), ('z0', 'b0: -z', '(0, 0, -1), (0, 0, 1)')]
    planes += [(f'y{k}', f'b{k}: -y', '(0, 0, -1), (0, 1, 0)') for k in range(3)]
    joints = [('p01', 'b0: +z', 'b1: -z'), ('p02', 'b0: +z', 'b2: -z'), ('p12', 'b1: +x', 'b2: -x')]
    return heading(['b0', 'b1', 'b2'], [name for name, _, _ in planes + joints]) + text + ''.join(pair(*one) for one in planes + joints)


def wall():
    """Bricks in running bond between planes, with Poisson's ratio 0, under their weight: the pressure of a joint is the height of what lies on it."""
    bricks = {}
    for course in range(3):
        edges = (0, 2, 4) if course % 2 == 0 else (0, 1, 3, 4)
        for i, (low, high) in enumerate(zip(edges[:-1], edges[1:])):
            bricks[f'k{course}{i}'] = (low, high, course)
    text, joints = '', []
    for k, (name, (low, high, course)) in enumerate(bricks.items()):
        divisions = ((2 + k % 3) * (high - low), 2 + (k + course) % 3, 2 + (2 * k + course) % 3)
        text += block(name, (low, 0, course), (high, 1, course + 1), divisions, 'Poisson ratio = 0', 'Volume force = (0, 0, -1)', 'Dirichlet = -y: (*, 0, *); +y: (*, 0, *)')
        if course == 0:
            joints.append((f'floor-{name}', f'{name}: -z', '(0, 0, 0), (0, 0, 1)'))
        if low == 0:
            joints.append((f'left-{name}', f'{name}: -x', '(0, 0, 0), (1, 0, 0)'))
        if high == 4:
            joints.append((f'right-{name}', f'{name}: +x', '(4, 0, 0), (-1, 0, 0)'))
        for other, (a, b, above) in bricks.items():
            if above == course + 1 and min(b, high) > max(a, low):
                joints.append((f'joint-{name}-{other}', f'{other}: -z', f'{name}: +z'))
            if above == course and a == high:
                joints.append((f'side-{name}-{other}', f'{name}: +x', f'{other}: -x'))
    return heading(bricks, [name for name, _, _ in joints]) + text + ''.join(pair(*one) for one in joints)


def seams(p):
    """A face over the seam of two bodies: constant pressures pass in every joint."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'blocks.prm')
        with open(path, 'w') as f:
            f.write(t_joint())
        for settings in ([], ['Pair p01/Nonmortar=first', 'Pair p02/Nonmortar=first'], ['Pair p01/Nonmortar=second', 'Pair p02/Nonmortar=first'], ['Refinement/Global cycles=1']):
            s = p.solve(path, *settings)
            check(not s['certificate']['objections'], f'{settings}: {s["certificate"]["objections"]}')
            for joint in s['pairs']:
                area = 2 if joint['name'] in ('y0', 'z0') else 1
                near(joint['load'], 3 * area, 1e-8, f'{settings}, {joint["name"]}: force')
                near(joint['max_pressure'], 3, 1e-7, f'{settings}, {joint["name"]}: pressure')
        with open(path, 'w') as f:
            f.write(wall())
        s = p.solve(path)
        check(not s['certificate']['objections'], f'wall: {s["certificate"]["objections"]}')
        check(not any('do not stay beside each other' in note for note in s['notes']), f'wall: {s["notes"]}')
        for joint in s['pairs']:
            words = joint['name'].split('-')
            weight = 3 if words[0] == 'floor' else 2 - int(words[1][1]) if words[0] == 'joint' else 0
            check(abs(joint['max_pressure'] - weight) < 1e-7, f'wall, {joint["name"]}: pressure {joint["max_pressure"]} for {weight}')


def seams_part(p):
    """Two plates beside each other against a block; one is pulled back: the other one carries what it would alone."""
    text = block('b', (0, -.5, -1), (1, .5, 1), (4, 4, 8), 'Dirichlet = +x: (0, 0, 0)')
    text += block('one', (-1, -.5, -1), (0, .5, 0), (3, 3, 3), 'Dirichlet = -x: (0.01, 0, 0)')
    other = block('other', (-1, -.5, 0), (0, .5, 1), (3, 3, 3), 'Dirichlet = -x: (-0.01, 0, 0)')
    first, second = (pair(f'p-{name}', 'b: -x', f'{name}: +x', 'Nonmortar = first') for name in ('one', 'other'))
    with tempfile.TemporaryDirectory() as folder:
        path, alone = os.path.join(folder, 'both.prm'), os.path.join(folder, 'alone.prm')
        with open(path, 'w') as f:
            f.write(heading(['b', 'one', 'other'], ['p-one', 'p-other']) + text + other + first + second)
        with open(alone, 'w') as f:
            f.write(heading(['b', 'one'], ['p-one']) + text + first)
        for cycles in (0, 2):
            expected = p.solve(alone, f'Refinement/Global cycles={cycles}')
            # In whatever order pairs come.
            for order in ('p-one, p-other', 'p-other, p-one'):
                s = p.solve(path, f'Refinement/Global cycles={cycles}', f'Contact pairs={order}')
                what = f'{cycles} cycles, {order}'
                parted = [note for note in s['notes'] if 'p-one and p-other: what they touch does not stay beside each other under "b: -x"' in note or 'p-other and p-one: what they touch does not stay beside each other under "b: -x"' in note]
                check(len(parted) == 1, f'{what}: {s["notes"]}')
                check(not s['certificate']['objections'], f'{what}: {s["certificate"]["objections"]}')
                loads = {pair['name']: pair['load'] for pair in s['pairs']}
                near(loads['p-one'], expected['pairs'][0]['load'], 1e-3, f'{what}: force')
                near(loads['p-other'], 0, 1e-12, f'{what}: force of the other one')
        # Pressed alike they stay beside each other, and share the nodes between them.
        s = p.solve(path, 'Body other/Dirichlet=-x: (0.01, 0, 0)')
        check(not any('stay beside each other' in note for note in s['notes']), f'pressed alike: {s["notes"]}')
        near(s['pairs'][1]['load'], s['pairs'][0]['load'], 1e-6, 'pressed alike: force')
        # So they are in the end, but not on the way there.
        s = p.solve(path, 'Body other/Dirichlet=-x: (-0.01 + 0.04*(t - 0.5), 0, 0)', 'Load steps=2')
        warned = [note for note in s['notes'] if note.startswith('warning: load step t = 0.5: pairs p-one and p-other: what they touch')]
        check(len(warned) == 1, f'steps: {s["notes"]}')
        # Three supports, the middle one lower: it gets none of the nodes over its seams.
        text = block('top', (0, 0, 0), (3, 1, .5), (12, 3, 2), 'Pressures = +z: 5', 'Dirichlet = -y: (*, 0, *); +y: (*, 0, *)')
        names = ['q0', 'q1', 'q2']
        for k, name in enumerate(names):
            text += block(name, (k, 0, -1), (k + 1, 1, 0), (3, 2, 3), f'Dirichlet = -z: (0, 0, {-.02 if k == 1 else 0}); -y: (*, 0, *); +y: (*, 0, *)')
        text += ''.join(pair(f'over-{name}', 'top: -z', f'{name}: +z', 'Nonmortar = first') for name in names)
        with open(path, 'w') as f:
            f.write(heading(['top', *names], [f'over-{name}' for name in names]) + text)
        s = p.solve(path)
        print([pair['load'] for pair in s['pairs']], s['notes'])
        near(s['pairs'][2]['load'], s['pairs'][0]['load'], 1e-4, 'supports: forces on both sides')
