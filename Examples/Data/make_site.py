#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes site.wrl, a district on a site of 1343 x 1692 m, or site_small.wrl, a few of its blocks on 240 x 300 m.

All lengths are in meters, Z is up. Blocks of buildings stand along streets; in the north-east they are turned by 20
degrees. Buildings are flat or gabled, 5 to 60 m high, and have no floor: they stand on the site. The named details are
sheets of zero thickness: canopies over entrances and screens at bus stops. The same file is written every time.

Usage: make_site.py [--small] [FOLDER]    (default: the current folder)
"""

import argparse
import math
import pathlib
import random

from vrml_text import surface

SIZE = (1343.0, 1692.0)
SMALL_SIZE = (240.0, 300.0)
BLOCK = (64.0, 52.0)  # a block with the streets around it
STREET = 14.0
GAP = 4.0  # between buildings of a block
TURN = math.radians(20)
COLORS = {"Flat": "0.85 0.83 0.80", "Gabled": "0.70 0.38 0.28", "Detail": "0.55 0.65 0.75", "Ground": "0.50 0.60 0.42"}


def box(x0, y0, x1, y1, height):
    """Walls and a flat roof, faces outward."""
    ring = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    walls = [
        [(*p, 0.0), (*q, 0.0), (*q, height), (*p, height)] for p, q in zip(ring, ring[1:] + ring[:1])
    ]
    return [*walls, [(x, y, height) for x, y in ring]]


def gabled(x0, y0, x1, y1, eaves, ridge):
    """Walls and a roof whose ridge runs along x."""
    ym = 0.5 * (y0 + y1)
    return [
        [(x0, y0, 0.0), (x1, y0, 0.0), (x1, y0, eaves), (x0, y0, eaves)],
        [(x1, y1, 0.0), (x0, y1, 0.0), (x0, y1, eaves), (x1, y1, eaves)],
        [(x0, y1, 0.0), (x0, y0, 0.0), (x0, y0, eaves), (x0, ym, ridge), (x0, y1, eaves)],
        [(x1, y0, 0.0), (x1, y1, 0.0), (x1, y1, eaves), (x1, ym, ridge), (x1, y0, eaves)],
        [(x0, y0, eaves), (x1, y0, eaves), (x1, ym, ridge), (x0, ym, ridge)],
        [(x1, y1, eaves), (x0, y1, eaves), (x0, ym, ridge), (x1, ym, ridge)],
    ]


def details(x0, y0, x1, number):
    """A canopy before the wall at y0, and a screen at the street."""
    xm = round(0.5 * (x0 + x1), 1)
    canopy = [(xm - 2.0, y0 - 2.4, 3.2), (xm + 2.0, y0 - 2.4, 3.2), (xm + 2.0, y0 - 0.4, 3.0), (xm - 2.0, y0 - 0.4, 3.0)]
    screen = [(xm - 3.0, y0 - 4.0, 0.0), (xm + 3.0, y0 - 4.0, 0.0), (xm + 3.0, y0 - 4.0, 2.2), (xm - 3.0, y0 - 4.0, 2.2)]
    return [(f"Canopy{number}", [canopy], "Detail"), (f"Screen{number}", [screen], "Detail")]


def block(origin, dice, first):
    """Four buildings at the corners of a block; one lot in eight is empty."""
    parts = []
    for i in range(2):
        for j in range(2):
            width, depth = ((BLOCK[k] - STREET - GAP) / 2 for k in range(2))
            x0, y0 = origin[0] + i * (width + GAP), origin[1] + j * (depth + GAP)
            x1, y1 = x0 + round(width * dice.uniform(0.7, 1.0), 1), y0 + round(depth * dice.uniform(0.7, 1.0), 1)
            kind, height = dice.random(), dice.random()
            if kind < 0.125:
                continue
            number = first + len(parts) + 1
            if kind < 0.5:
                eaves = round(5.0 + 5.0 * height, 1)
                parts.append((f"House{number:03}", gabled(x0, y0, x1, y1, eaves, eaves + round(0.3 * (y1 - y0), 1)), "Gabled"))
            else:
                parts.append((f"Building{number:03}", box(x0, y0, x1, y1, round(8.0 + 52.0 * height**4, 1)), "Flat"))
    return parts


def turned(parts, about):
    c, s = math.cos(TURN), math.sin(TURN)

    def move(p):
        x, y = p[0] - about[0], p[1] - about[1]
        return (about[0] + c * x - s * y, about[1] + s * x + c * y, p[2])

    return [(name, [[move(p) for p in polygon] for polygon in polygons], look) for name, polygons, look in parts]


def district(columns, rows, corner, corner_turned, detail_every):
    """The straight blocks, and half as many rows of turned ones."""
    dice = random.Random(1692)
    parts, buildings = [], 0
    for origin, rows_here, is_turned in ((corner, rows, False), (corner_turned, rows // 2, True)):
        for i in range(columns):
            for j in range(rows_here):
                at = (origin[0] + i * BLOCK[0], origin[1] + j * BLOCK[1])
                made = block(at, dice, buildings)
                if made and (i * rows_here + j) % detail_every == 0:
                    ring = [p for polygon in made[0][1] for p in polygon]
                    xs, ys = [p[0] for p in ring], [p[1] for p in ring]
                    made_details = details(min(xs), min(ys), max(xs), buildings + 1)
                else:
                    made_details = []
                buildings += len(made)
                parts += turned(made + made_details, origin) if is_turned else made + made_details
    return parts, buildings


def model(small):
    size = SMALL_SIZE if small else SIZE
    if small:
        parts, buildings = district(2, 2, (50.0, 50.0), (70.0, 170.0), 2)
    else:
        parts, buildings = district(7, 6, (420.0, 560.0), (560.0, 960.0), 8)
    x1, y1 = size
    parts.append(("Site", [[(0.0, 0.0, 0.0), (x1, 0.0, 0.0), (x1, y1, 0.0), (0.0, y1, 0.0)]], "Ground"))
    shapes = []
    for name, polygons, look in parts:
        color = f"appearance Appearance {{ material Material {{ diffuseColor {COLORS[look]} }} }}\n"
        shapes.append(surface(name, polygons, color))
    return "#VRML V2.0 utf8\n# Written by make_site.py. Meters, Z up.\n" + "".join(shapes), buildings


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default=".", type=pathlib.Path)
    parser.add_argument("--small", action="store_true")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    text, buildings = model(options.small)
    file = options.folder / ("site_small.wrl" if options.small else "site.wrl")
    file.write_text(text)
    print(f"{file}: {buildings} buildings")


if __name__ == "__main__":
    main()
