#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes sphere_in_cube.wrl: a cube of 10 m around the origin and a sphere of radius 2 m of 20,480 triangles.

Usage: make_sphere.py [FOLDER [SUBDIVISIONS]]    (default: the folder of this script, 5)
"""

import itertools
import math
import pathlib
import sys

from vrml_text import surface


def icosahedron():
    g = (1 + math.sqrt(5)) / 2
    points = []
    for a, b in itertools.product((-1.0, 1.0), (-g, g)):
        points += [(0.0, a, b), (a, b, 0.0), (b, 0.0, a)]
    triangles = []
    for a, b, c in itertools.combinations(points, 3):
        if all(abs(math.dist(p, q) - 2) < 1e-9 for p, q in ((a, b), (b, c), (c, a))):
            triangles.append((a, b, c) if determinant(a, b, c) > 0 else (a, c, b))
    return triangles


def determinant(a, b, c):
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def sphere(radius, subdivisions):
    """Triangles of a subdivided icosahedron, outward, with corners on the sphere."""

    def lift(p):
        scale = radius / math.hypot(*p)
        return tuple(scale * c for c in p)

    def middle(p, q):
        return lift([p_ + q_ for p_, q_ in zip(p, q)])  # symmetric in p and q: both sides get the same point

    triangles = [tuple(map(lift, t)) for t in icosahedron()]
    for _ in range(subdivisions):
        finer = []
        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        triangles = finer
    return triangles


def cube(h):
    """Six faces, outward."""
    return [
        [(-h, -h, -h), (-h, -h, h), (-h, h, h), (-h, h, -h)],
        [(h, -h, -h), (h, h, -h), (h, h, h), (h, -h, h)],
        [(-h, -h, -h), (h, -h, -h), (h, -h, h), (-h, -h, h)],
        [(-h, h, -h), (-h, h, h), (h, h, h), (h, h, -h)],
        [(-h, -h, -h), (-h, h, -h), (h, h, -h), (h, -h, -h)],
        [(-h, -h, h), (h, -h, h), (h, h, h), (-h, h, h)],
    ]


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    subdivisions = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    folder.mkdir(parents=True, exist_ok=True)
    text = "#VRML V2.0 utf8\n# Written by make_sphere.py. Meters.\n"
    text += surface("Cube", cube(5.0)) + surface("Sphere", sphere(2.0, subdivisions), digits=7)
    (folder / "sphere_in_cube.wrl").write_text(text)


if __name__ == "__main__":
    main()
