#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes building.wrl and building_turned17.wrl: a building of zero-thickness sheets on a site, and their openings.

All lengths are in meters, Z is up. Two storeys and an attic under a gabled roof that stands out over the walls on all
sides, slabs between the storeys, partitions with doors, and a screen before the building: 4,188 m2 of sheets with
62 m2 of openings. All rooms are connected with the open through windows and doors. Sheets share their points wherever
they meet. The walls stand on the site, which is a plain rectangle under everything, as it comes from a survey; they do
not share points with it. In a turned model everything but the site is turned about the vertical through the middle of
the building.

Beside each model a table of the same name, `_openings.csv`, has the corners of its openings.

Usage: make_building.py [FOLDER [DEGREES ...]]    (default: the folder of this script, 0 and 17 degrees)
"""

import math
import pathlib
import sys

from polygons import area, with_points_in_between
from vrml_text import number, surface

LENGTH, WIDTH, STOREY, EAVES, RIDGE = 39.3, 20.0, 4.0, 8.0, 14.0
MIDDLE = WIDTH / 2
SLOPE = (RIDGE - EAVES) / MIDDLE
OVERHANG = 1.0
SITE = (-90.0, -84.0, 137.0, 98.0)  # x0 y0 x1 y1: 227 x 182
CORRIDOR = 8.0  # y of the partition along the building, on both storeys
CROSS_SOUTH, CROSS_NORTH, CROSS_UPPER, CROSS_ATTIC = 13.3, 26.2, 20.6, 24.0  # x of the partitions across it
SCREEN = (8.0, 15.6, -6.5, 2.0)  # x0 x1 y height


def window(u, storey=0.0):
    """Sill at 1 m, 2 m wide and 1.5 m high: (u0, w0, u1, w1)."""
    return (u, storey + 1.0, u + 2.0, storey + 2.5)


def door(u, storey=0.0):
    return (u, storey, u + 1.25, storey + 2.4)


# Holes by surface, in coordinates along the wall and upwards.
HOLES = {
    "WallSouth": [window(u) for u in (3.0, 8.0, 17.0, 24.4, 31.0)] + [window(u, STOREY) for u in (4.0, 25.0)],
    "WallNorth": [window(u) for u in (5.0, 15.0, 29.0)] + [window(u, STOREY) for u in (6.0, 30.0)],
    "WallWest": [door(3.0)],
    "GableEast": [window(9.0, EAVES + 0.5)],
    "GableWest": [window(9.0, EAVES + 0.5)],
    "Corridor": [door(6.0), door(30.0)],
    "CorridorUpper": [door(10.0, STOREY)],
    "CrossSouth": [door(3.0)],
    "CrossNorth": [door(13.0)],
    "CrossAttic": [(10.0, EAVES, 11.0, EAVES + 2.0)],
}


def cells(u_cuts, w_cuts, holes):
    """Rectangles (u0, w0, u1, w1) between cuts, in upright strips beside, below and above holes."""
    for w0, w1 in zip(w_cuts, w_cuts[1:]):
        here = [h for h in holes if w0 <= h[1] and h[3] <= w1]
        stops = sorted({*u_cuts, *(u for h in here for u in (h[0], h[2]))})
        for u0, u1 in zip(stops, stops[1:]):
            heights = [w0]
            for hole in here:
                if hole[0] <= u0 and u1 <= hole[2]:
                    heights += [hole[1], hole[3]]
            heights.append(w1)
            for low, high in zip(heights[::2], heights[1::2]):
                if low < high:
                    yield u0, low, u1, high


def along(y):
    """Points of an upright plane along the building."""
    return lambda u, w: (u, y, w)


def across(x):
    return lambda u, w: (x, u, w)


def level(z):
    return lambda u, w: (u, w, z)


def wall(name, place, u_cuts, w_cuts, flip=False):
    """The wall's polygons; its front is where y falls (along) or x grows (across), or the other way with `flip`."""
    polygons = []
    for u0, w0, u1, w1 in cells(u_cuts, w_cuts, HOLES.get(name, [])):
        polygon = [place(u0, w0), place(u1, w0), place(u1, w1), place(u0, w1)]
        polygons.append(polygon[::-1] if flip else polygon)
    return polygons


def gable(name, x, flip):
    """From the eaves to the ridge, around one hole that reaches or passes the ridge's line."""
    ((u0, w0, u1, w1),) = HOLES[name]

    def top(u):
        return RIDGE - SLOPE * abs(u - MIDDLE)

    outlines = [[(0.0, EAVES), (u0, EAVES), (u0, top(u0))], [(u1, EAVES), (WIDTH, EAVES), (u1, top(u1))]]
    if w0 > EAVES:
        outlines.append([(u0, EAVES), (u1, EAVES), (u1, w0), (u0, w0)])
    peak = [(MIDDLE, RIDGE)] if u0 < MIDDLE < u1 else []
    tops = [(u1, top(u1)), *peak, (u0, top(u0))]
    outlines.append([(u0, w1), (u1, w1), *tops])
    return [[(x, u, w) for u, w in (outline[::-1] if flip else outline)] for outline in outlines]


def roof(side):
    """One slope, south (-1) or north (+1), cut where gables, the attic's partition and the walls' tops meet it."""

    def point(x, d):
        return (x, MIDDLE + side * d, RIDGE - SLOPE * d)

    xs = [-OVERHANG, 0.0, CROSS_ATTIC, LENGTH, LENGTH + OVERHANG]
    polygons = []
    for x0, x1 in zip(xs, xs[1:]):
        for d0, d1 in ((0.0, MIDDLE), (MIDDLE, MIDDLE + OVERHANG)):
            polygon = [point(x0, d1), point(x1, d1), point(x1, d0), point(x0, d0)]
            polygons.append(polygon if side < 0 else polygon[::-1])
    return polygons


def sheets():
    west_east = [0.0, LENGTH]
    both = [0.0, STOREY, EAVES]
    lower, upper = both[:2], both[1:]
    slab_xs = [0.0, CROSS_SOUTH, CROSS_UPPER, CROSS_NORTH, LENGTH]
    x0, x1, y, height = SCREEN
    return {
        "WallSouth": (wall("WallSouth", along(0.0), [0.0, CROSS_SOUTH, CROSS_UPPER, LENGTH], both), "Plaster"),
        "WallEast": (wall("WallEast", across(LENGTH), [0.0, CORRIDOR, WIDTH], both), "Plaster"),
        "WallNorth": (wall("WallNorth", along(WIDTH), [0.0, CROSS_UPPER, CROSS_NORTH, LENGTH], both, True), "Plaster"),
        "WallWest": (wall("WallWest", across(0.0), [0.0, CORRIDOR, WIDTH], both, True), "Plaster"),
        "GableEast": (gable("GableEast", LENGTH, False), "Boards"),
        "GableWest": (gable("GableWest", 0.0, True), "Boards"),
        "RoofSouth": (roof(-1), "Tiles"),
        "RoofNorth": (roof(+1), "Tiles"),
        "Slab": (wall("Slab", level(STOREY), slab_xs, [0.0, CORRIDOR, WIDTH]), "Boards"),
        "Ceiling": (wall("Ceiling", level(EAVES), [0.0, CROSS_UPPER, CROSS_ATTIC, LENGTH], [0.0, CORRIDOR, WIDTH]),
                    "Boards"),
        "Corridor": (wall("Corridor", along(CORRIDOR), [0.0, CROSS_SOUTH, CROSS_NORTH, LENGTH], lower), "Plaster"),
        "CorridorUpper": (wall("CorridorUpper", along(CORRIDOR), [0.0, CROSS_UPPER, LENGTH], upper), "Plaster"),
        "CrossSouth": (wall("CrossSouth", across(CROSS_SOUTH), [0.0, CORRIDOR], lower), "Plaster"),
        "CrossNorth": (wall("CrossNorth", across(CROSS_NORTH), [CORRIDOR, WIDTH], lower), "Plaster"),
        "CrossUpper": (wall("CrossUpper", across(CROSS_UPPER), [0.0, CORRIDOR, WIDTH], upper), "Plaster"),
        "CrossAttic": (gable("CrossAttic", CROSS_ATTIC, False), "Plaster"),
        "Screen": ([[(x0, y, 0.0), (x1, y, 0.0), (x1, y, height), (x0, y, height)]], "Boards"),
    }


COLORS = {"Boards": "0.62 0.45 0.30", "Plaster": "0.93 0.91 0.85", "Tiles": "0.68 0.30 0.22", "Grass": "0.50 0.62 0.40"}
PLACES = {
    "WallSouth": along(0.0),
    "WallNorth": along(WIDTH),
    "WallWest": across(0.0),
    "GableEast": across(LENGTH),
    "GableWest": across(0.0),
    "Corridor": along(CORRIDOR),
    "CorridorUpper": along(CORRIDOR),
    "CrossSouth": across(CROSS_SOUTH),
    "CrossNorth": across(CROSS_NORTH),
    "CrossAttic": across(CROSS_ATTIC),
}


def openings():
    """Corners of each opening by its name."""
    result = {}
    for name, holes in HOLES.items():
        for i, (u0, w0, u1, w1) in enumerate(holes, 1):
            kind = "Window" if w1 - w0 == 1.5 else "Door"
            result[f"{name}{kind}{i}"] = [PLACES[name](u, w) for u, w in ((u0, w0), (u1, w0), (u1, w1), (u0, w1))]
    return result


def turned(point, degrees):
    angle = math.radians(degrees)
    x, y = point[0] - LENGTH / 2, point[1] - WIDTH / 2
    return (
        LENGTH / 2 + math.cos(angle) * x - math.sin(angle) * y,
        WIDTH / 2 + math.sin(angle) * x + math.cos(angle) * y,
        point[2],
    )


def model(degrees):
    defined = set()

    def shape(name, polygons, material):
        look = f"USE {material}"
        if material not in defined:
            defined.add(material)
            look = f"DEF {material} Material {{ diffuseColor {COLORS[material]} }}"
        return surface(name, polygons, f"appearance Appearance {{ material {look} }}\n")

    turn = f"rotation 0 0 1 {math.radians(degrees)!r} center {LENGTH / 2:g} {WIDTH / 2:g} 0 " if degrees else ""
    parts = [shape(name, *value) for name, value in with_points_in_between(sheets()).items()]
    x0, y0, x1, y1 = SITE
    site = [[(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)]]
    return (
        "#VRML V2.0 utf8\n# Written by make_building.py. Meters, Z up.\n"
        f"DEF Building Transform {{ {turn}children [\n{''.join(parts)}] }}\n{shape('Site', site, 'Grass')}"
    )


def table(degrees):
    lines = ["name,x0,y0,z0,x1,y1,z1,x2,y2,z2,x3,y3,z3"]
    for name, corners in openings().items():
        numbers = [number(c) for corner in corners for c in (turned(corner, degrees) if degrees else corner)]
        lines.append(",".join([name, *numbers]))
    return "\n".join(lines) + "\n"


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    folder.mkdir(parents=True, exist_ok=True)
    for degrees in [float(text) for text in sys.argv[2:]] or [0.0, 17.0]:
        name = f"building_turned{degrees:g}" if degrees else "building"
        (folder / f"{name}.wrl").write_text(model(degrees))
        (folder / f"{name}_openings.csv").write_text(table(degrees))
    areas = {name: sum(map(area, polygons)) for name, (polygons, _) in sheets().items()}
    for name, value in areas.items():
        print(f"{name:14} {value:10.4f} m2")
    holes = [area(corners) for corners in openings().values()]
    print(f"{'All sheets':14} {sum(areas.values()):10.4f} m2 with {len(holes)} openings of {sum(holes):.4f} m2")


if __name__ == "__main__":
    main()
