#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes models as a user does who tries Atria first, `atria mesh MODEL --openfoam CASE` on one thread without any size or
domain, and tables what that takes and whether checkMesh objects to anything.

Usage: default_commands.py ATRIA MODEL ... [-- OPTION ...]    with these options of `atria mesh`, such as --layers 5
"""

import json
import pathlib
import sys
import tempfile

from compare import measure
from peers import checked
from tables import row

WRITTEN_BUT_FAILS_CHECKS = 5
STAGES = ("surface", "octree", "crossings", "layers")


def cells_of(program, model, options):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        command = [program, "mesh", model, "--openfoam", "case", "--report", "report.json", "--threads", "1", *options]
        try:
            used, _ = measure(command, folder, accepted=(0, WRITTEN_BUT_FAILS_CHECKS))
        except RuntimeError as error:
            return [str(error).strip().splitlines()[-1]]
        report = json.loads((folder / "report.json").read_text())
        elements = report["counts"]["elements"]
        return [f"{elements:,}", f"{used['processor']:.1f}", f"{elements / used['processor']:,.0f}",
                *(f"{report['seconds'].get(stage, 0.0):.1f}" for stage in STAGES),
                report["diagnostics"]["LeftOutElement"], ", ".join(checked(folder / "case")) or "Mesh OK"]


def main():
    arguments = sys.argv[1:]
    if len(arguments) < 2 or arguments[0].startswith("-"):
        sys.exit(__doc__)
    end = arguments.index("--") if "--" in arguments else len(arguments)
    program, *models = (pathlib.Path(a).resolve() for a in arguments[:end])
    heads = ("model", "elements", "s", "elements a s", *STAGES, "left out", "checks")
    print(row(*heads), row(*["---"] * len(heads)), sep="\n", flush=True)
    for model in models:
        print(row(model.name, *cells_of(program, model, arguments[end + 1:])), flush=True)


if __name__ == "__main__":
    main()
