#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Renders the results in a folder: mesh.png (the adaptive mesh, bodies a little apart), displacement.png (isolines of
the size of the displacement on the deformed bodies), pressure.png (contact pressure on the nonmortar surfaces) and, if
asked for, isosurfaces.png (surfaces of equal stress or displacement inside of the bodies).

usage: render.py FOLDER [--view X,Y,Z] [--up X,Y,Z] [--deform FACTOR] [--clip X,Y,Z] [--focus X,Y,Z,RADIUS]
                        [--lift DISTANCE] [--pressure-view X,Y,Z] [--isosurfaces FIELD] [--levels N]

  --view      direction from the model to the eye (default 1,-2,0.6)
  --deform    how much the displacement is exaggerated (default 1)
  --clip      normal of a plane through the middle (or the focus) that cuts the bodies open, seen from its side
  --focus     middle and radius of what the pictures of the bodies show (default all)
  --lift      moves the first body up by this length in mesh.png
  --isosurfaces  of a field in bodies.pvtu: von_Mises, stress_z, ..., or displacement for its size. Values are halved from surface to
              surface, beginning with half of the largest; of a displacement they are at equal distances in each body. A plane
              --clip cuts the surfaces open
  --levels    number of isosurfaces (default 7)

Needs VTK and numpy for Python (Debian: python3-vtk9) and, without a display, xvfb: xvfb-run -a render.py FOLDER
"""
import argparse
import glob
import os
import sys

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy


def vector(text):
    return [float(x) for x in text.split(',')]


def read(path):
    reader = vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    if reader.GetOutput().GetNumberOfCells() == 0:
        sys.exit(f'render.py: {path} has no cells.')
    return reader.GetOutput()


def chain(*filters):
    for first, second in zip(filters, filters[1:]):
        second.SetInputConnection(first.GetOutputPort())
    filters[-1].Update()
    return filters[-1].GetOutput()


def warped(grid, factor):
    grid.GetPointData().SetActiveVectors('displacement')
    warp = vtk.vtkWarpVector()
    warp.SetInputData(grid)
    warp.SetScaleFactor(factor)
    warp.Update()
    return warp.GetOutput()


def clipped(grid, normal, middle):
    """Whole cells on one side, so that the mesh inside can be seen."""
    plane = vtk.vtkPlane()
    plane.SetNormal(*[-n for n in normal])
    plane.SetOrigin(*middle)
    cut = vtk.vtkExtractGeometry()
    cut.SetInputData(grid)
    cut.SetImplicitFunction(plane)
    cut.ExtractInsideOff()
    cut.ExtractBoundaryCellsOff()
    cut.Update()
    return cut.GetOutput()


def part(grid, body):
    threshold = vtk.vtkThreshold()
    threshold.SetInputData(grid)
    threshold.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, 'body')
    threshold.SetLowerThreshold(body - .1)
    threshold.SetUpperThreshold(body + .1)
    threshold.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_BETWEEN)
    threshold.Update()
    return threshold.GetOutput()


def surface_of(data):
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(data)
    surface.Update()
    return surface.GetOutput()


def smooth(data):
    """With normals at the points, except at sharp edges."""
    clean = vtk.vtkCleanPolyData()
    clean.SetInputData(data)
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(clean.GetOutputPort())
    normals.SetFeatureAngle(40.)
    normals.Update()
    return normals.GetOutput()


def magnitude(data):
    calculator = vtk.vtkArrayCalculator()
    calculator.SetInputData(data)
    calculator.AddVectorArrayName('displacement')
    calculator.SetFunction('mag(displacement)')
    calculator.SetResultArrayName('size')
    calculator.Update()
    return calculator.GetOutput()


def colours(low, high):
    table = vtk.vtkColorTransferFunction()
    table.SetColorSpaceToLab()
    for x, colour in ((0., (.23, .30, .75)), (.5, (.93, .93, .93)), (1., (.71, .02, .15))):
        table.AddRGBPoint(low + x * (high - low), *colour)
    return table


def heat(low, high):
    table = vtk.vtkColorTransferFunction()
    for x, colour in ((0., (.93, .93, .90)), (.02, (.99, .90, .60)), (.35, (.99, .60, .24)), (.7, (.85, .15, .12)),
                      (1., (.45, 0., .15))):
        table.AddRGBPoint(low + x * (high - low), *colour)
    return table


def actor(data, colour=None, scalars=None, limits=None, edges=False):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    if scalars:
        data.GetPointData().SetActiveScalars(scalars)
        mapper.SetLookupTable(colours(*limits))
        mapper.UseLookupTableScalarRangeOn()
    else:
        mapper.ScalarVisibilityOff()
        result.GetProperty().SetColor(*colour)
    if edges:
        result.GetProperty().EdgeVisibilityOn()
        result.GetProperty().SetEdgeColor(.15, .15, .2)
        result.GetProperty().SetLineWidth(.8)
    result.GetProperty().SetAmbient(.35)
    result.GetProperty().SetDiffuse(.65)
    return result


def levels(grid, n):
    """Values between those of the bodies: n shares of the range of each body."""
    values = []
    bodies = int(grid.GetPointData().GetArray('body').GetRange()[1]) + 1
    for body in range(bodies):
        low, high = part(grid, body).GetPointData().GetArray('size').GetRange()
        count = max(2, n // bodies)
        values += [low + (i + .5) / count * (high - low) for i in range(count)]
    return values


def halved(grid, field, n):
    """Half of the value of largest size, a quarter of it, and so on."""
    low, high = grid.GetPointData().GetArray(field).GetRange()
    return [(high if high >= -low else low) * .5 ** (i + 1) for i in range(n)]


def open_half(data, normal, middle):
    """What lies behind a plane, cut smoothly."""
    plane = vtk.vtkPlane()
    plane.SetNormal(*[-n for n in normal])
    plane.SetOrigin(*middle)
    cut = vtk.vtkClipPolyData()
    cut.SetInputData(data)
    cut.SetClipFunction(plane)
    cut.Update()
    return cut.GetOutput()


def joined(grid):
    """The same with points that the cells of a body share, which the file does not have."""
    points = vtk_to_numpy(grid.GetPoints().GetData())
    body = vtk_to_numpy(grid.GetPointData().GetArray('body'))
    _, kept, number = numpy.unique(numpy.column_stack([points, body]), axis=0, return_index=True, return_inverse=True)
    cells = vtk.vtkCellArray()
    cells.SetData(grid.GetCells().GetOffsetsArray(),
                  numpy_to_vtkIdTypeArray(number.ravel()[vtk_to_numpy(grid.GetCells().GetConnectivityArray())].astype(numpy.int64), deep=True))
    result = vtk.vtkUnstructuredGrid()
    result.SetPoints(vtk.vtkPoints())
    result.GetPoints().SetData(numpy_to_vtk(points[kept], deep=True))
    result.SetCells(grid.GetCellTypesArray(), cells)
    for i in range(grid.GetPointData().GetNumberOfArrays()):
        values = grid.GetPointData().GetArray(i)
        array = numpy_to_vtk(vtk_to_numpy(values)[kept], deep=True)
        array.SetName(values.GetName())
        result.GetPointData().AddArray(array)
    return result


def isosurfaces(grid, field, n, normal, middle):
    """Actors: the surfaces (the first one is what a bar is for), and the hull of the bodies, which can be seen through."""
    grid = joined(grid)
    values = sorted(levels(grid, n) if field == 'size' else halved(grid, field, n))
    grid.GetPointData().SetActiveScalars(field)
    contour = vtk.vtkContourFilter()
    contour.SetInputData(grid)
    contour.SetNumberOfContours(0)
    for i, value in enumerate(values):
        contour.SetValue(i, value)
    contour.Update()
    surfaces, hull = smooth(contour.GetOutput()), surface_of(grid)
    if normal:
        surfaces, hull = (open_half(data, normal, middle) for data in (surfaces, hull))
    shown = actor(surfaces, scalars=field, limits=(values[0], values[-1]))
    if field != 'size' and values[0] > 0.:
        table = vtk.vtkLookupTable()
        table.SetScaleToLog10()
        table.SetTableRange(values[0], values[-1])
        table.SetHueRange(.62, 0.)
        table.Build()
        shown.GetMapper().SetLookupTable(table)
    shade = actor(hull, colour=(.6, .65, .7))
    shade.GetProperty().SetOpacity(.12)
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(hull)
    edges.SetFeatureAngle(40.)
    edges.ColoringOff()
    edges.Update()
    return shown, shade, actor(edges.GetOutput(), colour=(.3, .3, .3))


class Picture:
    def __init__(self, arguments, view):
        self.renderer = vtk.vtkRenderer()
        self.renderer.SetBackground(1., 1., 1.)
        self.arguments = arguments
        self.view = view
        self.has_bar = False

    def add(self, *actors):
        for a in actors:
            self.renderer.AddActor(a)

    def bar(self, a, title):
        self.has_bar = True
        bar = vtk.vtkScalarBarActor()
        bar.SetLookupTable(a.GetMapper().GetLookupTable())
        bar.SetTitle(title)
        bar.SetNumberOfLabels(5)
        bar.SetMaximumWidthInPixels(90)
        bar.SetMaximumHeightInPixels(450)
        bar.SetPosition(.86, .25)
        bar.UnconstrainedFontSizeOn()
        bar.GetLabelTextProperty().SetFontSize(16)
        bar.GetTitleTextProperty().SetFontSize(20)
        bar.SetLabelFormat('%.3g')
        for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
            text.SetColor(0., 0., 0.)
            text.ItalicOff()
            text.ShadowOff()
        self.renderer.AddActor2D(bar)

    def write(self, path, focus=None):
        window = vtk.vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(8)
        window.SetSize(1200, 900)
        window.AddRenderer(self.renderer)
        camera = self.renderer.GetActiveCamera()
        bounds = self.renderer.ComputeVisiblePropBounds()
        middle = focus[:3] if focus else [.5 * (bounds[2 * c] + bounds[2 * c + 1]) for c in range(3)]
        camera.SetFocalPoint(*middle)
        camera.SetPosition(*[m + v for m, v in zip(middle, self.view)])
        camera.SetViewUp(*vector(self.arguments.up))
        camera.ParallelProjectionOn()
        self.renderer.ResetCamera()
        if focus:
            camera.SetFocalPoint(*middle)
            camera.SetPosition(*[m + 10 * focus[3] * v for m, v in zip(middle, self.view)])
            camera.SetParallelScale(focus[3])
            self.renderer.ResetCameraClippingRange()
        else:
            camera.Zoom(1.15)
        # Room for the bar on the right.
        camera.SetWindowCenter(.12 if self.has_bar else 0., 0.)
        window.Render()
        image = vtk.vtkWindowToImageFilter()
        image.SetInput(window)
        writer = vtk.vtkPNGWriter()
        writer.SetInputConnection(image.GetOutputPort())
        writer.SetFileName(path)
        writer.Write()
        print(path)


BODY_COLOURS = ((.95, .83, .62), (.62, .77, .90), (.72, .88, .66), (.90, .70, .75))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folder')
    parser.add_argument('--view', default='1,-2,0.6')
    parser.add_argument('--up', default='0,0,1')
    parser.add_argument('--deform', type=float, default=1.)
    parser.add_argument('--clip')
    parser.add_argument('--focus')
    parser.add_argument('--lift', type=float, default=0.)
    parser.add_argument('--pressure-view', default='0.3,-0.8,1')
    parser.add_argument('--isosurfaces')
    parser.add_argument('--levels', type=int, default=7)
    arguments = parser.parse_args()
    view = vector(arguments.view)
    focus = vector(arguments.focus) if arguments.focus else None

    grid = magnitude(warped(read(os.path.join(arguments.folder, 'bodies.pvtu')), arguments.deform))
    middle = focus[:3] if focus else grid.GetCenter()
    shown = clipped(grid, vector(arguments.clip), middle) if arguments.clip else grid

    picture = Picture(arguments, view)
    for body in range(int(grid.GetPointData().GetArray('body').GetRange()[1]) + 1):
        a = actor(surface_of(part(shown, body)), colour=BODY_COLOURS[body % 4], edges=True)
        if body == 0:
            a.SetPosition(0., 0., arguments.lift)
        picture.add(a)
    picture.write(os.path.join(arguments.folder, 'mesh.png'), focus)

    picture = Picture(arguments, view)
    surface = smooth(surface_of(shown))
    limits = grid.GetPointData().GetArray('size').GetRange()
    coloured = actor(surface, scalars='size', limits=limits)
    surface.GetPointData().SetActiveScalars('size')
    contour = vtk.vtkContourFilter()
    contour.SetInputData(surface)
    # Every body has about the same number of lines: the sizes of all points at equal shares.
    contour.SetNumberOfContours(0)
    for i, value in enumerate(levels(grid, 36)):
        contour.SetValue(i, value)
    contour.Update()
    lines = actor(contour.GetOutput(), colour=(.1, .1, .1))
    lines.GetProperty().SetLineWidth(1.2)
    picture.add(coloured, lines)
    picture.bar(coloured, '|u|')
    picture.write(os.path.join(arguments.folder, 'displacement.png'), focus)

    if arguments.isosurfaces:
        field = 'size' if arguments.isosurfaces == 'displacement' else arguments.isosurfaces
        if not grid.GetPointData().HasArray(field):
            sys.exit(f'render.py: bodies.pvtu has no field "{field}".')
        picture = Picture(arguments, view)
        surfaces, *hull = isosurfaces(grid, field, arguments.levels, vector(arguments.clip) if arguments.clip else None, middle)
        picture.add(surfaces, *hull)
        picture.bar(surfaces, arguments.isosurfaces.replace('_', ' '))
        picture.write(os.path.join(arguments.folder, 'isosurfaces.png'), focus)

    picture = Picture(arguments, vector(arguments.pressure_view))
    surfaces = [smooth(surface_of(warped(read(path), arguments.deform)))
                for path in sorted(glob.glob(os.path.join(arguments.folder, 'contact-*.pvtu')))]
    limits = (0., max(s.GetPointData().GetArray('pressure').GetRange()[1] for s in surfaces))
    for surface in surfaces:
        a = actor(surface, scalars='pressure', limits=limits)
        a.GetMapper().SetLookupTable(heat(*limits))
        lines = vtk.vtkFeatureEdges()
        lines.SetInputData(surface)
        lines.ColoringOff()
        lines.Update()
        border = actor(lines.GetOutput(), colour=(.3, .3, .3))
        picture.add(a, border)
    picture.bar(a, 'pressure')
    picture.write(os.path.join(arguments.folder, 'pressure.png'))


if __name__ == '__main__':
    main()
