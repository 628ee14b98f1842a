# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a cut through the mesh, colored by a metric, and checks that there is something to see."""

import os
import pathlib

from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
import numpy

from house_pipeline import house


def draw(quality, file):
    view = simple.CreateRenderView(ViewSize=[1200, 800])
    cut = simple.Slice(Input=quality, Crinkleslice=1)
    cut.SliceType.Origin = [12.3, 7.1, 5.0]
    cut.SliceType.Normal = [0.0, 1.0, 0.0]
    display = simple.Show(cut, view)
    display.SetRepresentationType("Surface With Edges")
    simple.ColorBy(display, ("CELLS", "CellSquish"))
    display.RescaleTransferFunctionToDataRange()
    display.SetScalarBarVisibility(view, True)
    simple.Render(view)  # the first rendering moves the camera
    view.CameraPosition = [25.0, -75.0, 24.0]
    view.CameraFocalPoint = [25.0, 7.0, 14.0]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    simple.Render(view)
    simple.SaveScreenshot(str(file), view)


def colors_in(file):
    """Number of colors where neither the color bar nor the axes are."""
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    width, height, _ = reader.GetOutput().GetDimensions()
    middle = pixels.reshape(height, width, -1)[height // 5 :, width // 6 : 5 * width // 6, :3]
    return len(numpy.unique(middle.reshape(-1, 3), axis=0))


def main():
    file = pathlib.Path(os.environ["ATRIA_OUTPUT"]) / "cut.png"
    file.unlink(missing_ok=True)
    draw(house().quality, file)
    colors = colors_in(file)
    assert colors > 100, f"{file} has only {colors} colors"
    print(f"{file}: {colors} colors")


main()
