# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields of a case's last time, and what they are on sections."""

from __future__ import annotations

import math
import pathlib

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellLocator, vtkCellLocatorStrategy, vtkPlane, vtkPolyData
from vtkmodules.vtkFiltersCore import (
    vtkAppendPolyData, vtkCellCenters, vtkCleanPolyData, vtkCutter, vtkPolyDataNormals, vtkProbeFilter,
)
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader

from ..errors import Error, raising

# Air passes a patch one way if this share of all that passes does so on balance.
_ONE_WAY = 0.99
# How far behind a face a place in its cell is taken, in its size; the cells of layers are thin.
_BEHIND_A_FACE = 1e-3


def _blocks_of(group):
    """Name and data of each block within one."""
    return {group.GetMetaData(i).Get(group.NAME()): group.GetBlock(i) for i in range(group.GetNumberOfBlocks())}


def faces_of(patch):
    """Of a patch's faces: centers, normals out of the domain and areas."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(patch)
    normals.ComputePointNormalsOff()
    normals.ComputeCellNormalsOn()
    normals.SplittingOff()
    normals.ConsistencyOff()
    sizes = vtkCellSizeFilter()
    sizes.SetInputConnection(normals.GetOutputPort())
    sizes.ComputeAreaOn()
    centers = vtkCellCenters()
    centers.SetInputConnection(sizes.GetOutputPort())
    centers.Update()
    found = centers.GetOutput()
    data = found.GetPointData()
    return (vtk_to_numpy(found.GetPoints().GetData()).astype(float), vtk_to_numpy(data.GetArray("Normals")).astype(float),
            vtk_to_numpy(data.GetArray("Area")).astype(float))


def through(patch):
    """Of a patch's faces: velocity, what of it leaves the domain, and areas."""
    _, normals, areas = faces_of(patch)
    velocity = vtk_to_numpy(patch.GetCellData().GetArray("U"))
    return velocity, numpy.einsum("ij,ij->i", velocity, normals), areas


def _without_unused_points(zone):
    """The reader gives every face zone all points of the mesh, and so its bounds."""
    cleaner = vtkCleanPolyData()
    cleaner.SetInputData(zone)
    cleaner.PointMergingOff()
    cleaner.Update()
    return cleaner.GetOutput()


def _latest(reader, case):
    times = reader.GetTimeValues()
    time = max((times.GetValue(i) for i in range(times.GetNumberOfTuples())), default=0.0) if times else 0.0
    if time <= 0.0:
        raise Error(f"{case} has no fields of a run: run its Allrun to the end first")
    return time


class Fields:
    """The last time of a case.

    mesh        the air, with fields of its cells and points
    patches     by name, polydata with these fields
    face_zones  by name, polydata
    cell_zones  by name, parts of the mesh
    """

    def __init__(self, case):
        folder = pathlib.Path(case).resolve()
        marker = next(iter(sorted(folder.glob("*.foam"))), folder / "system" / "controlDict")
        reader = vtkOpenFOAMReader()
        reader.SetFileName(str(marker))
        reader.ReadZonesOn()
        reader.CopyDataToCellZonesOn()
        with raising(reader):
            reader.UpdateInformation()
            for i in range(reader.GetNumberOfPatchArrays()):
                reader.SetPatchArrayStatus(reader.GetPatchArrayName(i), 1)
            self.time = _latest(reader, case)
            reader.UpdateTimeStep(self.time)
        blocks = _blocks_of(reader.GetOutput())
        self.mesh = blocks.pop("internalMesh")
        if not self.mesh.GetCellData().HasArray("U"):
            raise Error(f"{case}: U of time {self.time:g} is missing or cannot be read")
        zones = _blocks_of(blocks.pop("zones")) if "zones" in blocks else {}
        face_zones = _blocks_of(zones["faceZones"]) if "faceZones" in zones else {}
        self.face_zones = {name: _without_unused_points(zone) for name, zone in face_zones.items()}
        self.cell_zones = _blocks_of(zones["cellZones"]) if "cellZones" in zones else {}
        self.patches = _blocks_of(blocks["boundary"]) if "boundary" in blocks else {}

    @property
    def velocity(self):
        """The name of the mean over the last iterations, or of the last velocity where there is none."""
        return self.averaged("U")

    def averaged(self, array):
        """The name of an array's mean over the last iterations, or of the array itself where there is none."""
        mean = array + "Mean"
        return mean if self.mesh.GetCellData().HasArray(mean) else array

    def mean(self, zone, array):
        """Over the air of a cell zone; None where either is not there."""
        return self._mean_over(self.cell_zones.get(zone), array)

    def mean_everywhere(self, array):
        """Over all air; None where the array is not there."""
        return self._mean_over(self.mesh, array)

    @staticmethod
    def _mean_over(grid, array, size="Volume"):
        if grid is None or not grid.GetNumberOfCells() or not grid.GetCellData().HasArray(array):
            return None
        sizes = vtkCellSizeFilter()
        sizes.SetInputData(grid)
        sizes.Update()
        data = sizes.GetOutput().GetCellData()
        return float(numpy.average(vtk_to_numpy(data.GetArray(array)), weights=vtk_to_numpy(data.GetArray(size))))

    def mean_over_patch(self, patch, array):
        """Over the faces of a patch by their areas; None where either is not there."""
        return self._mean_over(self.patches.get(patch), array, "Area")

    def mean_through(self, patch, array):
        """An array's mean over the air that passes a patch; None where the air passes it both ways."""
        faces = self.patches.get(patch)
        if faces is None or not faces.GetNumberOfCells() or not faces.GetCellData().HasArray(array):
            return None
        _, outwards, areas = through(faces)
        flows = outwards * areas
        if not abs(flows.sum()) > _ONE_WAY * abs(flows).sum():
            return None
        return float(numpy.average(vtk_to_numpy(faces.GetCellData().GetArray(array)), weights=flows))

    def share_in(self, zone, patch):
        """The share of a patch's area whose cells lie in a cell zone."""
        faces = self.patches.get(patch)
        if zone not in self.cell_zones or faces is None or not faces.GetNumberOfCells():
            return 0.0
        centers, normals, areas = faces_of(faces)
        behind = centers - _BEHIND_A_FACE * numpy.sqrt(areas)[:, None] * normals
        return float(areas[self.inside([zone], behind)].sum() / areas.sum())

    def inside(self, zones, places):
        """Whether places lie in cell zones."""
        found = numpy.zeros(len(places), bool)
        for zone in zones:
            if zone in self.cell_zones:
                found |= ~numpy.isnan(probe(self.cell_zones[zone], places, "p"))
        return found


def appended(parts):
    """One surface of many, an empty one of none."""
    if not parts:
        return vtkPolyData()
    append = vtkAppendPolyData()
    for part in parts:
        append.AddInputData(part)
    append.Update()
    return append.GetOutput()


class Section:
    """A rectangle of places: from a corner along two ways of unit length, which span it to the right and upwards."""

    def __init__(self, corner, right, up, size, columns=300):
        """`size` are the lengths in meters along `right` and `up`."""
        self.corner, self.right, self.up = (numpy.asarray(v, float) for v in (corner, right, up))
        self.size = size
        self.columns = columns
        self.rows = max(1, round(columns * size[1] / size[0]))
        self.places = self._grid(self.columns, self.rows)

    def _grid(self, columns, rows):
        u = (numpy.arange(columns) + 0.5) / columns * self.size[0]
        v = (1.0 - (numpy.arange(rows) + 0.5) / rows) * self.size[1]  # the first row on top
        u, v = (a.reshape(-1, 1) for a in numpy.meshgrid(u, v))
        return self.corner + u * self.right + v * self.up

    def sample(self, mesh, array):
        """Values of a cell array at all places; what lies in no cell is no number."""
        return probe(mesh, self.places, array)

    def image(self, values):
        """As rows and columns."""
        return numpy.asarray(values).reshape(self.rows, self.columns, *numpy.shape(values)[1:])

    def _shares(self, points):
        """Where points are in the picture: shares of its width from the left, and of its height from the top."""
        off = numpy.asarray(points, float) - self.corner
        return numpy.stack([off @ self.right / self.size[0], 1.0 - off @ self.up / self.size[1]], axis=-1)

    def lines(self, surfaces):
        """Where it cuts surfaces: pairs of points, in shares of the picture."""
        plane = vtkPlane()
        plane.SetOrigin(self.corner)
        plane.SetNormal(numpy.cross(self.right, self.up))
        cutter = vtkCutter()
        cutter.SetInputData(appended(surfaces))
        cutter.SetCutFunction(plane)
        cutter.Update()
        cut = cutter.GetOutput()
        if not cut.GetNumberOfLines():
            return []
        points = self._shares(vtk_to_numpy(cut.GetPoints().GetData()))
        ends = vtk_to_numpy(cut.GetLines().GetConnectivityArray()).reshape(-1, 2)
        inside = ((points >= 0.0) & (points <= 1.0)).all(axis=1)
        return [(points[a], points[b]) for a, b in ends if inside[a] and inside[b]]

    def arrows(self, mesh, array, across=28):
        """Velocity in the section: (point, way) in shares of its width, the fastest as long as arrows stand apart."""
        places = self._grid(across, max(1, round(across * self.size[1] / self.size[0])))
        velocity = probe(mesh, places, array)
        ways = numpy.stack([velocity @ self.right, -(velocity @ self.up)], axis=-1)
        longest = numpy.nanmax(numpy.linalg.norm(ways, axis=1), initial=0.0)
        if not longest > 0.0:
            return []
        ways = ways / longest / across * 1.3
        return [(p, w) for p, w in zip(self._shares(places), ways) if math.hypot(*w) > 0.06 / across]


class LevelView(Section):
    """Places at one height."""

    flat = True

    def __init__(self, bounds, height, columns=300):
        """`bounds` are x0, x1, y0, y1, meters."""
        x0, x1, y0, y1 = bounds
        super().__init__((x0, y0, height), (1, 0, 0), (0, 1, 0), (x1 - x0, y1 - y0), columns)


class PlanView(Section):
    """Places at a height above the ground, which need not be flat."""

    def __init__(self, ground, bounds, height, columns=300):
        """`ground` are polydata; `bounds` are x0, x1, y0, y1, meters."""
        x0, x1, y0, y1 = bounds
        super().__init__((x0, y0, 0.0), (1, 0, 0), (0, 1, 0), (x1 - x0, y1 - y0), columns)
        elevation = _elevation(ground, self.places)
        self.known = ~numpy.isnan(elevation)
        self.places[:, 2] = numpy.where(self.known, elevation + height, 0.0)
        known = elevation[self.known]
        self.flat = bool(known.size) and float(known.max() - known.min()) < height
        if self.flat:
            self.corner[2] = float(numpy.median(known)) + height

    def sample(self, mesh, array):
        values = numpy.full((len(self.places), *_shape_of(mesh, array)), numpy.nan)
        values[self.known] = probe(mesh, self.places[self.known], array)
        return values


def _shape_of(mesh, array):
    return vtk_to_numpy(mesh.GetCellData().GetArray(array)).shape[1:]


def _elevation(ground, places):
    """The ground's height below places; no number where there is none."""
    flat = vtkPolyData()
    flat.DeepCopy(appended(ground))
    if not flat.GetNumberOfCells():
        return numpy.full(len(places), numpy.nan)
    points = vtk_to_numpy(flat.GetPoints().GetData()).astype(float)
    heights = numpy_to_vtk(points[:, 2].copy(), deep=1)
    heights.SetName("Elevation")
    points[:, 2] = 0.0
    flat.SetPoints(_points(points))
    flat.GetCellData().Initialize()
    flat.GetPointData().Initialize()
    flat.GetPointData().AddArray(heights)
    return probe(flat, places, "Elevation")


def _points(places):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(places), deep=1))
    return points


def probe(source, places, array):
    """A cell's value at each place, or for an array of points what it interpolates; no number where there is no cell."""
    wanted = vtkPolyData()
    wanted.SetPoints(_points(places))
    strategy = vtkCellLocatorStrategy()
    strategy.SetCellLocator(vtkCellLocator())
    lookup = vtkProbeFilter()
    lookup.SetInputData(wanted)
    lookup.SetSourceData(source)
    lookup.SetFindCellStrategy(strategy)
    lookup.Update()
    data = lookup.GetOutput().GetPointData()
    values = vtk_to_numpy(data.GetArray(array)).astype(float).copy()
    values[vtk_to_numpy(data.GetArray(lookup.GetValidPointMaskArrayName())) == 0] = numpy.nan
    return values
