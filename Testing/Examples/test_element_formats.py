# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh of hexahedra in formats of finite elements: readers of our own and other programs find the same mesh.

Usage: test_element_formats.py ATRIA MODEL.wrl [MODEL…]
The first model has polyhedra without --hex. Gmsh, CalculiX (ccx) and meshio are asked where they are installed.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader, vtkXMLUnstructuredGridReader

ATRIA = pathlib.Path(sys.argv[1]).resolve()
OUTWARD = np.array([(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)])
# As in Abaqus' manual.
ABAQUS = np.array([(1, 2, 3, 4), (5, 8, 7, 6), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 8, 4), (4, 8, 5, 1)]) - 1


def run(*command, cwd):
    return subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True, check=False)


def area_vectors(loops):
    return np.cross(loops[:, 2] - loops[:, 0], loops[:, 3] - loops[:, 1]) / 2


def read_vtk(file, patches):
    """The number of cells, and the area vector of each patch."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    assert {grid.GetCellType(c) for c in range(grid.GetNumberOfCells())} == {12}
    reader = vtkXMLPartitionedDataSetCollectionReader()
    reader.SetFileName(str(patches))
    reader.Update()
    collection, areas = reader.GetOutputDataObject(0), {}
    for i in range(collection.GetNumberOfPartitionedDataSets()):
        data = collection.GetPartition(i, 0)
        points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
        loops = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 4)
        areas[collection.GetMetaData(i).Get(collection.NAME())] = area_vectors(points[loops])
    return grid.GetNumberOfCells(), areas


def read_gmsh(file):
    """Points, hexahedra, and by name the faces of patches."""
    sections = dict(re.findall(r"^\$(\w+)\n(.*?)^\$End\1$", file.read_text(), re.DOTALL | re.MULTILINE))
    assert sections["MeshFormat"] == "4.1 0 8\n"
    names = {(int(d), int(t)): name for d, t, name in re.findall(r'^(\d) (\d+) "(.*)"$', sections["PhysicalNames"], re.MULTILINE)}
    lines = sections["Entities"].splitlines()
    counts = list(map(int, lines[0].split()))
    tags = {}
    for dimension, rows in ((2, lines[1:1 + counts[2]]), (3, lines[1 + counts[2]:])):
        for row in map(str.split, rows):
            tags[dimension, int(row[0])] = [int(t) for t in row[8:8 + int(row[7])]]
    lines = iter(sections["Nodes"].splitlines())
    blocks, count, first, last = map(int, next(lines).split())
    assert (first, last) == (1, count)
    points = np.full((count, 3), np.nan)
    for _ in range(blocks):
        own = int(next(lines).split()[3])
        numbers = [int(next(lines)) - 1 for _ in range(own)]
        points[numbers] = [list(map(float, next(lines).split())) for _ in range(own)]
    assert not np.isnan(points).any()
    lines = iter(sections["Elements"].splitlines())
    blocks, cells, patches = int(next(lines).split()[0]), [], {}
    for _ in range(blocks):
        dimension, entity, kind, own = map(int, next(lines).split())
        assert kind == {2: 3, 3: 5}[dimension]
        rows = np.array([list(map(int, next(lines).split()))[1:] for _ in range(own)]) - 1
        if dimension == 3:
            cells.append(rows)
        else:
            patches[names[2, tags[2, entity][0]]] = rows
    return points, np.concatenate(cells), patches


def read_abaqus(file):
    points, cells, patches, keyword = [], [], {}, ""
    for line in file.read_text().splitlines():
        assert len(line) <= 256
        if line.startswith("**"):
            continue
        fields = [field.strip() for field in line.split(",")]
        if line.startswith("*"):
            keyword = fields[0]
            assert keyword != "*ELEMENT" or fields[1] == "TYPE=C3D8"
            faces = patches.setdefault(fields[1].removeprefix("NAME="), []) if keyword == "*SURFACE" else []
        elif keyword == "*NODE":
            assert int(fields[0]) == len(points) + 1 and all(len(x) <= 20 for x in fields[1:])
            points.append(list(map(float, fields[1:])))
        elif keyword == "*ELEMENT":
            assert int(fields[0]) == len(cells) + 1
            cells.append([int(n) - 1 for n in fields[1:]])
        elif keyword == "*SURFACE":
            faces.append((int(fields[0]) - 1, int(fields[1][1:]) - 1))
    cells = np.array(cells)
    return np.array(points), cells, {name: np.array([cells[c, ABAQUS[s]] for c, s in faces]) for name, faces in patches.items()}


def check_mesh(mesh, count, expected, what):
    """All cells are there and not inside out; patches are the boundary, each face once, with the areas they had."""
    points, cells, patches = mesh
    assert len(cells) == count, (what, len(cells), count)
    x = points[cells]
    loops = x[:, OUTWARD] - x.mean(axis=1)[:, None, None]
    a, b = loops, np.roll(loops, -1, axis=2)
    volumes = (np.cross(a, b) * loops.mean(axis=2)[:, :, None]).sum(axis=(1, 2, 3)) / 6
    assert (volumes > 0).all(), (what, (volumes <= 0).sum())
    seen, counts = np.unique(np.sort(cells[:, OUTWARD].reshape(-1, 4), axis=1), axis=0, return_counts=True)
    assert counts.max() == 2, what
    boundary = set(map(tuple, seen[counts == 1]))
    marked = [tuple(face) for faces in patches.values() for face in np.sort(faces, axis=1)]
    assert len(marked) == len(set(marked)), (what, "a face is in two patches")
    assert set(marked) == boundary, (what, len(set(marked) ^ boundary))
    assert set(patches) == {re.sub(r"[^\w.+:/-]", "_", name) for name in expected}, (what, sorted(patches))
    for name, areas in expected.items():
        found = area_vectors(points[patches[re.sub(r"[^\w.+:/-]", "_", name)]])
        assert len(found) == len(areas), (what, name)
        assert np.allclose(np.linalg.norm(found, axis=1).sum(), np.linalg.norm(areas, axis=1).sum(), rtol=1e-6), (what, name)
    return volumes.sum()


def ask_gmsh(folder, count, expected):
    """Gmsh reads the file and writes it for SU2: all elements and the names of patches are there."""
    if not shutil.which("gmsh"):
        return "not installed"
    said = run("gmsh", "m.msh", "-save", "-o", "gmsh.su2", cwd=folder)
    text = said.stdout + said.stderr
    assert said.returncode == 0 and not re.search("Error|Warning", text), text
    lines = (folder / "gmsh.su2").read_text()
    assert int(re.search(r"NELEM= *(\d+)", lines).group(1)) == count
    markers = {name: int(n) for name, n in re.findall(r"MARKER_TAG= *(\S+)\s+MARKER_ELEMS= *(\d+)", lines)}
    assert markers == {name: len(areas) for name, areas in expected.items()}, markers
    return "agrees"


def ask_meshio(folder, count, expected):
    try:
        import meshio
    except ImportError:
        return "not installed"
    for file in ("m.msh", "m.inp"):
        mesh = meshio.read(folder / file)
        blocks = {}
        for block in mesh.cells:
            blocks[block.type] = blocks.get(block.type, 0) + len(block.data)
        assert blocks["hexahedron"] == count, (file, blocks)
        assert "quad" not in blocks or blocks["quad"] == sum(map(len, expected.values())), blocks
    return "agrees"


CCX = """*INCLUDE, INPUT=m.inp
*MATERIAL, NAME=M
*ELASTIC
1., 0.
*SOLID SECTION, ELSET=EALL, MATERIAL=M
*NSET, NSET=HELD
{held}
*BOUNDARY
HELD, 1, 3
*STEP
*STATIC
*DSLOAD
{name}, P, 1.
*NODE PRINT, NSET=HELD, TOTALS=ONLY
RF
*END STEP
"""


def ask_ccx(folder, mesh, expected):
    """CalculiX puts a pressure on a patch. Nodes inside that are held carry the patch's area vector."""
    if not shutil.which("ccx"):
        return "not installed"
    _, cells, patches = mesh
    if len(cells) > 2000:
        return "not asked: it takes a minute or more"
    inside = cells[~np.isin(cells, np.concatenate(list(patches.values()))).any(axis=1)][0]
    for name, areas in expected.items():
        (folder / "job.inp").write_text(CCX.format(name=name, held="\n".join(str(n + 1) for n in inside)))
        said = run("ccx", "job", cwd=folder)
        text = said.stdout + said.stderr
        assert said.returncode == 0 and not re.search(r"\*ERROR|\*WARNING", text), text[-3000:]
        found = np.array((folder / "job.dat").read_text().split()[-3:], dtype=float)
        force = areas.sum(axis=0)  # the pressure acts into the mesh, and the nodes against it
        assert np.abs(found - force).max() < 1e-3 * np.linalg.norm(areas, axis=1).sum(), (name, found, force)
    return "agrees"


def check(model, folder, options):
    made = run(ATRIA, "mesh", model, "--hex", *options, "-o", "m.vtu", "--patches", "p.vtpc", "--gmsh", "m.msh", "--abaqus",
               "m.inp", cwd=folder)
    assert made.returncode in (0, 4, 5), made.stderr
    count, expected = read_vtk(folder / "m.vtu", folder / "p.vtpc")
    gmsh, abaqus = read_gmsh(folder / "m.msh"), read_abaqus(folder / "m.inp")
    volume = check_mesh(gmsh, count, expected, "Gmsh")
    assert abs(check_mesh(abaqus, count, expected, "Abaqus") - volume) < 1e-9 * volume
    for name, faces in gmsh[2].items():
        assert np.allclose(area_vectors(gmsh[0][faces]).sum(axis=0), expected[name].sum(axis=0), atol=1e-6 * volume), name
    others = {"Gmsh": ask_gmsh(folder, count, expected), "meshio": ask_meshio(folder, count, expected),
              "CalculiX": ask_ccx(folder, abaqus, expected)}
    print(f"{model.name}: {count} hexahedra, {len(expected)} patches, " + ", ".join(f"{k} {v}" for k, v in others.items()))


def check_refused(model, folder, options):
    """A mesh with polyhedra is refused in both formats, with their number; it is there in others."""
    made = run(ATRIA, "mesh", model, *options, "-o", "m.vtu", "--gmsh", "m.msh", cwd=folder)
    assert made.returncode not in (0, 4, 5), made.stderr
    assert re.search(r"no place for \d+ polyhedra among the mesh's \d+ elements; mesh with --hex and few layers, or write", made.stderr), made.stderr
    assert (folder / "m.vtu").exists() and not (folder / "m.msh").exists()
    made = run(ATRIA, "convert", "m.vtu", "--abaqus", "m.inp", cwd=folder)
    assert made.returncode != 0 and "polyhedra" in made.stderr and not (folder / "m.inp").exists(), made.stderr


def main():
    for number, argument in enumerate(sys.argv[2:]):
        name, *options = argument.split(" ")
        for step in (check, check_refused) if number == 0 else (check,):
            with tempfile.TemporaryDirectory() as folder:
                step(pathlib.Path(name).resolve(), pathlib.Path(folder), options)


main()
