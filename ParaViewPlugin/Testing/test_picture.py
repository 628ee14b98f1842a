# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a cut through the mesh, colored by a metric, and checks that there is something to see."""

import os
import pathlib

from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
import numpy

from house_pipeline import house, render_cut


def draw(quality, file):
    view = simple.CreateRenderView(ViewSize=[1200, 800])
    render_cut(view, quality, ("CELLS", "CellSquish"), True)
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
