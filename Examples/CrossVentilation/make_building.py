#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes box.wrl: a building with an opening in the wall to the wind and one in the wall behind, and a wind tunnel's floor.

Lengths are in meters of the tunnel's model, Z is up, the wind comes along x. Walls and roof are sheets without thickness.
Of the tunnel only the half at y > 0 is meshed: the mean flow is the same on both sides.

Usage: make_building.py FILE.wrl
"""

import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Data"))

from polygons import tunnel_floor, with_points_in_between  # noqa: E402
from vrml_text import surface  # noqa: E402

LENGTH, HEIGHT = 0.1, 0.08  # as wide as long
OPENING = (-0.023, 0.031, 0.023, 0.049)  # y0 z0 y1 z1, in the middle of both walls
DOMAIN = ((-0.3, 0.5), (0.0, 0.3), (0.0, 0.32))
# Where elements are as at the building: about it, within it, and over the air that leaves it.
NEAR = ((-0.1, 0.2), (0.0, 0.08), (0.0, 0.11))


def wall_with_opening(x):
    y0, z0, y1, z1 = OPENING
    half = LENGTH / 2
    parts = [(-half, 0.0, y0, HEIGHT), (y1, 0.0, half, HEIGHT), (y0, 0.0, y1, z0), (y0, z1, y1, HEIGHT)]
    return [[(x, a, low), (x, b, low), (x, b, high), (x, a, high)] for a, low, b, high in parts]


def opening(x):
    y0, z0, y1, z1 = OPENING
    return [[(x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1)]]


def sheets():
    half = LENGTH / 2
    return {
        "WallFront": (wall_with_opening(0.0), None),
        "WallBack": (wall_with_opening(LENGTH), None),
        "WallSides": ([[(0, y, 0), (LENGTH, y, 0), (LENGTH, y, HEIGHT), (0, y, HEIGHT)] for y in (-half, half)], None),
        "Roof": ([[(0, -half, HEIGHT), (LENGTH, -half, HEIGHT), (LENGTH, half, HEIGHT), (0, half, HEIGHT)]], None),
    }


def opening_area():
    """Of the half that is meshed, square meters."""
    _, z0, y1, z1 = OPENING
    return y1 * (z1 - z0)


def volume():
    """Of the half that is meshed, cubic meters."""
    return LENGTH * LENGTH / 2 * HEIGHT


def main(file):
    parts = [surface(name, polygons) for name, (polygons, _) in with_points_in_between(sheets()).items()]
    parts.append(surface("Ground", tunnel_floor(DOMAIN)))
    pathlib.Path(file).write_text("#VRML V2.0 utf8\n# Written by make_building.py. Meters, Z up.\n" + "".join(parts))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
