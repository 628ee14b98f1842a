#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Air between a warm and a cold wall, as measured: Betts and Bokhari (2000), Experiments on turbulent natural convection in an
enclosed tall cavity, Int. J. Heat Fluid Flow 21, 675-683; figures of the ERCOFTAC Classic Collection, case 79.

The cavity is 2.18 m high and 0.076 m wide; its walls have 34.7 and 15.1 °C. Here it is as thin as two elements, with slip sides,
and joined to outdoors by a small opening in its floor, which sets the pressure.

Rows are made one by one and kept as JSON in OUT/results; OUT/tables.md has the table of what there is.

Usage: cavity.py ATRIA OUT [ROW ...]     (PYTHONPATH must hold the package `atria`)
       cavity.py --list
"""

import math
import pathlib
import sys
from dataclasses import dataclass

sys.path += [str(pathlib.Path(__file__).resolve().parent.parent / folder) for folder in ("Data", "Study")]

from kept_rows import command_line, known, lines_of, run  # noqa: E402
from polygons import write_obj  # noqa: E402

WIDTH, HEIGHT = 0.076, 2.18
HOT, COLD = 34.7, 15.1
OUTDOORS = 0.5 * (HOT + COLD)
NU, PRANDTL, GRAVITY, KELVIN = 1.5e-5, 0.71, 9.81, 273.15
# At half the height, in its middle plane: mm from the cold wall, and °C or upward speed in m/s. About every second place of both.
TEMPERATURES = ((0.33, 15.62), (0.84, 16.45), (1.6, 17.58), (2.61, 19.05), (3.88, 19.96), (6.42, 21.32), (8.96, 22.01), (11.5, 22.53),
                (15.31, 23.02), (20.39, 23.76), (25.47, 24.17), (30.55, 25.08), (35.63, 25.33), (40.57, 25.23), (45.65, 25.92),
                (50.73, 25.87), (55.81, 26.55), (60.89, 27.05), (64.7, 27.65), (67.24, 27.71), (69.78, 28.61), (72.32, 30.06),
                (73.59, 31.12), (74.6, 32.37), (75.36, 33.37), (75.87, 34.21))
SPEEDS = ((1.2, -0.081), (3.2, -0.124), (6.2, -0.135), (10.2, -0.12), (14.2, -0.11), (18.2, -0.089), (28.2, -0.048), (38.2, 0.012),
          (48.2, 0.054), (58.2, 0.091), (62.2, 0.106), (66.2, 0.127), (70.2, 0.137), (72.2, 0.131), (73.2, 0.121))


@dataclass(frozen=True)
class Row:
    name: str
    across: int = 8  # elements over the width, without layers
    layers: int = 7
    first: float = 0.3  # height of the first layer, mm
    turbulence: str = "k-omega-sst"
    iterations: int = 1500


ROWS = [Row("sst8"), Row("sst16", across=16, layers=6), Row("realizable8", turbulence="realizable")]


def surfaces(row):
    """A box whose floor is open in the middle half."""
    w, h, d = WIDTH, HEIGHT, 2 * WIDTH / row.across
    a, b = 3 * w / 8, 5 * w / 8
    level = lambda x0, x1, z: [(x0, 0, z), (x1, 0, z), (x1, d, z), (x0, d, z)]
    upright = lambda x: [(x, 0, 0), (x, d, 0), (x, d, h), (x, 0, h)]
    return {"Cold": [upright(0)], "Hot": [upright(w)], "Side": [[(0, y, 0), (w, y, 0), (w, y, h), (0, y, h)] for y in (0, d)],
            "Ceiling": [level(0, w, h)], "Floor": [level(0, a, 0), level(b, w, 0)], "Opening": [level(a, b, 0)]}


def mesh(atria, row, folder):
    write_obj(folder / "cavity.obj", surfaces(row))
    size = WIDTH / row.across
    layers = [word for wall in ("Cold", "Hot") for word in ("--layers", f"{wall}={row.layers}:{row.first / 1000:g}:auto")]
    return run([atria, "mesh", folder / "cavity.obj", "-o", folder / "mesh.vtu", "--model-bounds", "--size-min", size, "--size-mid", size,
                "--size-max", size, "--layers", 0, *layers, "--threads", 1], folder, "mesh")


def case_command(atria, row, folder):
    return [atria, "case", folder / "mesh.vtu", "-o", folder / "case", "--kind", "room", "--calm", "--patch", "Opening", "inletOutlet",
            "--patch", "Side*", "slip", "--outdoor-temperature", f"{OUTDOORS:g}", "--temperature", "Hot", HOT, "--temperature", "Cold",
            COLD, "--turbulence", row.turbulence, "--iterations", row.iterations]


def heat_of_correlation():
    """From wall to wall, W/m²: Nu = 0.0605 Ra^(1/3), ElSherbiny, Raithby and Hollands (1982), Heat transfer by natural convection
    across vertical and inclined air layers, J. Heat Transfer 104, 96-102."""
    rayleigh = GRAVITY / (OUTDOORS + KELVIN) * (HOT - COLD) * WIDTH**3 / NU**2 * PRANDTL
    conductivity = NU / PRANDTL * CAPACITY
    return 0.0605 * rayleigh ** (1 / 3) * conductivity * (HOT - COLD) / WIDTH


CAPACITY = 1190.0  # J/(m³ K), of air at 24.9 °C


def at(fields, row, places, array):
    """Values at half the height, by mm from the cold wall."""
    import numpy
    from atria.report.fields import probe

    points = numpy.array([(mm / 1000.0, 0.6 * WIDTH / row.across, HEIGHT / 2) for mm, _ in places])
    return probe(fields.mesh, points, array)


def root_mean_square(differences):
    return math.sqrt(sum(d * d for d in differences) / len(differences))


def measure(row, case):
    from atria.report import Case

    described = Case(case)
    flow = described.runs[0]
    warmth, fields = flow.warmth, flow.fields
    area = HEIGHT * 2 * WIDTH / row.across
    mean = "TMean" if fields.mesh.GetCellData().HasArray("TMean") else "T"
    temperatures, speeds = at(fields, row, TEMPERATURES, mean), at(fields, row, SPEEDS, fields.velocity)[:, 2]
    heat = [watts.last() / area for watts in (warmth.surfaces["Hot"], warmth.surfaces["Cold"])]
    return {"cells": described.mesh["cells"], "solve_seconds": flow.log.seconds, "hot": heat[0], "cold": heat[1],
            "unconverged": flow.doubts_of_warmth(), "fastest": float(max(speeds)),
            "temperature": root_mean_square([a - b for a, (_, b) in zip(temperatures, TEMPERATURES)]),
            "speed": root_mean_square([a - b for a, (_, b) in zip(speeds, SPEEDS)]),
            "profile_T": [float(value) for value in temperatures], "profile_U": [float(value) for value in speeds]}


def make(atria, row, folder):
    seconds = mesh(atria, row, folder)
    run(case_command(atria, row, folder), folder, "case")
    run([folder / "case" / "Allrun"], folder, "run")
    return {"mesh_seconds": seconds, **measure(row, folder / "case")}


HEAD = ("row", "elements", "solving, s", "heat of the warm wall, W/m²", "of the cold wall", "by correlation", "fastest upwards, m/s",
        "measured", "speeds: root mean square, m/s", "temperatures, K")


def cells(row, result):
    if result is None:
        return [row.name, "not run", *[""] * (len(HEAD) - 2)]
    return [row.name, f"{result['cells']:,}", f"{result['solve_seconds']:.0f}", f"{result['hot']:.1f}", f"{result['cold']:.1f}",
            f"{heat_of_correlation():.1f}", f"{result['fastest']:.3f}", f"{max(speed for _, speed in SPEEDS):.3f}",
            f"{result['speed']:.3f}", f"{result['temperature']:.2f}"]


def tables(out):
    return f"## A tall cavity\n\n{lines_of(HEAD, [cells(row, known(row, out)) for row in ROWS])}\n"


if __name__ == "__main__":
    command_line(make, ROWS, tables, __doc__)
