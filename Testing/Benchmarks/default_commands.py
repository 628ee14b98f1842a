#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes models as a user does who tries Atria first, `atria mesh MODEL --openfoam CASE` on one thread without any size or
domain, and tables what that takes and whether checkMesh objects to anything.

Usage: default_commands.py ATRIA MODEL ... [-- OPTION ...]    with these options of `atria mesh`, such as --layers 5
       default_commands.py ATRIA MODEL ... --octants N [-- OPTION ...]
                                                              with the model N octants long at edges, half of that at
                                                              surfaces, a quarter away from them, in a box half as long again
Last it says how many models pass and how fast they were made. Models without faces to mesh are named by their error.
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from compare import box_about, measure, sizes_along
from peers import checked
from tables import heading, row

WRITTEN_BUT_FAILS_CHECKS = 5
STAGES = ("surface", "octree", "crossings", "layers", "audit")


def sizes_and_domain(program, model, octants):
    found = subprocess.run([program, "inspect", model, "--json"], capture_output=True, text=True, check=False)
    surfaces = json.loads(found.stdout)["surfaces"] if found.stdout else []
    boxes = [surface["bounds"] for surface in surfaces if surface.get("bounds")]
    if not boxes:
        return []
    bounds = [(max if i % 2 else min)(box[i] for box in boxes) for i in range(6)]
    sizes = sizes_along(bounds, octants)
    domain = [repr(bound) for pair in box_about(bounds, sizes) for bound in pair]
    return ["--domain", *domain, "--size-max", sizes[0], "--size-mid", sizes[1], "--size-min", sizes[2]]


def run(program, model, options):
    """Elements, elements a second, stages' seconds, elements left out, checks that fail. RuntimeError where there is no mesh."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        command = [program, "mesh", model, "--openfoam", "case", "--report", "report.json", "--threads", "1", *options]
        used, _ = measure(command, folder, accepted=(0, WRITTEN_BUT_FAILS_CHECKS))
        report = json.loads((folder / "report.json").read_text())
        elements = report["counts"]["elements"]
        return {"elements": elements, "s": used["processor"], "speed": elements / used["processor"],
                "stages": [report["seconds"].get(stage, 0.0) for stage in STAGES],
                "left out": report["diagnostics"]["LeftOutElement"], "failed": checked(folder / "case")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("atria", type=pathlib.Path)
    parser.add_argument("models", type=pathlib.Path, nargs="+")
    parser.add_argument("--octants", type=int, help="along a model")
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    given = parser.parse_args(sys.argv[1:end])
    options = sys.argv[end + 1:]
    heads = ("model", "elements", "s", "elements a s", *STAGES, "left out", "checks")
    print(*heading(*heads), sep="\n", flush=True)
    made = []
    for model in (path.resolve() for path in given.models):
        sizes = sizes_and_domain(given.atria.resolve(), model, given.octants) if given.octants else []
        try:
            one = run(given.atria.resolve(), model, [*sizes, *options])
        except RuntimeError as error:
            print(row(model.name, str(error).strip().splitlines()[-1]), flush=True)
            continue
        made.append(one)
        print(row(model.name, f"{one['elements']:,}", f"{one['s']:.1f}", f"{one['speed']:,.0f}",
                  *(f"{seconds:.2f}" for seconds in one["stages"]), one["left out"], ", ".join(one["failed"]) or "Mesh OK"), flush=True)
    if made:
        speeds = sorted(one["speed"] for one in made)
        print(f"\n{sum(not one['failed'] for one in made)} of {len(made)} pass. Elements a second: geometric mean "
              f"{math.exp(sum(map(math.log, speeds)) / len(speeds)):,.0f}, least {speeds[0]:,.0f}, "
              f"{sum(speed < 10000 for speed in speeds)} below 10,000.")


if __name__ == "__main__":
    main()
