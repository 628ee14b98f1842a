#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes tower.wrl: a square building twice as high as wide in a wind tunnel, and the tunnel's floor.

Lengths are in meters of the tunnel's model, Z is up, the wind comes along x. The building stands about the origin. Of
the tunnel only the half at y > 0 is meshed: the mean flow is the same on both sides.

Usage: make_building.py FILE.wrl
"""

import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Data"))

from polygons import box, tunnel_floor  # noqa: E402
from vrml_text import surface  # noqa: E402

WIDTH = 0.08  # b
HEIGHT = 2 * WIDTH
DOMAIN = ((-4 * WIDTH, 8 * WIDTH), (0.0, 3 * WIDTH), (0.0, 5 * WIDTH))
# Where elements are as at the building: about it, and over its wake.
NEAR = ((-WIDTH, 3.5 * WIDTH), (0.0, 1.25 * WIDTH), (0.0, 2.75 * WIDTH))


def building():
    return box(((-WIDTH / 2, WIDTH / 2), (-WIDTH / 2, WIDTH / 2), (0.0, HEIGHT)))


def main(file, with_building=True):
    parts = [surface("Building", building())] if with_building else []
    parts.append(surface("Ground", tunnel_floor(DOMAIN)))
    pathlib.Path(file).write_text("#VRML V2.0 utf8\n# Written by make_building.py. Meters, Z up.\n" + "".join(parts))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
