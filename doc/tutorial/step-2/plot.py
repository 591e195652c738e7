#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Left the adaptive mesh on the plane of symmetry with the von Mises stress, right the contact pressure on the tread, seen
from below.

usage: plot.py FOLDER PICTURE.png (Debian: python3-vtk9; without a display under xvfb-run -a)
"""
import sys

import vtk


def read(path):
    reader = vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputConnection(reader.GetOutputPort())
    surface.Update()
    return surface.GetOutput()


def view(data, field, largest, title, focus, position, up, scale, viewport):
    colours = vtk.vtkLookupTable()
    colours.SetHueRange(.66, 0.)
    colours.SetSaturationRange(.35, .8)
    colours.SetValueRange(1., .9)
    colours.SetTableRange(0., largest)
    colours.Build()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(field)
    mapper.SetLookupTable(colours)
    mapper.SetUseLookupTableScalarRange(True)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetLineWidth(.5)
    actor.GetProperty().LightingOff()
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(4)
    bar.SetWidth(.12)
    bar.SetHeight(.35)
    bar.SetPosition(.85, .6)
    bar.SetLabelFormat('%.0f')
    bar.UnconstrainedFontSizeOn()
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0, 0, 0)
        text.SetFontSize(18)
        text.ItalicOff()
        text.ShadowOff()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetViewport(*viewport)
    renderer.AddActor(actor)
    renderer.AddActor(bar)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(f + 100 * p for f, p in zip(focus, position)))
    camera.SetViewUp(*up)
    camera.SetParallelScale(scale)
    renderer.ResetCameraClippingRange()
    return renderer


def main():
    folder, picture = sys.argv[1:]
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(1400, 700)
    window.AddRenderer(view(read(folder + '/bodies.pvtu'), 'von_Mises', 60., 'von Mises', (0, -9, 0), (.12, .08, -1), (0, 1, 0), 29,
                            (0, 0, .5, 1)))
    window.AddRenderer(view(read(folder + '/contact-contact.pvtu'), 'pressure', 60., 'pressure', (0, -20, 6), (0, -1, 0), (0, 0, 1), 8,
                            (.5, 0, 1, 1)))
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if __name__ == '__main__':
    main()
