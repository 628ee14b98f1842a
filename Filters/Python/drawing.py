# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a picture without a display: drawing.py KIND FILE PICTURE.png

    patches  FILE.vtm, of surfaces: each in a color of its own, from outside
    air      FILE.json, which names surfaces and lines: pressure on walls, and the paths of air

An interpreter of its own runs this file: VTK ends the process where it finds no display.
"""

import json
import pathlib
import sys

import vtkmodules.vtkRenderingFreeType  # noqa: F401  (registers itself)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers itself)
from vtkmodules.vtkCommonColor import vtkColorSeries
from vtkmodules.vtkCommonDataModel import vtkBoundingBox
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader, vtkXMLPolyDataReader
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkActor2D, vtkColorTransferFunction, vtkCoordinate, vtkPolyDataMapper, vtkPolyDataMapper2D, vtkRenderer,
    vtkRenderWindow, vtkWindowToImageFilter,
)


def _read(reader, file):
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutputDataObject(0)


def _actor(source, array="", table=None, points=False):
    """Of a surface or what makes one; colored by an array of its cells or points where there is a table."""
    mapper = vtkPolyDataMapper()
    if isinstance(source, vtkAlgorithm):
        mapper.SetInputConnection(source.GetOutputPort())
    else:
        mapper.SetInputData(source)
    actor = vtkActor()
    actor.SetMapper(mapper)
    if table is None:
        mapper.ScalarVisibilityOff()
        return actor
    mapper.SetLookupTable(table)
    mapper.SelectColorArray(array)
    if points:
        mapper.SetScalarModeToUsePointFieldData()
    else:
        mapper.SetScalarModeToUseCellFieldData()
    return actor


def _shaded(actor, ambient):
    actor.GetProperty().SetAmbient(ambient)
    actor.GetProperty().SetDiffuse(1.0 - ambient)
    return actor


def _white():
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.GetActiveCamera().SetViewUp(0.0, 0.0, 1.0)
    return renderer


def _surface_of(patch):
    array = patch.GetCellData().GetArray("SurfaceId")
    return int(array.GetTuple1(0)) if array and array.GetNumberOfTuples() else -1


def _patch(patch, color):
    """Seen from outside; of the sides that face the eye, which would hide the rest, nothing is drawn."""
    actor = _shaded(_actor(patch), 0.35)
    look = actor.GetProperty()
    look.SetColor(color)
    look.EdgeVisibilityOn()
    look.SetEdgeColor(0.35, 0.38, 0.42)
    look.FrontfaceCullingOn()
    return actor


def _bounds_of(patches):
    """Of what stands up among the model's surfaces; the ground and the domain can be far larger."""

    def added(chosen):
        box = vtkBoundingBox()
        for patch in chosen:
            box.AddBounds(patch.GetBounds())
        return box

    model = [patch for patch in patches if _surface_of(patch) >= 0]
    upright = [patch for patch in model if patch.GetBounds()[5] - patch.GetBounds()[4] > 1e-3 * patch.GetLength()]
    bounds = [0.0] * 6
    added(upright or model or patches).GetBounds(bounds)
    return bounds


def _of_patches(file):
    blocks = _read(vtkXMLMultiBlockDataReader(), file)
    patches = [blocks.GetBlock(i) for i in range(blocks.GetNumberOfBlocks())]
    patches = [patch for patch in patches if patch and patch.GetNumberOfCells()]
    series = vtkColorSeries()
    series.SetColorScheme(vtkColorSeries.BREWER_QUALITATIVE_SET3)
    renderer = _white()
    for patch in patches:
        surface = _surface_of(patch)
        color = [part / 255.0 for part in series.GetColorRepeating(surface)] if surface >= 0 else [0.92, 0.93, 0.95]
        renderer.AddActor(_patch(patch, color))
    camera = renderer.GetActiveCamera()
    camera.SetPosition(-0.45, -0.75, 0.45)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    renderer.ResetCamera(_bounds_of(patches))
    camera.Zoom(1.3)
    return renderer


def _pressure_table(low, high):
    """From blue over white to red."""
    table = vtkColorTransferFunction()
    table.SetColorSpaceToDiverging()
    table.AddRGBPoint(low, 0.23, 0.30, 0.75)
    table.AddRGBPoint(high, 0.71, 0.02, 0.15)
    return table


def _speed_table(high):
    table = vtkColorTransferFunction()
    for share, color in ((0.0, (0.27, 0.0, 0.33)), (0.25, (0.23, 0.32, 0.55)), (0.5, (0.13, 0.57, 0.55)),
                         (0.75, (0.37, 0.79, 0.38)), (1.0, (0.99, 0.91, 0.14))):
        table.AddRGBPoint(share * high, *color)
    return table


def _white_behind(x, width, height):
    """A sheet behind a bar, wide enough for labels that are centered at its ends; shares of the picture."""
    sheet = vtkPlaneSource()
    sheet.SetOrigin(x - 0.03, 0.0, 0.0)
    sheet.SetPoint1(x + width + 0.03, 0.0, 0.0)
    sheet.SetPoint2(x - 0.03, height + 0.03, 0.0)
    places = vtkCoordinate()
    places.SetCoordinateSystemToNormalizedViewport()
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputConnection(sheet.GetOutputPort())
    mapper.SetTransformCoordinate(places)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(1.0, 1.0, 1.0)
    return actor


def _bar(title, table, x):
    """What is to be added to the renderer."""
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(2)  # one in the middle would be written over the title
    bar.SetOrientationToHorizontal()
    bar.SetPosition(x, 0.02)
    bar.SetWidth(0.26)
    bar.SetHeight(0.10)
    bar.UnconstrainedFontSizeOn()
    bar.SetLabelFormat("%.3g")
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.15, 0.15, 0.15)
        text.SetFontSize(13)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    return _white_behind(x, bar.GetWidth(), bar.GetHeight()), bar


def _of_air(file):
    scene = json.loads(pathlib.Path(file).read_text())
    pressure, speed = _pressure_table(*scene["ranges"]["pressure"]), _speed_table(scene["ranges"]["speed"])
    renderer = _white()
    walls = _shaded(_actor(_read(vtkXMLPolyDataReader(), scene["walls"]), "p", pressure), 0.4)
    walls.GetProperty().SetOpacity(0.5)
    renderer.AddActor(walls)
    ground = _actor(_read(vtkXMLPolyDataReader(), scene["ground"]))
    ground.GetProperty().SetColor(0.90, 0.91, 0.88)
    ground.GetProperty().LightingOff()
    renderer.AddActor(ground)
    tubes = vtkTubeFilter()
    tubes.SetInputData(_read(vtkXMLPolyDataReader(), scene["lines"]))
    tubes.SetRadius(scene["camera"]["reach"] * 0.0018)
    tubes.SetNumberOfSides(6)
    renderer.AddActor(_shaded(_actor(tubes, "Speed", speed, points=True), 0.5))
    for part in (*_bar("pressure on walls, m²/s²", pressure, 0.05), *_bar("speed on paths, m/s", speed, 0.68)):
        renderer.AddActor2D(part)
    renderer.SetUseDepthPeeling(True)
    renderer.SetMaximumNumberOfPeels(8)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(scene["camera"]["from"])
    camera.SetFocalPoint(scene["camera"]["to"])
    camera.SetViewAngle(24.0)
    return renderer


# By kind: what fills the renderer, the picture's size, and how edges are smoothed, which depth peeling does not take.
_KINDS = {"patches": (_of_patches, (640, 400), 8), "air": (_of_air, (1100, 560), 0)}


def _main(kind, file, picture):
    fill, size, samples = _KINDS[kind]
    renderer = fill(file)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetAlphaBitPlanes(samples == 0)
    window.SetMultiSamples(samples)
    window.SetSize(size)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(picture)
    writer.Write()


if __name__ == "__main__":
    _main(*sys.argv[1:])
