# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the profiles of docs/records/validation.md from the results of Examples/SquareBuilding/run.sh --study.

Usage: validation.py RESULTS OUTPUT
"""

import json
import pathlib
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(SOURCE / "Examples" / "SquareBuilding"))

import reference  # noqa: E402

ROWS = {"uniform12": "#2b6cb0", "adaptive12": "#c05621", "snappy12": "#805ad5", "layered12": "#2f855a", "k-epsilon": "#718096"}
WIDTH, HEIGHT, LEFT, TOP, GAP = 190, 250, 44, 34, 14
SPEEDS, HEIGHTS = (-0.4, 1.4), (0.0, 3.5)


def place(column, speed, height):
    x = LEFT + column * (WIDTH + GAP) + (speed - SPEEDS[0]) / (SPEEDS[1] - SPEEDS[0]) * WIDTH
    return x, TOP + HEIGHT * (1.0 - (height - HEIGHTS[0]) / (HEIGHTS[1] - HEIGHTS[0]))


def line(points, color, width=1.5):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"/>'


def text(x, y, words, anchor="middle"):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{words}</text>'


def station(column, x, found):
    bottom, top = TOP + HEIGHT, TOP
    left, right = place(column, SPEEDS[0], 0)[0], place(column, SPEEDS[1], 0)[0]
    zero = place(column, 0.0, 0.0)[0]
    yield line([(left, top), (left, bottom), (right, bottom), (right, top), (left, top)], "#718096", 0.8)
    yield line([(zero, top), (zero, bottom)], "#cbd5e0", 0.8)
    yield line([(left, place(column, 0, 2)[1]), (right, place(column, 0, 2)[1])], "#cbd5e0", 0.8)
    yield text((left + right) / 2, top - 8, f"x/b = {x:g}")
    for speed in (0.0, 0.5, 1.0):
        yield text(place(column, speed, 0)[0], bottom + 14, f"{speed:g}")
    for name, color in ROWS.items():
        if name in found:
            values = found[name]["profiles"]["middle"][str(x)]
            yield line([place(column, u, z) for u, z in zip(values, reference.HEIGHTS)], color)
    for u, z in zip(reference.MIDDLE[x], reference.HEIGHTS):
        cx, cy = place(column, u, z)
        yield f'<circle cx="{cx:.1f}" cy="{cy:.1f}" r="3" fill="none" stroke="#1a202c"/>'


def picture(found):
    total = LEFT + len(reference.MIDDLE) * (WIDTH + GAP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total} {TOP + HEIGHT + 62}" width="{total}" role="img" '
             'font-family="sans-serif" font-size="12">', f'<rect width="{total}" height="{TOP + HEIGHT + 62}" fill="#ffffff"/>']
    for z in range(4):
        parts.append(text(LEFT - 8, place(0, 0, z)[1] + 4, z, "end"))
    parts.append(text(14, TOP + HEIGHT / 2, "z/b"))
    for column, x in enumerate(reference.MIDDLE):
        parts += station(column, x, found)
    parts.append(text(LEFT, TOP + HEIGHT + 34, "U/U_H in the middle plane behind the building", "start"))
    x, y = LEFT, TOP + HEIGHT + 52
    parts.append(f'<circle cx="{x + 4}" cy="{y - 4}" r="3" fill="none" stroke="#1a202c"/>' + text(x + 14, y, "measured", "start"))
    for i, (name, color) in enumerate((name, color) for name, color in ROWS.items() if name in found):
        x = LEFT + 110 + 118 * i
        parts.append(line([(x, y - 4), (x + 20, y - 4)], color, 2) + text(x + 26, y, name, "start"))
    return "\n".join([*parts, "</svg>\n"])


def main(results, output):
    found = {name: json.loads((pathlib.Path(results) / f"{name}.json").read_text()) for name in ROWS
             if (pathlib.Path(results) / f"{name}.json").exists()}
    pathlib.Path(output, "validation-profiles.svg").write_text(picture(found))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
