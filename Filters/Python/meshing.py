# SPDX-License-Identifier: GPL-3.0-or-later
"""From a model to its mesh in one call."""

from __future__ import annotations

import base64
import difflib
import html
import math
import numbers
import os
import pathlib
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Union

from vtkmodules.vtkCommonCore import VTK_STRING, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON, VTK_POLYHEDRON, VTK_PYRAMID, VTK_TETRA, VTK_WEDGE, vtkCompositeDataSet, vtkDataObject, vtkPolyData,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from .errors import Error
from .picture import picture_of

Model = Union[str, "os.PathLike[str]", vtkDataObject, vtkAlgorithm]
Point = Sequence[float]

# Files that end so are VRML even without its header.
_VRML = (".wrl", ".vrml", ".wrz", ".wrl.gz", ".vrml.gz")
_UNITS = {"m": "Meters", "mm": "Millimeters", "cm": "Centimeters", "in": "Inches", "ft": "Feet"}
_SURFACES_BY = ("shape", "group", "material", "connected")
_SHAPES = {
    "hexahedra": VTK_HEXAHEDRON, "wedges": VTK_WEDGE, "pyramids": VTK_PYRAMID, "tetrahedra": VTK_TETRA,
    "polyhedra": VTK_POLYHEDRON,
}


class ModelWarning(UserWarning):
    """What Atria's filters warn of: a model that may be in inches, a domain that cuts through buildings …"""

    __module__ = __package__


class Result:
    """What `atria.mesh` returns.

    mesh         vtkUnstructuredGrid with an array for each metric of quality
    patches      by name, a vtkPolyData each
    diagnostics  vtkPolyData: where the model was hard to mesh, leaks and cracks
    report       counts, quality, invalid_elements, zones, layers, repair, warnings, seconds

    All are plain objects of VTK, which `pyvista.wrap` takes. docs/arrays.md lists their arrays.
    """

    __module__ = __package__

    mesh: vtkUnstructuredGrid
    patches: dict[str, vtkPolyData]
    diagnostics: vtkPolyData
    report: dict[str, Any]

    def __init__(self, mesh, patches, diagnostics, report):
        self.mesh = mesh
        self.patches = patches
        self.diagnostics = diagnostics
        self.report = report
        self._picture = None  # not drawn yet

    def save(self, file: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the mesh: a .vtu file; .msh for Fluent, .su2 for SU2, .msh4 for Gmsh, .inp for Abaqus; or a folder that becomes an OpenFOAM case."""
        from . import raising

        writer = _writer_of(pathlib.Path(file))
        writer.SetInputData(self.mesh)
        with raising(writer):
            if not writer.Write():
                raise Error(f"{os.fspath(file)} could not be written")

    def _rows(self):
        counts = self.report["counts"]
        shapes = ", ".join(f"{counts[shape]} {shape}" for shape in _SHAPES if counts[shape])
        yield "elements", f"{counts['elements']}: {shapes}"
        yield "not valid", str(self.report["invalid_elements"] or "none")
        for metric in ("NonOrthogonality", "Skewness", "CellSquish"):
            yield f"worst {metric}", f"{self.report['quality'][metric]['max']:.3g}"
        yield "patches", ", ".join(f"{name} ({patch.GetNumberOfCells()})" for name, patch in self.patches.items())
        left_out = [zone for zone in self.report["zones"] if not zone["kept"] and zone["kind"] != "beyond"]
        yield "left out", ", ".join(f"{zone['kind']} of {zone['elements']} elements" for zone in left_out) or "nothing"
        yield "seconds", f"{sum(self.report['seconds'].values()):.3g}"
        for text in self.report["warnings"]:
            yield "warning", text

    def __repr__(self) -> str:
        counts = self.report["counts"]
        return (f"<atria.Result: {counts['elements']} elements, {self.report['invalid_elements']} not valid, "
                f"{len(self.patches)} patches>")

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><th style='text-align:left'>{html.escape(label)}</th>"
                       f"<td style='text-align:left'>{html.escape(text)}</td></tr>" for label, text in self._rows())
        if self._picture is None:
            self._picture = picture_of(self.patches) or b""
        picture = base64.b64encode(self._picture).decode()
        image = f'<img alt="patches" src="data:image/png;base64,{picture}"/>' if picture else ""
        return f"<div><table>{rows}</table>{image}</div>"


def _writer_of(file):
    from . import (vtkAtriaAbaqusWriter, vtkAtriaFluentWriter, vtkAtriaGmshWriter, vtkAtriaOpenFOAMWriter,
                   vtkAtriaSU2Writer)
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    writers = {".vtu": vtkXMLUnstructuredGridWriter, ".msh": vtkAtriaFluentWriter, ".su2": vtkAtriaSU2Writer,
               ".msh4": vtkAtriaGmshWriter, ".inp": vtkAtriaAbaqusWriter}
    if file.suffix in writers:
        writer = writers[file.suffix]()
        writer.SetFileName(os.fspath(file))
        return writer
    if file.suffix not in ("", ".openfoam") and not file.is_dir():
        raise ValueError(f"{file} ends in {file.suffix}; it must end in {', '.join(writers)}, or be a folder, which has no "
                         "ending or is there already")
    writer = vtkAtriaOpenFOAMWriter()
    writer.SetCaseDirectory(os.fspath(file))
    return writer


def _class_of_reader(file):
    from . import vtkAtriaModelReader, vtkAtriaVRMLReader

    if file.is_dir():
        raise Error(f"{file} is a folder; name a file")
    if not file.is_file():
        raise Error(f"{file} does not exist")
    if vtkAtriaModelReader.CanReadFile(str(file)):
        return vtkAtriaModelReader
    if not file.name.lower().endswith(_VRML) and not vtkAtriaVRMLReader.CanReadFile(str(file)):
        if advice := vtkAtriaModelReader.GetExportAdvice(str(file)):
            raise Error(f"{file} {advice}")
        raise Error(f"{file} is of no format that is known; give VRML ({', '.join(_VRML)}), or a file that ends in one of "
                    f"{vtkAtriaModelReader.GetFileExtensions()}")
    return vtkAtriaVRMLReader


def _reader_of(file, unit, up, surfaces_by, without):
    reader = _class_of_reader(file)()
    reader.SetFileName(str(file))
    if unit is not None:
        if unit not in _UNITS:
            raise ValueError(f"unit is {unit!r}; it must be one of {', '.join(_UNITS)}")
        getattr(reader, f"SetLengthUnitTo{_UNITS[unit]}")()
    if up is not None:
        if up not in ("y", "z"):
            raise ValueError(f"up is {up!r}; it must be y or z")
        getattr(reader, f"SetUpAxisTo{up.upper()}")()
    if surfaces_by is not None:
        if surfaces_by not in _SURFACES_BY:
            raise ValueError(f"surfaces_by is {surfaces_by!r}; it must be one of {', '.join(_SURFACES_BY)}")
        getattr(reader, f"SetSurfaceByTo{surfaces_by.capitalize()}")()
    for pattern in without:
        reader.AddExcludedSurface(pattern)
    return reader


def _connect(mesher, model, unit, up, surfaces_by, without):
    """The reader, where the model is a file."""
    if isinstance(model, vtkAlgorithm):
        mesher.SetInputConnection(0, model.GetOutputPort())
    elif isinstance(model, (vtkPolyData, vtkCompositeDataSet)):
        mesher.SetInputDataObject(0, model)
    elif isinstance(model, (str, os.PathLike)):
        reader = _reader_of(pathlib.Path(model), unit, up, surfaces_by, without)
        mesher.SetInputConnection(0, reader.GetOutputPort())
        return reader
    else:
        raise TypeError(f"model is a {type(model).__name__}; it must be a file, surfaces of VTK, or what makes them")
    if unit is not None or up is not None or surfaces_by is not None or without:
        raise TypeError("unit, up, surfaces_by and without are for models from a file")
    return None


def _set_sizes(mesher, size, size_max, size_min):
    """Those that are not given follow from those that are, and from the model and its domain."""
    for name, value, set_size in (("size", size, mesher.SetSizeMid), ("size_max", size_max, mesher.SetSizeMax),
                                  ("size_min", size_min, mesher.SetSizeMin)):
        if value is not None and not (isinstance(value, numbers.Real) and 0 < value < math.inf):
            raise Error(f"{name} is {value!r}; it must be a number more than 0")
        set_size(0.0 if value is None else value)
    mesher.CompleteSizes()


def _set_domain(mesher, domain):
    if isinstance(domain, str):
        modes = {"automatic": mesher.SetDomainModeToAutomatic, "model": mesher.SetDomainModeToFromSurfaces,
                 "site": mesher.SetDomainModeToSite}
        if domain not in modes:
            raise ValueError(f"domain is {domain!r}; it must be {', '.join(modes)}, or six bounds")
        modes[domain]()
        return
    domain = list(domain)
    if domain and all(isinstance(corner, Sequence) and len(corner) == 2 for corner in domain):
        for x, y in domain:
            mesher.AddDomainCorner(x, y)
    else:
        bounds = [float(bound) for bound in domain]
        if len(bounds) != 6:
            raise ValueError(f"domain has {len(bounds)} numbers; it must have six: xmin, xmax, ymin, ymax, zmin, zmax; or it "
                             "is a list of corners (x, y)")
        mesher.SetDomainModeToExplicit()
        mesher.SetDomainBounds(bounds)


def _set_layers(mesher, layers):
    rules = layers if isinstance(layers, Mapping) else {}
    if not rules:
        mesher.SetNumberOfLayers(layers if not isinstance(layers, Mapping) else mesher.GetNumberOfLayers())
    for pattern, value in rules.items():
        if pattern == "*" and isinstance(value, int):
            mesher.SetNumberOfLayers(value)
        else:
            mesher.AddLayerRule(pattern, *(value if isinstance(value, Sequence) else [value]))


def _set_seeds(mesher, seeds):
    points = list(seeds)
    if len(points) == 3 and all(isinstance(number, numbers.Real) for number in points):
        points = [points]  # one point, not a list of them
    for point in points:
        mesher.SetZoneRule(mesher.Seeds)
        mesher.AddSeed(*point)


def _set_properties(mesher, properties):
    known = [name[3:] for name in dir(mesher) if name.startswith("Set") and hasattr(mesher, "Get" + name[3:])]
    for name, value in properties.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise TypeError(f"there is no property {name}" + (f"; did you mean {near[0]}?" if near else ""))
        getattr(mesher, "Set" + name)(value)


def _strings(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())] if array else []


def _numbers(data, name):
    array = data.GetFieldData().GetArray(name)
    return [array.GetTuple(i) if array.GetNumberOfComponents() > 1 else array.GetTuple1(i)
            for i in range(array.GetNumberOfTuples())] if array else []


def _records(data, **columns):
    """A dictionary for each entry of parallel field arrays; columns are name=(array, how to convert a value)."""
    values = [[convert(value) for value in (_numbers(data, array) or _strings(data, array))]
              for array, convert in columns.values()]
    return [dict(zip(columns, row)) for row in zip(*values)]


def _quality_of(summary):
    def row(i):
        value = lambda column: summary.GetValueByName(i, column)
        return value("Metric").ToString(), {"min": value("Minimum").ToDouble(), "max": value("Maximum").ToDouble(),
                                            "mean": value("Mean").ToDouble(), "std": value("StandardDeviation").ToDouble()}

    return dict(row(i) for i in range(summary.GetNumberOfRows()))


def _counts_of(mesh):
    types = _cells_by_type(mesh)
    return {"vertices": mesh.GetNumberOfPoints(), "elements": mesh.GetNumberOfCells(),
            **{shape: types.get(cell_type, 0) for shape, cell_type in _SHAPES.items()}}


def _types_of(mesh):
    """The type of each cell."""
    try:
        types = vtkUnsignedCharArray()
        types.DeepCopy(mesh.GetCellTypes())  # VTK 9.6 on; they need not stand in memory one by one
    except TypeError:
        types = mesh.GetCellTypesArray()
    return bytes(memoryview(types))


def _cells_by_type(mesh):
    """Cells by type."""
    data = _types_of(mesh) if mesh.GetNumberOfCells() else b""
    return {cell_type: data.count(cell_type) for cell_type in _SHAPES.values()}


def _report_of(mesher, quality, warned):
    diagnostics = mesher.GetOutputDataObject(2)
    lines = str.splitlines
    return {
        "counts": _counts_of(mesher.GetOutputDataObject(0)),
        "quality": _quality_of(quality.GetSummary()),
        "invalid_elements": quality.GetNumberOfInvalidCells(),
        "zones": _records(diagnostics, elements=("ZoneElements", int), kept=("ZoneKept", bool), kind=("ZoneKind", str),
                          volume=("ZoneVolume", float), inside=("ZonePoint", tuple), sides=("ZoneSides", lines),
                          surfaces=("ZoneSurfaces", lines)),
        "layers": _records(diagnostics, surface=("LayerSurface", str), layers=("LayersAsked", int),
                           area=("LayerArea", float), covered=("LayerCoverage", float),
                           covered_in_full=("LayerFullCoverage", float), thickness=("LayerThicknessRatio", float),
                           first_height=("LayerFirstHeight", float)),
        "leaks": _strings(diagnostics, "LeakMessage"),
        "repair": dict(zip(_strings(diagnostics, "RepairName"), _numbers(diagnostics, "RepairValue"))),
        "surfaces_without_faces": _strings(diagnostics, "SurfaceWithoutFaces"),
        "warnings": warned,
        "seconds": {mesher.GetStageName(i): mesher.GetStageSeconds(i) for i in range(mesher.GetNumberOfStages())},
    }


def _patches_of(collection):
    patches = {}
    for i in range(collection.GetNumberOfPartitionedDataSets()):
        info = collection.GetMetaData(i)
        patches[info.Get(vtkCompositeDataSet.NAME())] = collection.GetPartition(i, 0)
    return patches


def _warnings_of(algorithms, warned):
    """Observes warnings, which else are printed."""
    def note(_caller, _event, message):
        text = message.split("): ", 1)[-1].strip()
        warned.append(text)

    note.CallDataType = VTK_STRING
    return [(algorithm, algorithm.AddObserver("WarningEvent", note)) for algorithm in algorithms if algorithm]


def mesh(
    model: Model,
    size: float | None = None,
    *,
    size_min: float | None = None,
    size_max: float | None = None,
    sizes: Mapping[str, float] | None = None,
    layers: Union[int, Mapping[str, Union[int, Sequence[float]]]] = 1,
    domain: Union[str, Iterable[float], Iterable[Sequence[float]]] = "automatic",
    wind: float = 0.0,
    ground: str | None = None,
    terrain: str | None = None,
    seeds: Union[Point, Iterable[Point]] = (),
    unit: str | None = None,
    up: str | None = None,
    surfaces_by: str | None = None,
    without: Union[str, Iterable[str]] = (),
    **properties: Any,
) -> Result:
    """Meshes the air about a model, or in it. Lengths are in meters.

    model       a file (VRML, OBJ, STL, PLY, glTF, COLLADA, IFC, DXF, FBX, 3DS, CityJSON, .vtp), a vtkPolyData or composite,
                also as PyVista wraps it, or an algorithm that makes one
    size        of elements at surfaces; half as large at edges (size_min); four times as large in the open, or more in
                a large domain (size_max). Without any of the three they follow from the model
    sizes       {"Chimney*": 0.1}: at surfaces by name, * and ? stand for text
    layers      of elements on walls: a number, or by name {"*": 1, "Wall*": 5, "Floor": (3, 0.01, 1.2)} with the first
                height and the growth
    domain      "automatic" from the buildings' height, "model" for its bounds, "site" above the ground, six bounds, or
                the corners (x, y) of a convex polygon, whose height follows from the buildings'
    wind        where it blows to, degrees from x, counterclockwise
    ground      name of the surface that is flat ground; "Site" by default
    terrain     pattern of the names of surfaces that are terrain
    seeds       a point or several; what they reach is meshed, in place of what the sky reaches
    unit, up    of a file: "m", "mm", "cm", "in", "ft"; "y" or "z"
    surfaces_by what makes a named surface of a file: "shape", "group" (as SketchUp needs), "material" or "connected"
    without     pattern, or several, of surfaces of a file to leave out

    Further properties of vtkAtriaDualMesher go by their names, as CurvatureAngle=20. Raises atria.Error; what is only
    doubtful is an atria.ModelWarning.
    """
    from . import vtkAtriaDualMesher, vtkAtriaMeshQuality

    mesher = vtkAtriaDualMesher()
    mesher.CacheStagesOff()  # there is one run
    reader = _connect(mesher, model, unit, up, surfaces_by, [without] if isinstance(without, str) else list(without))
    _set_domain(mesher, domain)
    mesher.SetWindAngle(wind)
    if ground is not None:
        mesher.SetSiteName(ground)
    if terrain is not None:
        mesher.SetTerrainName(terrain)
    for pattern, value in (sizes or {}).items():
        mesher.AddSurfaceSizeRule(pattern, value)
    _set_layers(mesher, layers)
    _set_seeds(mesher, seeds)
    _set_properties(mesher, properties)

    warned: list[str] = []
    quality = vtkAtriaMeshQuality()
    quality.SetInputConnection(0, mesher.GetOutputPort(0))
    quality.SetInputConnection(1, mesher.GetOutputPort(1))
    observed = _warnings_of((reader, mesher, quality), warned)
    try:
        if reader:
            reader.Update()  # what fails here has one error, not one of each that follows
        _set_sizes(mesher, size, size_max, size_min)
        quality.Update()
    finally:
        for algorithm, tag in observed:
            algorithm.RemoveObserver(tag)
    for text in warned:
        warnings.warn(text, ModelWarning, stacklevel=2)
    return Result(quality.GetOutput(), _patches_of(mesher.GetOutputDataObject(1)), mesher.GetOutputDataObject(2),
                  _report_of(mesher, quality, warned))
