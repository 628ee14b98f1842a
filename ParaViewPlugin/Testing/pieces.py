# SPDX-License-Identifier: GPL-3.0-or-later
"""Fingerprints of what a rank holds of a mesh. Those of all ranks add up to that of the mesh.

A fingerprint is a sum of numbers, modulo 2^64, one for each point, element or face of the rank, ghosts left out. Such a
number is mixed of the bits of all values there, and of its number in the mesh. So sums are equal where the same things
are on any ranks in any order.
"""

import json
import pathlib

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkParallelCore import vtkMultiProcessController


def mixed(values):
    """Of whole numbers of 64 bits others that look like chance (the finalizer of splitmix64)."""
    x = values + numpy.uint64(0x9E3779B97F4A7C15)
    x = (x ^ (x >> numpy.uint64(30))) * numpy.uint64(0xBF58476D1CE4E5B9)
    x = (x ^ (x >> numpy.uint64(27))) * numpy.uint64(0x94D049BB133111EB)
    return x ^ (x >> numpy.uint64(31))


def bits(array):
    """A row of numbers of 64 bits for each tuple: doubles as they are."""
    values = vtk_to_numpy(array)
    values = values.reshape(len(values), -1)
    return values.view(numpy.uint64) if values.dtype == numpy.float64 else values.astype(numpy.int64).view(numpy.uint64)


def tuples(ids, columns):
    """One number for each tuple, of its id and its values in order."""
    total = mixed(ids)
    for column in columns:
        total = mixed(total ^ column)
    return total


def owned(data, count):
    """Which cells or points are the rank's own."""
    ghosts = data.GetArray("vtkGhostType")
    return vtk_to_numpy(ghosts) == 0 if ghosts else numpy.ones(count, bool)


def ids_of(data, count):
    ids = data.GetGlobalIds()
    return vtk_to_numpy(ids).astype(numpy.uint64) if ids else numpy.arange(count, dtype=numpy.uint64)


def columns_of(data):
    """Of all arrays but those that pieces alone have."""
    names = sorted(data.GetArrayName(i) for i in range(data.GetNumberOfArrays()))
    return [column for name in names if name not in ("vtkGhostType", "GlobalCellIds", "GlobalPointIds")
            for column in bits(data.GetArray(name)).T]


def of_lists(cells, number):
    """One number for each cell, of the numbers of its points in order."""
    offsets = vtk_to_numpy(cells.GetOffsetsArray()).astype(numpy.int64)
    points = number[vtk_to_numpy(cells.GetConnectivityArray())]
    at = numpy.arange(len(points)) - numpy.repeat(offsets[:-1], numpy.diff(offsets))
    sums = numpy.zeros(len(points) + 1, numpy.uint64)
    numpy.cumsum(mixed(points ^ mixed(at.astype(numpy.uint64))), out=sums[1:])
    return sums[offsets[1:]] - sums[offsets[:-1]]


def total(numbers):
    return int(numbers.sum(dtype=numpy.uint64))


def of_mesh(mesh):
    """Points and elements, with all arrays of these."""
    points, cells = mesh.GetNumberOfPoints(), mesh.GetNumberOfCells()
    if cells == 0:
        return {}
    number = ids_of(mesh.GetPointData(), points)
    own_points, own_cells = owned(mesh.GetPointData(), points), owned(mesh.GetCellData(), cells)
    types = numpy.fromiter(map(mesh.GetCellType, range(cells)), numpy.uint64, cells)
    columns = [of_lists(mesh.GetCells(), number), types, *columns_of(mesh.GetCellData())]
    elements = tuples(ids_of(mesh.GetCellData(), cells), columns)
    return {
        "points": int(own_points.sum()), "elements": int(own_cells.sum()),
        "hash of points": total(tuples(number, bits(mesh.GetPoints().GetData()).T)[own_points]),
        "hash of elements": total(elements[own_cells]),
    }


def of_patches(patches):
    """By name the faces, each by its element and points in the mesh."""
    found = {}
    for i in range(patches.GetNumberOfPartitionedDataSets()):
        name = patches.GetMetaData(i).Get(vtkCompositeDataSet.NAME())
        found[name] = 0
        for j in range(patches.GetNumberOfPartitions(i)):
            patch = patches.GetPartitionAsDataObject(i, j)
            if patch is not None and patch.GetNumberOfCells() > 0:
                number = bits(patch.GetPointData().GetArray("VolumePointId"))[:, 0]
                faces = of_lists(patch.GetPolys(), number)
                found[name] += total(tuples(faces, columns_of(patch.GetCellData())))
    return found


def peak_megabytes():
    status = pathlib.Path("/proc/self/status").read_text()
    return int(status.split("VmHWM:")[1].split()[0]) // 1000


def file_of(folder):
    return pathlib.Path(folder) / f"rank{vtkMultiProcessController.GetGlobalController().GetLocalProcessId()}.json"


def note(folder, mesh, patches):
    megabytes = peak_megabytes()
    found = {"megabytes": megabytes, **of_mesh(mesh), "patches": of_patches(patches)}
    file_of(folder).write_text(json.dumps(found))


def note_peak(folder):
    """Once more, after a case was written."""
    found = json.loads(file_of(folder).read_text())
    file_of(folder).write_text(json.dumps(found | {"megabytes with case": peak_megabytes()}))
