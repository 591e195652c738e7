"""What a user may get wrong: refused with a message that names the parameter and the cure, or solved right."""
import os
import tempfile

from harness import TOP, certificate, check, constant_pressure, near

PATCH_TEST = 'patch_test/patch_test.prm'


def refused(p, prm, settings, *words):
    """One message with all the words on all ranks, and nothing left."""
    with tempfile.TemporaryDirectory() as folder:
        run = p.call(os.path.join(TOP, 'prm', prm), '--output', os.path.join(folder, 'out'), *[a for s in settings for a in ('--set', s)])
        check(run.returncode == 1, f'{settings}: exit code {run.returncode}')
        for word in words:
            check(word in run.stderr, f'{settings}: the message does not name "{word}": {run.stderr}')
        check(run.stderr.count('signorini: error:') == 1, f'{settings}: not one message: {run.stderr}')
        check(os.listdir(folder) == [], f'{settings}: left {os.listdir(folder)}')


def block_settings(name, low, high, n, dirichlet):
    return [f'Body {name}/Mesh=block', f'Body {name}/Lower corner={low}', f'Body {name}/Upper corner={high}', f'Body {name}/Divisions={n}',
            f'Body {name}/Young modulus=1000', f'Body {name}/Dirichlet={dirichlet}']


FLOOR = """set Bodies        = block
set Contact pairs = high, low
subsection Body block
  set Mesh          = block
  set Upper corner  = 2, 1, 1
  set Divisions     = 10, 5, 5
  set Young modulus = 1000
  set Poisson ratio = 0.3
  set Dirichlet     = top: (0, 0, -0.01)
  set Probes        = edge: (1, 0.4, 0)
end
subsection Pair high
  set First        = block: bottom
  set First region = 0.95 - x
  set Obstacle     = plane: (0, 0, 0), (0, 0, 1)
end
subsection Pair low
  set First        = block: bottom
  set First region = x - 1.05
  set Obstacle     = plane: (0, 0, -0.02), (0, 0, 1)
end
"""


def shared_surfaces(p):
    """Pairs that have a surface in common."""
    again = ['Contact pairs=interface, again', 'Pair again/First=upper: bottom', 'Pair again/Second=lower: top']
    for sides in ([], ['Pair again/Nonmortar=first', 'Pair interface/Nonmortar=second']):
        refused(p, PATCH_TEST, again + sides, 'interface', 'again', 'Nonmortar', 'remove one')
    # Two blocks beside each other on one.
    two = ['Bodies=upper, lower, third', 'Contact pairs=interface, beside', 'Body lower/Upper corner=2.1, 1, 0', 'Body lower/Divisions=9, 4, 4',
           *block_settings('third', '1.1, 0, 0', '2.1, 1, 1', '3, 3, 3', 'right: (0, *, *); front: (*, 0, *); top: (*, *, -0.01)'),
           'Pair beside/First=third: bottom', 'Pair beside/Second=lower: top', 'Body third/Poisson ratio=0', 'Body upper/Poisson ratio=0',
           'Body lower/Poisson ratio=0', 'Body lower/Pressures=top: 5*(x > 1)*(x < 1.1)', 'Refinement/Global cycles=0',
           'Solver/Compare linear multigrid=false']
    s = p.solve(PATCH_TEST, *two, 'Body lower/Divisions=21, 4, 4')
    constant_pressure(s, 5.)
    certificate(s)
    # On the coarser mesh below whole faces face both, and they share the nodes between them.
    s = p.solve(PATCH_TEST, *two, 'Body third/Lower corner=1, 0, 0', 'Body lower/Pressures=')
    constant_pressure(s, 5.)
    certificate(s)
    check(not any('sides are swapped' in note for note in s['notes']), f'notes: {s["notes"]}')
    near(sum(abs(pair['force'][2]) for pair in s['pairs']), 10.5, 1e-10, 'force')
    # A step in a rigid floor, two obstacles: the edge of the upper one holds the nodes over it.
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'floor.prm')
        with open(path, 'w') as f:
            f.write(FLOOR)
        s = p.solve(path)
        down = s['probes'][0]['displacement'][2]
        check(abs(down) < 1e-12, f'displacement at the edge of the step: {down}')
    # A layer in between that both of the others face from one side: the second pair is left with nothing.
    refused(p, PATCH_TEST, ['Bodies=upper, lower, third', 'Contact pairs=interface, beside', 'Pair interface/Nonmortar=second',
                            *block_settings('third', '0, 0, 2', '1, 1, 3', '2, 2, 2', 'top: (0, 0, 0)'), 'Pair beside/First=third: bottom',
                            'Pair beside/Second=lower: top', 'Pair beside/Nonmortar=second'], 'Pair beside', '"interface"', 'Nonmortar')


def held_surfaces(p):
    """Contact surfaces with prescribed displacements."""
    pressed = ['Body upper/Dirichlet=bottom: (0, 0, -0.01)', 'Body lower/Dirichlet=bottom: (0, 0, 0); top: (0, 0, 0)']
    refused(p, PATCH_TEST, pressed, 'interface', 'Dirichlet', 'no node of')
    refused(p, PATCH_TEST, pressed[1:] + ['Pair interface/Nonmortar=second'], 'interface', 'Dirichlet', 'Nonmortar')
    # One of the surfaces only: it becomes the mortar side.
    s = p.solve(PATCH_TEST, 'Body upper/Divisions=6, 6, 6', 'Body upper/Dirichlet=bottom: (0, 0, -0.01)', 'Refinement/Global cycles=0')
    constant_pressure(s, 10.)
    certificate(s)
    check(any('sides are swapped' in note for note in s['notes']), f'notes: {s["notes"]}')
    # Half of both of them.
    with tempfile.TemporaryDirectory() as folder:
        halves = []
        for body, z, end in (('upper', 0, 'bottom'), ('lower', -1, 'top')):
            path = os.path.join(folder, body + '.msh')
            write_blocks(path, [((0, 0, z), (.5, 1, z + 1), 'a'), ((.5, 0, z), (1, 1, z + 1), 'b')], joined=True)
            halves += [f'Body {body}/Mesh={path}']
        first = ['Pair interface/First=upper: bottom a', 'Pair interface/Second=lower: top a']
        both = ['Body upper/Dirichlet=bottom a: (0, 0, -0.01); top b: (*, *, 0)', 'Body lower/Dirichlet=top a: (0, 0, 0); bottom b: (0, 0, 0)']
        refused(p, PATCH_TEST, halves + first + both, 'interface', 'Dirichlet')


def dense_coupling(p):
    """One nonmortar face over thousands of mortar nodes: every node of it would couple all of them with each other."""
    coarse = ['Body upper/Divisions=1, 1, 1', 'Body lower/Divisions=44, 44, 1', 'Refinement/Global cycles=0', 'Solver/Compare linear multigrid=false']
    refused(p, PATCH_TEST, coarse + ['Pair interface/Nonmortar=first'], 'Pair interface', '"upper: bottom" is much coarser', '"lower: top"',
            'one node faces 2025 nodes', 'Refinement/Regions', 'Pair/Nonmortar')
    # The cure.
    s = p.solve(PATCH_TEST, *coarse, 'Pair interface/Nonmortar=second')
    constant_pressure(s, 5.)
    certificate(s)


def write_blocks(path, blocks, n=4, joined=False):
    """A gmsh file of blocks (low, high, name) of 2 x n x 2 cells, each with the boundaries "bottom NAME" and "top NAME"."""
    points, lines, names = {}, [], []

    def node(block, q):
        return points.setdefault((0 if joined else block, *(round(x, 12) for x in q)), len(points) + 1)
    for b, (low, high, name) in enumerate(blocks):
        def corner(i, j, k):
            return node(b, [low[0] + (high[0] - low[0]) * i / 2, low[1] + (high[1] - low[1]) * j / n, low[2] + (high[2] - low[2]) * k / 2])

        def around(i, j, k):
            return [corner(i, j, k), corner(i + 1, j, k), corner(i + 1, j + 1, k), corner(i, j + 1, k)]
        names += [f'2 {2 * b + 1} "bottom {name}"', f'2 {2 * b + 2} "top {name}"']
        for j in range(n):
            for i in range(2):
                lines += [' '.join(map(str, [5, 2, 99, 99] + around(i, j, k) + around(i, j, k + 1))) for k in range(2)]
                lines += [' '.join(map(str, [3, 2, 2 * b + 1 + top, 2 * b + 1 + top] + around(i, j, 2 * top))) for top in range(2)]
    with open(path, 'w') as f:
        f.write(f'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(names) + 1}\n3 99 "all"\n' + '\n'.join(names) + '\n$EndPhysicalNames\n')
        f.write(f'$Nodes\n{len(points)}\n' + ''.join(f'{i} {q[1]!r} {q[2]!r} {q[3]!r}\n' for q, i in points.items()) + '$EndNodes\n')
        f.write(f'$Elements\n{len(lines)}\n' + ''.join(f'{i + 1} {line}\n' for i, line in enumerate(lines)) + '$EndElements\n')


def overlaps(p):
    """An overlap of the order of a body is no interference fit."""
    refused(p, PATCH_TEST, ['Body upper/Translation=0, 0, -0.8'], 'interface', 'overlap by 0.8', 'Translation')
    refused(p, PATCH_TEST, ['Pair interface/Initial gap=-0.9'], 'interface', 'Initial gap')
    refused(p, 'obstacle/paraboloid.prm', ['Pair bottom/Obstacle=plane: (0, 0, 0.7), (0, 0, 1)'], 'bottom', 'obstacle')
    held = 'Body upper/Dirichlet=left: (0, *, *); front: (*, 0, *); top: (*, *, 0)'
    # More than a percent has to be asked for, less is taken for a fit.
    refused(p, PATCH_TEST, ['Body upper/Translation=0, 0, -0.05', held], 'interface', 'overlap by 0.05', 'most at (', '"Initial penetration = resolve"')
    s = p.solve(PATCH_TEST, 'Body upper/Translation=0, 0, -0.05', held, 'Pair interface/Initial penetration=resolve')
    constant_pressure(s, 25.)
    s = p.solve(PATCH_TEST, 'Body upper/Translation=0, 0, -0.005', held)
    constant_pressure(s, 2.5)
    check(any('resolved as an interference fit' in note for note in s['notes']), f'notes: {s["notes"]}')
    refused(p, PATCH_TEST, ['Body upper/Translation=0, 0, -0.005', held, 'Pair interface/Initial penetration=refuse'], '"Initial penetration = refuse"')


def parts(p):
    """Bodies of several parts that do not touch each other: each part is held by conditions, by contact, or by nothing."""
    with tempfile.TemporaryDirectory() as folder:
        both, one, other = (os.path.join(folder, name + '.msh') for name in ('both', 'one', 'other'))
        a, b = ((0, 0, 0), (.375, 1, 1), 'a'), ((.625, 0, 0), (1, 1, 1), 'b')
        write_blocks(both, [a, b])
        write_blocks(one, [a])
        write_blocks(other, [b])
        held, pushed = 'Dirichlet=top a: (0, 0, -0.01)', 'Pressures=top b: 5'
        common = ['Refinement/Global cycles=1', 'Solver/Compare linear multigrid=false']
        # Tops and bottoms that belong together have one name in pairs of their own.
        pairs = ['Pair interface/First=upper: bottom a', 'Contact pairs=interface, beside', 'Pair beside/Second=lower: top']
        s = p.solve(PATCH_TEST, f'Body upper/Mesh={both}', f'Body upper/{held}', f'Body upper/{pushed}', 'Pair beside/First=upper: bottom b',
                    *pairs, *common)
        t = p.solve(PATCH_TEST, 'Bodies=upper, lower, third', f'Body upper/Mesh={one}', f'Body upper/{held}', f'Body third/Mesh={other}',
                    f'Body third/{pushed}', 'Body third/Young modulus=1000', 'Pair beside/First=third: bottom b', *pairs, *common)
        check(any('its part around (0.8125, 0.5, 0.5)' in note and 'contact must' in note for note in s['notes']), f'notes: {s["notes"]}')
        for name, force in (('interface', None), ('beside', 1.875)):
            one_body, two = (next(q['force'][2] for q in r['pairs'] if q['name'] == name) for r in (s, t))
            near(one_body, two, 1e-8, f'force of {name}')
            if force:
                near(abs(one_body), force, 1e-8, f'force of {name}')
        # Nothing holds the second part; or nothing could, because the load lifts it.
        single = [f'Body upper/Mesh={both}', f'Body upper/{held}', 'Pair interface/First=upper: bottom a']
        refused(p, PATCH_TEST, single, 'Body upper/Dirichlet', '(0.8125, 0.5, 0.5)', 'pair')
        refused(p, PATCH_TEST, [f'Body upper/Mesh={both}', f'Body upper/{held}', 'Body upper/Pressures=top b: -5', 'Pair beside/First=upper: bottom b',
                                *pairs], '(0.8125, 0.5, 0.5)', 'fly away')
        # Parts on both kinds of cells, and tied.
        s = p.solve(PATCH_TEST, f'Body upper/Mesh={both}', f'Body upper/{held}', f'Body upper/{pushed}', 'Pair beside/First=upper: bottom b',
                    'Body upper/Convert to tetrahedra=true', 'Pair beside/Contact=tied', *pairs, *common)
        near(abs(next(q['force'][2] for q in s['pairs'] if q['name'] == 'beside')), 1.875, 1e-8, 'tied force')
