#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of docs/ventilation.md: air changes of one building by meshes of many kinds, with warm rooms, and over the hours of
a year.

Each row has its mesh made, its case run by OpenFOAM on one processor, and what was measured written as JSON to
OUT/results. Rows that are there are not made again, so that the study goes on where it stopped. A row that fails is
told and left out. OUT/tables.md has the tables of what there is.

Usage: study.py ATRIA OUT [ROW ...]     (PYTHONPATH must hold the package `atria`)
       study.py --list
"""

import pathlib
import sys
from dataclasses import dataclass

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Study"))

import make_building  # noqa: E402
import snappy  # noqa: E402
import warm_rooms  # noqa: E402
import year  # noqa: E402
from kept_rows import Failed, command_line, known, lines_of, run  # noqa: E402

SPEED = 4.0  # of the wind, m/s
WIND = ("--height", "10", "--roughness", "0.1")
FEW = 200  # iterations, by which the air changes of most meshes have settled
LAYER = 0.6  # height of the layer on ground of 2 m, meters
NEAR_GROUND = 8.0  # of domains that are too large for fine ground, meters


@dataclass(frozen=True)
class Row:
    name: str
    finest: float = 2.0  # on all surfaces and at their edges, meters
    far: float = 8.0  # away from them, meters
    layers: int = 1
    site: tuple = make_building.SITE  # length and width of the domain, meters; its height is 0.3 of the longer
    ground: float = 0.0  # on the ground, meters; 0 for the finest
    fine_about: float = 0.0  # where the ground has the finest size all the same, meters about the building
    near: float = 0.0  # where the air has it, too, meters about and above the building; 0 for nowhere
    ground_layer: float = 0.0  # height of the layer there, meters; 0 for the share of the size that layers have
    sides: int = 4  # upright ones of the domain
    angle: float = 0.0  # of building, domain and wind against the grid, degrees
    mesher: str = "atria"
    hexahedra: bool = False  # no other elements
    most_iterations: int = 500  # limiters keep residuals from falling without end; the air changes settle far earlier


@dataclass(frozen=True)
class WarmRow(Row):
    """On the cheap mesh that keeps the air changes."""

    ground: float = 4.0
    fine_about: float = 24.0
    most_iterations: int = 600
    speed: float = SPEED  # of the wind; 0 for none, m/s
    heat: float = 30.0  # of the rooms, W for each m² of floor


@dataclass(frozen=True)
class YearRow(Row):
    """All directions of the wind on one mesh, weighted by the hours of a year."""

    far: float = 16.0
    ground: float = NEAR_GROUND
    fine_about: float = 24.0
    site: tuple = (500.0, 500.0)
    sides: int = 16
    most_iterations: int = FEW


FAR = [Row("uniform", far=2.0), Row("far4", far=4.0), Row("far8"), Row("far16", far=16.0), Row("far32", far=32.0),
       Row("far8_ground4", ground=4.0), Row("far8_ground8", ground=8.0),
       *(Row(f"ground4_about{about}", ground=4.0, fine_about=about, most_iterations=FEW) for about in (24, 48)),
       Row("near12_far8", near=12.0, most_iterations=FEW),
       Row("near12_ground4", near=12.0, ground=4.0, most_iterations=FEW),
       Row("near12_about24", near=12.0, ground=4.0, fine_about=24.0, most_iterations=FEW),
       Row("ground4_layer", ground=4.0, ground_layer=LAYER, most_iterations=FEW),
       Row("ground8_layer", ground=8.0, ground_layer=LAYER, most_iterations=FEW)]
ONE_AND_A_HALF = [Row("uniform1.5", finest=1.5, far=1.5, most_iterations=300),
                  Row("finest1.5", finest=1.5, far=6.0, most_iterations=FEW),
                  Row("near12_finest1.5", finest=1.5, far=6.0, near=12.0, most_iterations=FEW),
                  Row("near12_ground3", finest=1.5, far=6.0, near=12.0, ground=3.0, most_iterations=FEW),
                  Row("near12_ground3_about24", finest=1.5, far=6.0, near=12.0, ground=3.0, fine_about=24.0, most_iterations=FEW)]
TURNED = [Row("turned_uniform", far=2.0, angle=17.0, most_iterations=300),
          Row("turned_far8", angle=17.0, most_iterations=FEW),
          Row("turned_about24", ground=4.0, fine_about=24.0, angle=17.0, most_iterations=FEW),
          Row("turned_near12_far8", near=12.0, angle=17.0, most_iterations=FEW),
          Row("turned_near12", near=12.0, ground=4.0, angle=17.0, most_iterations=FEW),
          Row("turned_near12_about24", near=12.0, ground=4.0, fine_about=24.0, angle=17.0, most_iterations=FEW)]
FINER = [Row("far8"), *(Row(f"finest{size:g}", finest=size, far=4 * size) for size in (1.4, 1.0, 0.8))]
DOMAINS = [Row("domain227", far=16.0, ground=NEAR_GROUND),
           Row("domain500", far=16.0, ground=NEAR_GROUND, site=(500.0, 400.0)),
           Row("domain1000", far=16.0, ground=NEAR_GROUND, site=(1000.0, 1000.0))]
PRISMS = [Row("square", far=16.0, ground=NEAR_GROUND, site=(500.0, 500.0), most_iterations=FEW),
          Row("prism", far=16.0, ground=NEAR_GROUND, site=(500.0, 500.0), sides=16, most_iterations=FEW)]
LAYERS = [Row("far8"), Row("layers0", layers=0), Row("layers5", layers=5)]
MESHERS = [Row("layers0_uniform", far=2.0, layers=0), Row("layers0", layers=0),
           Row("snappy_uniform", far=2.0, layers=0, mesher="snappyHexMesh", most_iterations=FEW),
           Row("snappy_far8", layers=0, mesher="snappyHexMesh")]
LAYERED_MESHERS = [Row("far8"), *(Row(f"snappy_layers{n}", layers=n, mesher="snappyHexMesh", most_iterations=FEW) for n in (1, 5)),
                   Row("layers5", layers=5)]
HEXAHEDRA = [Row("far8"), Row("hexahedra", hexahedra=True, most_iterations=FEW),
             Row("turned_far8", angle=17.0, most_iterations=FEW),
             Row("turned_hexahedra", angle=17.0, hexahedra=True, most_iterations=FEW)]
WARM = [WarmRow("warm_calm", speed=0.0), WarmRow("warm_wind1", speed=1.0), WarmRow("warm_wind4"),
        WarmRow("cold_wind4", heat=0.001)]  # as good as none, but with the schemes of warm air
YEAR = YearRow("year")
TABLES = {"Uniform and adaptive": FAR, "At 1.5 m": ONE_AND_A_HALF, "Across the grid": TURNED, "Finer": FINER,
          "Domains": DOMAINS, "Box and prism": PRISMS, "Layers": LAYERS, "snappyHexMesh": MESHERS,
          "snappyHexMesh with layers": LAYERED_MESHERS, "Hexahedra only": HEXAHEDRA}


def rows():
    """Each once, those that take least first."""
    found = {row.name: row for table in (*TABLES.values(), WARM, [YEAR]) for row in table}
    return sorted(found.values(), key=lambda row: row.far == row.finest)


def bounds_about_building(distance, angle):
    """Along the grid, which the building may be turned against: least and greatest x and y."""
    (x0, x1), (y0, y1) = ((-distance, length + distance) for length in (make_building.LENGTH, make_building.WIDTH))
    corners = make_building.turned([[(x, y, 0.0) for x in (x0, x1) for y in (y0, y1)]], angle)[0]
    return tuple(tuple(least(axis) for axis in list(zip(*corners))[:2]) for least in (min, max))


def mesh_by_atria(atria, row, model, folder):
    command = [atria, "mesh", model, "-o", folder / "mesh.vtu", "--site", "Site", "--openings", "--size-min", row.finest,
               "--size-mid", row.finest, "--size-max", row.far, "--layers", row.layers, "--threads", 1,
               "--domain-sides", row.sides, "--start-level", 3]  # the fourth level of this domain has 16 m
    if row.angle:
        command += ["--domain-angle", row.angle, "--align", "axes"]
    if row.ground:
        command += ["--size", "Site", row.ground]
    if row.fine_about:
        (x0, y0), (x1, y1) = bounds_about_building(row.fine_about, row.angle)
        command += ["--refine-box", x0, x1, y0, y1, 0.0, 0.5 * row.finest, row.finest]
    if row.near:
        (x0, y0), (x1, y1) = bounds_about_building(row.near, row.angle)
        command += ["--refine-box", x0, x1, y0, y1, 0.0, make_building.HEIGHT + row.near, row.finest]
    if row.hexahedra:
        command += ["--hex"]
    if row.layers == 0:
        command += ["--no-support"]  # nor where elements cannot be valid without: these rows tell what a layer changes
    if row.ground_layer:
        command += ["--layers", f"Site={row.layers}:{row.ground_layer:g}"]
    return folder / "mesh.vtu", run(command, folder, "mesh")


def mesh_by_snappy(row, folder):
    case = folder / "snappy"
    commands = snappy.write_case(case, row.finest, row.far, row.site, row.layers)
    return case, sum(run(command, folder, name) for name, command in commands.items())


def case_command(atria, row, mesh, case):
    """The wind comes along the domain."""
    wind = ["--from", str(180.0 - row.angle), "--speed", f"{SPEED:g}", *WIND]
    if isinstance(row, WarmRow):
        wind = warm_rooms.options(row, wind)
    return [atria, "case", mesh, "-o", case, *wind, "--iterations", str(row.most_iterations)]


def measure(case):
    """What the row's table tells of a case that has run."""
    from atria.report import Case

    described = Case(case)
    flow = described.runs[0]
    through = [o for o in flow.openings if o.name.startswith(("WallSouth", "WallNorth"))]
    if len(through) != 6:
        raise Failed(f"{len(through)} of 6 windows were measured")
    # What comes in is half of all that passes.
    into = [o.both.times_factor(0.5) for o in through]
    history = type(into[0])(into[0].times, sum(flow.values for flow in into)).times_factor(3600.0 / make_building.volume())
    return {
        "cells": described.mesh["cells"],
        "worst_non_orthogonality": described.mesh["worst_non_orthogonality"],
        "failed_checks": described.mesh["failed_checks"],
        "iterations": int(history.times[-1]),
        "air_changes": history.last(),
        "drift": history.drift() / history.last(),
        "spread": history.spread() / history.last(),
        "imbalance": flow.imbalance(),
        "residuals": {field: h.last() for field, h in flow.log.residuals.items()},
        "solve_seconds": flow.log.seconds,
    }


def make(atria, row, folder):
    model = folder / "school.wrl"
    make_building.main(model, *row.site, row.angle)
    mesh, seconds = mesh_by_atria(atria, row, model, folder) if row.mesher == "atria" else mesh_by_snappy(row, folder)
    case = folder / "case"
    if isinstance(row, YearRow):
        wind = ["--speed", f"{SPEED:g}", *WIND]
        return {"mesh_seconds": seconds, **year.run_and_measure(atria, mesh, folder, wind, row.most_iterations)}
    run(case_command(atria, row, mesh, case), folder, "case")
    run([case / "Allrun"], folder, "run")
    return {"mesh_seconds": seconds, **measure(case), **(warm_rooms.measure(case) if isinstance(row, WarmRow) else {})}


HEAD = ("row", "finest–far, m", "layers", "elements", "meshing, s", "solving, s", "iterations", "residuals", "air changes, 1/h",
        "worst angle")


def cells(row, result, first):
    """Of one line; elements and air changes also against the table's first row."""
    start = [row.name, f"{row.finest:g}–{row.far:g}", row.layers]
    if result is None:
        return start + ["not run"] + [""] * (len(HEAD) - len(start) - 1)
    elements, changes = f"{result['cells']:,}", f"{result['air_changes']:.2f}"
    if first and first is not result:
        elements += f" ({100 * result['cells'] / first['cells']:.0f} %)"
        changes += f" ({100 * (result['air_changes'] / first['air_changes'] - 1):+.1f} %)"
    return start + [elements, f"{result['mesh_seconds']:.1f}", f"{result['solve_seconds']:.0f}", result["iterations"],
                    f"{max(result['residuals'].values()):.0e}", changes, f"{result['worst_non_orthogonality']:.0f}°"]


def table(title, members, out):
    results = {row: known(row, out) for row in members}
    first = next(iter(results.values()))
    return f"## {title}\n\n{lines_of(HEAD, [cells(row, result, first) for row, result in results.items()])}\n"


def tables(out):
    text = [*(table(title, members, out) for title, members in TABLES.items()),
            warm_rooms.table([(row, known(row, out)) for row in WARM]), year.table(known(YEAR, out))]
    return "\n".join(text)


if __name__ == "__main__":
    command_line(make, rows(), tables, __doc__)
