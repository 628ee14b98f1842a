#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of hexahedra of the air in closed models, beside those that HybridOctree_Hex publishes with its models, at like numbers of
elements: scaled Jacobians (by VTK's Verdict), distances between mesh and model, volume, time.

Tong, Halilaj, Zhang (2024): HybridOctree_Hex: hybrid octree-based adaptive all-hexahedral mesh generation with Jacobian control,
J. Comput. Sci. 78, 102278. Its repository has `input boundaries/NAME_tri.raw` and `our results/NAME.vtk`.

Usage: hexahedra.py ATRIA FOLDER_OF_THE_REPOSITORY NAME ...
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import time

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCellCenters, vtkImplicitPolyDataDistance, vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from tables import heading, row

LIKE = 0.08  # share by which numbers of elements may differ
TRIES = 6
MOST_PLACES = 4000  # at which distances are measured
THEIR_LENGTH = 100.0  # of a model in their meshes


def read_model(file):
    words = file.read_text().split()
    points, triangles = int(words[0]), int(words[1])
    end = 2 + 3 * points
    return (numpy.array(words[2:end], float).reshape(points, 3), numpy.array(words[end:end + 3 * triangles], int).reshape(triangles, 3))


def surface_of(points, triangles):
    surface, places, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(points, deep=True))
    cells.SetData(3, numpy_to_vtkIdTypeArray(numpy.ascontiguousarray(triangles.ravel(), numpy.int64), deep=True))
    surface.SetPoints(places)
    surface.SetPolys(cells)
    return surface


def write_model(file, points, triangles):
    file.write_text("o Body\n" + "".join("v {:.9g} {:.9g} {:.9g}\n".format(*point) for point in points)
                    + "".join("f {} {} {}\n".format(*triangle) for triangle in triangles + 1))


def centers_of(data):
    centers = vtkCellCenters()
    centers.SetInputData(data)
    centers.Update()
    return vtk_to_numpy(centers.GetOutput().GetPoints().GetData())


def boundary_of(mesh):
    boundary, triangles = vtkGeometryFilter(), vtkTriangleFilter()
    boundary.SetInputData(mesh)
    triangles.SetInputConnection(boundary.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def scaled_jacobians(mesh):
    quality = vtkMeshQuality()
    quality.SetInputData(mesh)
    quality.SetHexQualityMeasureToScaledJacobian()
    quality.Update()
    return numpy.sort(vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality")))


def distances(surface, target):
    """From some points and centers of triangles to another surface."""
    places = numpy.vstack([vtk_to_numpy(surface.GetPoints().GetData()), centers_of(surface)])
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(target)
    return numpy.abs([distance.EvaluateFunction(*place) for place in places[::max(1, len(places) // MOST_PLACES)]])


def volume_of(surface):
    properties = vtkMassProperties()
    properties.SetInputData(surface)
    return properties.GetVolume()


def place_inside(model, candidates):
    """The deepest of some places."""
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(model)
    some = candidates[::max(1, len(candidates) // 2000)]
    return some[numpy.argmin([distance.EvaluateFunction(*place) for place in some])]


def read_theirs(file, points):
    reader = vtkUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    mesh, low, high = reader.GetOutput(), points.min(axis=0), points.max(axis=0)
    length = (high - low).max()
    places = vtkPoints()
    places.SetData(numpy_to_vtk((low + high - length) / 2 + vtk_to_numpy(mesh.GetPoints().GetData()) * length / THEIR_LENGTH, deep=True))
    mesh.SetPoints(places)
    return mesh


def mesh_like(atria, folder, points, seed, wanted):
    """A mesh of about so many elements, and the seconds of the last try."""
    diagonal = numpy.linalg.norm(points.max(axis=0) - points.min(axis=0))
    bounds = zip(points.min(axis=0) - 0.1 * diagonal, points.max(axis=0) + 0.1 * diagonal)
    fixed = [atria, "mesh", folder / "model.obj", "-o", folder / "mesh.vtu", "--hex", "--unit", "m", "--layers", 1, "--threads", 1,
             "--domain", *(bound for pair in bounds for bound in pair), "--seed", *seed]
    size = diagonal / 60
    for _ in range(TRIES):
        begin = time.monotonic()
        sizes = ["--size-min", size, "--size-mid", size, "--size-max", 8 * size]
        run = subprocess.run([str(word) for word in [*fixed, *sizes]], capture_output=True, text=True, check=False, encoding="utf-8")
        seconds = time.monotonic() - begin
        found = re.search(r"^elements +(\d+): (\d+) hexahedra", run.stdout, re.MULTILINE)
        if not found:
            sys.exit(run.stderr)
        if abs(int(found[1]) / wanted - 1) < LIKE:
            break
        size *= (int(found[1]) / wanted) ** (1 / 2.3)
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "mesh.vtu"))
    reader.Update()
    return reader.GetOutput(), seconds


def cells_of(name, mesher, mesh, model, diagonal, seconds):
    jacobians, boundary = scaled_jacobians(mesh), boundary_of(mesh)
    share = lambda distance: f"{100 * distance / diagonal:.3f}"
    to_model, to_mesh = distances(boundary, model), distances(model, boundary)
    return [name, mesher, f"{mesh.GetNumberOfCells():,}", *(f"{value:.2f}" for value in (jacobians[0], jacobians[len(jacobians) // 100],
            jacobians.mean())), share(to_mesh.mean()), share(max(to_mesh.max(), to_model.max())),
            f"{100 * (volume_of(boundary) / volume_of(model) - 1):+.2f} %", seconds]


def main(atria, repository, *names):
    repository = pathlib.Path(repository)
    print(*heading("model", "mesher", "elements", "scaled Jacobian", "of 1 %", "mean", "distance, % of the diagonal", "greatest", "volume", "s"), sep="\n")
    for name in names:
        points, triangles = read_model(repository / "input boundaries" / f"{name}_tri.raw")
        model = surface_of(points, triangles)
        diagonal = numpy.linalg.norm(points.max(axis=0) - points.min(axis=0))
        theirs = read_theirs(repository / "our results" / f"{name}.vtk", points)
        print(row(*cells_of(name, "HybridOctree_Hex", theirs, model, diagonal, "")), flush=True)
        with tempfile.TemporaryDirectory() as scratch:
            write_model(pathlib.Path(scratch) / "model.obj", points, triangles)
            seed = place_inside(model, centers_of(theirs))
            ours, seconds = mesh_like(pathlib.Path(atria).resolve(), pathlib.Path(scratch), points, seed, theirs.GetNumberOfCells())
            print(row(*cells_of(name, "Atria", ours, model, diagonal, f"{seconds:.1f}")), flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
