"""The files of results: what is in them, that it fits together, and that doc/output.md explains it."""
import csv
import json
import math
import os
import re
import tempfile
import xml.etree.ElementTree

from harness import TOP, check, near, read_pressure
from tool_cases import arrays_of

CUBES = os.path.join(TOP, 'prm', 'cubes', 'cubes.prm')
DOCUMENT = os.path.join(TOP, 'doc', 'output.md')


def run(p, folder, prm, *settings):
    out = os.path.join(folder, f'out {len(os.listdir(folder))}')
    answer = p.call(prm, '--output', out, *[word for s in settings for word in ('--set', s)])
    if answer.returncode not in (0, 3):
        raise SystemExit(f'{prm} {settings}: exit code {answer.returncode}: {answer.stderr}')
    with open(os.path.join(out, 'summary.json')) as f:
        return out, json.load(f)


def parse(folder, name):
    return xml.etree.ElementTree.parse(os.path.join(folder, name)).getroot()


def pieces_of(folder, name):
    return [piece.get('Source') for piece in parse(folder, name).iter('Piece')]


def read_pieces(folder, name):
    """Arrays by name of all pieces of a .pvtu, one after the other; the corners of cells as numbers of these points."""
    import numpy
    pieces, n = [], 0
    for piece in pieces_of(folder, name):
        with open(os.path.join(folder, piece), 'rb') as f:
            # Several ranks may have written one file.
            check(f.read().count(b'<Piece ') == 1, f'{piece}: not one piece')
        pieces.append(arrays_of(os.path.join(folder, piece)))
        pieces[-1]['connectivity'] = pieces[-1]['connectivity'] + n
        n += len(pieces[-1]['points'])
    return {key: numpy.concatenate([piece[key] for piece in pieces]) for key in pieces[0]}


# An indicator, hanging nodes, and both sides with nodes that face nothing.
SMALL = ['Refinement/Global cycles=1', 'Refinement/Adaptive cycles=1', 'Solver/Compare linear multigrid=false', 'Output/Measure sweeps=false']


def check_bodies(s, data, single):
    import numpy
    body = numpy.full(len(data['points']), -1)
    sizes = numpy.diff(data['offsets'][:, 0], prepend=0)
    # Offsets begin again with each piece.
    sizes[sizes < 0] = data['offsets'][sizes < 0, 0]
    body[data['connectivity'][:, 0]] = numpy.repeat(data['body'][:, 0], sizes)
    check(set(body) == {0, 1} and len(sizes) == s['cycles'][-1]['cells'], f'bodies of points: {set(body)}, {len(sizes)} cells')
    nodes = len(set(data['node'][:, 0]))
    places = len({(b, *x) for b, x in zip(body, data['points'].tolist())})
    check(nodes == places, f'{nodes} numbers of nodes at {places} places')
    xx, yy, zz, xy, yz, xz = data['stress'].T
    mises = numpy.sqrt(.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy ** 2 + yz ** 2 + xz ** 2))
    digits = 1e-5 if single else 1e-13
    check(abs(mises - data['von_Mises'][:, 0]).max() <= digits * mises.max(), 'von Mises stress of the tensor')
    trace = data['principal_stress'].sum(axis=1) - (xx + yy + zz)
    check(abs(trace).max() <= digits * mises.max() * 10, 'trace of the tensor')
    check(set(data['level'][:, 0]) == {1, 2}, f'levels {set(data["level"][:, 0])}')
    near(math.sqrt((data['indicator'].astype(float) ** 2).sum()), s['cycles'][-1]['indicator'], 1e-6, 'sum of the indicators')
    for b, entry in enumerate(s['bodies']):
        near(numpy.linalg.norm(data['displacement'][body == b].astype(float), axis=1).max(), entry['largest_displacement'], 1e-6, 'largest displacement')


def check_scatter(pair, rows):
    """Half of the load is where pressures differ more from the recovered ones."""
    rows = [r for r in rows if r['active'] and r['recovered_pressure'] > 0]
    load = [r['area'] * r['pressure'] for r in rows]
    far = [abs(r['pressure'] - r['recovered_pressure']) / r['recovered_pressure'] for r in rows]
    def beyond(x):
        return sum(w for w, y in zip(load, far) if y > x) / sum(load)
    scatter = pair['pressure_scatter']
    check(scatter > 1e-3, f'scatter {scatter}')
    check(beyond((1 - 1e-6) * scatter) >= .5 >= beyond((1 + 1e-6) * scatter), f'scatter {scatter}: not the half of the load')
    check(pair['scatter_is_told'] == (scatter > .05), f'scatter {scatter} is told: {pair["scatter_is_told"]}')


def check_recovered_on_triangles(p, folder):
    """The mean of the pressure on each triangle, and of these around a node, where the surface is covered and no node hangs."""
    import numpy
    out, s = run(p, folder, CUBES, *[f'Body {body}/Convert to tetrahedra=true' for body in ('upper', 'lower')], 'Refinement/Global cycles=1',
                 'Solver/Compare linear multigrid=false', 'Output/Precision=double')
    check_scatter(s['pairs'][0], read_pressure(os.path.join(out, 'pressure.csv')))
    data = read_pieces(out, 'contact-interface.pvtu')
    nodes = data['node'][:, 0]
    corners = data['connectivity'].reshape(-1, 3)
    a, b, c = (data['points'][corners[:, k]] for k in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2
    mean = data['pressure'][corners, 0].mean(axis=1)
    check(mean.max() > 2 * mean.mean(), 'the pressure hardly varies')
    for node in set(nodes.tolist()):
        around = (nodes[corners] == node).any(axis=1)
        expected = (area * mean)[around].sum() / area[around].sum()
        for found in data['recovered pressure'][nodes == node, 0]:
            check(abs(found - expected) <= 1e-10 * s['pairs'][0]['max_pressure'], f'recovered pressure of node {node}: {found}, {expected}')


def check_pressure(s, out):
    """Both sides: forces, areas, the values of the summary, and those of the surfaces at the same nodes."""
    pair = s['pairs'][0]
    rows = {side: read_pressure(os.path.join(out, 'pressure.csv'), side) for side in ('nonmortar', 'mortar')}
    for side, force in (('nonmortar', pair['force']), ('mortar', pair['force_on_mortar'])):
        # The surfaces are flat: no part of the traction is lost by the mean.
        for c, n in enumerate(('nx', 'ny', 'nz')):
            total = -sum(r['area'] * r['pressure'] * r[n] for r in rows[side])
            check(abs(total - force[c]) <= 1e-9 * pair['load'], f'{side}: force {total} and {force}')
        check(len({r['node'] for r in rows[side]}) == len(rows[side]), f'{side}: nodes twice')
        check(any(r['active'] for r in rows[side]), f'{side}: no node is active')
    check(not all(r['active'] for r in rows['nonmortar']), 'all nodes are active')
    # What arrives is what was sent.
    for name in ('', 'recovered_pressure', 'gap'):
        sent, arrived = (sum(r['area'] * r.get(name, 1.) for r in rows[side]) for side in ('nonmortar', 'mortar'))
        near(arrived, sent, 1e-9, f'sum of area times {name or 1} on both sides')
    near(pair['mean_pressure'] * pair['contact_area'], pair['load'], 1e-12, 'mean pressure')
    highest = max(rows['nonmortar'], key=lambda r: r['recovered_pressure'])
    near(pair['max_recovered_pressure'], highest['recovered_pressure'], 1e-12, 'largest recovered pressure')
    check([highest[c] for c in 'xyz'] == pair['max_recovered_pressure_at'], 'place of the largest recovered pressure')
    check_scatter(pair, rows['nonmortar'])
    for side, name in (('nonmortar', 'contact-interface.pvtu'), ('mortar', 'contact-interface-mortar.pvtu')):
        data = read_pieces(out, name)
        at = dict(zip(data['node'][:, 0].tolist(), range(len(data['node']))))
        for r in rows[side]:
            i = at[int(r['node'])]
            check(max(abs(a - r[c]) for a, c in zip(data['points'][i], 'xyz')) < 1e-6, f'{side}: node {r["node"]} is elsewhere')
            check(abs(data['pressure'][i, 0] - r['pressure']) <= 1e-6 * pair['max_pressure'], f'{side}: pressure of node {r["node"]}')
            check(abs(data['recovered pressure'][i, 0] - r['recovered_pressure']) <= 1e-6 * pair['max_pressure'], f'{side}: recovered pressure of node {r["node"]}')
            check(abs(data['traction'][i] @ [r['nx'], r['ny'], r['nz']] + r['pressure']) <= 1e-6 * pair['max_pressure'], f'{side}: traction of node {r["node"]}')


def check_blocks(out, suffix='', times=('0',)):
    entries = [(e.get('timestep'), e.get('part'), e.get('name'), e.get('file')) for e in parse(out, f'results{suffix}.pvd').iter('DataSet')]
    names = ['body upper', 'body lower & more', 'contact interface, nonmortar side (upper: bottom)', 'contact interface, mortar side (lower & more: top)']
    check([(t, part, name) for t, part, name, _ in entries] == [(t, str(i), name) for t in times for i, name in enumerate(names)], f'blocks: {entries}')
    for _, _, _, file in entries:
        check(os.path.exists(os.path.join(out, file)), f'{file} is missing')
    single = [piece for _, _, name, file in entries[:2] for piece in pieces_of(out, file)]
    if not suffix:
        check(single == pieces_of(out, 'bodies.pvtu'), f'pieces of the bodies: {single}')


def output_files(p):
    """Points that cells share, tensors, single and double precision, both sides of the contact, blocks with names."""
    with tempfile.TemporaryDirectory() as folder:
        prm = os.path.join(folder, 'more.prm')
        with open(CUBES) as f:
            text = f.read()
        with open(prm, 'w') as f:
            f.write(text.replace('upper, lower', 'upper, lower & more').replace('Body lower', 'Body lower & more').replace('lower: top', 'lower & more: top'))
        found = {}
        for precision in ('single', 'double'):
            out, s = run(p, folder, prm, *SMALL, f'Output/Precision={precision}')
            data = read_pieces(out, 'bodies.pvtu')
            check_bodies(s, data, precision == 'single')
            check(data['stress'].dtype == data['points'].dtype == {'single': 'float32', 'double': 'float64'}[precision], f'{precision}: {data["stress"].dtype}')
            types = {a.get('Name'): a for a in parse(out, 'bodies.pvtu').iter('PDataArray')}
            check([types['stress'].get(f'ComponentName{c}') for c in range(6)] == ['XX', 'YY', 'ZZ', 'XY', 'YZ', 'XZ'], 'names of the components')
            check(types['stress'].get('type') == types['displacement'].get('type') == {'single': 'Float32', 'double': 'Float64'}[precision], 'type in the .pvtu')
            found[precision] = data
            check_pressure(s, out)
            check_blocks(out)
        check_recovered_on_triangles(p, folder)
        for key in ('points', 'displacement', 'stress', 'indicator'):
            a, b = found['single'][key], found['double'][key]
            check(abs(a - b).max() <= 1e-6 * abs(b).max() and abs(a - b).max() > 0, f'{key}: single and double')
        out, s = run(p, folder, prm, 'Refinement/Global cycles=0', 'Load steps=2', 'Solver/Compare linear multigrid=false')
        check_blocks(out, '-steps', ('0.5', '1'))


MESH = '''*NODE
 7, 0, 0, 0
 11, 1, 0, 0
 13, 1, 1, 0
 20, 0, 1, 0
 101, 0, 0, 1
 90, 1, 0, 1
 80, 1, 1, 1
 70, 0, 1, 1
 999, 5, 5, 5
*ELEMENT, TYPE=C3D8, ELSET=cube
 1, 7, 11, 13, 20, 101, 90, 80, 70
*SURFACE, NAME=bottom
 1, S1
*SURFACE, NAME=top
 1, S2
'''
PLACES = {int(n): tuple(map(float, x)) for n, *x in (line.split(',') for line in MESH.splitlines()[1:9])}
ON_PLANE = '''set Bodies = cube, other
set Contact pairs = floor
subsection Body cube
 set Mesh = cube.inp
 set Dirichlet = top: (0, 0, -0.01)
 {conversion}
end
subsection Body other
 set Lower corner = 0, 0, -1
 set Upper corner = 1, 1, 0
 set Dirichlet = bottom: (0, 0, 0)
end
subsection Pair floor
 set First = cube: bottom
 set Second = other: top
 set Nonmortar = {side}
end
subsection Refinement
 set Global cycles = 1
end
'''


def output_numbers_of_nodes(p):
    """The nodes of a mesh file have the numbers that they have there, those that are new or generated -1."""
    for conversion, side in (('', 'first'), ('set Convert to tetrahedra = true', 'second')):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, 'cube.inp'), 'w') as f:
                f.write(MESH)
            prm = os.path.join(folder, 'floor.prm')
            with open(prm, 'w') as f:
                f.write(ON_PLANE.format(conversion=conversion, side=side))
            out, s = run(p, folder, prm)
            rows = [r for side in ('nonmortar', 'mortar') for r in read_pressure(os.path.join(out, 'pressure.csv'), side)]
            lists = {'pressure.csv': [(int(r['mesh_node']), (r['x'], r['y'], r['z'])) for r in rows]}
            for name in ('body-cube', 'body-other', 'contact-floor', 'contact-floor-mortar'):
                data = read_pieces(out, name + '.pvtu')
                lists[name] = list(zip(data['mesh_node'][:, 0].tolist(), data['points'].tolist()))
        expected = {'pressure.csv': 4, 'body-cube': 8, 'body-other': 0, 'contact-floor' + '-mortar' * (side == 'second'): 4, 'contact-floor' + '-mortar' * (side == 'first'): 0}
        for name, entries in lists.items():
            known = {number: place for number, place in entries if number != -1}
            check(len(known) == expected[name], f'{conversion}, {name}: {known}')
            for number, place in known.items():
                check(max(abs(a - b) for a, b in zip(place, PLACES[number])) < 1e-6, f'{name}: node {number} at {place}')
            check(any(number == -1 for number, _ in entries), f'{name}: no new nodes')


def documented():
    """By section of doc/output.md what its tables name first; for summary.json all sections together."""
    with open(DOCUMENT) as f:
        text = f.read()
    tables, section = {}, ''
    for line in text.splitlines():
        if line.startswith('## '):
            top = section = line[3:].strip()
        elif line.startswith('### '):
            section = 'summary.json' if top == 'summary.json' else line[4:].strip()
        elif line.startswith('| `'):
            tables.setdefault(section, []).extend(re.findall(r'`([^`]*)`', line.split('|')[1]))
    return tables


def keys_of(value, path=''):
    """Paths of what is no object: lists of objects count as their entries."""
    if isinstance(value, dict):
        return {key for name, entry in value.items() for key in keys_of(entry, f'{path}/{name}' if path else name)}
    if isinstance(value, list) and any(isinstance(entry, dict) for entry in value):
        return {key for entry in value for key in keys_of(entry, path)}
    return {path}


def pattern(name):
    """Words in capital letters stand for names."""
    return re.compile(re.sub(r'\b[A-Z]{2,}\b', '[^/]+', re.escape(name).replace(r'\ ', ' ')) + '$')


def compare_names(where, found, listed, rare):
    for name in sorted(found):
        check(any(pattern(entry).match(name) for entry in listed), f'{where}: doc/output.md does not explain "{name}"')
    for entry in listed:
        check(any(pattern(entry).match(name) for name in found) or any(r in entry for r in rare), f'{where}: doc/output.md explains "{entry}", which is not there')


# What it takes a slow or failing iteration, another solver, or a bolt to have.
RARE = ('stagnated', 'amg_cycles', 'patches_after_iterations', 'safety_net', 'boundary_shapes', 'pretension/', 'cycles/nonlinear/start_iterations', 'unmapped')


def output_documented(p):
    """doc/output.md explains every key, column, array and file, and nothing that is not there."""
    tables = documented()
    with open(os.path.join(TOP, 'source', 'output', 'summary.cc')) as f:
        source = f.read()
    for key in tables['summary.json']:
        for part in key.split('/'):
            check(part.isupper() or f'"{part}"' in source or part in ('coverage_nonmortar',), f'summary.json: the program does not write "{key}"')
    with tempfile.TemporaryDirectory() as folder:
        out, s = run(p, folder, CUBES, 'Refinement/Global cycles=1', 'Refinement/Adaptive cycles=1', 'Refinement/Compare cycles=true', 'Solver/Check monotonicity=true',
                     'Body upper/Probes=corner: (1, 1, 0.5)', 'Body upper/Exact displacement=(0, 0, 0)', 'Load steps=2', 'Output/Mapping graph=true')
        names = set(os.listdir(out))
        compare_names('summary.json', keys_of(s), [k for k in tables['summary.json'] if k not in ('mappings/unmapped/REASON',)] + ['mappings/unmapped', 'mappings/unmapped/REASON'], RARE)
        with open(os.path.join(out, 'pressure.csv'), newline='') as f:
            compare_names('pressure.csv', set(next(csv.reader(f))), tables['pressure.csv'], ())
        with open(os.path.join(out, 'curve.csv'), newline='') as f:
            columns = {re.sub(r' [yz]$', ' x', name) for name in next(csv.reader(f))}
        compare_names('curve.csv', columns, tables['curve.csv'], ('BOLT',))
        surfaces = [set(), set()]
        for name in sorted(names):
            if name.endswith('.vtu'):
                arrays = {a.get('Name') for a in parse(out, name).iter('DataArray')} - {None, 'connectivity', 'offsets', 'types'}
                if name.startswith('bodies'):
                    compare_names(name, arrays, tables['Bodies'], ('mesh_node', 'indicator'))
                elif name.startswith('mapping'):
                    compare_names(name, arrays, tables['Mapping'], ())
                else:
                    surfaces['-mortar' in name] |= arrays
        compare_names('nonmortar side', surfaces[0], tables['Contact surfaces'], ('mesh_node',))
        compare_names('mortar side', surfaces[1], tables['Contact surfaces'], ('mesh_node', 'gap', 'active', 'mortar_image'))
        listed = tables['Files'] + ['bodies-step-NUMBER.pvtu']
        for name in sorted(names):
            plain = re.sub(r'-step-\d+', '', name)
            check(name[0] == '.' or any(pattern(entry).match(plain) for entry in listed) or plain.endswith('.pvd'), f'doc/output.md does not explain the file "{name}"')
        for entry in tables['Files']:
            check(any(pattern(entry).match(name) for name in names) or entry in ('results.frd', 'pressure.png'), f'doc/output.md explains "{entry}", which is not there')
