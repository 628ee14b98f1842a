# SPDX-License-Identifier: GPL-3.0-or-later
"""What a picture in space shows: pressure on the walls, and the paths of air through the openings."""

from __future__ import annotations

import json
import pathlib
import tempfile

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersFlowPaths import vtkStreamTracer
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from ..picture import drawn_apart

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
        return drawn_apart("air", str(described))
