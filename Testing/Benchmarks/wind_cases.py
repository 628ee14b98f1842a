#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether cases run as they are made: each model is meshed with --openings and default sizes, and the wind is run about
it for a hundred iterations. Prints a table.

Usage: wind_cases.py ATRIA OUT MOST_ELEMENTS MODEL ... [-- OPTION ...]

Folders are searched for models. Options are those of `atria mesh`, such as the unit. PYTHONPATH must hold `atria`.
"""

import json
import pathlib
import subprocess
import sys
import time

import numpy

ENDINGS = (".wrl", ".wrl.gz", ".wrz", ".obj", ".dae", ".ifc", ".city.json")
ITERATIONS = 100
SECONDS = 900


def run(command, log):
    """Its exit status, or None where it takes too long."""
    with open(log, "w", encoding="utf-8") as output:
        try:
            return subprocess.run([str(word) for word in command], stdout=output, stderr=subprocess.STDOUT, timeout=SECONDS,
                                  check=False).returncode
        except subprocess.TimeoutExpired:
            return None


def last_line(log):
    lines = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
    return next((line for line in lines if line.startswith("atria: error")), lines[-1] if lines else "").replace("|", "/")


def outcome(case):
    """In words, with what the run reached."""
    from atria.report import Case

    flow = Case(case).runs[0]
    if not flow.ran:
        return "no log", 0, 0.0
    residuals = flow.log.residuals
    finite = all(numpy.isfinite(history.values).all() for history in residuals.values())
    speed = flow.speed()
    last = int(max(history.times[-1] for history in residuals.values()))
    word = "failed" if not (finite and flow.log.ended) else "not bounded" if flow.failures() else "ran"
    return word, last, speed.last() if speed else float("nan")


def measured(atria, model, folder, most_elements, options):
    """A line of the table."""
    folder.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    mesh, case = folder / "mesh.vtu", folder / "case"
    status = run([atria, "mesh", model, "-o", mesh, "--openings", "--max-elements", most_elements, *options], folder / "log.mesh")
    if status not in (0, 4, 5):
        return f"| {model.name} | no mesh: {last_line(folder / 'log.mesh')} | | | | |"
    if run([atria, "case", mesh, "-o", case, "--iterations", ITERATIONS], folder / "log.case") != 0:
        return f"| {model.name} | no case: {last_line(folder / 'log.case')} | | | | |"
    described = json.loads((case / "case.json").read_text())
    result = run([case / "Allrun"], folder / "log.run")
    word, last, speed = outcome(case)
    if result != 0:
        word = "failed" if result is not None else f"more than {SECONDS} s"
    mesh = described["mesh"]
    valid = "" if status != 4 else ", not all valid"
    return (f"| {model.name} | {mesh['cells']:,}{valid} | {mesh['worst_non_orthogonality']:.0f}° | {mesh['failed_checks']} "
            f"| {len(described['rooms'])}, {len(described['openings'])} | {word}, {last} iterations, {speed:.2g} m/s, "
            f"{time.monotonic() - begin:.0f} s |")


def models_in(places):
    for place in map(pathlib.Path, places):
        found = sorted(place.rglob("*")) if place.is_dir() else [place]
        yield from (path for path in found if path.name.lower().endswith(ENDINGS))


def main(atria, out, most_elements, *arguments):
    end = arguments.index("--") if "--" in arguments else len(arguments)
    places, options = arguments[:end], arguments[end + 1:]
    print("| model | elements | worst angle | failed checks | rooms, openings | outcome, mean speed of pedestrians |\n"
          "|---|---|---|---|---|---|", flush=True)
    for model in models_in(places):
        print(measured(atria, model, pathlib.Path(out) / model.name, most_elements, options), flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
