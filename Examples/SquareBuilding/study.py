#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of docs/records/validation.md: wind about a square building, by meshes of several kinds, against measurement.

Each row has its mesh made, its case run by OpenFOAM on one processor, and what was measured written as JSON to
OUT/results. Rows that are there are not made again, so that the study goes on where it stopped. A row that fails is
told and left out. OUT/tables.md has the tables of what there is.

Usage: study.py ATRIA OUT [ROW ...]     (PYTHONPATH must hold the package `atria`)
       study.py --list
"""

import math
import pathlib
import sys
from dataclasses import dataclass

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Study"))

import make_building  # noqa: E402
import reference  # noqa: E402
import snappy  # noqa: E402
from convergence import TENDENCY, tendency  # noqa: E402
from kept_rows import command_line, known, lines_of, run  # noqa: E402

B = make_building.WIDTH
GROUND, FAR = 2, 4  # sizes on the ground and far away of adaptive meshes, in finest sizes
MODELS = {"realizable": "realizable k-epsilon", "k-epsilon": "k-epsilon", "k-omega-sst": "k-omega SST"}


@dataclass(frozen=True)
class Row:
    name: str
    kind: str  # one of KINDS, or empty: as layered, without the building
    across: int  # elements across the building's width
    turbulence: str = "realizable"
    inflow: str = "measured"  # or logarithmic, as the case has it by itself
    most_iterations: int = 400
    starts_from_adaptive: bool = False  # from the flow in the adaptive mesh of this size, as from rest it takes too long

    @property
    def finest(self):
        return B / self.across


# By Atria, but for snappy, which is by snappyHexMesh; hexahedra are as layered, but these only.
KINDS = {"uniform": (6, 8, 12, 16), "adaptive": (8, 12, 16, 24), "layered": (8, 12, 16, 24),
         "hexahedra": (8, 12, 16), "snappy": (8, 12, 16, 24)}
# By elements across. From these on the drag of adaptive meshes changes by some 1e-4 of itself; uniform ones settle later.
ITERATIONS = {6: 300, 8: 300, 12: 300, 16: 400, 24: 500}
UNIFORM_ITERATIONS = 500
SETTLED_ITERATIONS = 220  # of uniform meshes that start from another's flow
FROM_ADAPTIVE = 16  # the size from which on they do


def family_of(kind, sizes):
    return [Row(f"{kind}{across}", kind, across, most_iterations=ITERATIONS[across]) for across in sizes]


def uniform_family(sizes):
    return [Row(f"uniform{across}", "uniform", across, most_iterations=UNIFORM_ITERATIONS if across < FROM_ADAPTIVE else
                SETTLED_ITERATIONS, starts_from_adaptive=across >= FROM_ADAPTIVE) for across in sizes]


FAMILIES = {kind: uniform_family(sizes) if kind == "uniform" else family_of(kind, sizes) for kind, sizes in KINDS.items()}
OTHERS = [FAMILIES["layered"][2], Row("k-epsilon", "layered", 16, turbulence="k-epsilon"),
          Row("k-omega-sst", "layered", 16, turbulence="k-omega-sst"), Row("logarithmic", "layered", 16, inflow="logarithmic")]
EMPTY = family_of("empty", (8, 16))
UNIFORM = {row.across: row for row in FAMILIES["uniform"]}  # what others of the same size are compared with


def rows():
    """Each once, those that take least first."""
    found = {row.name: row for row in [*sum(FAMILIES.values(), []), *OTHERS, *EMPTY]}
    return sorted(found.values(), key=lambda row: (row.across**3) * (10 if row.kind == "uniform" else 1))


def mesh_by_atria(atria, row, model, folder):
    adaptive, layers = row.kind != "uniform", int(row.kind in ("layered", "hexahedra", "empty"))
    bounds = [c for pair in make_building.DOMAIN for c in pair]
    command = [atria, "mesh", model, "-o", folder / "mesh.vtu", "--domain", *bounds, "--size-min", row.finest, "--size-mid",
               row.finest, "--size-max", FAR * row.finest if adaptive else row.finest, "--layers", layers,
               "--start-level", 3, "--threads", 1]
    if not layers:
        command += ["--no-support"]  # nor where elements cannot be valid without: these rows tell what a layer changes
    if row.kind == "hexahedra":
        command += ["--hex"]
    if adaptive:
        near = [c for pair in make_building.NEAR for c in pair]
        command += ["--size", "Ground", GROUND * row.finest, "--refine-box", *near, row.finest]
    return folder / "mesh.vtu", run(command, folder, "mesh")


def mesh_by_snappy(row, folder):
    case = folder / "snappy"
    commands = snappy.write_case(case, row.finest, GROUND * row.finest, FAR * row.finest)
    return case, sum(run(command, folder, name) for name, command in commands.items())


def make_case(atria, row, folder):
    """The case, and the seconds that its mesh took."""
    model = folder / "tower.wrl"
    make_building.main(model, row.kind != "empty")
    mesh, seconds = mesh_by_snappy(row, folder) if row.kind == "snappy" else mesh_by_atria(atria, row, model, folder)
    case = folder / "case"
    wind = ["--speed", reference.SPEED, "--height", make_building.HEIGHT, "--roughness", reference.ROUGHNESS]
    if row.inflow == "measured":
        wind += reference.inflow_conditions("xMin", row.turbulence == "k-omega-sst")
    run([atria, "case", mesh, "-o", case, *wind, "--turbulence", row.turbulence, "--iterations", row.most_iterations], folder,
        "case")
    return case, seconds


def start_from_adaptive(atria, row, case, folder):
    """Solves the adaptive mesh of the row's size, and gives its flow to the case."""
    folder.mkdir()
    other, _ = make_case(atria, next(one for one in FAMILIES["adaptive"] if one.across == row.across), folder)
    run([other / "Allrun"], folder, "run")
    run(["mapFields", other, "-case", case, "-sourceTime", "latestTime", "-consistent"], folder, "map")


def make(atria, row, folder):
    from measures import measure

    case, seconds = make_case(atria, row, folder)
    if row.starts_from_adaptive:
        start_from_adaptive(atria, row, case, folder / "start")
    run([case / "Allrun"], folder, "run")
    run(["simpleFoam", "-postProcess", "-func", "wallShearStress", "-latestTime", "-case", case], folder, "friction")
    return {"mesh_seconds": seconds, **measure(case)}


def length(value):
    """Of reversed flow, as a table has it: 'none', or beyond where it was looked for."""
    return "none" if value is None else "beyond" if math.isinf(value) else f"{value:.2f}"


def difference(result, other, plane):
    """Root of the mean square of differences of U/U_H in a plane; `other` are values by place."""
    pairs = [(a, b) for x, values in result["profiles"][plane].items() for a, b in zip(values, other[x])]
    return math.sqrt(sum((a - b) ** 2 for a, b in pairs) / len(pairs))


def by_text(places):
    """Places as JSON has them."""
    return {str(x): values for x, values in places.items()}


MEASURED = {"middle": by_text(reference.MIDDLE), "near_ground": by_text(reference.NEAR_GROUND)}
HEAD = ("row", "elements", "worst angle", "meshing, s", "solving, s", "iterations", "drift", "roof", "wake", "drag",
        "middle plane", "near the ground", "against uniform")


def cells(row, out):
    result, uniform = known(row, out), known(UNIFORM[row.across], out) if row.across in UNIFORM else None
    if result is None:
        return [row.name, "not run", *[""] * (len(HEAD) - 2)]
    against = difference(result, uniform["profiles"]["middle"], "middle") if uniform and row.kind != "uniform" else None
    return [row.name, f"{result['cells']:,}", f"{result['worst_non_orthogonality']:.0f}°", f"{result['mesh_seconds']:.1f}",
            f"{result['solve_seconds']:.0f}", result["iterations"], f"{result['drift']:.0e}", length(result["roof"]),
            length(result["wake"]), f"{result['drag']:.3f}",
            f"{difference(result, MEASURED['middle'], 'middle'):.3f}",
            f"{difference(result, MEASURED['near_ground'], 'near_ground'):.3f}", "" if against is None else f"{against:.3f}"]


def convergences(out):
    """A line for each three sizes of a family and each quantity: its values, the finest last, and what they tend to."""
    for kind, family in FAMILIES.items():
        for three in zip(family[2:], family[1:], family):
            results = [known(row, out) for row in three]
            if all(results):
                for quantity in ("roof", "wake", "drag"):
                    values = [result[quantity] for result in results]
                    if all(value is not None and math.isfinite(value) for value in values):
                        yield [kind, ", ".join(str(row.across) for row in three[::-1]), quantity,
                               *tendency([row.finest for row in three], values)]


def wind_rows(out):
    """U/U_H at the building's place without it, over that of the inflow."""
    for row in EMPTY:
        if result := known(row, out):
            yield [row.name, *(f"{found / speed:.2f}" for found, (_, speed, _) in zip(result["wind"], reference.INFLOW))]


def tables(out):
    groups = {**{kind.capitalize(): family for kind, family in FAMILIES.items()}, "Models and wind": OTHERS}
    parts = [(title, lines_of(HEAD, [cells(row, out) for row in members])) for title, members in groups.items()]
    head = ("meshes", "elements across b", "quantity", *TENDENCY)
    parts.append(("Grid convergence", lines_of(head, convergences(out))))
    heights = [f"{height:g}" for height, _, _ in reference.INFLOW[:-1]]
    parts.append(("Wind without the building, over the inflow, by z/b", lines_of(("row", *heights), wind_rows(out))))
    published = [("measured", reference.ROOF_LENGTH, reference.WAKE_LENGTH), *reference.PUBLISHED]
    parts.append(("Published", lines_of(("by", "roof", "wake"), published)))
    return "\n".join(f"## {title}\n\n{table}\n" for title, table in parts)


if __name__ == "__main__":
    command_line(make, rows(), tables, __doc__)
