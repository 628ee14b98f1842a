# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture in space: pressure on the walls, and the paths of air through the openings.

VTK draws it with an interpreter of its own, which runs this file as `scene.py SCENE.json PICTURE.png`.
"""

from __future__ import annotations

import json
import pathlib
import sys
import tempfile

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkFiltersFlowPaths import vtkStreamTracer
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

SIZE = (1100, 560)
# Paths through an opening, and without openings past the building.
PATHS_OF_OPENING = 7
PATHS_PAST = 24


def _spread(points, count):
    """Some of them, spread over the list."""
    return points[numpy.unique(numpy.linspace(0, len(points) - 1, min(count, len(points))).round().astype(int))]


def seeds_in(face_zones):
    """Places in openings: the middles of some of their faces."""
    from vtkmodules.vtkFiltersCore import vtkCellCenters

    found = []
    for zone in face_zones:
        centers = vtkCellCenters()
        centers.SetInputData(zone)
        centers.Update()
        found.append(_spread(vtk_to_numpy(centers.GetOutput().GetPoints().GetData()), PATHS_OF_OPENING))
    return numpy.concatenate(found)


def seeds_before(bounds, way):
    """Places on a line across the wind before the walls, at a third of their height."""
    x0, x1, y0, y1, z0, z1 = bounds
    middle = numpy.array([(x0 + x1) / 2, (y0 + y1) / 2, z0 + (z1 - z0) / 3])
    reach = 0.5 * numpy.hypot(x1 - x0, y1 - y0)
    across = numpy.array([-way[1], way[0], 0.0])
    shares = numpy.linspace(-1.0, 1.0, PATHS_PAST).reshape(-1, 1)
    return middle - way * reach * 1.2 + shares * across * reach


def paths(mesh, seeds, array, reach):
    """Lines of the flow through places, both ways, as far as `reach` meters."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(seeds, float), deep=1))
    starts = vtkPolyData()
    starts.SetPoints(points)
    tracer = vtkStreamTracer()
    tracer.SetInputData(mesh)
    tracer.SetSourceData(starts)
    tracer.SetInputArrayToProcess(0, 0, 0, 0, array)  # of points
    tracer.SetIntegrationDirectionToBoth()
    tracer.SetIntegratorTypeToRungeKutta4()
    tracer.SetMaximumPropagation(reach)
    tracer.SetComputeVorticity(False)
    tracer.Update()
    lines = vtkPolyData()
    lines.DeepCopy(tracer.GetOutput())
    velocity = lines.GetPointData().GetArray(array)
    if velocity is not None:
        speed = numpy_to_vtk(numpy.linalg.norm(vtk_to_numpy(velocity), axis=1), deep=1)
        speed.SetName("Speed")
        lines.GetPointData().AddArray(speed)
    return lines


def draw(walls, ground, lines, camera, ranges):
    """A PNG, or None where nothing can be drawn. `ranges` are those of pressure and speed."""
    from ..picture import drawn_apart

    with tempfile.TemporaryDirectory() as folder:
        scene = {"camera": camera, "ranges": ranges}
        for name, data in (("walls", walls), ("ground", ground), ("lines", lines)):
            file = pathlib.Path(folder) / f"{name}.vtp"
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(str(file))
            writer.SetInputData(data)
            writer.Write()
            scene[name] = str(file)
        described = pathlib.Path(folder) / "scene.json"
        described.write_text(json.dumps(scene))
        return drawn_apart(__file__, str(described))


def _read(file):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def _table(low, high):
    """From blue over white to red."""
    from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

    table = vtkColorTransferFunction()
    table.SetColorSpaceToDiverging()
    table.AddRGBPoint(low, 0.23, 0.30, 0.75)
    table.AddRGBPoint(high, 0.71, 0.02, 0.15)
    return table


def _speed_table(high):
    from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

    table = vtkColorTransferFunction()
    for share, color in ((0.0, (0.27, 0.0, 0.33)), (0.25, (0.23, 0.32, 0.55)), (0.5, (0.13, 0.57, 0.55)),
                         (0.75, (0.37, 0.79, 0.38)), (1.0, (0.99, 0.91, 0.14))):
        table.AddRGBPoint(share * high, *color)
    return table


def _actor(source, array, table, points=False):
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

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


def _bar(title, table, x):
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor

    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(3)
    bar.SetOrientationToHorizontal()
    bar.SetPosition(x, 0.02)
    bar.SetWidth(0.26)
    bar.SetHeight(0.10)
    bar.UnconstrainedFontSizeOn()
    bar.SetLabelFormat("%.3g")
    bar.DrawBackgroundOn()
    bar.GetBackgroundProperty().SetColor(1.0, 1.0, 1.0)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.15, 0.15, 0.15)
        text.SetFontSize(13)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    return bar


def _renderer(scene):
    from vtkmodules.vtkFiltersCore import vtkTubeFilter
    from vtkmodules.vtkRenderingCore import vtkRenderer

    (low, high), fastest = scene["ranges"]["pressure"], scene["ranges"]["speed"]
    pressure, speed = _table(low, high), _speed_table(fastest)
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    walls = _actor(_read(scene["walls"]), "p", pressure)
    walls.GetProperty().SetOpacity(0.5)
    walls.GetProperty().SetAmbient(0.4)
    walls.GetProperty().SetDiffuse(0.6)
    renderer.AddActor(walls)
    ground = _actor(_read(scene["ground"]), "", None)
    ground.GetProperty().SetColor(0.90, 0.91, 0.88)
    ground.GetProperty().LightingOff()
    renderer.AddActor(ground)
    tubes = vtkTubeFilter()
    tubes.SetInputData(_read(scene["lines"]))
    tubes.SetRadius(scene["camera"]["reach"] * 0.0018)
    tubes.SetNumberOfSides(6)
    air = _actor(tubes, "Speed", speed, points=True)
    air.GetProperty().SetAmbient(0.5)
    air.GetProperty().SetDiffuse(0.5)
    renderer.AddActor(air)
    renderer.AddActor2D(_bar("pressure on walls, m²/s²", pressure, 0.05))
    renderer.AddActor2D(_bar("speed on paths, m/s", speed, 0.68))
    renderer.SetUseDepthPeeling(True)
    renderer.SetMaximumNumberOfPeels(8)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(scene["camera"]["from"])
    camera.SetFocalPoint(scene["camera"]["to"])
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(24.0)
    renderer.ResetCameraClippingRange()
    return renderer


def _main(file, picture):
    import vtkmodules.vtkRenderingFreeType  # noqa: F401  (registers itself)
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers itself)
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter

    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetAlphaBitPlanes(1)
    window.SetMultiSamples(0)
    window.SetSize(SIZE)
    window.AddRenderer(_renderer(json.loads(pathlib.Path(file).read_text())))
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
