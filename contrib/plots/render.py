#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Renders the bodies and contact surfaces of a result folder, as far as it has their files:

  mesh.png                the cells, one colour for each body
  displacement.png        size of the displacement, with isolines, on the deformed bodies
  von-mises.png           von Mises stress on the deformed bodies
  contact-pressure.png    on the nonmortar surfaces, seen from where they face; the smoothed one where nodes scatter
  gap.png                 what is left of the gap, on the same surfaces
  isosurfaces.png         with --isosurfaces: surfaces of equal stress or displacement inside of the bodies
"""
import argparse
import glob
import os
import re
import shutil
import sys

import picture

TOOL = 'render.py'


def without_display():
    """Starts again with a display that nobody sees: VTK draws by OpenGL."""
    if os.environ.get('DISPLAY') or os.environ.get('SIGNORINI_RENDER_AGAIN'):
        return
    if not shutil.which('xvfb-run') or not shutil.which('xauth'):
        picture.fail(TOOL, 'there is no display. Install xvfb and xauth (Debian: apt-get install xvfb xauth): they stand in for one.')
    os.environ['SIGNORINI_RENDER_AGAIN'] = '1'
    os.execvp('xvfb-run', ['xvfb-run', '-a', '-s', '-screen 0 640x480x24', sys.executable] + sys.argv)


def vector(text, n=3):
    try:
        values = [float(x) for x in text.split(',')]
    except ValueError:
        values = []
    if len(values) != n:
        raise argparse.ArgumentTypeError(f'"{text}" should be {n} numbers with commas between them')
    return values


def arguments_of_line():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog='Needs python3-vtk9 and, without a display, xvfb and xauth (names of Debian packages).')
    parser.add_argument('folder', metavar='FOLDER', help='of the results')
    parser.add_argument('--deform', type=float, default=1., metavar='FACTOR', help='how much the displacement is exaggerated (default 1)')
    parser.add_argument('--view', type=vector, default=[1., -2., .6], metavar='X,Y,Z', help='direction from the model to the eye (default 1,-2,0.6)')
    parser.add_argument('--up', type=vector, default=[0., 0., 1.], metavar='X,Y,Z', help='what is up in the pictures (default 0,0,1)')
    parser.add_argument('--pressure-view', type=vector, metavar='X,Y,Z', help='the same for the contact surfaces (default: from where they face)')
    parser.add_argument('--clip', type=lambda text: text if text == 'none' else vector(text), metavar='X,Y,Z', help='normal of a plane through the middle (or the '
                        'focus) that cuts the bodies open, or none (default: von-mises.png only, through the largest stress)')
    parser.add_argument('--focus', type=lambda text: vector(text, 4), metavar='X,Y,Z,R', help='middle and radius of what the pictures of the bodies show (default all)')
    parser.add_argument('--lift', type=float, default=0., metavar='LENGTH', help='moves the first body up in mesh.png')
    parser.add_argument('--isosurfaces', metavar='FIELD', help='von_Mises, stress_XX to stress_XZ or displacement (its size): values are halved from surface to '
                        'surface, those of a displacement at equal distances in each body')
    parser.add_argument('--levels', type=int, default=7, metavar='N', help='number of isosurfaces (default 7)')
    return parser.parse_args(picture.command_line())


if __name__ == '__main__':
    ARGUMENTS = arguments_of_line()
    try:
        import vtk
    except ImportError:
        picture.fail(TOOL, 'VTK for Python is missing (Debian: apt-get install python3-vtk9).')
    without_display()
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    import numpy
    from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    HEAT = LinearSegmentedColormap.from_list('heat', ((0., (.93, .93, .90)), (.02, (.99, .90, .60)), (.35, (.99, .60, .24)), (.7, (.85, .15, .12)), (1., (.45, 0., .15))))
    COOL = LinearSegmentedColormap.from_list('cool', ((0., (.23, .30, .75)), (.5, (.93, .93, .93)), (1., (.71, .02, .15))))

BODY_COLOURS = ((.95, .83, .62), (.62, .77, .90), (.72, .88, .66), (.90, .70, .75))


def read(path):
    reader = vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    if reader.GetOutput().GetNumberOfCells() == 0:
        picture.fail(TOOL, f'{path} has no cells.')
    return reader.GetOutput()


def output_of(kind, data, **settings):
    """Runs a filter of VTK on data."""
    made = kind()
    made.SetInputData(data)
    for name, value in settings.items():
        getattr(made, name)(*value if isinstance(value, tuple) else (value,))
    made.Update()
    return made.GetOutput()


def add_array(data, name, values):
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.GetPointData().AddArray(array)


def warped(grid, factor):
    """Moved by the displacement, with its size and single components of the stress as fields."""
    points = grid.GetPointData()
    points.SetActiveVectors('displacement')
    add_array(grid, 'size of displacement', numpy.linalg.norm(vtk_to_numpy(points.GetArray('displacement')), axis=1))
    if points.HasArray('stress'):
        for c, name in enumerate(('XX', 'YY', 'ZZ', 'XY', 'YZ', 'XZ')):
            add_array(grid, f'stress_{name}', vtk_to_numpy(points.GetArray('stress'))[:, c])
    return output_of(vtk.vtkWarpVector, grid, SetScaleFactor=factor)


def plane_of(normal, middle):
    plane = vtk.vtkPlane()
    plane.SetNormal(*[-n for n in normal])
    plane.SetOrigin(*middle)
    return plane


def selected(values, cells_or_points):
    array = numpy_to_vtk(numpy.ascontiguousarray(vtk_to_numpy(values)[cells_or_points]), deep=True)
    array.SetName(values.GetName())
    return array


def nodes_of_cells(grid):
    """Where the nodes of each cell start in a list, and the list."""
    return [vtk_to_numpy(array).astype(numpy.int64) for array in (grid.GetCells().GetOffsetsArray(), grid.GetCells().GetConnectivityArray())]


def subset(grid, chosen):
    """Those cells. Not by filters: vtkExtractCells of VTK 9.3 (Debian 13), which they use, ends with a segmentation fault."""
    cells = numpy.flatnonzero(chosen)
    result = vtk.vtkUnstructuredGrid()
    if len(cells) == 0:
        return result
    starts, nodes = nodes_of_cells(grid)
    points, nodes = numpy.unique(numpy.concatenate([nodes[starts[c]:starts[c + 1]] for c in cells]), return_inverse=True)
    starts = numpy.concatenate(([0], numpy.cumsum(numpy.diff(starts)[cells])))
    array = vtk.vtkCellArray()
    array.SetData(*(numpy_to_vtk(a.astype(numpy.int64), deep=True, array_type=vtk.VTK_ID_TYPE) for a in (starts, nodes.ravel())))
    result.SetPoints(vtk.vtkPoints())
    result.GetPoints().SetData(selected(grid.GetPoints().GetData(), points))
    result.SetCells(selected(grid.GetCellTypesArray(), cells), array)
    for source, target, places in ((grid.GetPointData(), result.GetPointData(), points), (grid.GetCellData(), result.GetCellData(), cells)):
        for k in range(source.GetNumberOfArrays()):
            target.AddArray(selected(source.GetArray(k), places))
    return result


def clipped(grid, normal, middle):
    """Whole cells on one side, so that the mesh inside can be seen."""
    starts, nodes = nodes_of_cells(grid)
    behind = (vtk_to_numpy(grid.GetPoints().GetData()) - numpy.array(middle)) @ numpy.array(normal) < 0.
    cut = subset(grid, numpy.logical_and.reduceat(behind[nodes], starts[:-1]))
    if cut.GetNumberOfCells() == 0:
        picture.fail(TOOL, '--clip leaves nothing of the bodies.')
    return cut


def part(grid, body):
    return subset(grid, vtk_to_numpy(grid.GetCellData().GetArray('body')) == body)


def n_bodies(grid):
    return int(grid.GetCellData().GetArray('body').GetRange()[1]) + 1


def surface_of(data):
    return output_of(vtk.vtkDataSetSurfaceFilter, data)


def surfaces_of_bodies(grid):
    """The surface of each body by itself: points of tied ones are not merged."""
    parts = [part(grid, body) for body in range(n_bodies(grid))]
    return [smooth(surface_of(p)) for p in parts if p.GetNumberOfCells() > 0]


def smooth(data):
    """With normals at the points, except at sharp edges."""
    return output_of(vtk.vtkPolyDataNormals, output_of(vtk.vtkCleanPolyData, data), SetFeatureAngle=40.)


def values_of(data, field):
    return vtk_to_numpy(data.GetPointData().GetArray(field))


def actor(data, colour=None, field=None, shown=None, edges=False, opacity=1.):
    """shown: norm and colour map of matplotlib."""
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    if field:
        norm, colours = shown
        table = numpy.ascontiguousarray((255 * colours(norm(values_of(data, field)))).astype(numpy.uint8))
        array = numpy_to_vtk(table, deep=True)
        array.SetName('colour of ' + field)
        data.GetPointData().AddArray(array)
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(array.GetName())
        mapper.SetColorModeToDirectScalars()
    else:
        mapper.ScalarVisibilityOff()
        result.GetProperty().SetColor(*colour)
    if edges:
        result.GetProperty().EdgeVisibilityOn()
        result.GetProperty().SetEdgeColor(.15, .15, .2)
        result.GetProperty().SetLineWidth(.8)
    # Little shade: colours should be those of the bar.
    result.GetProperty().SetAmbient(.6)
    result.GetProperty().SetDiffuse(.4)
    result.GetProperty().SetOpacity(opacity)
    return result


def edges_of(data):
    """Its border and its sharp edges, without those where a face has two or four smaller ones beside it."""
    edges = output_of(vtk.vtkFeatureEdges, data, SetFeatureAngle=40., SetColoring=0)
    border = output_of(vtk.vtkFeatureEdges, data, SetFeatureEdges=0, SetNonManifoldEdges=0, SetColoring=0)
    if border.GetNumberOfLines() > 0:
        x = vtk_to_numpy(border.GetPoints().GetData())
        ends = x[vtk_to_numpy(border.GetLines().GetConnectivityArray()).reshape(-1, 2)]
        places = numpy.round(numpy.concatenate([x, ends.mean(axis=1)]) / (1e-5 * (numpy.ptp(x, axis=0).max() or 1.))).astype(numpy.int64)
        _, number = numpy.unique(places, axis=0, return_inverse=True)
        number = number.ravel()
        hanging = numpy.intersect1d(number[:len(x)], number[len(x):])
        is_inside = numpy.zeros(number.max() + 1, bool)
        is_inside[hanging] = True
        lines = vtk_to_numpy(edges.GetLines().GetConnectivityArray()).reshape(-1, 2)
        y = vtk_to_numpy(edges.GetPoints().GetData())[lines]
        inside = {tuple(p) for p in places[is_inside[number]]}
        scale = 1e-5 * (numpy.ptp(x, axis=0).max() or 1.)
        kept = vtk.vtkCellArray()
        for line, (a, b) in zip(lines, y):
            if not any(tuple(numpy.round(p / scale).astype(numpy.int64)) in inside for p in (a, b, .5 * (a + b))):
                kept.InsertNextCell(2, [int(i) for i in line])
        edges.SetLines(kept)
    return actor(edges, colour=(.3, .3, .3))


def contours(data, field, values):
    data.GetPointData().SetActiveScalars(field)
    contour = vtk.vtkContourFilter()
    contour.SetInputData(data)
    contour.SetNumberOfContours(0)
    for i, value in enumerate(values):
        contour.SetValue(i, value)
    contour.Update()
    return contour.GetOutput()


def levels(grid, field, n):
    """Values between those of the bodies: n shares of the range of each body."""
    values = []
    for body in range(n_bodies(grid)):
        of_body = part(grid, body)
        if of_body.GetNumberOfCells() > 0:
            low, high = of_body.GetPointData().GetArray(field).GetRange()
            count = max(2, n // n_bodies(grid))
            values += [low + (i + .5) / count * (high - low) for i in range(count)]
    return sorted(values)


def halved(grid, field, n):
    """Half of the value of largest size, a quarter of it, and so on."""
    low, high = grid.GetPointData().GetArray(field).GetRange()
    return sorted((high if high >= -low else low) * .5 ** (i + 1) for i in range(n))


class Scene:
    """Actors as an image that has all of them, or the surroundings of a point."""

    PIXELS = 1400

    def __init__(self, view, up):
        self.renderer = vtk.vtkRenderer()
        self.renderer.SetBackground(1., 1., 1.)
        self.eye = numpy.array(view) / numpy.linalg.norm(view)
        up = numpy.array(up, float)
        right = numpy.cross(up, self.eye)
        if numpy.linalg.norm(right) < 1e-3 * numpy.linalg.norm(up):
            right = numpy.cross(numpy.roll(up, 1), self.eye)
        self.right = right / numpy.linalg.norm(right)
        self.up = numpy.cross(self.eye, self.right)
        self.low, self.high = numpy.full(3, numpy.inf), numpy.full(3, -numpy.inf)

    def add(self, *actors):
        for a in actors:
            data = a.GetMapper().GetInput()
            if data.GetNumberOfPoints() == 0:
                continue
            self.renderer.AddActor(a)
            x = vtk_to_numpy(data.GetPoints().GetData()) + numpy.array(a.GetPosition())
            x = x @ numpy.c_[self.right, self.up, self.eye]
            self.low, self.high = numpy.minimum(self.low, x.min(axis=0)), numpy.maximum(self.high, x.max(axis=0))

    def image(self, focus=None):
        size = numpy.linalg.norm(self.high - self.low) or 1.
        middle, half = .5 * (self.low + self.high), .5 * (self.high - self.low)
        if focus:
            middle[:2], half[:2] = [numpy.dot(focus[:3], d) for d in (self.right, self.up)], focus[3]
        half = numpy.maximum(half[:2], .05 * max(half[:2]) or 1.) * 1.02
        pixels = numpy.maximum((self.PIXELS * half / max(half)).astype(int), 80)
        window = vtk.vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(8)
        window.SetSize(*(int(p) for p in pixels))
        window.AddRenderer(self.renderer)
        camera = self.renderer.GetActiveCamera()
        point = middle[0] * self.right + middle[1] * self.up + middle[2] * self.eye
        camera.SetFocalPoint(*point)
        camera.SetPosition(*(point + 2 * size * self.eye))
        camera.SetViewUp(*self.up)
        camera.ParallelProjectionOn()
        camera.SetParallelScale(half[1])
        self.renderer.ResetCameraClippingRange()
        window.Render()
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.ReadFrontBufferOff()
        grab.Update()
        data = grab.GetOutput()
        width, height, _ = data.GetDimensions()
        return vtk_to_numpy(data.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]


def write(folder, name, image, title, shown=None, label='', is_cut=False):
    """The image with a title and, of a field, its colours."""
    height, width = image.shape[:2]
    scale = 7.5 / max(height, width)
    figure = plt.figure(figsize=(width * scale, height * scale))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.imshow(image, interpolation='antialiased')
    axes.set_axis_off()
    figure.text(0, 1 + .15 / (height * scale), title, fontsize=12, va='bottom')
    if shown:
        norm, colours = shown
        tall = max(height * scale, 2.6)
        bar = figure.add_axes((1 + .25 / (width * scale), .5 - .4 * tall / (height * scale), .22 / (width * scale), .8 * tall / (height * scale)))
        figure.colorbar(matplotlib.cm.ScalarMappable(norm, colours), cax=bar, label=label, extend='max' if is_cut else 'neither')
    picture.save(figure, folder, name, TOOL)
    plt.close(figure)


def limits(data, field):
    """Norm of the values, and whether single peaks are beyond: at edges and where loads end stresses may be singular."""
    values = numpy.concatenate([values_of(d, field) for d in data])
    high = numpy.quantile(values, .998)
    is_cut = values.max() > 1.5 * high > 0
    return Normalize(min(0., values.min()), (high if is_cut else values.max()) or 1.), is_cut


def deformed(factor):
    return 'deformed' if factor == 1 else 'not deformed' if factor == 0 else f'displacement times {factor:g}'


def cut_at_largest(grid, field, arguments):
    """A plane through the largest value across the coordinate axis that looks most toward the eye; None where it would take away
    (nearly) nothing, or all but nothing, of the bodies."""
    place = numpy.array(grid.GetPoint(int(numpy.argmax(values_of(grid, field)))))
    up, view = numpy.array(arguments.up), numpy.array(arguments.view)
    flat = numpy.abs(view) * (numpy.abs(up) < .5 * numpy.abs(up).max())
    k = int(numpy.argmax(flat if flat.max() > .2 * numpy.abs(view).max() else numpy.abs(view)))
    normal = numpy.zeros(3)
    normal[k] = numpy.sign(view[k])
    share = numpy.mean((vtk_to_numpy(grid.GetPoints().GetData()) - place) @ normal > 1e-6 * grid.GetLength())
    return plane_of(normal, place) if .02 < share < .9 else None


def opened(grid, plane):
    """The surfaces of the bodies behind a plane, and what it cuts."""
    cut = [output_of(vtk.vtkClipPolyData, surface, SetClipFunction=plane) for surface in surfaces_of_bodies(grid)]
    return cut, output_of(vtk.vtkCutter, grid, SetCutFunction=plane)


def draw_bodies(arguments, grid, title):
    focus = arguments.focus
    middle = focus[:3] if focus else grid.GetCenter()
    shown = clipped(grid, arguments.clip, middle) if arguments.clip and arguments.clip != 'none' else grid
    how = f'{title}, {deformed(arguments.deform)}'

    scene = Scene(arguments.view, arguments.up)
    for body in range(n_bodies(grid)):
        a = actor(surface_of(part(shown, body)), colour=BODY_COLOURS[body % 4], edges=True)
        if body == 0:
            a.SetPosition(*(arguments.lift * u for u in arguments.up))
        scene.add(a)
    write(arguments.folder, 'mesh', scene.image(focus), how)

    surfaces = surfaces_of_bodies(shown)
    for name, field, label in (('displacement', 'size of displacement', 'displacement'), ('von-mises', 'von_Mises', 'von Mises stress')):
        if not grid.GetPointData().HasArray(field):
            continue
        plane = cut_at_largest(grid, field, arguments) if field == 'von_Mises' and not arguments.clip else None
        outside, inside = opened(grid, plane) if plane else (surfaces, None)
        norm, is_cut = limits(outside + [inside] * bool(plane), field)
        look = norm, COOL if field != 'von_Mises' else plt.get_cmap('viridis')
        scene = Scene(arguments.view, arguments.up)
        if plane:
            scene.add(actor(inside, field=field, shown=look))
        for surface in outside:
            scene.add(actor(surface, field=field, shown=look), edges_of(surface))
            if field != 'von_Mises':
                # Every body has about the same number of lines.
                lines = actor(contours(surface, field, levels(grid, field, 36)), colour=(.1, .1, .1))
                lines.GetProperty().SetLineWidth(1.2)
                scene.add(lines)
        largest, cut = values_of(grid, field).max(), 'cut open where it is largest, ' if plane else ''
        write(arguments.folder, name, scene.image(focus), f'{how}\n{cut}largest {label}: {picture.number(largest)}', look, label, is_cut)


def draw_isosurfaces(arguments, grid, title):
    field = 'size of displacement' if arguments.isosurfaces == 'displacement' else arguments.isosurfaces
    if not grid.GetPointData().HasArray(field):
        picture.fail(TOOL, f'bodies.pvtu has no field "{arguments.isosurfaces}".')
    values = levels(grid, field, arguments.levels) if field == 'size of displacement' else halved(grid, field, arguments.levels)
    surfaces, hull = smooth(contours(grid, field, values)), surface_of(grid)
    if arguments.clip and arguments.clip != 'none':
        plane = plane_of(arguments.clip, arguments.focus[:3] if arguments.focus else grid.GetCenter())
        surfaces, hull = (output_of(vtk.vtkClipPolyData, data, SetClipFunction=plane) for data in (surfaces, hull))
    if surfaces.GetNumberOfCells() == 0:
        picture.fail(TOOL, f'there are no surfaces of equal "{arguments.isosurfaces}".')
    is_log = field != 'size of displacement' and values[0] > 0.
    look = (LogNorm if is_log else Normalize)(values[0], values[-1]), plt.get_cmap('turbo')
    scene = Scene(arguments.view, arguments.up)
    scene.add(actor(surfaces, field=field, shown=look), actor(hull, colour=(.6, .65, .7), opacity=.12), edges_of(hull))
    label = arguments.isosurfaces.replace('_', ' ')
    write(arguments.folder, 'isosurfaces', scene.image(arguments.focus), f'{title}\nsurfaces of equal {label}', look, label)


def view_of(surfaces):
    """From where most of the pressure is seen: along the mean normal, a little from the side."""
    total = numpy.zeros(3)
    for surface in surfaces:
        normal = vtk_to_numpy(surface.GetPointData().GetArray('normal'))
        total += (numpy.maximum(values_of(surface, 'pressure'), 0.)[:, None] * normal).sum(axis=0)
    weight = sum(numpy.maximum(values_of(s, 'pressure'), 0.).sum() for s in surfaces)
    if numpy.linalg.norm(total) < .2 * weight or weight == 0:
        return [1., -2., .6]
    total /= numpy.linalg.norm(total)
    side = numpy.array([.3, -.8, 0.]) if abs(total[2]) > .7 else numpy.array([0., 0., .6])
    return list(total + .7 * (side - (side @ total) * total))


def draw_contact(arguments, paths, title, is_smoothed):
    surfaces = [smooth(surface_of(warped(read(path), arguments.deform))) for path in paths]
    view = arguments.pressure_view or view_of(surfaces)
    for name, field, label, colours in (('contact-pressure', 'recovered pressure' if is_smoothed else 'pressure', 'contact pressure' + ', smoothed' * is_smoothed, HEAT), ('gap', 'gap', 'gap', plt.get_cmap('viridis_r'))):
        values = numpy.concatenate([values_of(s, field) for s in surfaces])
        low, high = values.min(), values.max()
        if field == 'gap':
            # Lengths that are rounding are zero.
            size = max(s.GetLength() for s in surfaces)
            low, high = (v if abs(v) > 1e-10 * size else 0. for v in (low, high))
        look = Normalize(min(0., low), high or 1.), colours
        scene = Scene(view, arguments.up)
        for surface in surfaces:
            scene.add(actor(surface, field=field, shown=look), edges_of(surface))
        of = f'largest {label}: {picture.number(high)}' if field != 'gap' else f'gap from {picture.number(low)} to {picture.number(high)}'
        if low == high == 0.:
            of = 'no contact pressure' if field != 'gap' else 'closed everywhere'
        write(arguments.folder, name, scene.image(), f'{title}, nonmortar side\n{of}', look if high > low else None, label)


def main(arguments):
    summary = picture.read_summary(arguments.folder, TOOL)
    title = summary.get('title', '') or os.path.basename(os.path.abspath(arguments.folder))
    bodies = os.path.join(arguments.folder, 'bodies.pvtu')
    pairs = [path for path in sorted(glob.glob(os.path.join(glob.escape(arguments.folder), 'contact-*.pvtu')))
             if not re.search(r'(-mortar|-step-\d+)\.pvtu$', path)]
    if not os.path.exists(bodies) and not pairs:
        picture.fail(TOOL, f'"{arguments.folder}" has neither bodies nor contact surfaces: were Output/Bodies and Output/Contact surfaces turned off?')
    if os.path.exists(bodies):
        grid = warped(read(bodies), arguments.deform)
        draw_bodies(arguments, grid, title)
        if arguments.isosurfaces:
            draw_isosurfaces(arguments, grid, title)
    if pairs:
        # All pairs have one scale.
        draw_contact(arguments, pairs, title, any(pair.get('scatter_is_told') for pair in summary.get('pairs', [])))


if __name__ == '__main__':
    main(ARGUMENTS)
