#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of docs/ventilation.md of warm air: a room with a low and a high opening, in outdoor air at rest.

Rows `stack…` have heat in all of the room's air. The flow is compared with Q = Cd A* sqrt(2 g H dT / T), where Cd is 0.6, H the
height between the openings, dT how much warmer the room is than outdoors, and 1/A*² = 1/A1² + 1/A2². Rows `plume…` have a small
source near the floor, and air comes in slowly: displacement ventilation. The second goes on with a transient run from the steady
one, which shows whether that has converged. Both are compared with Linden, Lane-Serff and Smeed (1990), Emptying filling boxes:
the fluid mechanics of natural ventilation, J. Fluid Mech. 212, 309-335.

Each row has its mesh made, its case run by OpenFOAM on one processor, and what was measured written as JSON to
OUT/results. Rows that are there are not made again, so that the study goes on where it stopped. A row that fails is
told and left out. OUT/tables.md has the tables of what there is.

Usage: study.py ATRIA OUT [ROW ...]     (PYTHONPATH must hold the package `atria`)
       study.py --list
"""

import math
import pathlib
import shutil
import sys
from dataclasses import dataclass

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Study"))

import make_room  # noqa: E402
from kept_rows import Failed, command_line, known, lines_of, run  # noqa: E402

OUTDOORS = 20.0  # °C
GRAVITY, KELVIN = 9.81, 273.15
DISCHARGE = 0.6  # of an opening with sharp edges
ENTRAINMENT = 0.1  # of a plume, as Linden, Lane-Serff and Smeed have it: top-hat profiles
LEVELS = 40  # of the profile of temperatures


@dataclass(frozen=True)
class Row:
    name: str
    watts: float
    has_plume: bool = False
    finest: float = 0.1  # meters, at the openings and in the plume
    iterations: int = 800
    transient: float = 0.0  # seconds, after the iterations


ROWS = [Row("stack150", 150), Row("stack600", 600), Row("stack2400", 2400),
        Row("plume600", 600, True), Row("plume600_for_600s", 600, True, transient=600.0)]


def mesh(atria, row, folder, model):
    room = 2 * row.finest
    command = [atria, "mesh", model, "-o", folder / "mesh.vtu", "--openings", "--domain", *(c for pair in make_room.DOMAIN for c in pair),
               "--size-min", row.finest, "--size-mid", room, "--size-max", 8 * room, "--layers", 0, "--threads", 1]
    plume = ["--cell-zone", "Source", "--refine-box", *(c for pair in make_room.PLUME for c in pair), row.finest]
    return run([*command, *(plume if row.has_plume else ())], folder, "mesh")


def case_command(atria, row, folder, transient=False):
    command = [atria, "case", folder / "mesh.vtu", "-o", folder / ("transient" if transient else "case"), "--calm",
               "--outdoor-temperature", OUTDOORS, "--heat", "Source" if row.has_plume else "room_1", f"{row.watts:g}W"]
    return [*command, *(("--transient", row.transient) if transient else ("--iterations", row.iterations))]


def go_on_from(steady, transient):
    """Starts a transient case with the last fields of a steady one."""
    last = max((folder for folder in steady.iterdir() if folder.name.isdigit()), key=lambda folder: int(folder.name))
    for field in (transient / "0").iterdir():
        shutil.copy(last / field.name, field)


# Formulas

def effective_area(has_plume=False):
    """A* of low and high openings in series, without the coefficient of discharge, m²."""
    area = make_room.opening_area
    areas = (2 * area(make_room.WIDE), area(make_room.SMALL)) if has_plume else (area(make_room.LOWER), area(make_room.UPPER))
    return 1.0 / math.sqrt(sum(1.0 / area**2 for area in areas))


def middle(opening):
    return (opening[1] + opening[3]) / 2


def stack_flow(warmer):
    """Of a room that is mixed, m³/s."""
    height = middle(make_room.UPPER) - middle(make_room.LOWER)
    return DISCHARGE * effective_area() * math.sqrt(2 * GRAVITY * height * warmer / (OUTDOORS + KELVIN))


def plume_constant():
    """C of the flow in a plume, C B^(1/3) z^(5/3)."""
    return 1.2 * ENTRAINMENT * (0.9 * ENTRAINMENT) ** (1 / 3) * math.pi ** (2 / 3)


def interface_share():
    """Height of the interface above the source over that of the upper opening: A*/H² = C^(3/2) (x^5 / (1 - x))^(1/2).

    A* has Linden's factor, sqrt(2) of ours. The heat does not matter.
    """
    height = rise()
    wanted = math.sqrt(2.0) * DISCHARGE * effective_area(True) / height**2
    low, high = 0.0, 1.0
    for _ in range(60):
        share = (low + high) / 2
        found = plume_constant() ** 1.5 * math.sqrt(share**5 / (1.0 - share))
        low, high = (share, high) if found < wanted else (low, share)
    return (low + high) / 2


def source_height():
    low, high = make_room.SOURCE[2]
    return (low + high) / 2


def rise():
    """From the source to the middle of the high opening, meters."""
    return middle(make_room.SMALL) - source_height()


def plume_flow(watts, capacity):
    """Through the interface and so through the openings, m³/s."""
    buoyancy = GRAVITY / (OUTDOORS + KELVIN) * watts / capacity
    return plume_constant() * buoyancy ** (1 / 3) * (interface_share() * rise()) ** (5 / 3)


# What is measured

def profile(case):
    """Heights and mean temperatures of the room's air over them, from the floor up."""
    import numpy
    from atria.report.fields import Fields, probe

    grid = [(x, y) for x in numpy.linspace(0.1, make_room.LENGTH - 0.1, 20) for y in numpy.linspace(0.1, make_room.WIDTH - 0.1, 15)]
    heights = (numpy.arange(LEVELS) + 0.5) * make_room.HEIGHT / LEVELS
    mesh = Fields(case).mesh
    means = [float(numpy.nanmean(probe(mesh, numpy.array([(x, y, z) for x, y in grid]), "T"))) for z in heights]
    return heights.tolist(), means


def interface_height(heights, means):
    """Where the air is half as much warmer than outdoors as it is below the ceiling, meters."""
    half = OUTDOORS + (means[-1] - OUTDOORS) / 2
    for i in range(1, len(means)):
        if means[i - 1] < half <= means[i]:
            return heights[i - 1] + (heights[i] - heights[i - 1]) * (half - means[i - 1]) / (means[i] - means[i - 1])
    return 0.0


def measure(row, case):
    from atria.report import Case

    described = Case(case)
    flow = described.runs[0]
    through = {opening.name: opening for opening in flow.openings}
    if sorted(through) != [f"Wall_opening_{i + 1}" for i in range(3 if row.has_plume else 2)]:
        raise Failed(f"openings are {', '.join(sorted(through))}")
    warmth = flow.warmth
    into = flow.inflow("room_1")
    heights, means = profile(case)
    return {
        "cells": described.mesh["cells"],
        "worst_non_orthogonality": described.mesh["worst_non_orthogonality"],
        "flow": into,
        "warmer": warmth.rooms["room_1"].last() - OUTDOORS,
        "heat_through_openings": sum(heat.last() for heat in warmth.openings.values()),
        "imbalance": warmth.imbalance(),
        "capacity": described.described["warm_air"]["heat_capacity"],
        "unconverged": warmth.doubts(flow.log.residuals, {name: opening.both for name, opening in through.items()}),
        "solve_seconds": flow.log.seconds,
        "below_ceiling": means[-1],
        "interface": interface_height(heights, means),
    }


def make(atria, row, folder):
    model = folder / "room.obj"
    make_room.main(model, row.has_plume)
    seconds = mesh(atria, row, folder, model)
    case = folder / "case"
    run(case_command(atria, row, folder), folder, "case")
    run([case / "Allrun"], folder, "run")
    if row.transient:
        steady, case = case, folder / "transient"
        run(case_command(atria, row, folder, transient=True), folder, "transient_case")
        go_on_from(steady, case)
        run([case / "Allrun"], folder, "transient_run")
    return {"mesh_seconds": seconds, **measure(row, case)}


STACK_HEAD = ("row", "heat, W", "elements", "solving, s", "Q, m³/s", "warmer, K", "Q of the formula", "difference",
              "heat through openings, W", "heat balance")
PLUME_HEAD = ("row", "heat, W", "elements", "solving, s", "Q, m³/s", "Q of the model", "interface, m", "interface of the model",
              "below the ceiling, K", "of the model", "heat balance")


def percent(value, digits=1):
    return f"{100 * value:+.{digits}f} %"


def balance_of(result):
    return percent(result["imbalance"], 2) + (" (not converged)" if result["unconverged"] else "")


def beginning(row, result):
    return [row.name, f"{row.watts:g}", f"{result['cells']:,}", f"{result['solve_seconds']:.0f}", f"{result['flow']:.4f}"]


def stack_cells(row, result):
    formula = stack_flow(result["warmer"])
    return [*beginning(row, result), f"{result['warmer']:.3f}", f"{formula:.4f}", percent(result["flow"] / formula - 1.0),
            f"{result['heat_through_openings']:.1f}", balance_of(result)]


def plume_cells(row, result):
    flow = plume_flow(row.watts, result["capacity"])
    return [*beginning(row, result), f"{flow:.4f} ({percent(result['flow'] / flow - 1.0)})", f"{result['interface']:.2f}",
            f"{source_height() + interface_share() * rise():.2f}", f"{result['below_ceiling'] - OUTDOORS:.2f}",
            f"{row.watts / result['capacity'] / flow:.2f}", balance_of(result)]


def table(head, rows, cells, out):
    found = [(row, known(row, out)) for row in rows]
    return lines_of(head, [cells(row, result) if result else [row.name, f"{row.watts:g}", "not run", *[""] * (len(head) - 3)]
                           for row, result in found])


def tables(out):
    stacks, plumes = ([row for row in ROWS if row.has_plume == wanted] for wanted in (False, True))
    return (f"## Warm air\n\n{table(STACK_HEAD, stacks, stack_cells, out)}\n\n{table(PLUME_HEAD, plumes, plume_cells, out)}\n")


if __name__ == "__main__":
    command_line(make, ROWS, tables, __doc__)
