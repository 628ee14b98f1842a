#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a mesh cut open: elements behind a plane coloured by size, and in front of it the model's patches.

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
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader, vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkDataSetMapper, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter,
)

SIDES = {"xMin", "xMax", "yMin", "yMax", "zMin", "zMax"}
# Colours of patches by the beginning of their name; the first that fits.
PATCH_COLOURS = {
    "Roof": "indianred", "Gable": "peru", "Wall": "antiquewhite", "Partition": "lightsteelblue",
    "Floor": "burlywood", "Neighbour": "lightgrey", "Site": "darkseagreen", "zMin": "darkseagreen",
}
CUT_Y = 9.0  # the mesh is shown behind this plane, the patches on either side of it


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
    part.ExtractBoundaryCellsOn()
    surface = vtkGeometryFilter()
    surface.SetInputConnection(part.GetOutputPort())
    surface.Update()
    return surface.GetOutput()


def level_colours(levels):
    """Pale for large elements, blue for small ones."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(int(levels[1] - levels[0]) + 1)
    table.SetRange(levels)
    count = table.GetNumberOfTableValues()
    for i in range(count):
        t = i / max(count - 1, 1)
        table.SetTableValue(i, 0.93 - 0.55 * t, 0.95 - 0.35 * t, 0.97 - 0.12 * t, 1.0)
    return table


def with_edges(actor, width=1.0):
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.25, 0.28, 0.32)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().SetAmbient(0.35)
    actor.GetProperty().SetDiffuse(0.7)
    return actor


def cut_actor(mesh):
    levels = mesh.GetCellData().GetArray("Level").GetRange()
    mapper = vtkDataSetMapper()
    mapper.SetInputData(behind(mesh))
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("Level")
    mapper.SetLookupTable(level_colours(levels))
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return with_edges(actor)


def patch_actors(patches):
    colours = vtkNamedColors()
    for i in range(patches.GetNumberOfPartitionedDataSets()):
        name = patches.GetMetaData(i).Get(vtkCompositeDataSet.NAME())
        colour = next((c for start, c in PATCH_COLOURS.items() if name.startswith(start)), None)
        if colour is None or (name in SIDES and name != "zMin"):
            continue
        mapper = vtkPolyDataMapper()
        mapper.SetInputDataObject(patches.GetPartition(i, 0))
        mapper.ScalarVisibilityOff()
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(colours.GetColor3d(colour))
        yield with_edges(actor, 1.5)


def draw(actors, file):
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    for actor in actors:
        renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetPosition(-22.0, -62.0, 34.0)
    camera.SetFocalPoint(30.0, 8.0, 6.0)
    camera.SetViewAngle(32.0)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(1400, 800)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
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
