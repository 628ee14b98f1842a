#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes school.wrl: a building whose windows stand open, a closed neighbor, and the site.

All lengths are in meters, Z is up, y points north. Walls, roof and partitions are sheets without thickness. Windows are
in the walls to the south and the north only; doors in the partitions join the rooms. Openings are wide enough for
elements of 2 m. The site is a rectangle of 227 x 182 m, or of the sizes asked for, with the building in its middle.

Usage: make_building.py FILE.wrl [LENGTH WIDTH [ANGLE]]

With ANGLE, degrees counterclockwise from above, building, neighbor and site are turned about the origin.
"""

import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Data"))

from polygons import with_points_in_between  # noqa: E402
from vrml_text import surface  # noqa: E402

LENGTH, WIDTH, HEIGHT = 48.0, 26.0, 9.0
CORRIDOR = 14.0  # y of the partition along the building
CROSS_SOUTH, CROSS_NORTH = 17.0, 31.0  # x of the partitions across it
SITE = (227.0, 182.0)
NEIGHBOR = (64.0, 10.0, 84.0, 26.0, 12.0)  # x0 y0 x1 y1 height


def window(u):
    """(u0, w0, u1, w1), along the wall and upwards."""
    return (u, 2.0, u + 6.0, 6.0)


def door(u):
    return (u, 0.0, u + 4.0, 5.0)


HOLES = {
    "WallSouth": [window(u) for u in (5.0, 20.0, 36.0)],
    "WallNorth": [window(u) for u in (4.0, 18.0, 37.0)],
    "Corridor": [door(7.0), door(24.0), door(38.0)],
    "CrossSouth": [door(5.0)],
    "CrossNorth": [door(18.0)],
}


def wall(name, place, stops, top=HEIGHT):
    """Polygons beside, below and above the holes; `stops` are where other walls meet it, ends among them."""
    holes = HOLES.get(name, [])
    cuts = sorted({*stops, *(u for hole in holes for u in (hole[0], hole[2]))})
    polygons = []
    for u0, u1 in zip(cuts, cuts[1:]):
        here = [hole for hole in holes if hole[0] <= u0 and u1 <= hole[2]]
        heights = [0.0, *(w for hole in here for w in (hole[1], hole[3])), top]
        for low, high in zip(heights[::2], heights[1::2]):
            if low < high:
                polygons.append([place(u0, low), place(u1, low), place(u1, high), place(u0, high)])
    return polygons


def along(y):
    return lambda u, w: (u, y, w)


def across(x):
    return lambda u, w: (x, u, w)


def roof():
    xs, ys = [0.0, CROSS_SOUTH, CROSS_NORTH, LENGTH], [0.0, CORRIDOR, WIDTH]
    return [
        [(x0, y0, HEIGHT), (x1, y0, HEIGHT), (x1, y1, HEIGHT), (x0, y1, HEIGHT)]
        for x0, x1 in zip(xs, xs[1:])
        for y0, y1 in zip(ys, ys[1:])
    ]


def sheets():
    sides, crossed = [0.0, CORRIDOR, WIDTH], [0.0, CROSS_SOUTH, CROSS_NORTH, LENGTH]
    return {
        "WallSouth": (wall("WallSouth", along(0.0), [0.0, CROSS_SOUTH, LENGTH]), None),
        "WallNorth": (wall("WallNorth", along(WIDTH), [0.0, CROSS_NORTH, LENGTH]), None),
        "WallWest": (wall("WallWest", across(0.0), sides), None),
        "WallEast": (wall("WallEast", across(LENGTH), sides), None),
        "Roof": (roof(), None),
        "Corridor": (wall("Corridor", along(CORRIDOR), crossed), None),
        "CrossSouth": (wall("CrossSouth", across(CROSS_SOUTH), [0.0, CORRIDOR]), None),
        "CrossNorth": (wall("CrossNorth", across(CROSS_NORTH), [CORRIDOR, WIDTH]), None),
    }


def neighbor():
    """A closed solid, faces outward."""
    x0, y0, x1, y1, top = NEIGHBOR
    floor = [(x0, y0), (x0, y1), (x1, y1), (x1, y0)]
    sides = [
        [(*a, 0.0), (*b, 0.0), (*b, top), (*a, top)] for a, b in zip(floor[1:] + floor[:1], floor)
    ]
    return [[(*p, 0.0) for p in floor], [(*p, top) for p in floor[::-1]], *sides]


def site(length, width):
    x, y = (LENGTH - length) / 2, (WIDTH - width) / 2
    return [[(x, y, 0.0), (x + length, y, 0.0), (x + length, y + width, 0.0), (x, y + width, 0.0)]]


def volume():
    """Of all rooms, cubic meters."""
    return LENGTH * WIDTH * HEIGHT


PLACES = {"WallSouth": along(0.0), "WallNorth": along(WIDTH), "Corridor": along(CORRIDOR), "CrossSouth": across(CROSS_SOUTH),
          "CrossNorth": across(CROSS_NORTH)}


def openings():
    """Rectangles by the names that Atria gives openings of these surfaces, but for the order of the numbers."""
    return {
        f"{name}_opening_{number}": [[PLACES[name](*corner) for corner in ((u0, w0), (u1, w0), (u1, w1), (u0, w1))]]
        for name, holes in HOLES.items()
        for number, (u0, w0, u1, w1) in enumerate(holes, 1)
    }


def turned(polygons, degrees):
    """About the origin, counterclockwise from above."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[(c * x - s * y, s * x + c * y, z) for x, y, z in polygon] for polygon in polygons]


def model(length, width, angle):
    parts = {name: polygons for name, (polygons, _) in with_points_in_between(sheets()).items()}
    parts |= {"Neighbor": neighbor(), "Site": site(length, width)}
    if angle:
        parts = {name: turned(polygons, angle) for name, polygons in parts.items()}
    parts = [surface(name, polygons) for name, polygons in parts.items()]
    return "#VRML V2.0 utf8\n# Written by make_building.py. Meters, Z up.\n" + "".join(parts)


def main(file, length=SITE[0], width=SITE[1], angle=0.0):
    pathlib.Path(file).write_text(model(float(length), float(width), float(angle)))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 4, 5):
        sys.exit(__doc__)
    main(*sys.argv[1:])
