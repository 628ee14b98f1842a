# SPDX-License-Identifier: GPL-3.0-or-later
"""A layered mesh in all formats of solvers: other programs find the same cells, names, areas and volumes.

Usage: test_formats.py ATRIA MODEL.wrl [MODEL…]
Models that are not there are skipped.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkUnstructuredGrid
from vtkmodules.vtkIOCGNSReader import vtkCGNSReader
from vtkmodules.vtkIOGeometry import vtkFLUENTReader, vtkOpenFOAMReader
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader

ATRIA = pathlib.Path(sys.argv[1]).resolve()
CORNERS = {5: 3, 9: 4, 10: 4, 12: 8, 13: 6, 14: 5}
# VTK's numbers; faces by corners.
FACES = {
    10: ((0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)),
    12: ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)),
    13: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    14: ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
}


def run(*command, cwd):
    environment = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}
    return subprocess.run([str(c) for c in command], cwd=cwd, env=environment, capture_output=True, text=True, check=False)


def area_of(points):
    center = points.mean(axis=0)
    following = np.roll(points, -1, axis=0)
    return np.linalg.norm(np.cross(points - center, following - center).sum(axis=0)) / 2


def area_of_cells(data):
    points = vtk_to_numpy(data.GetPoints().GetData())
    total = 0.0
    for c in range(data.GetNumberOfCells()):
        ids = data.GetCell(c).GetPointIds() # of a cell that VTK uses again
        total += area_of(points[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]])
    return total


def areas_of_patches(file):
    reader = vtkXMLPartitionedDataSetCollectionReader()
    reader.SetFileName(str(file))
    reader.Update()
    collection = reader.GetOutputDataObject(0)
    return {collection.GetMetaData(i).Get(collection.NAME()): area_of_cells(collection.GetPartition(i, 0))
            for i in range(collection.GetNumberOfPartitionedDataSets())}


def faces_of_polyhedra(grid):
    if hasattr(grid, "GetPolyhedronFaces"):  # VTK 9.4 on
        faces = grid.GetPolyhedronFaces()
        points = vtk_to_numpy(faces.GetConnectivityArray()).tolist()
        starts = vtk_to_numpy(faces.GetOffsetsArray()).tolist()
        yield from (points[begin:end] for begin, end in zip(starts, starts[1:]))
        return
    stream, places = vtk_to_numpy(grid.GetFaces()).tolist(), vtk_to_numpy(grid.GetFaceLocations())
    for at in places[places >= 0].tolist():
        count, at = stream[at], at + 1
        for _ in range(count):
            yield stream[at + 1:at + 1 + stream[at]]
            at += stream[at] + 1


def sum_over_faces(points, faces):
    """The volume within, positive where they look outwards."""
    by_corners = {}
    for face in faces:
        by_corners.setdefault(len(face), []).append(face)
    total = 0.0
    for listed in by_corners.values():
        p = points[np.array(listed)]
        normals = np.cross(p, np.roll(p, -1, axis=1)).sum(axis=1)
        total += (normals * p.mean(axis=1)).sum() / 6
    return total


def volume_of(grid):
    """Of a closed mesh. VTK's readers do not turn faces of all polyhedra alike, but those of one file."""
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    points -= points.mean(axis=0)
    types = np.array([grid.GetCellType(cell) for cell in range(grid.GetNumberOfCells())])
    starts = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    volume = abs(sum_over_faces(points, faces_of_polyhedra(grid))) if 42 in types else 0.0
    for kind, faces in FACES.items():
        cells = corners[starts[:-1][types == kind][:, None] + np.arange(CORNERS[kind])]
        volume += abs(sum(sum_over_faces(points, cells[:, face]) for face in faces if len(cells)))
    assert set(types.tolist()) <= {*FACES, 42}, set(types.tolist())
    return volume


def leaves_of(data):
    """(name, dataset) of all that a reader gives."""
    for i in range(data.GetNumberOfBlocks()):
        block = data.GetBlock(i)
        if block is None:
            continue
        if block.IsA("vtkMultiBlockDataSet"):
            yield from leaves_of(block)
        else:
            yield data.GetMetaData(i).Get(vtkCompositeDataSet.NAME()) if data.HasMetaData(i) else None, block


def expect_read(reader, table, volume, expected, what, tolerance):
    """VTK's reader finds all cells, their volume, and every patch with its name and area."""
    inside, areas = [], {}
    reader.Update()
    for name, data in leaves_of(reader.GetOutput()):
        if data.GetCell(0).GetCellDimension() == 3:
            inside.append(data)
        else:
            areas[name] = area_of_cells(data)
    assert sum(data.GetNumberOfCells() for data in inside) == int(table["cells"]), what
    found = sum(map(volume_of, inside))
    assert abs(found - volume) < tolerance * volume, (what, found, volume)
    same(areas, expected, what, tolerance)
    kept = {name for name in expected if re.fullmatch(r"\w{1,28}", name)}
    assert kept <= areas.keys(), (what, kept - areas.keys())
    for name in kept:
        assert abs(areas[name] - expected[name]) <= tolerance * expected[name], (what, name)


def check_vtk_reads(folder, table, volume, expected):
    """All formats that VTK has readers of; of a Fluent mesh it takes the cells only, polyhedra as sets of points."""
    assert run(ATRIA, "convert", "m.vtu", "--openfoam", "binary", cwd=folder).returncode in (0, 5)
    for name in ("case", "binary"):
        reader = vtkOpenFOAMReader()
        (folder / name / "case.foam").touch()
        reader.SetFileName(str(folder / name / "case.foam"))
        if hasattr(reader, "DecomposePolyhedraOff"):  # later versions of VTK never do
            reader.DecomposePolyhedraOff()
        reader.UpdateInformation()
        reader.EnableAllPatchArrays()
        expect_read(reader, table, volume, expected, f"VTK of {name}", 1e-5) # its points have single precision
    reader = vtkCGNSReader()
    reader.SetFileName(str(folder / "m.cgns"))
    reader.LoadBndPatchOn()
    reader.UpdateInformation()
    reader.EnableAllBases()
    reader.EnableAllFamilies()
    expect_read(reader, table, volume, expected, "VTK of CGNS", 1e-6)
    if hasattr(vtkUnstructuredGrid, "SetPolyhedralCells"):
        return  # vtkFLUENTReader of these versions crashes at polyhedra
    reader = vtkFLUENTReader()
    reader.SetFileName(str(folder / "m.msh"))
    reader.AddObserver("ErrorEvent", lambda *_: None) # it asks for results, too
    reader.AddObserver("WarningEvent", lambda *_: None)
    reader.Update()
    assert sum(data.GetNumberOfCells() for _, data in leaves_of(reader.GetOutput())) == int(table["cells"])


def check_mesh(folder):
    report = run("checkMesh", "-allGeometry", "-allTopology", cwd=folder).stdout
    assert "Mesh OK." in report or "mesh checks" in report, report[-2000:]
    table = dict(re.findall(r"^    (points|faces|internal faces|cells|boundary patches): +(\d+)", report, re.MULTILINE))
    volume = float(re.search(r"Total volume = ([\d.e+-]+?)\.? ", report).group(1))
    return table, volume, len(re.findall(r"^ \*\*\*", report, re.MULTILINE))


def numbers(text, kind):
    return np.array(re.findall(r"[-+\d.e]+", text), dtype=kind)


def foam_body(folder, name):
    text = (folder / "constant" / "polyMesh" / name).read_text()
    return text[text.index("\n(\n"):] if name != "boundary" else text


def areas_of_case(folder):
    """By patch, of a case in ASCII."""
    points = numbers(foam_body(folder, "points"), float).reshape(-1, 3)
    faces = [np.array(f.split(), dtype=int) for f in re.findall(r"\d+\(([\d ]+)\)", foam_body(folder, "faces"))]
    areas = {}
    for name, body in re.findall(r"^    ([^\s/]+)\n    \{(.*?)\}", foam_body(folder, "boundary"), re.DOTALL | re.MULTILINE):
        count, start = (int(re.search(rf"{key}\s+(\d+)", body).group(1)) for key in ("nFaces", "startFace"))
        areas[name] = sum(area_of(points[f]) for f in faces[start:start + count])
    return areas


def read_su2(file):
    """The volume and the areas of markers; fails where these are not the boundary, each face once."""
    lines = iter(line for line in file.read_text().splitlines() if not line.startswith("%"))
    value = lambda: next(lines).split("= ")[1]
    assert value() == "3"
    cells = [tuple(map(int, next(lines).split())) for _ in range(int(value()))]
    points = np.array([next(lines).split()[:3] for _ in range(int(value()))], dtype=float)
    seen, volume = {}, 0.0
    for cell in cells:
        ids = cell[1:1 + CORNERS[cell[0]]]
        origin = points[ids[0]]
        for local in FACES[cell[0]]:
            face = [ids[k] for k in local]
            key = tuple(sorted(face))
            seen[key] = seen.get(key, 0) + 1
            p = points[face] - origin
            center = p.mean(axis=0)
            volume += np.dot(np.cross(p, np.roll(p, -1, axis=0)).sum(axis=0), center) / 6
    assert max(seen.values()) == 2, "three cells share a face"
    areas, marked = {}, set()
    for _ in range(int(value())):
        name = value()
        areas[name] = 0.0
        for _ in range(int(value())):
            face = tuple(map(int, next(lines).split()[1:]))
            areas[name] += area_of(points[list(face)])
            marked.add(tuple(sorted(face)))
    alone = {face for face, count in seen.items() if count == 1}
    assert alone <= marked, f"{len(alone - marked)} faces are not conformal"
    return volume, areas, len(marked - alone)


def same(found, expected, what, tolerance=1e-6):
    assert len(found) == len(expected), (what, sorted(found), sorted(expected))
    for a, b in zip(sorted(found.values()), sorted(expected.values())):
        assert abs(a - b) <= tolerance * b, (what, a, b)


def check(model, folder, options):
    made = run(ATRIA, "mesh", model, *options, "-o", "m.vtu", "--patches", "p.vtpc", "--openfoam", "case", "--ascii",
               "--fluent", "m.msh", "--cgns", "m.cgns", "--su2", "m.su2", "--report", "report.json", cwd=folder)
    assert made.returncode in (0, 4, 5), made.stderr
    report = json.loads((folder / "report.json").read_text())
    openings = {opening["name"] for opening in report.get("openings", [])}
    expected = {name: area for name, area in areas_of_patches(folder / "p.vtpc").items() if name not in openings}
    table, volume, failed = check_mesh(folder / "case")
    same(areas_of_case(folder / "case"), expected, "OpenFOAM")
    shutil.copytree(folder / "case" / "system", folder / "fluent" / "system")
    converted = run("fluent3DMeshToFoam", folder / "m.msh", cwd=folder / "fluent")
    assert converted.returncode == 0, converted.stdout + converted.stderr
    its_table, its_volume, its_failed = check_mesh(folder / "fluent")
    assert (its_table, its_failed) == (table, failed), (its_table, its_failed, table, failed)
    for written in ("case", "fluent"):
        for file, zones in (("faceZones", openings), ("cellZones", {room["name"] for room in report.get("rooms", [])})):
            assert zones <= (names_in(folder / written, file) if zones else set()), (written, zones)
    assert abs(its_volume - volume) < 1e-6 * volume
    same(areas_of_case(folder / "fluent"), expected, "Fluent")
    for name in expected:
        word = re.sub("_back$", "-shadow", re.sub("_front$", "", name))
        if re.fullmatch(r"\w+", name) and name.replace("_front", "_back") in expected and name != word:
            assert word in names_in(folder / "fluent", "boundary"), word
    su2_volume, areas, common = read_su2(folder / "m.su2")
    assert abs(su2_volume - volume) < 1e-6 * volume, (su2_volume, volume)
    same(areas, expected, "SU2")
    check_vtk_reads(folder, table, volume, expected)
    if shutil.which("cgnscheck"):
        said = run("cgnscheck", folder / "m.cgns", cwd=folder).stdout
        # It tells faces apart by their points, which those of a sheet one face wide have in common.
        errors = [line for line in said.splitlines() if line.startswith("ERROR")]
        assert common or not errors, errors
        assert all(re.search(rf'checking BC "{re.escape(name[:32])}', said) for name in expected if len(name) < 28), said
    print(f"{model.name}: {table['cells']} cells, {len(expected)} patches, {common} faces with common points, {failed} failed checks")


def names_in(folder, file):
    """Of the entries of a list of patches or zones."""
    return set(re.findall(r"^ *([^\s/{}();]+)\n *\{", foam_body(folder, file), re.MULTILINE))


def main():
    if not shutil.which("fluent3DMeshToFoam"):
        print("SKIP: OpenFOAM is not installed")
        sys.exit(77)
    for argument in sys.argv[2:]:
        name, *options = argument.split(" ")
        model = pathlib.Path(name).resolve()
        if not model.exists():
            print(f"{model} is not there: skipped")
            continue
        with tempfile.TemporaryDirectory() as folder:
            check(model, pathlib.Path(folder), options)


main()
