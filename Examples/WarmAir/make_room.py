#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes room.obj: a room with an opening low in one wall and one high in the wall opposite. With --plume the room has wide
low openings in both walls, through which air comes in slowly, a small high one, and a box near its floor that is to be a cell zone.

Lengths are in meters, Z is up. Walls and ceiling are sheets without thickness. The floor is the bottom of the domain.

Usage: make_room.py FILE.obj [--plume]
"""

import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Data"))

from polygons import box, write_obj  # noqa: E402

LENGTH, WIDTH, HEIGHT = 4.0, 3.0, 4.0
LOWER, UPPER = (1.0, 0.2, 2.0, 0.6), (1.0, 3.4, 2.0, 3.8)  # y0 z0 y1 z1, in the walls at x = 0 and x = LENGTH
WIDE, SMALL = (0.2, 0.1, 2.8, 0.7), (1.2, 3.4, 1.8, 3.8)  # with a plume: low in both walls, and high in the one at x = LENGTH
SOURCE = ((1.9, 2.1), (1.4, 1.6), (0.1, 0.3))
DOMAIN = ((-8.0, 12.0), (-8.0, 11.0), (0.0, 14.0))
PLUME = ((1.5, 2.5), (1.0, 2.0), (0.0, 4.0))  # where elements are finest around the source


def wall_with_openings(x, openings):
    ys = sorted({0.0, WIDTH, *(y for opening in openings for y in opening[::2])})
    zs = sorted({0.0, HEIGHT, *(z for opening in openings for z in opening[1::2])})
    parts = [(a, b, low, high) for a, b in zip(ys, ys[1:]) for low, high in zip(zs, zs[1:])
             if not any(y0 <= a < y1 and z0 <= low < z1 for y0, z0, y1, z1 in openings)]
    return [[(x, a, low), (x, b, low), (x, b, high), (x, a, high)] for a, b, low, high in parts]


def surfaces(has_plume):
    first, last = ((WIDE,), (WIDE, SMALL)) if has_plume else ((LOWER,), (UPPER,))
    sides = [[(0, y, 0), (LENGTH, y, 0), (LENGTH, y, HEIGHT), (0, y, HEIGHT)] for y in (0.0, WIDTH)]
    found = {"Wall": [*wall_with_openings(0.0, first), *wall_with_openings(LENGTH, last), *sides],
             "Ceiling": [[(0, 0, HEIGHT), (LENGTH, 0, HEIGHT), (LENGTH, WIDTH, HEIGHT), (0, WIDTH, HEIGHT)]]}
    return found | ({"Source": box(SOURCE)} if has_plume else {})


def opening_area(opening):
    y0, z0, y1, z1 = opening
    return (y1 - y0) * (z1 - z0)


def main(file, has_plume=False):
    write_obj(file, surfaces(has_plume))


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[2:] not in ([], ["--plume"]):
        sys.exit(__doc__)
    main(sys.argv[1], len(sys.argv) > 2)
