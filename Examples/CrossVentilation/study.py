#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of docs/ventilation.md of a cross-ventilated building in a wind tunnel: what blows through it, by meshes of
several kinds and sizes.

Each row has its mesh made, its case run by OpenFOAM on one processor, and what was measured written as JSON to
OUT/results. Rows that are there are not made again, so that the study goes on where it stopped. A row that fails is
told and left out. OUT/tables.md has the table of what there is.

Usage: study.py ATRIA OUT [ROW ...]     (PYTHONPATH must hold the package `atria`)
       study.py --list
"""

import math
import pathlib
import sys
from dataclasses import dataclass

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Study"))

import make_building  # noqa: E402
import numpy  # noqa: E402
from convergence import TENDENCY, tendency  # noqa: E402
from kept_rows import Failed, command_line, known, lines_of, run  # noqa: E402

SPEED, ROUGHNESS = 6.97, 2.5e-5  # of the wind at the height of the roof, m/s, and of the tunnel's floor, meters
GROUND, FAR = 2, 4  # sizes on the ground and far away of adaptive meshes, in finest sizes


@dataclass(frozen=True)
class Row:
    name: str
    finest: float  # millimeters
    adaptive: bool = True  # or of one size
    layers: int = 0
    most_iterations: int = 500  # uniform meshes take longest: the wind comes from an element to the next


ROWS = [Row("uniform10", 10, False), Row("adaptive10", 10), Row("layered10", 10, layers=1),
        Row("uniform7", 7, False), Row("adaptive7", 7), Row("layered7", 7, layers=1),
        Row("uniform5", 5, False), Row("adaptive5", 5), Row("layered5", 5, layers=1)]
UNIFORM = {row.finest: row for row in ROWS if not row.adaptive}  # what others of the same size are compared with


def rows():
    """Those that take least first."""
    return sorted(ROWS, key=lambda row: (1 if row.adaptive else 10) / row.finest**3)


def mesh(atria, row, model, folder):
    finest = row.finest / 1000
    bounds, near = ([c for pair in box for c in pair] for box in (make_building.DOMAIN, make_building.NEAR))
    command = [atria, "mesh", model, "-o", folder / "mesh.vtu", "--openings", "--domain", *bounds, "--size-min", finest,
               "--size-mid", finest, "--size-max", FAR * finest if row.adaptive else finest, "--layers", row.layers,
               "--start-level", 3, "--threads", 1]
    if not row.layers:
        command += ["--no-support"]  # nor where elements cannot be valid without: these rows tell what a layer changes
    if row.adaptive:
        command += ["--size", "Ground", GROUND * finest, "--refine-box", *near, finest]
    return run(command, folder, "mesh")


def case_command(atria, row, folder):
    return [atria, "case", folder / "mesh.vtu", "-o", folder / "case", "--speed", str(SPEED), "--height",
            str(make_building.HEIGHT), "--roughness", str(ROUGHNESS), "--iterations", str(row.most_iterations),
            "--patch", "Roof*", "wall"]  # the roof that the middle plane cuts is no ground


def speeds(mesh):
    """U/U_H along a line through the middle of both openings, from in front of the building to behind it."""
    from atria.report.fields import probe

    height = (make_building.OPENING[1] + make_building.OPENING[3]) / 2
    places = [(x, 1e-6, height) for x in numpy.linspace(-0.5, 1.5, 81) * make_building.LENGTH]
    return (probe(mesh, numpy.array(places), "U")[:, 0] / SPEED).tolist()


def measure(case):
    from atria.report import Case
    from atria.report.fields import Fields

    described = Case(case)
    flow = described.runs[0]
    through = {opening.name: opening for opening in flow.openings}
    if sorted(through) != ["WallBack_opening_1", "WallFront_opening_1"]:
        raise Failed(f"openings are {', '.join(sorted(through))}")
    history = through["WallFront_opening_1"].net.times_factor(1.0 / (make_building.opening_area() * SPEED))
    return {
        "cells": described.mesh["cells"],
        "worst_non_orthogonality": described.mesh["worst_non_orthogonality"],
        "failed_checks": described.mesh["failed_checks"],
        "iterations": int(history.times[-1]),
        "flow": abs(history.last()),
        "drift": history.drift() / abs(history.last()),
        "solve_seconds": flow.log.seconds,
        "speeds": speeds(Fields(case).mesh),
    }


def make(atria, row, folder):
    model = folder / "box.wrl"
    make_building.main(model)
    seconds = mesh(atria, row, model, folder)
    case = folder / "case"
    run(case_command(atria, row, folder), folder, "case")
    run([case / "Allrun"], folder, "run")
    return {"mesh_seconds": seconds, **measure(case)}


HEAD = ("row", "finest, mm", "elements", "worst angle", "meshing, s", "solving, s", "iterations", "drift", "Q / (A U_H)",
        "along the middle")


def cells(row, out):
    """Of one line; elements, flow and speeds also against the uniform mesh of that size."""
    result, uniform = known(row, out), known(UNIFORM[row.finest], out) if row.finest in UNIFORM else None
    if result is None:
        return [row.name, f"{row.finest:g}", "not run", *[""] * (len(HEAD) - 3)]
    elements, flow, along = f"{result['cells']:,}", f"{result['flow']:.3f}", ""
    if uniform and row.adaptive:
        elements += f" ({100 * result['cells'] / uniform['cells']:.0f} %)"
        flow += f" ({100 * (result['flow'] / uniform['flow'] - 1):+.1f} %)"
        squares = [(a - b) ** 2 for a, b in zip(result["speeds"], uniform["speeds"])]
        along = f"{math.sqrt(sum(squares) / len(squares)):.3f}"
    return [row.name, f"{row.finest:g}", elements, f"{result['worst_non_orthogonality']:.0f}°", f"{result['mesh_seconds']:.1f}",
            f"{result['solve_seconds']:.0f}", result["iterations"], f"{result['drift']:.0e}", flow, along]


def convergences(out):
    """A line for each kind of mesh of which all three sizes are there."""
    kinds = {}
    for row in ROWS:
        kinds.setdefault(row.name.rstrip("0123456789"), []).append(row)
    for kind, family in kinds.items():
        family = sorted(family, key=lambda row: row.finest)
        results = [known(row, out) for row in family]
        if all(results):
            yield [kind, *tendency([row.finest for row in family], [result["flow"] for result in results])]


def tables(out):
    return (f"## A building in a wind tunnel\n\n{lines_of(HEAD, [cells(row, out) for row in ROWS])}\n\n"
            f"{lines_of(('meshes', *TENDENCY), convergences(out))}\n")


if __name__ == "__main__":
    command_line(make, rows(), tables, __doc__)
