#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes house.wrl and house_turned17.wrl: a gabled house of zero-thickness walls on a site, with a neighbor.

All lengths are in meters, Z is up. Walls, roof, floor and partitions are single sheets that share their points wherever
they meet. The site is a plain rectangle under everything, as it comes from a survey. In the turned model everything
but the site is turned by 17 degrees about the vertical through the middle of the house.

Usage: make_house.py [FOLDER]    (default: the folder of this script)
"""

import math
import pathlib
import sys

from polygons import area, with_points_in_between
from vrml_text import surface

LENGTH, WIDTH, EAVES, RIDGE = 24.0, 14.0, 7.0, 11.0
SILL, HEAD = 1.0, 2.5
SITE = (-90.0, -84.0, 137.0, 98.0)  # x0 y0 x1 y1: 227 x 182
PARTITION_A, PARTITION_B = 6.0, 18.0  # x of the two partitions
DOOR_A, DOOR_B, DOOR_HEAD = (6.0, 7.0), (10.0, 11.0), 2.1
LONG_SIDE_WINDOWS = [(2.5, 4.5), (8.5, 10.5), (13.5, 15.5), (19.5, 21.5)]
SHORT_SIDE_WINDOWS = [(6.0, 8.0)]
TURN = math.radians(17)


def bands(start, end, windows, cuts):
    """Rectangles (u0, w0, u1, w1) of a wall around its windows, cut where partitions meet it."""
    stops = [start, *cuts, end]
    for left, right in zip(stops, stops[1:]):
        holes = [w for w in windows if left < w[0] and w[1] < right]
        yield left, 0.0, right, SILL
        edges = [left, *(u for w in holes for u in w), right]
        for pier_left, pier_right in zip(edges[::2], edges[1::2]):
            yield pier_left, SILL, pier_right, HEAD
        yield left, HEAD, right, EAVES


def long_wall(y, outward):
    faces = []
    for u0, w0, u1, w1 in bands(0.0, LENGTH, LONG_SIDE_WINDOWS, [PARTITION_A, PARTITION_B]):
        face = [(u0, y, w0), (u1, y, w0), (u1, y, w1), (u0, y, w1)]
        faces.append(face if outward < 0 else face[::-1])
    return faces


def short_wall(x, outward):
    faces = []
    for u0, w0, u1, w1 in bands(0.0, WIDTH, SHORT_SIDE_WINDOWS, []):
        face = [(x, u0, w0), (x, u1, w0), (x, u1, w1), (x, u0, w1)]
        faces.append(face if outward > 0 else face[::-1])
    return faces


def gable(x, outward):
    face = [(x, 0.0, EAVES), (x, WIDTH, EAVES), (x, WIDTH / 2, RIDGE)]
    return [face if outward > 0 else face[::-1]]


def roof(y_eaves):
    """One slope; cut along partition A, which reaches it."""
    faces = []
    for x0, x1 in ((0.0, PARTITION_A), (PARTITION_A, LENGTH)):
        face = [(x0, y_eaves, EAVES), (x1, y_eaves, EAVES), (x1, WIDTH / 2, RIDGE), (x0, WIDTH / 2, RIDGE)]
        faces.append(face if y_eaves == 0 else face[::-1])
    return faces


def floor():
    stops = [0.0, PARTITION_A, PARTITION_B, LENGTH]
    return [
        [(x0, 0.0, 0.0), (x1, 0.0, 0.0), (x1, WIDTH, 0.0), (x0, WIDTH, 0.0)] for x0, x1 in zip(stops, stops[1:])
    ]


def partition(x, door, up_to_roof):
    """One concave polygon around the door; it ends at the eaves' height or follows the roof."""
    outline = [(0.0, 0.0), (door[0], 0.0), (door[0], DOOR_HEAD), (door[1], DOOR_HEAD), (door[1], 0.0)]
    outline += [(WIDTH, 0.0), (WIDTH, EAVES)]
    if up_to_roof:
        outline.append((WIDTH / 2, RIDGE))
    outline.append((0.0, EAVES))
    return [[(x, y, z) for y, z in outline]]


def neighbor(x0=49.0, y0=2.0, length=12.0, width=10.0, eaves=6.0, ridge=9.0):
    """A closed solid, faces outward."""
    x1, y1, ym = x0 + length, y0 + width, y0 + width / 2
    return [
        [(x0, y0, 0.0), (x0, y1, 0.0), (x1, y1, 0.0), (x1, y0, 0.0)],
        [(x0, y0, 0.0), (x1, y0, 0.0), (x1, y0, eaves), (x0, y0, eaves)],
        [(x1, y1, 0.0), (x0, y1, 0.0), (x0, y1, eaves), (x1, y1, eaves)],
        [(x0, y1, 0.0), (x0, y0, 0.0), (x0, y0, eaves), (x0, ym, ridge), (x0, y1, eaves)],
        [(x1, y0, 0.0), (x1, y1, 0.0), (x1, y1, eaves), (x1, ym, ridge), (x1, y0, eaves)],
        [(x0, y0, eaves), (x1, y0, eaves), (x1, ym, ridge), (x0, ym, ridge)],
        [(x1, y1, eaves), (x0, y1, eaves), (x0, ym, ridge), (x1, ym, ridge)],
    ]


def site():
    x0, y0, x1, y1 = SITE
    return [[(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)]]


HOUSE = {
    "Floor": (floor(), "Boards"),
    "WallSouth": (long_wall(0.0, -1), "Plaster"),
    "WallEast": (short_wall(LENGTH, +1), "Plaster"),
    "WallNorth": (long_wall(WIDTH, +1), "Plaster"),
    "WallWest": (short_wall(0.0, -1), "Plaster"),
    "GableEast": (gable(LENGTH, +1), "Boards"),
    "GableWest": (gable(0.0, -1), "Boards"),
    "RoofSouth": (roof(0.0), "Tiles"),
    "RoofNorth": (roof(WIDTH), "Tiles"),
    "PartitionA": (partition(PARTITION_A, DOOR_A, up_to_roof=True), "Plaster"),
    "PartitionB": (partition(PARTITION_B, DOOR_B, up_to_roof=False), "Plaster"),
}
COLORS = {"Boards": "0.62 0.45 0.30", "Plaster": "0.93 0.91 0.85", "Tiles": "0.68 0.30 0.22", "Grass": "0.50 0.62 0.40"}


def model(turned):
    defined = set()

    def shape(name, polygons, material):
        look = f"USE {material}"
        if material not in defined:
            defined.add(material)
            look = f"DEF {material} Material {{ diffuseColor {COLORS[material]} }}"
        return surface(name, polygons, f"appearance Appearance {{ material {look} }}\n")

    turn = f"rotation 0 0 1 {TURN!r} center {LENGTH / 2:g} {WIDTH / 2:g} 0 " if turned else ""
    parts = [shape(name, *value) for name, value in with_points_in_between(HOUSE).items()]
    parts.append(shape("Neighbor", neighbor(), "Plaster"))
    return (
        "#VRML V2.0 utf8\n# Written by make_house.py. Meters, Z up.\n"
        f"DEF Buildings Transform {{ {turn}children [\n{''.join(parts)}] }}\n{shape('Site', site(), 'Grass')}"
    )


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "house.wrl").write_text(model(turned=False))
    (folder / "house_turned17.wrl").write_text(model(turned=True))
    sheets = {name: sum(map(area, polygons)) for name, (polygons, _) in HOUSE.items()}
    for name, value in sheets.items():
        print(f"{name:12} {value:10.4f} m2")
    print(f"{'All sheets':12} {sum(sheets.values()):10.4f} m2, of which {sheets['Floor']:g} on the ground")


if __name__ == "__main__":
    main()
