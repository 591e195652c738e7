"""The tools of contrib/plots on small results: the pictures are there, not blank, nothing in them is cropped, and no other file
has changed.

usage: plots.py PROGRAM matplotlib|vtk
"""
import hashlib
import math
import os
import re
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PLOTS = os.path.join(TOP, 'contrib', 'plots')
sys.path.insert(0, PLOTS)
FAILURES = []
SKIPPED = 77


def check(condition, text):
    if not condition:
        FAILURES.append(text)


def solve(program, folder, name, prm, *settings):
    out = os.path.join(folder, name)
    words = [word for s in settings + ('Output/Verbosity=0', 'Solver/Compare linear multigrid=false') for word in ('--set', s)]
    subprocess.run([program, os.path.join(TOP, 'prm', prm), '--output', out, *words], check=True, timeout=300)
    return out


def snapshot(folder):
    result = {}
    for name in os.listdir(folder):
        with open(os.path.join(folder, name), 'rb') as f:
            result[name] = hashlib.sha256(f.read()).hexdigest()
    return result


def call(tool, *arguments):
    return subprocess.run(['/usr/bin/python3', os.path.join(PLOTS, tool), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, timeout=300)


def check_picture(path):
    import matplotlib.image
    image = matplotlib.image.imread(path)[:, :, :3]
    border = [image[:3], image[-3:], image[:, :3], image[:, -3:]]
    check(all((part == 1.).all() for part in border), f'{path}: something is cut off')
    ink = (image != 1.).any(axis=2)
    check(ink.mean() > .02, f'{path}: blank')
    colours = {tuple(c) for c in (image[::3, ::3].reshape(-1, 3) * 31).astype(int).tolist()}
    check(len(colours) > 8, f'{path}: {len(colours)} colours')
    # All of the picture is used.
    for axis in (0, 1):
        where = ink.any(axis=1 - axis).nonzero()[0]
        check(where[0] < .12 * len(ink.any(axis=1 - axis)) and where[-1] > .88 * len(ink.any(axis=1 - axis)), f'{path}: empty on one side')


def draw(tool, folder, expected, *arguments):
    """The tool writes these pictures, and leaves what else lies there."""
    before = snapshot(folder)
    run = call(tool, folder, *arguments)
    check(run.returncode == 0, f'{tool} {arguments}: {run.returncode}, {run.stderr}')
    after = snapshot(folder)
    changed = {name for name in after if after[name] != before.get(name)}
    check(changed <= set(expected) and set(expected) <= set(after) and set(before) <= set(after), f'{tool}: {sorted(changed)} instead of {sorted(expected)}')
    check({os.path.basename(line) for line in run.stdout.splitlines() if line.endswith('.png')} == set(expected), f'{tool}: says {run.stdout}')
    for name in expected:
        check_picture(os.path.join(folder, name))


def foreign(folder, tool, name, *arguments):
    """A file of somebody else stays, and the picture gets a number; the next picture takes the place of that one."""
    path = os.path.join(folder, name)
    with open(path, 'wb') as f:
        f.write(b'not of this tool')
    other = name.replace('.png', '-2.png')
    for _ in range(2):
        run = call(tool, folder, *arguments)
        check(run.returncode == 0 and other in run.stdout, f'{tool}: {run.stdout} {run.stderr}')
    with open(path, 'rb') as f:
        check(f.read() == b'not of this tool', f'{tool} has overwritten {name}')
    check(not os.path.exists(path.replace('.png', '-3.png')), f'{tool}: pictures pile up')
    os.remove(path)
    os.remove(os.path.join(folder, other))


def inside_axes(folder):
    """All that plot_pressure.py draws lies within its axes."""
    import picture
    import plot_pressure
    seen = {}

    def look(figure, _, name, tool, dpi=0):
        seen[name] = [(axes.dataLim, axes.viewLim, [line.get_xydata() for line in axes.lines]) for axes in figure.axes]
    save, picture.save = picture.save, look
    arguments, sys.argv = sys.argv, ['plot_pressure.py', folder, '--centre', '0,0,0']
    plot_pressure.main()
    picture.save, sys.argv = save, arguments
    for data, view, lines in seen['pressure']:
        check(not lines or (view.x0 <= data.x0 and data.x1 <= view.x1 and view.y0 <= data.y0 and data.y1 <= view.y1), f'pressure: {data} in {view}')
    for data, view, lines in seen['pressure-unrolled']:
        for line in lines:
            # Around the seam nodes are drawn twice, beyond the axes.
            loaded = line[(line[:, 1] > 0)]
            check(len(loaded) > 3 and (view.x0 <= line[:, 0]).any() and loaded[:, 1].max() <= view.y1 and loaded[:, 1].min() >= view.y0, f'unrolled: {view}')


def cylinders():
    """Bores and shafts are found with axis and radius, whatever the arc; spheres, planes and cones are none."""
    import numpy
    from plot_pressure import Cylinder
    random = numpy.random.default_rng(1)
    turn = numpy.linalg.qr(random.normal(size=(3, 3)))[0]

    def points(start, end, sign, normal=None):
        a, z = random.uniform(math.radians(start), math.radians(end), 400), random.uniform(-3, 3, 400)
        n = numpy.c_[numpy.cos(a), numpy.sin(a), 0 * a]
        return (7.5 * n + numpy.c_[0 * a, 0 * a, z]) @ turn.T + [100, -20, 3], sign * n @ turn.T, numpy.ones(400)
    for start, end, sign in ((0, 360, -1), (0, 360, 1), (20, 110, -1), (-30, 30, 1)):
        found = Cylinder(*points(start, end, sign))
        check(found.is_one and abs(found.radius - 7.5) < 1e-6 and found.is_bore == (sign < 0), f'cylinder {start} to {end}: {vars(found)}')
        check(abs(abs(found.axis @ turn[:, 2]) - 1) < 1e-9, f'axis {found.axis}')
        check(abs(numpy.ptp(found.angle) - (end - start)) < 15, f'{start} to {end}: angles over {numpy.ptp(found.angle)} degrees')
    n = random.normal(size=(400, 3))
    n /= numpy.linalg.norm(n, axis=1)[:, None]
    check(not Cylinder(5 * n, n, numpy.ones(400)).is_one, 'a sphere is a cylinder')
    cap = n[n[:, 2] > .9]
    check(not Cylinder(5 * cap, cap, numpy.ones(len(cap))).is_one, 'a cap is a cylinder')
    flat = numpy.c_[random.uniform(size=(400, 2)), numpy.zeros(400)]
    check(not Cylinder(flat, numpy.tile([0., 0., 1.], (400, 1)), numpy.ones(400)).is_one, 'a plane is a cylinder')


def with_matplotlib(program, folder):
    cubes = solve(program, folder, 'cubes', 'cubes/cubes.prm', 'Refinement/Global cycles=1', 'Load steps=2')
    fit = solve(program, folder, 'press fit', 'shapes/press-fit.prm')
    draw('plot_pressure.py', cubes, ['pressure.png'])
    draw('plot_pressure.py', cubes, ['pressure.png'], '--centre', '-0.5,0.5,0', '--field', 'recovered_pressure')
    draw('plot_pressure.py', fit, ['pressure.png', 'pressure-unrolled.png'])
    draw('plot_curve.py', cubes, ['curve.png'], 't', 'mean pressure')
    foreign(cubes, 'plot_curve.py', 'curve.png')
    foreign(fit, 'plot_pressure.py', 'pressure-unrolled.png')
    inside_axes(fit)
    cylinders()
    for tool, arguments, words in (('plot_pressure.py', [folder], 'summary.json'), ('plot_pressure.py', [cubes, '--pair', 'x'], 'interface'),
                                   ('plot_curve.py', [fit], 'load steps'), ('plot_curve.py', [cubes, 'nothing'], 'active nodes'),
                                   ('plot_pressure.py', [cubes, '--centre', '1,2'], 'X,Y,Z')):
        run = call(tool, *arguments)
        check(run.returncode != 0 and words in run.stderr and 'Traceback' not in run.stderr, f'{tool} {arguments}: {run.returncode}, {run.stderr}')


def with_vtk(program, folder):
    cubes = solve(program, folder, 'cubes', 'cubes/cubes.prm', 'Refinement/Global cycles=1', 'Refinement/Adaptive cycles=1')
    all_of_them = [f'{name}.png' for name in ('mesh', 'displacement', 'von-mises', 'contact-pressure', 'gap')]
    draw('plot_pressure.py', cubes, ['pressure.png'])
    draw('render.py', cubes, all_of_them)
    draw('render.py', cubes, all_of_them + ['isosurfaces.png'], '--deform', '2', '--clip', '0,-1,0', '--view', '-1,-2,1', '--isosurfaces', 'stress_ZZ')
    foreign(cubes, 'render.py', 'gap.png')
    for arguments, words in (([folder], 'summary.json'), ([cubes, '--view', '1,2'], '3 numbers'), ([cubes, '--isosurfaces', 'heat'], 'no field'),
                             ([cubes, '--clip', '0,0,1', '--focus', '0,0,-9,1'], 'leaves nothing')):
        run = call('render.py', *arguments)
        check(run.returncode != 0 and words in run.stderr and 'Traceback' not in run.stderr, f'render.py {arguments}: {run.returncode}, {run.stderr}')
    read_blocks(cubes)


def read_blocks(folder):
    """What VTK makes of the files in results.pvd (whose own reader only ParaView has): tensors, vectors, as many points and cells as
    the run has."""
    import json
    import xml.etree.ElementTree
    import vtk
    grids, names = [], []
    for entry in xml.etree.ElementTree.parse(os.path.join(folder, 'results.pvd')).iter('DataSet'):
        names.append(entry.get('name'))
        reader = vtk.vtkXMLPUnstructuredGridReader()
        reader.SetFileName(os.path.join(folder, entry.get('file')))
        reader.Update()
        grids.append(reader.GetOutput())
    check(names[:2] == ['body upper', 'body lower'] and len(names) == 4 and all('interface' in name for name in names[2:]), f'blocks {names}')
    with open(os.path.join(folder, 'summary.json')) as f:
        last = json.load(f)['cycles'][-1]
    check(sum(g.GetNumberOfCells() for g in grids[:2]) == last['cells'], 'number of cells')
    # Hanging nodes are no unknowns.
    n = sum(g.GetNumberOfPoints() for g in grids[:2])
    check(last['dofs'] / 3 <= n < 1.3 * last['dofs'] / 3, f'{n} points, {last["dofs"]} unknowns')
    points = grids[0].GetPointData()
    check(points.GetTensors() is not None and points.GetTensors().GetName() == 'stress' and points.GetVectors().GetName() == 'displacement', 'no tensor')
    check(points.GetArray('stress').GetComponentName(3) == 'XY', 'names of components')
    check(grids[0].GetCellData().GetArray('indicator') is not None, 'no indicator')


def main():
    program, what = sys.argv[1:3]
    if what == 'vtk':
        missing = [tool for tool in ('xvfb-run', 'xauth') if not any(os.access(os.path.join(p, tool), os.X_OK) for p in os.environ['PATH'].split(os.pathsep))]
        try:
            import vtk  # noqa: F401
        except ImportError:
            missing.append('python3-vtk9')
        if missing:
            print('skipped, not installed: ' + ', '.join(missing))
            sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as folder:
        (with_vtk if what == 'vtk' else with_matplotlib)(program, folder)
    for failure in FAILURES:
        print('FAILED:', re.sub(r'\n', '\n  ', failure))
    sys.exit(1 if FAILURES else 0)


if __name__ == '__main__':
    main()
