#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a house as people draw it: rooms of sheets, full of detail far below any mesh.

The detail is furniture, foliage, railings, nested pipes, copies that (nearly) coincide, and text. A seed says which, where and
how it is turned; the number of triangles is about what is asked for, and the house stays the same size.

Usage: make_detailed_house.py FILE [--triangles N] [--seed S] [--only KIND ...]
"""

import argparse
import math
import random

LENGTH, WIDTH, STOREY, STOREYS = 14.0, 9.0, 3.0, 2


class Model:
    """Named surfaces of faces over points."""

    def __init__(self):
        self.surfaces = {}
        self.triangles = 0

    def add(self, name, points, faces):
        own_points, own_faces = self.surfaces.setdefault(name, ([], []))
        base = len(own_points)
        own_points.extend(points)
        own_faces.extend([base + i for i in face] for face in faces)
        self.triangles += sum(len(face) - 2 for face in faces)

    def write(self, path, angle):
        c, s = math.cos(angle), math.sin(angle)
        with open(path, "w", encoding="ascii") as file:
            file.write("#VRML V2.0 utf8\n")
            for name, (points, faces) in self.surfaces.items():
                file.write(f"DEF {name} Shape {{ geometry IndexedFaceSet {{ solid FALSE convex FALSE coord Coordinate {{ point [\n")
                file.writelines(f"{c * x - s * y:.6f} {s * x + c * y:.6f} {z:.6f},\n" for x, y, z in points)
                file.write("] } coordIndex [\n")
                file.writelines(" ".join(map(str, face)) + " -1\n" for face in faces)
                file.write("] } }\n")


class Place:
    """A frame that things are put in: turned about the vertical, and moved."""

    def __init__(self, x, y, z, angle=0.0, scale=1.0):
        self.origin, self.scale = (x, y, z), scale
        self.c, self.s = math.cos(angle), math.sin(angle)

    def __call__(self, p):
        x, y, z = (self.scale * value for value in p)
        return (self.origin[0] + self.c * x - self.s * y, self.origin[1] + self.s * x + self.c * y, self.origin[2] + z)


BOX_FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def box(model, name, place, low, high):
    corners = [(x, y, z) for z in (low[2], high[2]) for x, y in
               ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))]
    model.add(name, [place(p) for p in corners], BOX_FACES)


def cylinder(model, name, place, begin, end, radius, sides, closed=True):
    axis = [e - b for b, e in zip(begin, end)]
    length = math.sqrt(sum(a * a for a in axis))
    w = [a / length for a in axis]
    helper = (1.0, 0.0, 0.0) if abs(w[0]) < 0.9 else (0.0, 1.0, 0.0)
    u = cross(w, helper)
    size = math.sqrt(sum(a * a for a in u))
    u = [a / size for a in u]
    v = cross(w, u)
    points = []
    for at in (begin, end):
        for i in range(sides):
            a = 2 * math.pi * i / sides
            points.append(place([at[k] + radius * (math.cos(a) * u[k] + math.sin(a) * v[k]) for k in range(3)]))
    faces = [(i, (i + 1) % sides, sides + (i + 1) % sides, sides + i) for i in range(sides)]
    if closed:
        faces += [tuple(range(sides - 1, -1, -1)), tuple(range(sides, 2 * sides))]
    model.add(name, points, faces)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def ball(model, name, place, center, radius, rings):
    points, faces, sides = [], [], 2 * rings
    for i in range(rings + 1):
        a = math.pi * i / rings
        for j in range(sides):
            b = 2 * math.pi * j / sides
            points.append(place((center[0] + radius * math.sin(a) * math.cos(b),
                                 center[1] + radius * math.sin(a) * math.sin(b), center[2] + radius * math.cos(a))))
    for i in range(rings):
        for j in range(sides):
            k = (j + 1) % sides
            faces.append((i * sides + j, (i + 1) * sides + j, (i + 1) * sides + k, i * sides + k))
    model.add(name, points, faces)


def chair(model, place, rng):
    for x in (-0.2, 0.2):
        for y in (-0.2, 0.2):
            cylinder(model, "Chairs", place, (x, y, 0.0), (x, y, 0.45), 0.015, rng.choice((6, 12, 24)))
    box(model, "Chairs", place, (-0.22, -0.22, 0.44), (0.22, 0.22, 0.47))
    box(model, "Chairs", place, (-0.22, 0.2, 0.47), (0.22, 0.23, 0.9))
    for x in (-0.15, 0.0, 0.15):
        cylinder(model, "Chairs", place, (x, 0.215, 0.5), (x, 0.215, 0.85), 0.02, 8)


def table(model, place, rng):
    box(model, "Tables", place, (-0.8, -0.4, 0.71), (0.8, 0.4, 0.74))
    for x in (-0.75, 0.75):
        for y in (-0.35, 0.35):
            box(model, "Tables", place, (x - 0.025, y - 0.025, 0.0), (x + 0.025, y + 0.025, 0.71))
    for _ in range(rng.randrange(6)):
        ball(model, "Things", place, (rng.uniform(-0.7, 0.7), rng.uniform(-0.3, 0.3), 0.79), 0.05, rng.choice((6, 10, 16)))


def furniture(model, place, rng):
    table(model, place, rng)
    for i in range(rng.randrange(2, 7)):
        at = place((-0.6 + 0.6 * (i % 3), 0.6 if i % 2 else -0.6, 0.0))
        chair(model, Place(*at, rng.uniform(0, 2 * math.pi)), rng)


def shelf(model, place, rng):
    for x in (0.0, 1.0):
        box(model, "Shelves", place, (x, 0.0, 0.0), (x + 0.02, 0.3, 2.0))
    for i in range(6):
        z = 0.05 + 0.38 * i
        box(model, "Shelves", place, (0.02, 0.0, z), (1.0, 0.3, z + 0.02))
        x = 0.03
        while x < 0.95:
            width = rng.uniform(0.01, 0.05)
            box(model, "Books", place, (x, 0.02, z + 0.02), (x + width, rng.uniform(0.15, 0.28), z + rng.uniform(0.2, 0.34)))
            x += width + rng.choice((0.0, 0.001, 0.01))


def foliage(model, place, rng):
    cylinder(model, "Trunks", place, (0, 0, 0), (0, 0, 1.6), 0.08, 10)
    for _ in range(rng.randrange(300, 900)):
        while True:
            p = [rng.uniform(-1, 1) for _ in range(3)]
            if sum(a * a for a in p) <= 1.0:
                break
        u = [rng.gauss(0, 0.05) for _ in range(3)]
        v = [rng.gauss(0, 0.05) for _ in range(3)]
        q = (p[0], p[1], 2.4 + p[2])
        model.add("Leaves", [place([q[k] + a * u[k] + b * v[k] for k in range(3)]) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))],
                  [(0, 1, 2), (0, 2, 3)])


def railing(model, place, rng):
    length = rng.uniform(2.0, 6.0)
    step = rng.choice((0.06, 0.1, 0.12))
    count = int(length / step)
    for i in range(count + 1):
        cylinder(model, "Railings", place, (i * step, 0, 0), (i * step, 0, 0.95), 0.008, rng.choice((6, 8)))
    for z in (0.05, 0.95):
        cylinder(model, "Railings", place, (0, 0, z), (count * step, 0, z), 0.02, 12)


def grating(model, place, rng):
    for i in range(40):
        box(model, "Gratings", place, (0.03 * i, 0, 0), (0.03 * i + 0.004, 1.2, 0.03))
        box(model, "Gratings", place, (0, 0.03 * i, 0), (1.2, 0.03 * i + 0.004, 0.03))


def pipes(model, place, rng):
    turn = rng.uniform(0, math.pi)
    end = (3 * math.cos(turn), 3 * math.sin(turn), rng.uniform(-0.2, 0.2))
    for i in range(rng.randrange(3, 9)):
        cylinder(model, "Pipes", place, (0, 0, 0.3), (end[0], end[1], 0.3 + end[2]), 0.1 - 0.01 * i, rng.choice((12, 24, 48)),
                 closed=bool(i % 2))
    for i in range(10):
        at = [a * (i + 0.5) / 10 for a in end]
        cylinder(model, "Flanges", place, (at[0], at[1], 0.3 + at[2] - 0.02), (at[0], at[1], 0.3 + at[2] + 0.02), 0.15, 24)


def copies(model, place, rng):
    jitter = rng.choice((0.0, 1e-7, 1e-5, 1e-3, 0.01))
    for i in range(rng.randrange(5, 60)):
        at = place([rng.uniform(-jitter, jitter) for _ in range(3)])
        other = Place(*at, rng.uniform(-jitter, jitter))
        box(model, "Copies", other, (0, 0, 0), (0.8, 0.5, 0.9))
        ball(model, "Copies", other, (0.4, 0.25, 1.1), 0.2, 8)


def text(model, place, rng):
    for i in range(rng.randrange(10, 60)):
        x, y = 0.07 * (i % 20), -0.1 * (i // 20)
        for _ in range(rng.randrange(2, 5)):
            a, b = rng.uniform(0, 0.04), rng.uniform(0, 0.06)
            if rng.random() < 0.5:
                low, high = (x + a, 0.0, 1.5 + y), (x + a + 0.01, 0.005, 1.56 + y)
            else:
                low, high = (x, 0.0, 1.5 + y + b), (x + 0.05, 0.005, 1.51 + y + b)
            box(model, "Letters", place, low, high)


KINDS = {f.__name__: f for f in (furniture, shelf, foliage, railing, grating, pipes, copies, text)}


def wall(model, name, a, b, z, openings):
    """An upright sheet from a to b, with rectangular openings (from, to, sill, head) along it, without overlap."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = math.hypot(dx, dy)

    def panel(s, t, low, high):
        if t - s > 1e-9 and high - low > 1e-9:
            ends = [(a[0] + dx * k / length, a[1] + dy * k / length) for k in (s, t)]
            model.add(name, [(*ends[0], z + low), (*ends[1], z + low), (*ends[1], z + high), (*ends[0], z + high)], [(0, 1, 2, 3)])

    at = 0.0
    for s, t, sill, head in sorted(openings):
        panel(at, s, 0.0, STOREY)
        panel(s, t, 0.0, sill)
        panel(s, t, head, STOREY)
        at = t
    panel(at, length, 0.0, STOREY)


def house(model):
    for storey in range(STOREYS + 1):
        z = storey * STOREY
        name = "Roof" if storey == STOREYS else "Floor"
        model.add(name, [(0, 0, z), (LENGTH, 0, z), (LENGTH, WIDTH, z), (0, WIDTH, z)], [(0, 1, 2, 3)])
    for storey in range(STOREYS):
        z = storey * STOREY
        windows = [(1.0 + 3.0 * i, 2.5 + 3.0 * i, 0.9, 2.2) for i in range(4)]
        wall(model, "WallSouth", (0, 0), (LENGTH, 0), z, windows)
        wall(model, "WallNorth", (0, WIDTH), (LENGTH, WIDTH), z, windows)
        wall(model, "WallWest", (0, 0), (0, WIDTH), z, [(3.0, 4.0, 0.0, 2.1)] if storey == 0 else [])
        wall(model, "WallEast", (LENGTH, 0), (LENGTH, WIDTH), z, [])
        wall(model, "Partitions", (0, 5.0), (LENGTH, 5.0), z, [(2.0, 2.9, 0.0, 2.1), (9.0, 9.9, 0.0, 2.1)])
        wall(model, "Partitions", (6.0, 0), (6.0, 5.0), z, [(2.0, 2.9, 0.0, 2.1)])


def detailed_house(triangles, seed, only=()):
    rng = random.Random(seed)
    model = Model()
    house(model)
    kinds = [KINDS[name] for name in (only or rng.sample(sorted(KINDS), rng.randrange(2, 6)))]
    while model.triangles < triangles:
        storey = rng.randrange(-1, STOREYS)
        outside = storey < 0
        x = rng.uniform(-4.0, LENGTH + 4.0) if outside else rng.uniform(1.0, LENGTH - 1.0)
        y = rng.uniform(-4.0, -1.5) if outside else rng.uniform(1.0, WIDTH - 1.0)
        z = 0.0 if outside else storey * STOREY
        angle = rng.choice((0.0, math.pi / 2, rng.uniform(0, 2 * math.pi)))
        rng.choice(kinds)(model, Place(x, y, z, angle), rng)
    return model, rng.choice((0.0, math.radians(17.0), rng.uniform(0, math.pi / 2)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--triangles", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="*", default=(), choices=sorted(KINDS))
    arguments = parser.parse_args()
    model, angle = detailed_house(arguments.triangles, arguments.seed, arguments.only)
    model.write(arguments.file, angle)
    print(f"{arguments.file}: {model.triangles} triangles, turned by {math.degrees(angle):.1f} degrees")


if __name__ == "__main__":
    main()
