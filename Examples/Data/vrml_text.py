# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes polygons as VRML97 text. Shared by the scripts that make the example models."""


def number(value, digits=10):
    """Shortest text of a coordinate; never -0."""
    text = f"{value:.{digits}g}"
    return "0" if text == "-0" else text


def indexed_face_set(polygons, digits=10):
    """An IndexedFaceSet of polygons given by their points; equal points are shared."""
    ids = {}
    faces = []
    for polygon in polygons:
        faces.append([ids.setdefault(tuple(point), len(ids)) for point in polygon])
    points = ",\n".join(" ".join(number(c, digits) for c in point) for point in ids)
    indices = ",\n".join(",".join(map(str, face)) + ",-1" for face in faces)
    return (
        "IndexedFaceSet {\nsolid FALSE\nconvex FALSE\n"
        f"coord Coordinate {{ point [\n{points}\n] }}\n"
        f"coordIndex [\n{indices}\n]\n}}"
    )


def surface(name, polygons, appearance="", digits=10):
    """A named surface: `DEF name Transform` around one Shape."""
    return (
        f"DEF {name} Transform {{ children Shape {{\n{appearance}"
        f"geometry {indexed_face_set(polygons, digits)}\n}} }}\n"
    )
