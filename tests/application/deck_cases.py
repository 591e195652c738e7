"""Decks of Abaqus and CalculiX: what is computed, refused and written."""
import csv
import itertools
import json
import math
import os
import shutil
import subprocess
import tempfile

from decks import EDGES, HEX, INTERACTION, KINDS, LOAD, MATERIAL, PARTS, SIDES, Block, nset, surface, two_blocks
from free_body_cases import CLIP, write_clip
from harness import certificate, check, constant_pressure, near


def read_frd(path):
    """Nodes, elements and fields of a result file of CalculiX, by its columns."""
    nodes, elements, fields, mode, name = {}, {}, {}, '', ''
    with open(path) as f:
        for line in f:
            line = line.rstrip('\n')
            if line.startswith('    2C'):
                mode = 'nodes'
            elif line.startswith('    3C'):
                mode = 'elements'
            elif line.startswith(' -4'):
                mode, name = 'field', line.split()[1]
                fields[name] = {}
            elif line.startswith(' -1') and mode == 'elements':
                label = int(line[3:13])
                elements[label] = (int(line[13:18]), [])
            elif line.startswith(' -2') and mode == 'elements':
                elements[label][1].extend(int(line[i:i + 10]) for i in range(3, len(line), 10))
            elif line.startswith(' -1'):
                values = [float(line[i:i + 12]) for i in range(13, len(line), 12)]
                (nodes if mode == 'nodes' else fields[name])[int(line[3:13])] = values
    return nodes, elements, fields


class Decks:
    """Writes decks into a folder and runs them."""

    def __init__(self, p, folder):
        self.p, self.folder, self.n = p, folder, 0

    def path(self, name, text, **how):
        path = os.path.join(self.folder, name)
        with open(path, 'w', **how) as f:
            f.write(text)
        return path

    def call(self, text, *arguments):
        self.n += 1
        out = os.path.join(self.folder, f'out{self.n}')
        return self.p.call(self.path(f'deck{self.n}.inp', text), '--output', out, *arguments), out

    def solve(self, text, *arguments, code=0):
        run, out = self.call(text, *arguments)
        if run.returncode != code:
            print(run.stdout, run.stderr)
            raise SystemExit(f'deck {self.n}: exit code {run.returncode}')
        with open(os.path.join(out, 'summary.json')) as f:
            return json.load(f), read_frd(os.path.join(out, 'results.frd'))

    def refuses(self, text, *words, arguments=()):
        run, out = self.call(text, *arguments)
        check(run.returncode == 1, f'{words}: exit code {run.returncode}')
        for word in words:
            check(word in run.stderr, f'"{word}" is not in: {run.stderr}')
        check(not os.path.exists(out), f'{words}: results are left')


def in_folder(case):
    def run(p):
        with tempfile.TemporaryDirectory() as folder:
            case(Decks(p, folder))
    return run


def exact(s, frd, blocks, pressure=5., energy=True):
    """Constant stress: sigma_zz = -p, u = p / E (nu x, nu y, -(z + 1))."""
    constant_pressure(s, pressure, 1e-8)
    certificate(s)
    if energy:
        near(s['certificate']['potential_energy'], -.5 * pressure * 2 * pressure / 1000, 1e-8, 'energy')
    nodes, elements, fields = frd
    for block in blocks:
        for label, (x, _) in block.nodes.items():
            for value, expected in zip(fields['DISP'][label], (.3 * x[0], .3 * x[1], -(x[2] + 1))):
                check(abs(value - expected * pressure / 1000) < 1e-7, f'displacement of node {label}: {fields["DISP"][label]}')
            check(abs(fields['STRESS'][label][2] + pressure) < 1e-4 * pressure, f'stress at node {label}: {fields["STRESS"][label]}')
        for label, element in block.elements.items():
            check(sorted(elements[label][1]) == sorted(element), f'element {label}: {elements[label]}')
    check(fields['CONTACT'] and set(fields['CONTACT']) <= set(nodes), f'nodes of CONTACT: {sorted(set(fields["CONTACT"]) - set(nodes))}')
    for label, value in fields['CONTACT'].items():
        check(abs(value[3] - pressure) < 1e-4 * pressure, f'pressure at node {label}: {value}')


@in_folder
def deck_elements(d):
    """Every kind of element: constant stress to the last digits."""
    for kind in ('C3D8', 'C3D8R', 'C3D8I', 'C3D20', 'C3D20R', 'C3D6', 'C3D15', 'C3D4', 'C3D10', 'C3D10M', 'C3D10T'):
        text, upper, lower = two_blocks(kind, (2, 2, 1), (3, 3, 1))
        exact(*d.solve(text), [upper, lower])
    text, upper, lower = two_blocks('C3D20', (2, 2, 1), (3, 3, 1), other='C3D10')
    exact(*d.solve(text), [upper, lower])
    # Wedges beside hexahedra in one body.
    text, upper, lower = two_blocks('C3D8', (2, 2, 1), (3, 3, 2))
    cut = ''
    for line in lower.text_elements('Lower').splitlines()[1:]:
        label, *n = [int(w) for w in line.split(',')]
        if (label - 1) // 2 % 2:
            cut += f'*ELEMENT, TYPE=C3D6, ELSET=Lower\n{label}, {n[0]}, {n[1]}, {n[2]}, {n[4]}, {n[5]}, {n[6]}\n'
            cut += f'{label + 5000}, {n[0]}, {n[2]}, {n[3]}, {n[4]}, {n[6]}, {n[7]}\n'
        else:
            cut += f'*ELEMENT, TYPE=C3D8, ELSET=Lower\n{line}\n'
    text = text.replace(lower.text_elements('Lower'), cut).replace(surface('SL', lower.sides(2, 0)), nset('NL', lower.plane(2, 0)) +
                                                                    '*SURFACE, NAME=SL, TYPE=NODE\nNL\n')
    lower.elements = {}
    exact(*d.solve(text), [upper, lower])


@in_folder
def deck_words(d):
    """The same problem in other words."""
    text, upper, lower = two_blocks('C3D8', (2, 2, 2), (3, 3, 3))
    blocks = [upper, lower]
    su, sl = surface('SU', upper.sides(2, 0)), surface('SL', lower.sides(2, 0))

    def same(changed, *arguments):
        check(changed != text, 'nothing was changed')
        exact(*d.solve(changed, *arguments), blocks)

    # Surfaces by sets of elements with sides, by sets of nodes, and all outer faces of some elements (the touching ones count).
    low = [e for e, _ in upper.sides(2, 0)]
    same(text.replace(su, f'*ELSET, ELSET=LOWEST\n{", ".join(str(e) for e in low)}\n*SURFACE, NAME=SU\nLOWEST, S1\n'))
    same(text.replace(su, nset('NU', upper.plane(2, 0)) + '*Surface, name=SU, type=NODE\nNU,\n'))
    # Shell faces.
    shells = '*ELEMENT, TYPE=S4, ELSET=SHELLS\n'
    for k, (e, s) in enumerate(upper.sides(2, 0)):
        n = upper.elements[e]
        shells += f'{9000 + k}, {n[0]}, {n[1]}, {n[2]}, {n[3]}\n'
    same(text.replace(su, shells + '*SURFACE, NAME=SU\nSHELLS, SPOS\n'))
    # Loads: by element sides, by nodes (a quarter, a half or all of a cell's share).
    load = '*DLOAD\n' + ''.join(f'{e}, P{s}, 5.\n' for e, s in upper.sides(2, 1))
    same(text.replace(LOAD.format(5.), load))
    tops = [e for e, _ in upper.sides(2, 1)]
    same(text.replace(LOAD.format(5.), f'*DLOAD\nHIGH, P2, 5.D0\n').replace('*MATERIAL', f'*ELSET, ELSET=HIGH\n{", ".join(map(str, tops))}\n*MATERIAL'))
    force = {}
    for e, s in upper.sides(2, 1):
        for v in (4, 5, 6, 7):
            n = upper.elements[e][v]
            force[n] = force.get(n, 0.) - 5. / 16
    same(text.replace(LOAD.format(5.), '*CLOAD\n' + ''.join(f'{n}, 3, {f}\n' for n, f in force.items())))
    same(text.replace(LOAD.format(5.), '*DSLOAD\nSTOP, TRVEC, 5., 0., 0., -1.\n'))
    # Conditions: names, single nodes, edges (overlapping sets), in the step, with amplitudes and several steps.
    same(text.replace('X0, 1, 1\nY0, 2, 2\nBOTTOM, 3, 3\n', 'X0, XSYMM\nY0, YSYMM\nBOTTOM, ZSYMM\n'))
    single = ''.join(f'{n}, 1\n' for n in upper.plane(0, 0) + lower.plane(0, 0))
    same(text.replace('X0, 1, 1\n', single))
    same(text.replace('*STEP\n*STATIC\n' + LOAD.format(5.), '*AMPLITUDE, NAME=ramp\n0., 0., 2., 1.\n*STEP\n*STATIC\n1., 1.\n' + LOAD.format(7.) +
                      '*END STEP\n*STEP\n*STATIC\n1., 1.\n*DSLOAD, OP=NEW, AMPLITUDE=ramp\nSTOP, P, 10.\n'))
    same(text.replace('*BOUNDARY\nX0', '*BOUNDARY\nTOP, 1, 3, 0.1\nX0').replace('*STATIC\n', '*STATIC\n*BOUNDARY, OP=NEW\nX0,1\nY0, 2, 2,\nBOTTOM, 3, 3, 0.\n'))
    # Lower case, blanks, Windows line ends, quotes, comments, GENERATE, sets of sets.
    strange = text.replace('*NSET, NSET=TOP\n', '** comment\n*Nset ,  nset = "my TOP" , internal\n').replace('*SOLID SECTION, ELSET=Upper', '*Solid Section , elset = "UPPER" ')
    low_labels = sorted(lower.elements)
    strange = strange.replace('*MATERIAL', f'*ELSET, ELSET=part, GENERATE\n{low_labels[0]}, {low_labels[4]}, 1\n*Elset, elset=ALLLOWER\nrest, PART\n*Elset, elset=rest, generate\n{low_labels[5]},{low_labels[-1]}\n*MATERIAL', 1)
    strange = strange.replace('ELSET=Lower, MATERIAL', 'ELSET=allLower ,\nMATERIAL')
    same('\r\n'.join(strange.split('\n')))
    # Files that are included.
    d.path('nodes.txt', upper.text_nodes())
    d.path('elements.txt', '\n'.join(lower.text_elements('Lower').split('\n')[1:]))
    same(text.replace(upper.text_nodes(), '*INCLUDE, INPUT=nodes.txt\n').replace(
        lower.text_elements('Lower'), '*ELEMENT, TYPE=C3D8, ELSET=Lower, INPUT=elements.txt\n'))
    # A set on the faces of a surface: both names are there.
    s, _ = d.solve(text.replace(LOAD.format(5.), '*BOUNDARY\nTOP, 3, 3, -0.01\n'))
    constant_pressure(s, 5., 1e-8)
    # TRANSFORM: axes in another order; all directions along oblique ones.
    same(text.replace('*BOUNDARY\nX0, 1, 1', '*TRANSFORM, NSET=X0\n0., 0., 1., 1., 0., 0.\n*BOUNDARY\nX0, 2, 2').replace('Y0, 2, 2\n', '').replace(
        'BOTTOM, 3, 3\n', '').replace('*STEP', nset('Y1', set(upper.plane(1, 0) + lower.plane(1, 0)) - set(upper.plane(0, 0) + lower.plane(0, 0))) +
                                      nset('YX', set(upper.plane(1, 0) + lower.plane(1, 0)) & set(upper.plane(0, 0) + lower.plane(0, 0))) +
                                      nset('BX', set(lower.plane(2, -1)) & set(lower.plane(0, 0))) + nset('B1', set(lower.plane(2, -1)) - set(lower.plane(0, 0))) +
                                      '*BOUNDARY\nY1, 2\nYX, 3\nBX, 1\nB1, 3\n*STEP', 1))


def turned(x, axis=(1, 2, 3), angle=25):
    """A point turned about an axis through the origin (degrees)."""
    a = [t / math.hypot(*axis) for t in axis]
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    along = sum(t * q for t, q in zip(a, x))
    return [c * x[i] + s * (a[i - 2] * x[i - 1] - a[i - 1] * x[i - 2]) + (1 - c) * along * a[i] for i in range(3)]


@in_folder
def deck_transform(d):
    """Rollers along the axes of TRANSFORM: the blocks turned by any angle; a ring with rollers along its radius and tangents."""
    for kind in ('C3D8', 'C3D10'):
        text, upper, lower = two_blocks(kind, (2, 2, 2), (3, 3, 2), move=turned)
        axes = ', '.join(f'{c:.16g}' for x in ((1, 0, 0), (0, 1, 0)) for c in turned(x))
        frame = nset('ALL', list(upper.nodes) + list(lower.nodes)) + f'*TRANSFORM, NSET=ALL, TYPE=R\n{axes}\n'
        force = ''.join(f'{n}, 3, -0.05\n' for n in upper.plane(2, 1))
        for refined in ([], ['--set', 'Refinement/Initial global levels=1']):
            s, _ = d.solve(text.replace('*BOUNDARY', frame + '*BOUNDARY'), *refined)
            constant_pressure(s, 5., 1e-8)
            certificate(s)
            near(s['certificate']['potential_energy'], -.025, 1e-8, 'energy')
        s, _ = d.solve(text.replace('*BOUNDARY', frame + '*BOUNDARY').replace(LOAD.format(5.), '*CLOAD\n' + force))
        near(s['pairs'][0]['load'], .05 * len(upper.plane(2, 1)), 1e-9, 'forces along the axes')
    # A quarter of a ring whose inner side is moved out by u and whose outer side is held: radial displacement a r + b / r.
    block = Block('C3D20', (1, 0, 0), (2, 90, 1), (12, 6, 1),
                  move=lambda x: [x[0] * math.cos(math.radians(x[1])), x[0] * math.sin(math.radians(x[1])), x[2]])
    text = block.text_nodes() + block.text_elements('RING') + nset('ALL', block.nodes) + nset('IN', block.plane(0, 1)) + nset('OUT', block.plane(0, 2))
    text += nset('ENDS', block.plane(1, 0) + block.plane(1, 90)) + nset('FLAT', block.plane(2, 0) + block.plane(2, 1))
    text += '*TRANSFORM, NSET=ALL, TYPE=C\n0., 0., -1., 0., 0., 5.\n' + MATERIAL + '*SOLID SECTION, ELSET=RING, MATERIAL=steel\n'
    text += '*STEP\n*STATIC\n*BOUNDARY\nIN, 1, 1, 0.01\nOUT, 1, 1\nENDS, 2, 2\nFLAT, 3, 3\n*END STEP\n'
    s, (nodes, _, fields) = d.solve(text)
    for label in block.plane(0, 1.5):
        x, u = nodes[label], fields['DISP'][label]
        r = math.hypot(x[0], x[1])
        near((u[0] * x[0] + u[1] * x[1]) / r, .01 / 3 * (4 / r - r), 5e-3, 'radial displacement')


@in_folder
def deck_refined(d):
    """Sets of nodes, forces at nodes and result files on refined meshes; the same on any number of ranks."""
    for kind in ('C3D8', 'C3D6'):
        text, upper, lower = two_blocks(kind, (2, 2, 2), (3, 3, 2))
        s, (nodes, elements, fields) = d.solve(text, '--set', 'Refinement/Global cycles=1', '--set', 'Refinement/Regions=ball: (0.4, 0.5, 0.3), 0.3, 1')
        constant_pressure(s, 5., 1e-8)
        certificate(s)
        near(s['certificate']['potential_energy'], -.025, 1e-8, 'energy')
        check(all(v in nodes for _, element in elements.values() for v in element), 'nodes of the elements')
        for block in (upper, lower):
            for label, (x, _) in block.nodes.items():
                check(max(abs(a - b) for a, b in zip(nodes[label], x)) < 1e-5, f'node {label}')
        for label, x in nodes.items():
            check(abs(fields['DISP'][label][2] + .005 * (x[2] + 1)) < 1e-7, f'node {label}: {fields["DISP"][label]}')
    # How a pair is treated is nothing that decks can say.
    text = two_blocks('C3D8', (2, 2, 2), (3, 3, 2))[0]
    first = d.solve(text)[0]
    pair = first['pairs'][0]
    sides = {}
    for side in ('first', 'second'):
        s = d.solve(text, '--set', f'Pair {pair["name"]}/Nonmortar={side}')[0]
        sides[side] = s['pairs'][0]['nonmortar']
        near(s['pairs'][0]['load'], pair['load'], 1e-8, f'{side}: force')
    check(sorted(sides.values()) == sorted([pair['nonmortar'], pair['mortar']]), f'{sides}')
    # An edge that is held, and forces at corners.
    text, upper, lower = two_blocks('C3D8', (1, 1, 1), (2, 2, 2), None)
    corners = ''.join(f'{n}, 3, -1.\n' for n in upper.plane(2, 1))
    edge = sorted(set(upper.plane(2, 1)) & set(upper.plane(0, 0)))
    text = text.replace('*STEP', nset('EDGE', edge) + '*STEP', 1).replace('*STATIC\n', f'*STATIC\n*CLOAD\n{corners}*BOUNDARY\nEDGE, 1, 1, 0.001\n')
    s, (nodes, _, fields) = d.solve(text, '--set', 'Refinement/Initial global levels=2')
    near(s['pairs'][0]['load'], 4., 1e-9, 'forces at corners')
    certificate(s)
    on_edge = [label for label, x in nodes.items() if x[0] == 0 and x[2] == 1]
    check(len(on_edge) == 5, f'nodes on the edge: {on_edge}')
    for label in on_edge:
        near(fields['DISP'][label][0], .001, 1e-5, 'held edge')


@in_folder
def deck_sets_between(d):
    """New nodes between sets that hold the same: an end in two halves, axes of TRANSFORM that are those of space, values node by node. Not the sides of
    a layer that is held on both of its faces."""
    text, upper, lower = two_blocks('C3D8', (2, 2, 2), (3, 3, 2))
    halves = [[n for n in lower.plane(2, -1) if (lower.nodes[n][0][0] < .5) == left] for left in (True, False)]
    in_halves = text.replace('BOTTOM, 3, 3', 'LEFT, 3, 3\nRIGHT, 3, 3').replace('*BOUNDARY', nset('LEFT', halves[0]) + nset('RIGHT', halves[1]) + '*BOUNDARY', 1)
    same_axes = text.replace('*BOUNDARY', '*TRANSFORM, NSET=X0\n1., 0., 0., 0., 1., 0.\n*BOUNDARY', 1)
    back = [n for block in (upper, lower) for n in block.plane(1, 1) if block.nodes[n][0][0] > 0]
    around = text.replace('*BOUNDARY', nset('BACK', back) + '*TRANSFORM, NSET=BACK, TYPE=C\n0.3, 0.7, 0., 0.3, 0.7, 1.\n*BOUNDARY', 1)
    by_node = text.replace(LOAD.format(5.), '*BOUNDARY\n' + ''.join(f'{n}, 3, 3, -0.01\n' for n in upper.plane(2, 1)))
    for name, deck in (('halves', in_halves), ('axes', same_axes), ('cylinder', around), ('nodes', by_node)):
        check(deck != text, name)
        s, (nodes, _, fields) = d.solve(deck, '--set', 'Refinement/Initial global levels=1')
        constant_pressure(s, 5., 1e-8)
        low = max(abs(fields['DISP'][label][2]) for label, x in nodes.items() if x[2] == -1)
        check(low <= 1e-12, f'{name}: the bottom moves by {low}')
    # Each set carries what it holds.
    s, _ = d.solve(in_halves)
    near(sum(b['reaction'][2] for b in s['boundaries'] if b['name'] in ('LEFT', 'RIGHT')), 5., 1e-8, 'reaction of both halves')
    check(not any(' and ' in b['name'] for b in s['boundaries']), f'there are no nodes between the halves: {s["boundaries"]}')
    s, _ = d.solve(in_halves, '--set', 'Refinement/Initial global levels=1')
    between = [b['reaction'][2] for b in s['boundaries'] if ' and ' in b['name']]
    check(len(between) == 1 and between[0] > 0, f'nodes between the halves: {s["boundaries"]}')
    near(between[0] + sum(b['reaction'][2] for b in s['boundaries'] if b['name'] in ('LEFT', 'RIGHT')), 5., 1e-8, 'reaction of halves and what is between')
    text, upper, lower = two_blocks('C3D8', (2, 2, 1), (2, 2, 1))
    layer = text.replace('*BOUNDARY', nset('FOOT', upper.plane(2, 0)) + '*BOUNDARY\nTOP, 1, 1\nFOOT, 1, 1\n*BOUNDARY', 1)
    one = [n for n in upper.plane(0, 1) if upper.nodes[n][0][1] <= .5]
    with_one = layer.replace('*BOUNDARY', nset('ONE', one) + '*BOUNDARY\nONE, 1, 1\n*BOUNDARY', 1)
    for deck, free in ((layer, 0.), (with_one, .6)):
        _, (nodes, _, fields) = d.solve(deck, '--set', 'Refinement/Initial global levels=1')
        check(all(fields['DISP'][label][0] > 1e-4 for label, x in nodes.items() if x[0] == 1 and x[2] == .5 and x[1] >= free), 'the side of the layer is held')


@in_folder
def deck_parts(d):
    """PART and INSTANCE: the upper block is the lower one, turned and moved."""
    block = Block('C3D8', (0, 0, 0), (1, 1, 1), (2, 2, 2))
    side = [e for e, _ in block.sides(0, 0)]
    part = ('*HEADING\n** Job name: two Model name: Model-1\n*Part, name=Cube\n' + block.text_nodes() + block.text_elements('Set-1') +
            nset('X1', block.plane(0, 1)) + nset('X0', block.plane(0, 0)) + nset('Y0', block.plane(1, 0)) + nset('Z0', block.plane(2, 0)) +
            f'*Elset, elset=_S0_S6, internal\n{", ".join(map(str, side))}\n' +
            '** Section: Section-1\n*Solid Section, elset=Set-1, material=steel\n,\n*End Part\n**\n** ASSEMBLY\n*Assembly, name=Assembly\n')
    # Upper: as it is, its plane z = 0 down. Lower: turned about the y axis by 90 degrees such that x becomes -z.
    part += ('*Instance, name=Cube-1, part=Cube\n*End Instance\n'
             '*Instance, name=Cube-2, part=Cube\n 0., 0., 0.\n 0., 0., 0., 0., 1., 0., 90.\n*End Instance\n')
    sides = ''.join(f'Cube-1.{e}, S{s}\n' for e, s in block.sides(2, 0))
    part += ('*Node\n1, 5., 5., 5.\n*Nset, nset=RP\n1,\n'
             f'*Elset, elset=_top_S2, internal, instance=Cube-1\n{", ".join(str(e) for e, _ in block.sides(2, 1))}\n'
             '*Surface, type=ELEMENT, name=TOP\n_top_S2, S2\n*Surface, name=Down\n' + sides + '*Surface, type=ELEMENT, name=Up\nCube-2._S0_S6, S6\n*End Assembly\n')
    part += MATERIAL + INTERACTION + '*Contact Pair, interaction=hard, small sliding\nDown, Up\n'
    history = ('*Boundary\nCube-1.X0, XSYMM\nCube-1.Y0, 2, 2\nCube-2.Z0, 1, 1\nCube-2.Y0, 2, 2\nCube-2.X1, 3, 3\n'
               '*Step, name=Step-1, nlgeom=YES\n*Static\n1., 1., 1e-05, 1.\n*Dsload\nTOP, P, 5.\n*Restart, write, frequency=0\n'
               '*Output, field, variable=PRESELECT\n*End Step\n')
    s, (nodes, elements, fields) = d.solve(part + history)
    constant_pressure(s, 5., 1e-8)
    certificate(s)
    check([b['body'] for b in s['boundaries']].count('Cube-2') == 3, f'bodies: {s["boundaries"]}')
    check(any('NLGEOM: cells rotate' in note for note in s['notes']), f'notes: {s["notes"]}')
    check(any('passed over: OUTPUT, RESTART' in note for note in s['notes']), f'notes: {s["notes"]}')
    check(len(nodes) == 2 * len(block.nodes) and len(elements) == 2 * len(block.elements), 'nodes of both instances')
    d.refuses(part + history, 'NLGEOM', '--strict', arguments=['--strict'])
    # A condition of the part holds in each instance: two punches on a floor.
    floor = Block('C3D8', (-1, -1, -1), (7, 2, 0), (4, 2, 1))
    punch = '*PART, NAME=Punch\n' + block.text_nodes() + block.text_elements('ALL')
    for name, plane in (('X0', (0, 0)), ('Y0', (1, 0)), ('TOP', (2, 1))):
        punch += nset(name, block.plane(*plane))
    punch += surface('BOT', block.sides(2, 0)) + '*SOLID SECTION, ELSET=ALL, MATERIAL=steel\n*BOUNDARY\nTOP, 3, 3, -0.01\n*END PART\n'
    base = ('*PART, NAME=Floor\n' + floor.text_nodes() + floor.text_elements('ALL') + nset('LOW', floor.plane(2, -1)) + surface('UP', floor.sides(2, 0)) +
            '*SOLID SECTION, ELSET=ALL, MATERIAL=steel\n*BOUNDARY\nLOW, 1, 3\n*END PART\n')
    assembly = ('*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Left, PART=Punch\n*END INSTANCE\n*INSTANCE, NAME=Right, PART=Punch\n5., 0., 0.\n*END INSTANCE\n'
                '*INSTANCE, NAME=Base, PART=Floor\n*END INSTANCE\n*END ASSEMBLY\n')
    s, _ = d.solve('*HEADING\nPunches\n' + punch + base + assembly + MATERIAL + INTERACTION +
                   '*CONTACT PAIR, INTERACTION=hard\nLeft.BOT, Base.UP\nRight.BOT, Base.UP\n*BOUNDARY\nLeft.X0, 1\nRight.X0, 1\nLeft.Y0, 2\nRight.Y0, 2\n*STEP\n*STATIC\n*END STEP\n')
    left, right = (pair['load'] for pair in s['pairs'])
    check(left > 8., f'force of the left punch {left}')
    near(right, left, .01, 'force of the right punch')


@in_folder
def deck_ties(d):
    """Two blocks glued together are one bar under tension."""
    text, upper, lower = two_blocks('C3D8', (2, 2, 2), (3, 3, 3), -5.)
    for tie in ('*TIE, NAME=glue\nSU, SL\n', '*CONTACT PAIR, INTERACTION=hard, TIED\nSU, SL\n'):
        s, (_, _, fields) = d.solve(text.replace('*CONTACT PAIR, INTERACTION=hard, TYPE=SURFACE TO SURFACE\nSU, SL\n', tie))
        near(s['cycles'][-1]['energy'], -.025, 1e-8, 'energy')
        near(fields['DISP'][upper.plane(2, 1)[0]][2], .01, 1e-5, 'displacement')
    # A C whose lips are glued to each other across the slit, on a floor that alone should hold it.
    heights, node = (0, 1, 1.3, 2.3), lambda i, j, k: 1 + i + 5 * (j + 2 * k)
    deck = '*HEADING\nC\n*NODE\n' + ''.join(f'{node(i, j, k)}, {i}., {j}., {heights[k]}\n' for k in range(4) for j in range(2) for i in range(5))
    deck += '*ELEMENT, TYPE=C3D8, ELSET=C\n'
    sides = {'Low': [], 'Up': [], 'Bottom': [], 'Top': []}
    cells = [(i, k) for k in range(3) for i in range(4) if k != 1 or i == 0]
    for e, (i, k) in enumerate(cells, 1):
        deck += f'{e}, ' + ', '.join(str(node(i + a, b, k + c)) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))) + '\n'
        if k != 1:
            sides['Bottom' if k == 0 else 'Top'].append((e, 1 if k == 0 else 2))
            if i > 0:
                sides['Low' if k == 0 else 'Up'].append((e, 2 if k == 0 else 1))
    floor = Block('C3D8', (-1, -1, -1), (5, 2, 0), (6, 3, 1), 10000, 10000)
    deck += floor.text_nodes() + floor.text_elements('Floor') + nset('HELD', floor.plane(2, -1)) + surface('FTOP', floor.sides(2, 0))
    deck += ''.join(surface(name, of_name) for name, of_name in sides.items())
    deck += MATERIAL + '*SOLID SECTION, ELSET=C, MATERIAL=steel\n*SOLID SECTION, ELSET=Floor, MATERIAL=steel\n' + INTERACTION
    deck += '*CONTACT PAIR, INTERACTION=hard\nBottom, FTOP\n*TIE, NAME=lips\nUp, Low\n*BOUNDARY\nHELD, 1, 3\n*STEP\n*STATIC\n*DSLOAD\nTop, P, 1.\n*END STEP\n'
    d.refuses(deck, 'body C (tied to itself)', 'the tied surfaces are apart')


@in_folder
def deck_steps(d):
    """Steps of a deck are load steps: the force follows pressures, forces, displacements and amplitudes."""
    text, upper, lower = two_blocks('C3D8', (2, 2, 2), (3, 3, 2), None)
    amplitude = '*AMPLITUDE, NAME=wave\n0., 0., 1., 2., 2., 0.5\n'
    head, tail = text.replace('*STEP', amplitude + '*STEP', 1).split('*STATIC\n')
    steps = ('*STATIC\n' + LOAD.format(5.) + '*END STEP\n*STEP\n*STATIC\n1., 1.\n*DSLOAD, AMPLITUDE=wave\nSTOP, P, 5.\n*END STEP\n*STEP\n*STATIC\n' +
             f'*CLOAD\n{upper.plane(2, 1)[0]}, 3, -1.\n*END STEP\n*STEP\n*STATIC\n*DSLOAD, OP=NEW\n')

    def loads():
        path = os.path.join(d.folder, f'out{d.n}', 'curve.csv')
        if not os.path.exists(path):
            return []
        with open(path) as f:
            return [float(row['SU-SL: load']) for row in csv.DictReader(f)]

    s, _ = d.solve(head + steps + tail)
    check(len(loads()) == 4, f'steps: {loads()}')
    for force, expected in zip(loads(), (5, 10, 11, 1)):
        near(force, expected, 1e-9, 'load of a step')
    near(s['pairs'][0]['load'], 1, 1e-9, 'last load')
    # A load of a later step replaces that of the same kind alone: P 5 and TRVEC stay beside BX, BX does not end BZ.
    both = '*STATIC\n*DSLOAD\nSTOP, P, 5.\nSTOP, TRVEC, 1., 0., 0., -1.\n*DLOAD\nUpper, BZ, -2.\nUpper, BX, 1.\n*END STEP\n*STEP\n*STATIC\n'
    s, _ = d.solve(head + both + '*DSLOAD\nSTOP, P, 6.\n*DLOAD\nUpper, BX, 0.5\n*END STEP\n')
    for force, expected in zip(loads(), (8, 9)):
        near(force, expected, 1e-9, 'load beside others')
    check(len(loads()) == 2, f'steps: {loads()}')
    # By displacement; other directions than in the last step: that alone.
    push = head + '*STATIC\n*BOUNDARY\nTOP, 3, 3, -0.01\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY\nTOP, 3, 3, {}\n' + tail
    s, _ = d.solve(push.format(-.02))
    check(len(loads()) == 2, f'steps: {loads()}')
    for force, expected in zip(loads(), (5, 10)):
        near(force, expected, 1e-8, 'load of a displacement')
    other = push.format(-.02).replace('*BOUNDARY\nTOP, 3, 3, -0.02\n', '*BOUNDARY\nTOP, 3, 3, -0.02\nTOP, 1, 1\n')
    s, _ = d.solve(other)
    check(not loads(), 'steps that hold other directions')
    check(any('of 2 steps the last one' in note for note in s['notes']), f'notes: {s["notes"]}')


@in_folder
def deck_rigid(d):
    """A stamp: RIGID BODY, couplings, and equations that make nodes move alike."""
    text, upper, lower = two_blocks('C3D8', (2, 2, 2), (3, 3, 2), None)
    text = text.replace('1000., 0.3', '1000., 0.').replace('*STEP', '*NODE\n900, 0.4, 0.5, 2.\n901, 0., 0., 3.\n*STEP', 1)
    top = upper.plane(2, 1)
    equations = '*EQUATION\n' + ''.join(f'2\n{n}, {c}, 1., 900, {c}, -1.\n' for n in top for c in (1, 2, 3))
    upright = ''.join(f'2\n{n}, 3, 1., {top[0]}, 3, -1.\n' for n in top[1:])
    push, held = '*CLOAD\n900, 3, -5.\n', '*BOUNDARY\n900, 4, 6\n'
    for words, load in (('*RIGID BODY, NSET=TOP, REF NODE=900\n', push + held), ('*RIGID BODY, NSET=TOP, REF NODE=900, ROT NODE=901\n', push + '*BOUNDARY\n901, 1, 3\n'),
                        ('*KINEMATIC COUPLING, REF NODE=900\nTOP, 1, 3\n', push + held), ('*COUPLING, CONSTRAINT NAME=c, REF NODE=900, SURFACE=STOP\n*KINEMATIC\n', push + held),
                        (equations, push), ('*EQUATION\n' + upright, f'*CLOAD\n{top[0]}, 3, -5.\n')):
        s, (_, _, fields) = d.solve(text.replace('*STEP', words + '*STEP', 1).replace('*STATIC\n', '*STATIC\n' + load))
        constant_pressure(s, 5., 1e-8)
        near(s['pairs'][0]['load'], 5., 1e-10, 'load')
        near(fields['DISP'][top[0]][2], -.01, 1e-5, 'displacement of the stamp')
    check(any('EQUATION: nodes that move alike' in note for note in s['notes']), f'notes: {s["notes"]}')
    # By a displacement of the reference node, and an eccentric force that may turn the stamp.
    s, _ = d.solve(text.replace('*STEP', '*RIGID BODY, NSET=TOP, REF NODE=900\n*STEP', 1).replace('*STATIC\n', '*STATIC\n*BOUNDARY\n900, 3, 3, -0.01\n900, 4, 6\n'))
    constant_pressure(s, 5., 1e-8)
    free = text.replace('X0, 1, 1\nY0, 2, 2\n', 'XL, 1, 1\nYL, 2, 2\n').replace('*BOUNDARY', nset('XL', lower.plane(0, 0)) + nset('YL', lower.plane(1, 0)) + '*BOUNDARY', 1)
    for moment, x in (('', .4), ('900, 5, -0.25\n', .35)):
        s, _ = d.solve(free.replace('*STEP', '*RIGID BODY, NSET=TOP, REF NODE=900\n*STEP', 1).replace(
            '*STATIC\n', '*STATIC\n' + push + moment + '*BOUNDARY\n900, 1, 2\n900, 6, 6\n'))
        near(s['pairs'][0]['load'], 5., 1e-10, 'load')
        near(s['pairs'][0]['moment'][0], 5 * .5, 1e-8, 'moment about x')
        near(s['pairs'][0]['moment'][1], -5 * x, 1e-8, 'moment about y')


@in_folder
def deck_adjust(d):
    """Dependent nodes with a gap, or an overlap, are moved onto the other surface without strain."""
    for gap, moved in ((.003, True), (-.003, True), (.02, False)):
        upper = Block('C3D20', (0, 0, gap), (1, 1, 1), (2, 2, 2))
        text, _, lower = two_blocks('C3D20', (2, 2, 2), (3, 3, 2))
        text = text.replace(two_blocks('C3D20', (2, 2, 2), (3, 3, 2))[1].text_nodes(), upper.text_nodes())
        for adjust in ('ADJUST=0.01', 'ADJUST=NADJUST') if moved else ('ADJUST=0.01',):
            changed = text.replace('TO SURFACE\n', f'TO SURFACE, {adjust}\n').replace('*STEP', nset('NADJUST', upper.plane(2, gap)) + '*STEP', 1)
            s, (nodes, _, _) = d.solve(changed)
            constant_pressure(s, 5., 1e-8)
            check(any('ADJUST: 25 nodes' in note for note in s['notes']) == moved, f'notes: {s["notes"]}')
            # The free way down is part of the energy where nothing was moved.
            near(s['certificate']['potential_energy'], -.025 if moved else -5 * gap - .5 * 25e-3 * (2 - gap), 1e-8, f'energy with {adjust}, gap {gap}')
            for n in upper.plane(2, gap):
                near(nodes[n][2] + 1, 1 if moved else 1 + gap, 1e-6, f'node {n}')


@in_folder
def deck_gravity(d):
    """The weight of the upper block rests on the lower one; also with two materials in a body."""
    text, upper, lower = two_blocks('C3D20', (2, 2, 2), (3, 3, 1), None)
    text = text.replace('1000., 0.3\n', '1000., 0.3\n*DENSITY\n2.\n').replace('*STATIC\n', '*STATIC\n*DLOAD\nUpper, GRAV, 3., 0., 0., -1.\n')
    s, _ = d.solve(text)
    near(s['pairs'][0]['load'], 6., 1e-9, 'weight')
    certificate(s)
    heavy = text.replace('*INTERACTION', '').replace('*STEP', '*MATERIAL, NAME=lead\n*ELASTIC\n1000., 0.3\n*DENSITY\n4.\n*ELSET, ELSET=half\n'
                                                     f'{", ".join(str(e) for e, _ in upper.sides(2, 1))}\n*SOLID SECTION, ELSET=half, MATERIAL=lead\n*STEP', 1)
    s, _ = d.solve(heavy)
    near(s['pairs'][0]['load'], 9., 1e-9, 'weight of two materials')
    # A force on mid nodes keeps its size.
    mid = upper.elements[1][12]
    s, _ = d.solve(two_blocks('C3D20', (2, 2, 2), (3, 3, 1), 5.)[0].replace('*STATIC\n', f'*STATIC\n*CLOAD\n{mid}, 3, -1.\n'))
    near(s['pairs'][0]['load'], 6., 1e-9, 'force on a mid node')
    certificate(s)


@in_folder
def deck_refused(d):
    """What would change the result is refused, with file and line; --ignore passes over it."""
    text, upper, lower = two_blocks('C3D8', (1, 1, 1), (1, 1, 1))
    top = upper.plane(2, 1)

    def line_of(changed, keyword):
        return next(i + 1 for i, line in enumerate(changed.split('\n')) if line.startswith('*' + keyword))

    def refused(where, what, keyword, *words, ignorable=True):
        changed = text.replace(where, what)
        check(changed != text, f'{keyword}: nothing was changed')
        d.refuses(changed, keyword, '.inp, line ', *words)
        if ignorable:
            s, _ = d.solve(changed, '--ignore', keyword)
            constant_pressure(s, 5., 1e-8)
            check(any(keyword in note for note in s['notes']), f'{keyword} is not noted: {s["notes"]}')

    behind = '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n'
    refused(behind, behind + '*FRICTION\n0.1, 1e4\n', 'FRICTION', 'frictionless')
    # All at once.
    both = text.replace(behind, behind + '*FRICTION\n0.1, 1e4\n*GAP CONDUCTANCE\n1., 2.\n').replace('*STATIC', '*HEAT TRANSFER')
    d.refuses(both, 'FRICTION: contact is frictionless', '--ignore "FRICTION"', 'also has GAP CONDUCTANCE, HEAT TRANSFER', '--ignore "FRICTION,GAP CONDUCTANCE,HEAT TRANSFER"')
    d.solve(both, '--ignore', 'FRICTION,GAP CONDUCTANCE,HEAT TRANSFER')
    # The stiffness of what sticks to tied surfaces.
    s, _ = d.solve(text.replace(behind, behind.replace('HARD', 'TIED') + '*FRICTION\n0.1, 1e4\n'))
    check(any('FRICTION of tied surfaces' in note for note in s['notes']), f'tied: {s["notes"]}')
    # Nodes of elements.
    d.refuses(text.replace('BOTTOM, 3, 3', 'Lower, 3, 3'), 'there is no NSET "Lower"', '*NSET, NSET=Lower, ELSET=Lower')
    named = text.replace('*STEP', '*NSET, NSET=ALSO, ELSET=Upper\n*STEP').replace('*STATIC\n', '*STATIC\n*CLOAD\nALSO, 3, 0.\n')
    constant_pressure(d.solve(named)[0], 5., 1e-8)
    refused('1000., 0.3\n', '1000., 0.3\n*PLASTIC\n5., 0.\n', 'PLASTIC', 'elastic')
    refused('1000., 0.3\n', '1000., 0.3\n*CREEP, LAW=NORTON\n1e-10, 5., 0.\n', 'CREEP')
    equation = f'*EQUATION\n2\n{top[0]}, 1, 1., {top[1]}, 1, -1.\n*STEP'
    refused('*STEP', equation, 'EQUATION')
    refused('*STEP', f'*MPC\nPLANE, {top[0]}, {top[1]}\n*STEP', 'MPC')
    refused('*STEP', f'*RIGID BODY, ELSET=Upper, REF NODE={top[0]}\n*STEP', 'RIGID BODY')
    refused('*STEP', nset('EDGE', top[:2]) + f'*RIGID BODY, NSET=EDGE, REF NODE={top[0]}\n*STEP', 'RIGID BODY', 'whole faces')
    refused('*STEP', f'*EQUATION\n3\n{top[0]}, 1, 1., {top[1]}, 1, -1., {top[2]}, 1, 2.\n*STEP', 'EQUATION', 'alike')
    refused('*STEP', f'*KINEMATIC COUPLING, REF NODE={top[0]}\nTOP, 3, 3\n*STEP', 'KINEMATIC COUPLING', 'all directions')
    refused('*STEP', f'*PRE-TENSION SECTION, SURFACE=STOP, NODE={top[0]}\n0., 0., 1.\n*STEP', 'PRE-TENSION SECTION')
    refused('*STEP', '*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nSU, SL\n*STEP', 'MODEL CHANGE')
    refused('*STEP', '*CLEARANCE, MASTER=SL, SLAVE=SU, VALUE=0.1\n*STEP', 'CLEARANCE')
    refused('*STEP', '*UNHEARD OF\n1., 2.\n*STEP', 'UNHEARD OF', 'not known')
    refused('*STATIC\n', '*STATIC\n*DLOAD\nUpper, CENTRIF, 1., 0., 0., 0., 0., 0., 1.\n', 'DLOAD', 'CENTRIF', ignorable=False)
    refused('*STATIC\n', '*STATIC\n*CLOAD\n1, 4, 1.\n', 'CLOAD', ignorable=False)
    refused('*STATIC\n', '*STATIC\n*BOUNDARY\n1, 11, 11, 20.\n', 'BOUNDARY', 'directions', ignorable=False)
    refused('*STATIC\n', '*FREQUENCY\n10\n', 'FREQUENCY', 'STATIC')
    hot = text.replace('1000., 0.3\n', '1000., 0.3\n*EXPANSION\n1e-5\n').replace('*STATIC\n', '*STATIC\n*TEMPERATURE\nTOP, 100.\n')
    constant_pressure(d.solve(hot, '--ignore', 'EXPANSION')[0], 5., 1e-8)
    constant_pressure(d.solve(hot.replace('TOP, 100.', 'TOP, 0.'))[0], 5., 1e-8)
    # Mistakes.
    for where, what, words in [('*SOLID SECTION, ELSET=Upper, MATERIAL=steel\n', '', ['element 1 has no SOLID SECTION']),
                               ('MATERIAL=steel\n*SOLID', 'MATERIAL=gold\n*SOLID', ['no MATERIAL "gold"']),
                               ('*ELASTIC\n1000., 0.3\n', '', ['has no ELASTIC']), ('1000., 0.3', '1000., O.3', ['O.3']),
                               ('SU, SL\n', 'SU, nowhere\n', ['no SURFACE "nowhere"']), ('SU, SL\n', 'SU\n', ['two surfaces']),
                               ('BOTTOM, 3, 3', 'BOTTON, 3, 3', ['no NSET "BOTTON"']), ('*END STEP\n', '', ['END STEP']),
                               ('STOP, P', 'STOPP, P', ['no SURFACE "STOPP"']), ('INTERACTION=hard, TYPE', 'INTERACTION=soft, TYPE', ['no SURFACE INTERACTION "soft"']),
                               ('*STEP\n*STATIC\n' + LOAD.format(5.) + '*END STEP\n', '', ['no STEP']), ('*STATIC\n', '*STATIC\n*DLOAD\n1, P7, 5.\n', ['P7', 'P1 to P6']),
                               ('*STATIC\n', '*STATIC\n*DLOAD\nUpper, GRAV, 9.8, 0., 0., -1.\n', ['DENSITY', 'steel']),
                               ('*HEADING', '*INCLUDE, INPUT=gone.txt\n*HEADING', ['gone.txt', 'line 2']),
                               ('*STEP', '*TRANSFORM, NSET=TOP\n1., 1., 0., 2., 2., 0.\n*BOUNDARY\nTOP, 1, 1\n*STEP', ['parallel']),
                               ('TYPE=C3D8, ELSET=Upper', 'TYPE=C3D5, ELSET=Upper', ['C3D5', 'C3D10'])]:
        check(text.replace(where, what, 1) != text, f'{words}: nothing was changed')
        d.refuses(text.replace(where, what, 1), *words)
    # Every keyword that is refused says why, and how to pass over it.
    for word, keywords in (('elastic', ['PLASTIC', 'CYCLIC HARDENING', 'HYPERELASTIC', 'HYPERFOAM', 'CREEP', 'VISCOELASTIC', 'DEFORMATION PLASTICITY',
                                        'CONCRETE', 'DRUCKER PRAGER', 'MOHR COULOMB', 'USER MATERIAL', 'DEPVAR', 'RATE DEPENDENT']),
                           ('solid elements', ['SHELL SECTION', 'BEAM SECTION', 'MEMBRANE SECTION', 'BEAM GENERAL SECTION', 'SHELL GENERAL SECTION', 'SPRING',
                                               'DASHPOT', 'MASS', 'GAP', 'CONNECTOR SECTION']),
                           ('STATIC', ['DYNAMIC', 'FREQUENCY', 'BUCKLE', 'HEAT TRANSFER', 'COUPLED TEMPERATURE-DISPLACEMENT',
                                       'UNCOUPLED TEMPERATURE-DISPLACEMENT', 'VISCO', 'MODAL DYNAMIC', 'STEADY STATE DYNAMICS', 'COMPLEX FREQUENCY']),
                           ('nodes', ['MPC', 'DISTRIBUTING COUPLING', 'DISTRIBUTING']), ('pretension', ['PRE-TENSION SECTION']), ('cyclic', ['CYCLIC SYMMETRY MODEL']),
                           ('CONTACT PAIR', ['CONTACT']), ('are those of the nodes', ['CLEARANCE', 'CONTACT INTERFERENCE']), ('frictionless', ['CHANGE FRICTION']),
                           ('the same in all steps', ['CHANGE CONTACT TYPE', 'MODEL CHANGE']), ('heat', ['GAP CONDUCTANCE']), ('held', ['INERTIA RELIEF'])):
        for keyword in keywords:
            path = d.path('refused.inp', text.replace('*STEP', f'*{keyword}\n1., 2.\n*STEP'))
            line = line_of(text, 'STEP')
            run = d.p.call(path, '--check')
            expected = f'refused.inp, line {line}: {keyword}: '
            check(run.returncode == 1 and expected in run.stderr and word in run.stderr and f'--ignore "{keyword}"' in run.stderr,
                  f'{keyword}: {run.returncode}, {run.stderr}')
            run = d.p.call(path, '--check', '--ignore', keyword)
            check(run.returncode == 0 and f'{keyword} is passed over' in run.stdout, f'{keyword}: {run.returncode}, {run.stdout} {run.stderr}')
    # What is taken differently is said, or refused.
    soft = text.replace('OVERCLOSURE=HARD\n', 'OVERCLOSURE=LINEAR\n1e5, \n')
    s, _ = d.solve(soft)
    constant_pressure(s, 5., 1e-8)
    check(any('LINEAR is taken as hard contact' in note for note in s['notes']), f'notes: {s["notes"]}')
    d.refuses(soft, 'LINEAR', '--strict', arguments=['--strict'])
    # A large rotation under NLGEOM is no answer.
    large = text.replace('*STEP\n', '*STEP, NLGEOM\n').replace('1000., 0.3', '20., 0.3')
    d.solve(large, code=3)
    # --check says what was understood.
    run, out = d.call(soft, '--check')
    check(run.returncode == 0 and 'body Upper: 1 cells, E = 1000' in run.stdout, run.stdout + run.stderr)


def ccx_pressure(folder, name, text, nodes):
    """The reaction of some nodes in z, by CalculiX."""
    text = text.replace('*END STEP', nset('REACTION', nodes) + '*NODE PRINT, NSET=REACTION, TOTALS=ONLY\nRF\n*END STEP')
    # Sets belong before the steps.
    text = text.replace(nset('REACTION', nodes), '').replace('*STEP', nset('REACTION', nodes) + '*STEP', 1)
    with open(os.path.join(folder, name + '.inp'), 'w') as f:
        f.write(text)
    run = subprocess.run(['ccx', '-i', name], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=300)
    with open(os.path.join(folder, name + '.dat')) as f:
        lines = [line for line in f if line.strip()]
    check(len(lines) > 1, f'{name}: CalculiX says {run.stdout[-500:]}')
    return float(lines[-1].split()[2])


def quadratic_forces(block, direction, value, pressure):
    """Nodal forces of a pressure on triangles of six nodes as mesh programs spread it: a third at each mid node."""
    forces = {}
    for e, s in block.sides(direction, value):
        corners = [block.elements[e][v] for v in SIDES[4][s - 1]]
        a, b, c = (block.nodes[n][0] for n in corners)
        u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
        area = .5 * sum((u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2]) ** 2 for i in range(3)) ** .5
        for n in corners:
            forces.setdefault(n, 0.)
        for i in range(3):
            pair = tuple(SIDES[4][s - 1][k] for k in (i, (i + 1) % 3))
            k = next(k for k, edge in enumerate(EDGES[4]) if set(edge) == set(pair))
            mid = block.elements[e][4 + k]
            forces[mid] = forces.get(mid, 0.) - pressure * area / 3
    return forces


@in_folder
def deck_exporters(d):
    """Decks laid out as FreeCAD and PrePoMax write them: C3D10, sets by number, surfaces by element faces, loads by node."""
    upper, lower = Block('C3D10', (0, 0, 0), (1, 1, 1), (2, 2, 2)), Block('C3D10', (0, 0, -1), (1, 1, 0), (3, 3, 2), 500, 900)
    stars = '*' * 59 + '\n'

    def numbers(label, name, list):
        return f'*{label},{label}={name}\n' + ''.join(f'{n},\n' for n in list) + '\n'

    nodes = '*Node, NSET=Nall\n' + upper.text_nodes().split('\n', 1)[1] + lower.text_nodes().split('\n', 1)[1]
    elements = '*Element, TYPE=C3D10, ELSET=Evolumes\n' + upper.text_elements('').split('\n', 1)[1] + lower.text_elements('').split('\n', 1)[1]
    freecad = ('** written by FreeCAD inp file writer for CalculiX,Abaqus meshes\n** all mesh elements.\n\n** Nodes\n' + nodes + '\n\n** Volume elements\n' +
               elements + '\n\n** Define element set Eall\n*ELSET, ELSET=Eall\nEvolumes\n\n' + stars +
               '** Element sets for materials and FEM element type (solid, shell, beam, fluid)\n' +
               numbers('ELSET', 'MaterialSolidSolid', list(upper.elements) + list(lower.elements)) + stars + '** constraints\n')
    for name, direction in (('FixX', 0), ('FixY', 1)):
        freecad += numbers('NSET', name, upper.plane(direction, 0) + lower.plane(direction, 0))
    freecad += numbers('NSET', 'ConstraintFixed', lower.plane(2, -1)) + stars + '** Surfaces for contact constraint\n** ConstraintContact\n'
    freecad += '*SURFACE, NAME=DEP0\n' + ''.join(f'{e},S{s}\n' for e, s in upper.sides(2, 0))
    freecad += '*SURFACE, NAME=IND0\n' + ''.join(f'{e},S{s}\n' for e, s in lower.sides(2, 0))
    freecad += ('\n' + stars + '** Materials\n** see information about units at file end\n** FreeCAD material name: Steel\n** MaterialSolid\n'
                '*MATERIAL, NAME=MaterialSolid\n*ELASTIC\n1000,0.300\n*DENSITY\n7.900e-09\n\n' + stars + '** Sections\n'
                '*SOLID SECTION, ELSET=MaterialSolidSolid, MATERIAL=MaterialSolid\n\n' + stars + '** Contact Constraints\n** ConstraintContact\n'
                '*CONTACT PAIR, INTERACTION=INT0, TYPE=SURFACE TO SURFACE\nDEP0,IND0\n*SURFACE INTERACTION, NAME=INT0\n'
                '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1000000.0\n\n' + stars + '** At least one step is needed to run an CalculiX analysis of FreeCAD\n'
                '*STEP, INC=2000\n*STATIC\n\n\n' + stars + '** Fixed Constraints\n** ConstraintFixed\n*BOUNDARY\nConstraintFixed,3\n\nFixX,1\nFixY,2\n\n' +
                stars + '** Node loads Constraints\n** ConstraintForce\n*CLOAD\n** node loads on shape: Box:Face6\n' +
                ''.join(f'{n},3,{f:.13E}\n' for n, f in quadratic_forces(upper, 2, 1, 5.).items()) + '\n\n' + stars +
                '** Outputs --> frd file\n*NODE FILE\nU\n*EL FILE\nS, E\n** outputs --> dat file\n** reaction forces for Constraint fixed\n'
                '*NODE PRINT, NSET=ConstraintFixed, TOTALS=ONLY\nRF\n\n' + stars + '*OUTPUT, FREQUENCY=1\n' + stars + '*END STEP\n\n' + stars +
                '** CalculiX Input file\n** Units\n')
    s, (frd_nodes, frd_elements, fields) = d.solve(freecad)
    near(s['pairs'][0]['load'], 5., 1e-9, 'load')
    certificate(s)
    check(len(frd_nodes) == len(upper.nodes) + len(lower.nodes) and all(t == 6 for t, _ in frd_elements.values()), 'elements of the deck')
    # The way the forces are spread is felt near the top only.
    mean = [fields['DISP'][n][2] for n in upper.plane(2, 0)]
    near(sum(mean) / len(mean), -.005, .01, 'approach')

    prepomax = '**\n** Heading ++++\n**\n*Heading\nModel: Two parts,     Date: today\n**\n** Nodes ++++\n**\n' + upper.text_nodes() + lower.text_nodes()
    prepomax += '**\n** Elements ++++\n**\n' + upper.text_elements('Solid_part-1') + lower.text_elements('Solid_part-2')
    for name, direction in (('Internal_Selection-1_X', 0), ('Internal_Selection-1_Y', 1)):
        prepomax += nset(name, upper.plane(direction, 0) + lower.plane(direction, 0)).replace('*NSET, NSET', '*Nset, Nset')
    prepomax += nset('Internal_Selection-1_Fixed-1', lower.plane(2, -1)).replace('*NSET, NSET', '*Nset, Nset')
    for name, block, value in (('Slave', upper, 0), ('Master', lower, 0), ('Pressure', upper, 1)):
        sides = block.sides(2, value)
        for s in sorted({s for _, s in sides}):
            prepomax += f'*Elset, Elset=Internal_Selection-1_{name}_S{s}\n' + ',\n'.join(str(e) for e, t in sides if t == s) + '\n'
        prepomax += f'*Surface, Name={name}, Type=Element\n' + ''.join(f'Internal_Selection-1_{name}_S{s}, S{s}\n' for s in sorted({s for _, s in sides}))
    prepomax += ('**\n** Materials ++++\n**\n*Material, Name=S235\n*Density\n7.8E-09\n*Elastic\n1000, 0.3, 0\n**\n*Solid section, Elset=Solid_part-1, Material=S235\n'
                 '*Solid section, Elset=Solid_part-2, Material=S235\n**\n*Surface interaction, Name=Surface_interaction-1\n'
                 '*Surface behavior, Pressure-overclosure=Hard\n**\n*Contact pair, Interaction=Surface_interaction-1, Type=Surface to surface\nSlave, Master\n'
                 '**\n*Step, Inc=100\n*Static\n1, 1, 1E-05, 1E+30\n**\n*Output, Frequency=1\n**\n*Boundary, op=New\n** Name: Fixed-1\n*Boundary\n'
                 'Internal_Selection-1_X, 1, 1, 0\nInternal_Selection-1_Y, 2, 2, 0\nInternal_Selection-1_Fixed-1, 3, 6, 0\n**\n*Cload, op=New\n*Dload, op=New\n'
                 '** Name: Pressure-1\n*Dload\n' + ''.join(f'Internal_Selection-1_Pressure_S{s}, P{s}, 5\n' for s in sorted({s for _, s in upper.sides(2, 1)})) +
                 '**\n*Node file\nRF, U\n*El file\nS, E, NOE\n*Contact file\nCDIS, CSTR\n**\n*End step\n')
    exact(*d.solve(prepomax), [upper, lower])


@in_folder
def deck_calculix(d):
    """The same decks by CalculiX, where it is installed: forces within two percent."""
    if shutil.which('ccx') is None:
        print('ccx is not installed')
        return
    penalty = INTERACTION.replace('OVERCLOSURE=HARD\n', 'OVERCLOSURE=LINEAR\n1e7,\n')
    for kind, n_upper, n_lower in (('C3D8', (4, 4, 4), (5, 5, 4)), ('C3D8I', (4, 4, 4), (5, 5, 4)), ('C3D20', (2, 2, 2), (3, 3, 2)),
                                   ('C3D20R', (2, 2, 2), (3, 3, 2)), ('C3D10', (3, 3, 3), (4, 4, 4)), ('C3D6', (6, 6, 6), (7, 7, 6))):
        # The upper block is narrower, the top is pushed down.
        upper = Block(kind, (0, 0, 0), (.5, .5, .5), n_upper)
        lower = Block(kind, (0, 0, -1), (1, 1, 0), tuple(2 * k for k in n_lower[:2]) + (n_lower[2],), 10000, 10000)
        text = '*HEADING\npunch\n' + upper.text_nodes() + lower.text_nodes() + upper.text_elements('Upper') + lower.text_elements('Lower')
        text += nset('X0', upper.plane(0, 0) + lower.plane(0, 0)) + nset('Y0', upper.plane(1, 0) + lower.plane(1, 0))
        text += nset('BOTTOM', lower.plane(2, -1)) + nset('TOP', upper.plane(2, .5))
        text += surface('SU', upper.sides(2, 0)) + surface('SL', lower.sides(2, 0)) + MATERIAL
        text += '*SOLID SECTION, ELSET=Upper, MATERIAL=steel\n*SOLID SECTION, ELSET=Lower, MATERIAL=steel\n' + penalty
        text += '*CONTACT PAIR, INTERACTION=hard, TYPE=SURFACE TO SURFACE\nSU, SL\n*BOUNDARY\nX0, 1, 1\nY0, 2, 2\nBOTTOM, 3, 3\n'
        text += '*STEP\n*STATIC\n*BOUNDARY\nTOP, 3, 3, -0.01\n*END STEP\n'
        s, _ = d.solve(text)
        theirs = ccx_pressure(d.folder, f'ccx{kind}', text, upper.plane(2, .5))
        ours = s['pairs'][0]['load']
        print(kind, 'ours', ours, 'CalculiX', theirs)
        check(abs(ours + theirs) <= .02 * ours, f'{kind}: force {ours}, CalculiX {theirs}')


def heated(expansion='1e-5', n=(3, 3, 3), kind='C3D8'):
    """A block on another one under a wall that its top cannot leave, with its own material; both expand."""
    text, upper, lower = two_blocks(kind, n, (2, 2, 2), None)
    text = text.replace('1000., 0.3\n', f'1000., 0.3\n*EXPANSION, ZERO=20.\n{expansion}\n')
    text = text.replace('*STEP', nset('ALL', list(upper.nodes) + list(lower.nodes)) + nset('HOT', upper.nodes) + nset('COLD', lower.nodes) +
                        '*BOUNDARY\nTOP, 3, 3\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 20.\n*STEP', 1)
    return text, upper, lower


@in_folder
def deck_heat(d):
    """Temperatures: stresses of a block between walls, of two with different temperatures, steps, fields that differ from node to node."""
    text, upper, lower = heated()
    for kind in ('C3D8', 'C3D20', 'C3D10', 'C3D6'):
        s, (_, _, fields) = d.solve(heated(kind=kind)[0].replace('*STATIC\n', '*STATIC\n*TEMPERATURE\nALL, 120.\n'))
        # E alpha dT = 1.
        constant_pressure(s, 1., 1e-8)
        certificate(s)
        check(all(abs(v[2] + 1) < 1e-4 and abs(v[0]) < 1e-4 for v in fields['STRESS'].values()), f'{kind}: stresses')
    # One of them alone makes half of it; an expansion that is passed over none.
    one = text.replace('*STATIC\n', '*STATIC\n*TEMPERATURE\nHOT, 120.\n')
    s, _ = d.solve(one)
    constant_pressure(s, .5, 1e-8)
    check(d.solve(one, '--ignore', 'EXPANSION')[0]['pairs'][0]['load'] == 0., 'without EXPANSION')
    s, _ = d.solve(one.replace('*STATIC\n', '*STATIC\n*TEMPERATURE\nCOLD, 220.\n'))
    constant_pressure(s, 1.5, 1e-8)
    # What stays at its first temperature, and materials that do not expand.
    check(d.solve(text.replace('*STATIC\n', '*STATIC\n*TEMPERATURE\nALL, 20.\n'))[0]['pairs'][0]['load'] == 0., 'the first temperature')
    # Steps, with an amplitude that multiplies temperatures.
    s, _ = d.solve(text.replace('*STEP', '*AMPLITUDE, NAME=half\n0., 0., 1., 0.5, 2., 0.5\n*STEP', 1).replace(
        '*STATIC\n', '*STATIC\n*TEMPERATURE, AMPLITUDE=half\nALL, 140.\n*END STEP\n*STEP\n*STATIC\n*TEMPERATURE\nALL, 120.\n*END STEP\n*STEP\n*STATIC\n'
                     '*TEMPERATURE\nHOT, 220.\n'))
    with open(os.path.join(d.folder, f'out{d.n}', 'curve.csv')) as f:
        for row, expected in zip(csv.DictReader(f), (.5, 1., 1.5)):
            near(float(row['SU-SL: load']), expected, 1e-8, 'load of a step')
    # A temperature that grows along z, on refined meshes too: the mean counts.
    for kind, n in (('C3D8', (1, 1, 1)), ('C3D10', (1, 1, 1)), ('C3D20', (1, 1, 2))):
        text, upper, lower = heated(kind=kind, n=n)
        text = text.replace('1000., 0.3\n', '1000., 0.\n').replace('TOP, 3, 3\n', 'TOP, 3, 3\nALL, 1, 2\n')
        linear = ''.join(f'{label}, {20 + 200 * x[2]:.12g}\n' for label, (x, _) in upper.nodes.items())
        for levels in '01':
            s, _ = d.solve(text.replace('*STATIC\n', f'*STATIC\n*TEMPERATURE\n{linear}'), '--set', f'Refinement/Initial global levels={levels}')
            near(s['pairs'][0]['load'], .5, 1e-8, 'load of a mean temperature')
            certificate(s)
    # A table of expansions is noted; other kinds are refused.
    text, upper, lower = heated('1e-5, 0.\n2e-5, 100.')
    table = text.replace('*STATIC\n', '*STATIC\n*TEMPERATURE\nALL, 120.\n')
    s, _ = d.solve(table)
    constant_pressure(s, 1., 1e-8)
    check(any('EXPANSION depends on temperature' in note for note in s['notes']), f'notes: {s["notes"]}')
    d.refuses(table, 'EXPANSION', '--strict', arguments=['--strict'])
    d.refuses(table.replace('ZERO=20.', 'TYPE=ORTHO'), 'EXPANSION', '.inp, line ', 'isotropic')
    d.refuses(table.replace('TYPE=TEMPERATURE', 'TYPE=STRESS'), 'INITIAL CONDITIONS', '.inp, line ')
    d.refuses(table.replace('*TEMPERATURE\nALL, 120.', '*TEMPERATURE, FILE=other'), 'TEMPERATURE', '.inp, line ')
    d.refuses(table.replace('*TEMPERATURE\nALL, 120.', '*BOUNDARY\nALL, 11, 11, 120.'), 'BOUNDARY', '.inp, line ')


class Bolt:
    """A quarter of a bolt whose shank is held below and whose head presses a plate around it; section at z = 3."""

    def __init__(self, kind='C3D8', n=1):
        self.kind, self.n, self.nodes, self.elements, self.lift = kind, n, {}, {'BOLT': {}, 'PLATE': {}}, {}
        shank = [(i, j, k) for i in range(n) for j in range(n) for k in range(6)]
        ring = [(i, j) for i in range(3 * n) for j in range(3 * n) if i >= n or j >= n]
        self.add('BOLT', shank + [(i, j, 6) for i in range(3 * n) for j in range(3 * n)])
        self.add('PLATE', [(i, j, k) for i, j in ring for k in range(6)])

    def add(self, body, cells):
        first = 10000 * list(self.elements).index(body)
        for cell in cells:
            for part in PARTS[KINDS[self.kind][0]]:
                corners = [tuple(c + x for c, x in zip(cell, HEX[v])) for v in part]
                label = first + len(self.elements[body]) + 1
                self.elements[body][label] = [self.nodes.setdefault((body, c), len(self.nodes) + 1) for c in corners]

    def find(self, body, direction, place):
        return [label for (b, c), label in self.nodes.items() if b == body and c[direction] == place]

    def sides(self, body, z, upward):
        """Sides of elements in a plane of the elements below it, or above it."""
        place, result = {label: c for (_, c), label in self.nodes.items()}, []
        for label, element in self.elements[body].items():
            low = min(place[v][2] for v in element)
            for s, side in enumerate(SIDES[KINDS[self.kind][0]]):
                corners = [place[element[v]] for v in side]
                if all(c[2] == z for c in corners) and (low < z) == upward:
                    result.append((label, s + 1))
        return result

    def text(self, load='*CLOAD\n90000, 1, 3.\n', section='*PRE-TENSION SECTION, SURFACE=CUT, NODE=90000\n0., 0., 1.\n', step=''):
        text = '*NODE\n' + ''.join(f'{label}, {.5 * c[0] / self.n:.12g}, {.5 * c[1] / self.n:.12g}, {c[2] + self.lift.get(c, 0.):.12g}\n' for (_, c), label in self.nodes.items())
        text += '90000, 0., 0., 9.\n'
        for body, elements in self.elements.items():
            text += f'*ELEMENT, TYPE={self.kind}, ELSET={body}\n' + ''.join(', '.join(map(str, [label] + nodes)) + '\n' for label, nodes in elements.items())
        for c, name in enumerate('XYZ'):
            text += nset(name + '0', self.find('BOLT', c, 0) + self.find('PLATE', c, 0))
        text += nset('HELD', self.find('BOLT', 2, 0))
        n = self.n
        head = [(e, s) for e, s in self.sides('BOLT', 6, False)]
        shank = {e for e, s in head if all(v in {label for (b, c), label in self.nodes.items() if b == 'BOLT' and c[0] <= n and c[1] <= n}
                                           for v in self.elements['BOLT'][e])}
        text += surface('HEAD', [(e, s) for e, s in head if e not in shank])
        text += surface('TOP', self.sides('PLATE', 6, True)) + surface('CUT', self.sides('BOLT', 3, True))
        text += MATERIAL + '*SOLID SECTION, ELSET=BOLT, MATERIAL=steel\n*SOLID SECTION, ELSET=PLATE, MATERIAL=steel\n' + INTERACTION
        text += '*CONTACT PAIR, INTERACTION=hard, TYPE=SURFACE TO SURFACE\nHEAD, TOP\n' + section
        return text + '*BOUNDARY\nX0, 1, 1\nY0, 2, 2\nZ0, 3, 3\n*STEP\n*STATIC\n' + load + '*END STEP\n' + step


@in_folder
def deck_bolt(d):
    """PRE-TENSION SECTION: the force of the section and of the joint is that of the node."""
    def same(text, *arguments, force=3.):
        s, frd = d.solve(text, *arguments)
        near(s['pretension'][0]['force'], force, 1e-7, 'force of the section')
        near(s['pairs'][0]['load'], force, 1e-6, 'force of the joint')
        certificate(s)
        return s, frd

    for kind in ('C3D8', 'C3D6', 'C3D4'):
        same(Bolt(kind).text())
    bolt = Bolt()
    text = bolt.text()
    same(text, '--set', 'Refinement/Initial global levels=1')
    # The direction is that of the surface where it is not given.
    same(text.replace('0., 0., 1.\n*BOUNDARY', '*BOUNDARY'))
    # Steps: tightened in two, then a load that the joint takes beside it.
    same(bolt.text('*CLOAD\n90000, 1, 1.\n', step='*STEP\n*STATIC\n*CLOAD\n90000, 1, 2.5\n*END STEP\n'), force=2.5)
    with open(os.path.join(d.folder, f'out{d.n}', 'curve.csv')) as f:
        for row, expected in zip(csv.DictReader(f), (1., 2.5)):
            near(float(row['HEAD-TOP: load']), expected, 1e-6, 'force of the joint in a step')
    # The elements behind the section need not be a layer between planes.
    for kind in ('C3D8', 'C3D4'):
        rugged = Bolt(kind, n=2)
        rugged.lift = {(0, 0, 4): .3, (1, 1, 4): -.4, (2, 0, 4): .2, (1, 2, 4): .35, (0, 1, 4): -.2}
        same(rugged.text())
    # Tightened and locked, and then the head is pulled: as with the force that the section has in the end.
    pulled = '*CLOAD\n{}, 3, 2.\n'.format(bolt.nodes['BOLT', (0, 0, 7)])
    locked = '*STEP\n*STATIC\n*BOUNDARY, FIXED\n90000, 1, 1\n'
    s, _ = d.solve(bolt.text(step=locked + pulled + '*END STEP\n'))
    section, joint = s['pretension'][0], s['pairs'][0]['load']
    print('locked:', section, 'joint', joint)
    near(section['wanted'], 3., 1e-12, 'force of tightening')
    near(section['force'], joint + 2., 1e-6, 'balance of the head')
    check(3.1 < section['force'] < 4.9 and section['locked_after'] == .5, f'locked: {section}')
    s, _ = d.solve(bolt.text(f'*CLOAD\n90000, 1, {section["force"]:.15g}\n' + pulled))
    near(s['pairs'][0]['load'], joint, 1e-6, 'force of the joint, not locked')
    near(s['pretension'][0]['strain'], section['strain'], 1e-6, 'strain, not locked')
    # The order in which a step says what holds does not matter.
    again = '*BOUNDARY, OP=NEW\nX0, 1, 1\nY0, 2, 2\nZ0, 3, 3\n'
    for order in (locked.replace('FIXED', 'OP=NEW, FIXED') + again, locked.replace('*BOUNDARY, FIXED', again + '*BOUNDARY, OP=NEW, FIXED')):
        s, _ = d.solve(bolt.text(step=order + pulled + '*END STEP\n'))
        near(s['pretension'][0]['force'], section['force'], 1e-6, f'{order}: section force')
    d.refuses(bolt.text('*BOUNDARY, FIXED\n90000, 1, 1\n'), '.inp, line ', 'FIXED in the first step')
    d.refuses(bolt.text(step=locked + '*END STEP\n*STEP\n*STATIC\n*BOUNDARY, OP=NEW\nX0, 1, 1\nY0, 2, 2\nZ0, 3, 3\n*END STEP\n'), '.inp, line ', 'stay so')
    # What is refused.
    held = '*BOUNDARY\n90000, 1, 1, 0.01\n'
    section = '*PRE-TENSION SECTION, SURFACE=CUT, NODE=90000\n'
    for where, what, words in (('*CLOAD\n90000, 1, 3.\n', held, ['BOUNDARY', 'cannot be given']), ('*CLOAD\n90000, 1, 3.\n', '', ['no section has a force']),
                               ('90000, 1, 3.', '90000, 1, -3.', ['negative']), ('90000, 1, 3.', '90000, 3, 3.', ['direction 1']),
                               ('SURFACE=CUT', 'SURFACE=TOP', ['inside of a bolt']), (section, section.replace('90000', '1'), ['belongs to no element']),
                               (section, section.replace('SURFACE=CUT', 'ELEMENT=1'), ['between solid elements']),
                               (section + '0., 0., 1.', section + '1., 0., 1.', ['normal of its surface'])):
        check(where in text, f'{words}: nothing was changed')
        d.refuses(text.replace(where, what), '.inp, line ', *words)
    fine = Bolt(n=2)
    cut = fine.text()
    d.refuses(cut.replace(surface('CUT', fine.sides('BOLT', 3, True)), surface('CUT', fine.sides('BOLT', 3, True)[:1])),
              '.inp, line ', 'cross the whole bolt')
    same(cut)


@in_folder
def deck_slit(d):
    """Two surfaces of one body touch: as in a parameter file with the same mesh. A surface with itself is refused."""
    x, y, z = [0, .5, 1, 2, 3, 4, 5, 5.5, 6], [-3, -2.5, -2, -1.4, -.8, -.4, -.1, 0, .1, .4, .8, 1.4, 2, 2.5, 3], [0, .5, 1]
    label = lambda i, j, k: 1 + i + len(x) * (j + len(y) * k)
    elements, low, top, bottom, upper_lip, lower_lip = {}, set(), [], [], [], []
    for i, j, k in itertools.product(range(len(x) - 1), range(len(y) - 1), range(len(z) - 1)):
        cx, cy = (x[i] + x[i + 1]) / 2, (y[j] + y[j + 1]) / 2
        if 1 < cx < 5 and abs(cy) < 2 or cx > 5 and abs(cy) < .1:
            continue
        n = len(elements) + 1
        elements[n] = [label(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        if k == 0:
            low.update(elements[n][:4])
        for sides, there, side in ((top, y[j + 1] == 3, 'S5'), (bottom, y[j] == -3, 'S3'), (upper_lip, y[j] == .1 and cx > 5, 'S3'), (lower_lip, y[j + 1] == -.1 and cx > 5, 'S5')):
            if there:
                sides.append((n, side))
    used = {n for nodes in elements.values() for n in nodes}
    text = '*NODE, NSET=ALL\n' + ''.join(f'{label(i, j, k)}, {x[i]}, {y[j]}, {z[k]}\n' for i, j, k in itertools.product(range(len(x)), range(len(y)), range(len(z)))
                                         if label(i, j, k) in used)
    text += '*ELEMENT, TYPE=C3D8, ELSET=clip\n' + ''.join(f'{n}, {", ".join(map(str, nodes))}\n' for n, nodes in elements.items())
    text += nset('LOW', sorted(low)) + ''.join(f'*SURFACE, NAME={name}\n' + ''.join(f'{n}, {side}\n' for n, side in sides)
                                               for name, sides in (('TOP', top), ('BOTTOM', bottom), ('UPPER', upper_lip), ('LOWER', lower_lip)))
    text += '*MATERIAL, NAME=m\n*ELASTIC\n1., 0.3\n*SOLID SECTION, ELSET=clip, MATERIAL=m\n' + INTERACTION
    text += '*CONTACT PAIR, INTERACTION=hard, TYPE=SURFACE TO SURFACE\nUPPER, LOWER\n*BOUNDARY\nLOW, 3, 3\n'
    text += '*STEP\n*STATIC\n*DSLOAD\nTOP, P, 0.002\nBOTTOM, P, 0.002\n*END STEP\n'
    s, _ = d.solve(text)
    certificate(s)
    write_clip(d.folder, -3)
    prm = d.path('clip.prm', CLIP.format(hold='low: (*, *, 0)', more='; bottom: 0.002', second='set Second = clip: lower lip\n  set Nonmortar = first'))
    theirs = d.p.solve(prm, 'Body clip/Young modulus=1', 'Body clip/Poisson ratio=0.3')
    print(s['pairs'][0]['load'], theirs['pairs'][0]['load'])
    check(s['pairs'][0]['load'] > 0, 'the lips do not touch')
    near(s['pairs'][0]['load'], theirs['pairs'][0]['load'], 1e-6, 'force of the lips')
    d.refuses(text.replace('UPPER, LOWER', 'UPPER, UPPER'), 'faces in common', '"UPPER"')


@in_folder
def deck_few_digits(d):
    """A block on a block, held by nothing but contact with a plane that no axis goes along, in coordinates of few digits: it slid away over what rounding had left."""
    reference = None
    for digits in (14, 10, 9, 8, 7, 6, 5, 4):
        def move(x, digits=digits):
            y, z = math.cos(.3) * x[1] - math.sin(.3) * x[2], math.sin(.3) * x[1] + math.cos(.3) * x[2]
            return [round(c, digits) for c in (math.cos(.4) * x[0] + math.sin(.4) * z, y, -math.sin(.4) * x[0] + math.cos(.4) * z)]
        upper = Block('C3D8', (1.1, 1.2, 0), (2.7, 2.9, 1), (6, 6, 4), move=move)
        lower = Block('C3D8', (0, 0, -1), (4, 4, 0), (9, 10, 4), 10000, 10000, move=move)
        text = upper.text_nodes() + lower.text_nodes() + upper.text_elements('Upper') + lower.text_elements('Lower')
        text += nset('BOTTOM', lower.plane(2, -1)) + surface('SU', upper.sides(2, 0)) + surface('SL', lower.sides(2, 0)) + surface('STOP', upper.sides(2, 1))
        text += MATERIAL + '*SOLID SECTION, ELSET=Upper, MATERIAL=steel\n*SOLID SECTION, ELSET=Lower, MATERIAL=steel\n' + INTERACTION
        text += '*CONTACT PAIR, INTERACTION=hard, TYPE=SURFACE TO SURFACE\nSU, SL\n*BOUNDARY\nBOTTOM, 1, 3\n*STEP\n*STATIC\n' + LOAD.format(1.) + '*END STEP\n'
        s, _ = d.solve(text)
        certificate(s)
        iterations, largest = s['cycles'][0]['nonlinear']['iterations'], [body['largest_displacement'] for body in s['bodies']]
        print(digits, 'digits:', iterations, 'iterations, displacements', largest, 'pressure', s['pairs'][0]['max_recovered_pressure'])
        near(s['pairs'][0]['load'], 1.6 * 1.7, 10 * 10.**-digits + 1e-9, f'{digits} digits: load')
        check(iterations <= 12 and max(largest) < .0025, f'{digits} digits: {iterations} iterations, displacements {largest}')
        reference = reference or s['pairs'][0]['max_recovered_pressure']
        near(s['pairs'][0]['max_recovered_pressure'], reference, .03, f'{digits} digits: largest pressure')
        # A force along the plane has nothing against it.
        if digits < 14:
            d.refuses(text.replace('*END STEP', f'*CLOAD\n{upper.plane(2, 1)[0]}, 2, 0.1\n*END STEP'), 'Upper', 'Prescribe')
