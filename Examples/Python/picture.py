#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a mesh cut open: elements behind a plane colored by size, and before it the patches without the house's front.

Usage: picture.py MESH.vtu PATCHES.vtpc PICTURE.png    (needs a display, such as xvfb-run gives)
"""

import sys

import vtkmodules.vtkInteractionStyle  # noqa: F401  (registers itself)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers itself)
from vtkmodules.vtkCommonColor import vtkNamedColors
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkPlane
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkImagingColor import vtkImageQuantizeRGBToIndex
from vtkmodules.vtkImagingCore import vtkImageMapToColors
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader, vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkDataSetMapper, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter,
)

# Colors of patches by the beginning of their name; the first that fits.
PATCH_COLORS = {
    "Roof": "salmon", "Gable": "sandybrown", "Wall": "linen", "Partition": "lightsteelblue",
    "Floor": "burlywood", "Neighbor": "gainsboro", "Site": "honeydew", "zMin": "honeydew",
}
HIDDEN = ("RoofSouth", "WallSouth")  # so that the rooms are seen
CUT_Y = 16.5  # the mesh is shown behind this plane, meters


def read(reader, file):
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutputDataObject(0)


def behind(mesh):
    """The surface of the elements whose middle lies behind the cut."""
    plane = vtkPlane()
    plane.SetOrigin(0.0, CUT_Y, 0.0)
    plane.SetNormal(0.0, 1.0, 0.0)
    part = vtkExtractGeometry()
    part.SetInputData(mesh)
    part.SetImplicitFunction(plane)
    part.ExtractInsideOff()
    surface = vtkGeometryFilter()
    surface.SetInputConnection(part.GetOutputPort())
    surface.Update()
    return surface.GetOutput()


def level_colors(levels):
    """Pale for large elements, blue for small ones."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(int(levels[1] - levels[0]) + 1)
    table.SetRange(levels)
    count = table.GetNumberOfTableValues()
    for i in range(count):
        t = i / max(count - 1, 1)
        table.SetTableValue(i, 0.93 - 0.55 * t, 0.95 - 0.35 * t, 0.97 - 0.12 * t, 1.0)
    return table


def with_edges(actor):
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.35, 0.38, 0.42)
    actor.GetProperty().SetAmbient(0.55)
    actor.GetProperty().SetDiffuse(0.5)
    return actor


def cut_actor(mesh):
    levels = mesh.GetCellData().GetArray("Level").GetRange()
    mapper = vtkDataSetMapper()
    mapper.SetInputData(behind(mesh))
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("Level")
    mapper.SetColorModeToMapScalars()  # Level is of unsigned char, which would be taken for grey values
    mapper.SetLookupTable(level_colors(levels))
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return with_edges(actor)


def patch_actors(patches):
    colors = vtkNamedColors()
    for i in range(patches.GetNumberOfPartitionedDataSets()):
        name = patches.GetMetaData(i).Get(vtkCompositeDataSet.NAME())
        color = next((c for start, c in PATCH_COLORS.items() if name.startswith(start)), None)
        if color is None or name.startswith(HIDDEN):
            continue
        mapper = vtkPolyDataMapper()
        mapper.SetInputDataObject(patches.GetPartition(i, 0))
        mapper.ScalarVisibilityOff()
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(colors.GetColor3d(color))
        yield with_edges(actor)


def draw(actors, file):
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    for actor in actors:
        renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetPosition(-18.0, -50.0, 27.0)
    camera.SetFocalPoint(29.5, 8.0, 5.5)
    camera.SetViewAngle(24.0)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(1120, 520)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    # A few hundred colors are enough, and make a much smaller file.
    indices = vtkImageQuantizeRGBToIndex()
    indices.SetInputConnection(image.GetOutputPort())
    indices.SetNumberOfColors(256)
    indices.Update()
    colors = vtkImageMapToColors()
    colors.SetInputConnection(indices.GetOutputPort())
    colors.SetLookupTable(indices.GetLookupTable())
    colors.SetOutputFormatToRGB()
    writer = vtkPNGWriter()
    writer.SetInputConnection(colors.GetOutputPort())
    writer.SetFileName(file)
    writer.SetCompressionLevel(9)
    writer.Write()


def main(mesh_file, patches_file, picture):
    mesh = read(vtkXMLUnstructuredGridReader(), mesh_file)
    patches = read(vtkXMLPartitionedDataSetCollectionReader(), patches_file)
    draw([cut_actor(mesh), *patch_actors(patches)], picture)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
