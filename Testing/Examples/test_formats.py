# SPDX-License-Identifier: GPL-3.0-or-later
"""A layered mesh in all formats of solvers: other programs find the same cells, names, areas and volumes.

Usage: test_formats.py ATRIA MODEL.wrl [MODEL…]
Models that are not there are skipped.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np
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


def areas_of_patches(file):
    reader = vtkXMLPartitionedDataSetCollectionReader()
    reader.SetFileName(str(file))
    reader.Update()
    collection = reader.GetOutputDataObject(0)
    areas = {}
    for i in range(collection.GetNumberOfPartitionedDataSets()):
        data = collection.GetPartition(i, 0)
        points = np.array([data.GetPoint(p) for p in range(data.GetNumberOfPoints())])
        cells = []
        for c in range(data.GetNumberOfCells()):
            ids = data.GetCell(c).GetPointIds() # of a cell that VTK uses again
            cells.append([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
        name = collection.GetMetaData(i).Get(collection.NAME())
        areas[name] = sum(area_of(points[cell]) for cell in cells)
    return areas


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
               "--fluent", "m.msh", "--cgns", "m.cgns", "--su2", "m.su2", cwd=folder)
    assert made.returncode in (0, 4, 5), made.stderr
    expected = areas_of_patches(folder / "p.vtpc")
    table, volume, failed = check_mesh(folder / "case")
    same(areas_of_case(folder / "case"), expected, "OpenFOAM")
    shutil.copytree(folder / "case" / "system", folder / "fluent" / "system")
    converted = run("fluent3DMeshToFoam", folder / "m.msh", cwd=folder / "fluent")
    assert converted.returncode == 0, converted.stdout + converted.stderr
    its_table, its_volume, its_failed = check_mesh(folder / "fluent")
    assert (its_table, its_failed) == (table, failed), (its_table, its_failed, table, failed)
    assert abs(its_volume - volume) < 1e-6 * volume
    same(areas_of_case(folder / "fluent"), expected, "Fluent")
    for name in expected:
        word = re.sub("_back$", "-shadow", re.sub("_front$", "", name))
        if re.fullmatch(r"\w+", name) and name.replace("_front", "_back") in expected and name != word:
            assert word in names_of_fluent(folder), word
    su2_volume, areas, common = read_su2(folder / "m.su2")
    assert abs(su2_volume - volume) < 1e-6 * volume, (su2_volume, volume)
    same(areas, expected, "SU2")
    if shutil.which("cgnscheck"):
        said = run("cgnscheck", folder / "m.cgns", cwd=folder).stdout
        # It tells faces apart by their points, which those of a sheet one face wide have in common.
        errors = [line for line in said.splitlines() if line.startswith("ERROR")]
        assert common or not errors, errors
        assert all(re.search(rf'checking BC "{re.escape(name[:32])}', said) for name in expected if len(name) < 28), said
    print(f"{model.name}: {table['cells']} cells, {len(expected)} patches, {common} faces with common points, {failed} failed checks")


def names_of_fluent(folder):
    return set(re.findall(r"^    ([^\s/]+)\n    \{", foam_body(folder / "fluent", "boundary"), re.MULTILINE))


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
