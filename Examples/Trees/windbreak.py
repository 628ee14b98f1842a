#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wind behind a row of trees against measurements in the field: docs/records/validation.md.

The trees are a box of leaves across the wind, 16.5 m high and 8 m deep, in open fields; the domain is 4 m wide, with slip sides. A row
without trees tells the open wind. Windbreaks are described by their optical porosity, the share of the background that is seen through them. The leaf area per
area of the front follows from it by the law of Beer and Lambert, porosity = exp(-L / 2), for leaves that point everywhere.

Measured, 2 m above the ground:
- four windbreaks of 15 to 18 m in Moravia: with 10 % porosity the wind is slower by 60 % at 50 m and by 30 % at 150 m behind them; it
  is slowest at four heights, and as before at 250 m. Aerodynamic parameters of windbreak based on its optical porosity, Contributions
  to Geophysics and Geodesy 42 (2012); and by up to 64 % at 50 m: Streda et al. (2008), Acta Univ. Agric. Silvic. Mendel. Brun. 56, 281-288.
- nine of conifers in Ontario, with 0 to 31 % porosity of the lower half: the slowest wind has 29 to 71 % of the open wind's speed, at 2
  to 6 heights. Loeffler, Gordon, Gillespie (1992), Optical porosity and windspeed reduction by coniferous windbreaks in Southern
  Ontario, Agroforestry Systems 17, 119-133.

Rows are made one by one and kept as JSON in OUT/results; OUT/tables.md has the table of what there is.

Usage: windbreak.py ATRIA OUT [ROW ...]     (PYTHONPATH must hold the package `atria`)
       windbreak.py --list
"""

import math
import pathlib
import sys
from dataclasses import dataclass

sys.path += [str(pathlib.Path(__file__).resolve().parent.parent / folder) for folder in ("Data", "Study")]

from kept_rows import command_line, known, lines_of, run  # noqa: E402
from polygons import box, write_obj  # noqa: E402

HEIGHT, DEPTH = 16.5, 8.0
WIDTH = 4.0  # of the domain, meters
MEASURED_AT = 2.0  # meters above the ground
SPEED, ROUGHNESS = 5.0, 0.03  # m/s at 10 m; meters, of grass
TREES = ((0.0, DEPTH), (-WIDTH, 2.0 * WIDTH), (0.0, HEIGHT))  # beyond the sides of the domain
DOMAIN = ((-250.0, 500.0), (0.0, WIDTH), (0.0, 130.0))
NEAR = ((-30.0, 270.0), (0.0, WIDTH), (0.0, 25.0))  # where elements are finest
DISTANCES = (50.0, 150.0, 250.0)  # behind the trees, meters
PROFILE = tuple(0.25 * HEIGHT * i for i in range(1, 61))


@dataclass(frozen=True)
class Row:
    name: str
    porosity: float  # 1 without trees
    drag: float = 0.2  # coefficient of the leaves
    finest: float = 1.0  # meters
    turbulence: str = "k-epsilon"
    iterations: int = 600


OPEN = Row("open", 1.0)
ROWS = [OPEN, Row("porosity30", 0.3), Row("porosity10", 0.1), Row("porosity1", 0.01), Row("porosity10_drag5", 0.1, drag=0.5)]


def leaf_area_density(row):
    """1/m."""
    return 2.0 * math.log(1.0 / row.porosity) / DEPTH


def mesh(atria, row, folder):
    write_obj(folder / "trees.obj", {"Trees": box(TREES)})
    domain, near = ([c for pair in bounds for c in pair] for bounds in (DOMAIN, NEAR))
    return run([atria, "mesh", folder / "trees.obj", "-o", folder / "mesh.vtu", "--cell-zone", "Trees", "--domain", *domain,
                "--size-min", row.finest, "--size-mid", row.finest, "--size-max", 4 * row.finest, "--refine-box", *near, row.finest,
                "--layers", 0, "--threads", 1], folder, "mesh")


def case_command(atria, row, folder):
    leaves = ["--canopy", "Trees", f"{leaf_area_density(row):.4g}", row.drag] if row.porosity < 1.0 else []
    return [atria, "case", folder / "mesh.vtu", "-o", folder / "case", "--wind", 0, "--speed", SPEED, "--roughness", ROUGHNESS, *leaves,
            "--turbulence", row.turbulence, "--iterations", row.iterations]


def speeds_at(fields, distances):
    """Along the wind, at the height of the measurements, by the distance behind the trees."""
    import numpy
    from atria.report.fields import probe

    places = numpy.array([(DEPTH + distance, 0.5 * WIDTH, MEASURED_AT) for distance in distances])
    return [float(value) for value in probe(fields.mesh, places, fields.velocity)[:, 0]]


def measure(case):
    from atria.report import Case

    described = Case(case)
    flow = described.runs[0]
    return {"cells": described.mesh["cells"], "solve_seconds": flow.log.seconds, "speeds": speeds_at(flow.fields, PROFILE),
            "at": speeds_at(flow.fields, DISTANCES)}


def make(atria, row, folder):
    seconds = mesh(atria, row, folder)
    run(case_command(atria, row, folder), folder, "case")
    run([folder / "case" / "Allrun"], folder, "run")
    return {"mesh_seconds": seconds, **measure(folder / "case")}


HEAD = ("row", "elements", "solving, s", "leaf area, 1/m", "slowest, of the open wind", "at, heights",
        *(f"slower at {distance:g} m" for distance in DISTANCES))


def cells(row, result, open_wind):
    if result is None or open_wind is None:
        return [row.name, "not run", *[""] * (len(HEAD) - 2)]
    share = [speed / free for speed, free in zip(result["speeds"], open_wind["speeds"])]
    at = [speed / free for speed, free in zip(result["at"], open_wind["at"])]
    slowest = min(range(len(share)), key=share.__getitem__)
    return [row.name, f"{result['cells']:,}", f"{result['solve_seconds']:.0f}", f"{leaf_area_density(row):.2f}",
            f"{100 * share[slowest]:.0f} %", f"{PROFILE[slowest] / HEIGHT:.1f}", *(f"{100 * (1 - speed):.0f} %" for speed in at)]


def tables(out):
    measured = ["*measured*", "", "", "", "29 to 71 %", "2 to 6", "60 %", "30 %", "0 %"]
    return f"## A row of trees\n\n{lines_of(HEAD, [*(cells(row, known(row, out), known(OPEN, out)) for row in ROWS if row is not OPEN), measured])}\n"


if __name__ == "__main__":
    command_line(make, ROWS, tables, __doc__)
