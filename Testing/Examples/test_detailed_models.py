#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes houses full of detail below the mesh: none is refused, none takes long, and all are valid.

Eight houses, or a thousand with ATRIA_TEST_FULL=1, of up to 100,000 triangles, 60 octants of the finest size long, with a
layer, five layers and none in turn: layers stay on the walls, and no face is beyond 60 degrees, with five 72.
Where OpenFOAM's checkMesh is installed, it is asked.

Usage: test_detailed_models.py ATRIA DATA [FIRST [LAST]]
"""

import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

OCTANTS = 60
MOST_SECONDS = 60.0  # of the processor
MOST_DEGREES = {0: 60.0, 1: 60.0, 5: 72.0}  # of non-orthogonality
LEAST_COVERED = 0.9  # with all layers, of the area of surfaces of which nothing is too fine for the mesh
SKIPPED = 77


def bounds_of(atria, model):
    run = subprocess.run([atria, "inspect", model, "--json", "--no-problems"], capture_output=True, text=True, check=True)
    bounds = [surface["bounds"] for surface in json.loads(run.stdout)["surfaces"] if surface["triangles"]]
    return [(max if i % 2 else min)(b[i] for b in bounds) for i in range(6)]


def mesh(atria, model, folder, layers):
    """Exit status, messages, report and seconds of the processor."""
    b = bounds_of(atria, model)
    longest = max(b[1] - b[0], b[3] - b[2], b[5] - b[4])
    domain = [b[i] + (0.25 if i % 2 else -0.25) * longest for i in range(6)]
    size = 1.5 * longest / OCTANTS
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    run = subprocess.run(
        [atria, "mesh", model, "--domain", *map(repr, domain), "--zone", "all", "--layers", str(layers),
         "--size-min", repr(size), "--size-mid", repr(2 * size), "--size-max", repr(4 * size), "--openfoam", folder / "case", "--report",
         folder / "report.json", "-o", folder / "mesh.vtu"],
        capture_output=True, text=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    report = json.loads((folder / "report.json").read_text()) if run.returncode in (0, 5) else {}
    return run.returncode, run.stderr, report, seconds


def coverage_of(report):
    """The part of the walls with all layers; of walls that have details below the mesh only their outline is there."""
    detailed = {detail["surface"] for detail in report["hidden_detail"]}
    walls = [wall for wall in report["layers"] if wall["surface"] not in detailed]
    return sum(wall["area"] * wall["covered_in_full"] for wall in walls) / sum(wall["area"] for wall in walls)


def faults_of(atria, data, seed, triangles):
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        model = folder / "house.wrl"
        subprocess.run([sys.executable, data / "make_detailed_house.py", model, "--seed", str(seed), "--triangles",
                        str(triangles)], check=True, stdout=subprocess.DEVNULL)
        layers = (5, 1, 0)[seed % 3]
        status, messages, report, seconds = mesh(atria, model, folder, layers)
        if status not in (0, 5):  # checkMesh judges below
            return [f"exit status {status}: {messages.strip()[-300:]}"], seconds
        faults = []
        if report["invalid_elements"]:
            faults.append(f"{report['invalid_elements']} invalid elements")
        worst = report["openfoam"]["checks"]["NonOrthogonality"]["worst"]
        if worst > MOST_DEGREES[layers]:
            faults.append(f"{worst:.1f} degrees with {layers} layers")
        covered = coverage_of(report)
        if layers and covered < LEAST_COVERED:
            faults.append(f"{layers} layers on {100 * covered:.0f} % of the walls")
        if seconds > MOST_SECONDS:
            faults.append(f"{seconds:.0f} s of the processor")
        if shutil.which("checkMesh"):
            # Debian's packages are called without OpenFOAM's environment; this alone they need.
            environment = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}
            check = subprocess.run(["checkMesh", "-allGeometry", "-allTopology", "-case", folder / "case"], capture_output=True, text=True,
                                   env=environment)
            if "Mesh OK." not in check.stdout:
                faults.append("checkMesh: " + "; ".join(line.strip() for line in check.stdout.splitlines() if "***" in line))
        return faults, seconds


def main():
    atria, data = sys.argv[1], pathlib.Path(sys.argv[2])
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    last = int(sys.argv[4]) if len(sys.argv) > 4 else (1000 if os.environ.get("ATRIA_TEST_FULL") else 8)
    failed = 0
    for seed in range(first, last + 1):
        triangles = (1_000, 3_000, 10_000, 30_000, 100_000)[seed % (5 if last - first >= 100 else 4)]
        faults, seconds = faults_of(atria, data, seed, triangles)
        failed += bool(faults)
        print(f"seed {seed}, {triangles} triangles: {seconds:.1f} s, {'; '.join(faults) or 'good'}", flush=True)
    print(f"{failed} of {last - first + 1} failed")
    if failed:
        return 1
    return 0 if shutil.which("checkMesh") else SKIPPED


if __name__ == "__main__":
    sys.exit(main())
