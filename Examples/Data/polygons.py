# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons as lists of points. Shared by the scripts that make the example models."""

import math
import pathlib


def with_points_in_between(surfaces):
    """Puts into every edge the points of the model that lie on it, so that neighbors share whole edges.

    `surfaces` are pairs of polygons and material by name.
    """
    points = {p for polygons, _ in surfaces.values() for polygon in polygons for p in polygon}
    result = {}
    for name, (polygons, material) in surfaces.items():
        result[name] = ([[q for edge in edges(p) for q in on_edge(edge, points)] for p in polygons], material)
    return result


def edges(polygon):
    return zip(polygon, polygon[1:] + polygon[:1])


def on_edge(edge, points):
    """The edge's first point and the points strictly inside of it, in order."""
    a, b = edge
    length = math.dist(a, b)
    inside = [p for p in points if p not in edge and math.dist(a, p) + math.dist(p, b) < length + 1e-12]
    return [a, *sorted(inside, key=lambda p: math.dist(a, p))]


def tunnel_floor(domain):
    """The floor of a wind tunnel of whose domain the half at y > 0 is given."""
    (x0, x1), (_, y1), _ = domain
    return [[(x0, -y1, 0.0), (x1, -y1, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)]]


def area(polygon):
    """Newell's formula."""
    total = [0.0, 0.0, 0.0]
    for p, q in edges(polygon):
        for axis in range(3):
            j, k = (axis + 1) % 3, (axis + 2) % 3
            total[axis] += p[j] * q[k] - p[k] * q[j]
    return 0.5 * math.hypot(*total)


def box(bounds):
    """Polygons of a box, by its least and greatest x, y and z."""
    points = [tuple(bounds[axis][i >> axis & 1] for axis in range(3)) for i in range(8)]
    return [[points[i] for i in face] for face in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))]


def write_obj(file, named):
    """Writes polygons by name as Wavefront OBJ."""
    lines, count = [], 0
    for name, polygons in named.items():
        lines.append(f"o {name}")
        for polygon in polygons:
            lines += ["v {:g} {:g} {:g}".format(*point) for point in polygon]
            lines.append("f " + " ".join(str(count + i + 1) for i in range(len(polygon))))
            count += len(polygon)
    pathlib.Path(file).write_text("\n".join(lines) + "\n", encoding="utf-8")
