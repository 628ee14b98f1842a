# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes meshes of OpenFOAM for tests: boxes of hexahedra, with a face zone across and cell zones on its sides."""

import itertools
import pathlib
import tempfile
import unittest

BOX = ((0.0, 100.0), (-20.0, 20.0), (0.0, 40.0))
SIDES = ("xMin", "xMax", "yMin", "yMax", "zMin", "zMax")


def header(name, of):
    return (f"FoamFile {{ version 2.0; format ascii; class {of}; location \"constant/polyMesh\"; object {name}; }}\n")


def write_box(case, counts, bounds, *, zone_at=None, turned=None, patch_of=None):
    """A box of counts[0] × counts[1] × counts[2] cells between `bounds` ((x0, x1), (y0, y1), (z0, z1)).

    zone_at  the face zone `Wall_opening_1` lies between cells i = zone_at - 1 and zone_at; cells before it are the zone
             `hall`, of those behind it none
    turned   a function of a point, such as a rotation
    patch_of a function of a side's name and a cell (i, j, k) at it: the patch of the face, its side by itself. Patches
             with other names than sides are walls
    """
    nx, ny, nz = counts
    cell = lambda i, j, k: i + nx * (j + ny * k)
    point = lambda i, j, k: i + (nx + 1) * (j + (ny + 1) * k)
    at = lambda axis, i: bounds[axis][0] + (bounds[axis][1] - bounds[axis][0]) * i / counts[axis]
    points = [(at(0, i), at(1, j), at(2, k)) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    if turned:
        points = [turned(p) for p in points]

    def face(axis, i, j, k):
        """Below cell (i, j, k) along an axis, its normal along the axis."""
        if axis == 0:
            return [point(i, j, k), point(i, j + 1, k), point(i, j + 1, k + 1), point(i, j, k + 1)]
        if axis == 1:
            return [point(i, j, k), point(i, j, k + 1), point(i + 1, j, k + 1), point(i + 1, j, k)]
        return [point(i, j, k), point(i + 1, j, k), point(i + 1, j + 1, k), point(i, j + 1, k)]

    internal, sides = [], {} if patch_of else {name: [] for name in SIDES}
    named = lambda side, place: sides.setdefault(patch_of(side, tuple(place)) if patch_of else side, [])
    for k, j, i in itertools.product(range(nz), range(ny), range(nx)):
        here = cell(i, j, k)
        for axis, count in enumerate(counts):
            place = [i, j, k]
            if place[axis] == 0:
                named(SIDES[2 * axis], place).append((here, None, face(axis, i, j, k)[::-1], None))
            inside = list(place)
            place[axis] += 1
            there = face(axis, *place)
            if place[axis] == count:
                named(SIDES[2 * axis + 1], inside).append((here, None, there, None))
            else:
                internal.append((here, cell(*place), there, place[0] if axis == 0 else None))
    internal.sort(key=lambda f: f[:2])
    faces = internal + [f for name in sides for f in sides[name]]
    folder = case / "constant" / "polyMesh"
    folder.mkdir(parents=True)
    listed = lambda rows: f"{len(rows)}\n(\n" + "\n".join(rows) + "\n)\n"
    write = lambda name, of, text: (folder / name).write_text(header(name, of) + text)
    write("points", "vectorField", listed([f"({x!r} {y!r} {z!r})" for x, y, z in points]))
    write("faces", "faceList", listed(["4(" + " ".join(map(str, f[2])) + ")" for f in faces]))
    write("owner", "labelList", listed([str(f[0]) for f in faces]))
    write("neighbour", "labelList", listed([str(f[1]) for f in internal]))
    start, patches = len(internal), []
    for name in sides:
        kind = "patch" if name in SIDES else "wall"
        patches.append(f"// a comment\n{name} {{ type {kind}; nFaces {len(sides[name])}; startFace {start}; }}")
        start += len(sides[name])
    write("boundary", "polyBoundaryMesh", listed(patches))
    if zone_at is not None:
        chosen = [str(n) for n, f in enumerate(internal) if f[3] == zone_at]
        write("faceZones", "regIOobject",
              f"1\n(\nWall_opening_1 {{ type faceZone; faceLabels List<label> {len(chosen)}({' '.join(chosen)}); "
              f"flipMap List<bool> {len(chosen)}{{0}}; }}\n)\n")
        hall = [str(cell(i, j, k)) for i in range(zone_at) for j in range(ny) for k in range(nz)]
        write("cellZones", "regIOobject",
              f"1\n(\nhall {{ type cellZone; cellLabels List<label> {len(hall)}({' '.join(hall)}); }}\n)\n")


class BoxCase(unittest.TestCase):
    """Tests with a scratch folder for all of them, and in it the case `box`, with a zone across."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.box = cls.folder / "box"
        write_box(cls.box, (20, 8, 8), BOX, zone_at=10)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()
