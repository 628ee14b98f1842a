# SPDX-License-Identifier: GPL-3.0-or-later
"""The row of the study with the weather of a year: from the weather file to air changes over its hours."""

import shutil

import make_weather
from kept_rows import lines_of, run

OPEN = (18, 26)  # °C outdoors, in which windows can be open
STATION = (10.0, 0.03)  # height of the wind measured and roughness of the ground there, meters
SECTORS = 12
WHICH = {"open": "18 to 26 °C", "all": "all"}


def run_and_measure(atria, mesh, folder, wind, iterations):
    """Runs all directions once and weights them by both kinds of hours."""
    weather = folder / "year.epw"
    make_weather.main(weather)
    tables = {name: folder / f"{name}.csv" for name in WHICH}
    run([atria, "climate", weather, "-o", tables["all"], "--sectors", SECTORS], folder, "climate")
    run([atria, "climate", weather, "-o", tables["open"], "--sectors", SECTORS, "--temperature", *OPEN], folder, "climate_open")
    case = folder / "case"
    run([atria, "case", mesh, "-o", case, *wind, "--rose", tables["open"], "--iterations", iterations], folder, "case")
    run([case / "Allrun"], folder, "run")
    run([atria, "report", case, "--climate", tables["open"], "--station", *STATION], folder, "report")
    shutil.copy(case / "report.html", folder.parent.parent / "year.html")
    return measure(case, tables)


def measure(case, tables):
    from atria.report import Case, read_climate, yearly
    from atria.report.comfort import at_reference

    described = Case(case)
    changes = {flow.origin: flow.all_air_changes().last() for flow in described.runs}
    found = {"cells": described.mesh["cells"], "solve_seconds": sum(flow.log.seconds for flow in described.runs),
             "least": min(changes.values()), "most": max(changes.values()), "hours": {}}
    for name, table in tables.items():
        climate = at_reference(read_climate(table), *STATION, described.described)
        factor = climate[0].scale / read_climate(table)[0].scale
        chosen = [hour for hour in make_weather.hours() if name == "all" or OPEN[0] <= hour.temperature <= OPEN[1]]
        found["hours"][name] = {
            "hours": len(chosen), "wind": sum(hour.speed for hour in chosen) / len(chosen),
            "mean": yearly.mean(climate, changes, described.speed),
            "hour_by_hour": hour_by_hour(chosen, changes, factor / described.speed)}
        for share in yearly.SHARES:
            found["hours"][name][f"exceeded_{100 * share:g}"] = yearly.exceeded(climate, changes, described.speed, share)
    return found


def hour_by_hour(hours, changes, per_speed):
    """Mean air changes of all hours, each by its own wind. `per_speed` makes shares of the runs' speed of the station's."""
    def apart(a, b):
        return abs((a - b + 180.0) % 360.0 - 180.0)

    def of(hour):
        return hour.speed * per_speed * changes[min(changes, key=lambda origin: apart(origin, hour.origin))]

    return sum(map(of, hours)) / len(hours)


HEAD = ("hours", "number", "mean wind, m/s", "mean air changes, 1/h", "hour by hour", "exceeded in 50 %", "in 90 %")


def table(result):
    if result is None:
        return "## A year\n\nnot run\n"
    rows = [[WHICH[name], f"{of['hours']:,}", f"{of['wind']:.2f}", f"{of['mean']:.2f}",
             f"{of['hour_by_hour']:.2f} ({100 * (of['hour_by_hour'] / of['mean'] - 1):+.1f} %)",
             f"{of['exceeded_50']:.2f}", f"{of['exceeded_90']:.2f}"] for name, of in result["hours"].items()]
    return (f"## A year\n\n{lines_of(HEAD, rows)}\n\n{result['cells']:,} elements, {result['solve_seconds']:.0f} s for all directions, whose "
            f"air changes at the study's wind are {result['least']:.2f} to {result['most']:.2f}.\n")
