#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes one tuning constant of the core at a time by 20 % and tells what moves in twelve small meshes.

Constants are found and made tunable by tunable.py. The models are ours and five that others wrote (left out where
ATRIA_CORPUS names no folder). Meshes are made on one thread; times are seconds of the processor.

Usage: sensitivity.py WORK                    builds in the folder WORK, and measures all constants
       sensitivity.py WORK --only Layer       those whose file or name matches
       sensitivity.py WORK --minutes 30       stops in time
       sensitivity.py WORK --list             prints the constants alone
       sensitivity.py WORK --report FILE      writes the table of what was measured between the marks in FILE
Results stay in WORK/results.json: a later call goes on from there.
"""

import argparse
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys
import textwrap
import time

import numpy
from vtkmodules.util import numpy_support
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader

import tunable
from fingerprints import DATA, bounds_of, building

SIGNS = {"−": 1 / 1.2, "+": 1.2}
LONGEST = 60  # seconds for a mesh, which takes half of one
WORST = {"angle": ("NonOrthogonality", "max"), "mean": ("FaceNonOrthogonality", "mean"), "skewness": ("Skewness", "max"),
         "jacobian": ("ScaledJacobian", "min")}
MARK = "<!-- sensitivity.py -->\n"


def jobs(program, folder, corpus):
    """By name the model and the options of each mesh, each of some 0.3 s. They hold one and more layers, curved walls,
    openings, a leak, narrow gaps, sheets at all angles, and what is wrong with models that others made."""
    site = "--site Site --size-max 8 --size-mid 4 --size-min {} --layers {}".format
    box = "--domain {0} {1} {0} {1} {0} {1} --zone all --layers 1 --size-max {2} --size-mid {3} --size-min {3}".format
    out = {"sphere": (DATA / "sphere_in_cube.wrl", box(-2, 2, 0.8, 0.4).split()),
           "fan": (fan(folder), box(-8, 8, 3, 0.75).split()),
           "building 0": (building(folder, 0), site(4, 3).split()),
           "building 17": (building(folder, 17), site(2, 1).split()),
           "building 30": (building(folder, 30), site(4, 0).split()),
           "house": (DATA / "house.wrl", "--domain -6 30 -6 20 0 14 --zone all --openings --sealed-seed 3 3 3 "
                     "--layers 1 --size-min 1 --size-mid 1 --size-max 1".split()),
           "house 17": (DATA / "house_turned17.wrl", "--size-max 4 --size-mid 2 --size-min 1 --layers 1 "
                        "--align walls".split()),
           "district": (district(folder), "--site Site --size-max 32 --size-mid 8 --size-min 8 --layers 1 "
                        "--curvature-angle 20 --gap-cells 2".split())}
    for name, across in (("d01_castle_blender_v97.wrl", 10), ("d13_sketchup_car_door.wrl", 12), ("d14_labo1/rack2.wrl", 12),
                         ("d22_rotating_fan_room.wrl", 12)) if corpus else ():
        bounds, longest = bounds_of(program, corpus / name)
        size = longest / across
        out[re.sub(r"d\d+_|\.wrl", "", name)] = (corpus / name, [
            "--domain", *map(repr, bounds), "--zone", "all", "--layers", "1", "--size-min", repr(size), "--size-mid",
            repr(2 * size), "--size-max", repr(4 * size)])
    return out


def fan(folder):
    """Seven sheets at 20 degrees that meet in an axis that stands skew."""
    axis = numpy.array([0.3, 0.2, 0.93]) / numpy.linalg.norm([0.3, 0.2, 0.93])
    across = numpy.cross(axis, [0.0, 1.0, 0.0])
    across /= numpy.linalg.norm(across)
    text = ""
    for i in range(7):
        angle = numpy.radians(20.0 * i)
        way = numpy.cos(angle) * across + numpy.sin(angle) * numpy.cross(axis, across)
        corners = [up * axis + out * way for out, up in ((0, -4), (0, 4), (5, 4), (5, -4))]
        text += f"o Sheet{i}\n" + "".join("v {:.6f} {:.6f} {:.6f}\n".format(*corner) for corner in corners)
        text += "f -4 -3 -2 -1\n"
    (pathlib.Path(folder) / "fan.obj").write_text(text)
    return pathlib.Path(folder) / "fan.obj"


def district(folder):
    subprocess.run([sys.executable, DATA / "make_site.py", "--small", folder], check=True, stdout=subprocess.DEVNULL)
    return pathlib.Path(folder) / "site_small.wrl"


class Mesher:
    """Makes the meshes, with one constant changed, and compares them with those of the constants as they are."""

    def __init__(self, program, folder, corpus):
        self.program, self.folder = program, folder
        self.jobs = jobs(program, folder, corpus)
        self.areas = {name: self.model_areas(model) for name, (model, _) in self.jobs.items()}
        self.before = {}
        for name in self.jobs:
            self.before[name] = self.figures(name)
            if not self.before[name]:
                raise SystemExit(f"{name} is not meshed")
            self.before[name]["curves"] = curves_of(self.folder / "patches.vtpc", self.spacing(name))
            print(f"{name}: {self.before[name]['elements']} elements, {self.before[name]['seconds']:.2f} s", flush=True)

    def model_areas(self, model):
        run = subprocess.run([self.program, "inspect", model, "--json"], capture_output=True, text=True)
        return {surface["name"]: surface["area"] for surface in json.loads(run.stdout)["surfaces"]}

    def spacing(self, name):
        """How near curves are taken for the same: a fifth of the least size."""
        options = self.jobs[name][1]
        return float(options[options.index("--size-min") + 1]) / 5.0

    def figures(self, name, tune=""):
        """What one mesh is like; None where there is none."""
        model, options = self.jobs[name]
        report = self.folder / "report.json"
        report.unlink(missing_ok=True)
        begin = os.times().children_user
        try:
            subprocess.run([self.program, "mesh", model, "-o", self.folder / "mesh.vtu", "--patches",
                            self.folder / "patches.vtpc", "--threads", "1", "--report", report, *options],
                           capture_output=True, timeout=LONGEST, env={**os.environ, tunable.VARIABLE: tune})
            return {**figures_of(json.loads(report.read_text())), "seconds": os.times().children_user - begin}
        except (subprocess.TimeoutExpired, FileNotFoundError):
            return None

    def changed(self, name, key, factor):
        """Of a constant times a factor: what differs, nothing where all is the same, and the seconds more."""
        before, now = self.before[name], self.figures(name, f"{key}={factor}")
        if now is None:
            return {"differs": "not meshed", "seconds": 0.0}
        return {"differs": self.difference(name, before, now) if now["same"] != before["same"] else None,
                "seconds": now["seconds"] - before["seconds"]}

    def difference(self, name, before, now):
        out = {key: now[key] - before[key] for key in ("invalid", "missed", "coverage", *WORST)}
        out["elements"] = 100.0 * (now["elements"] / before["elements"] - 1.0)
        patches = before["patches"].keys() | now["patches"].keys()
        out["area"] = max((100.0 * (now["patches"].get(p, 0.0) - before["patches"].get(p, 0.0)) /
                           self.model_area(name, p) for p in patches), key=abs)
        kept = curves_of(self.folder / "patches.vtpc", self.spacing(name))
        out["curves"] = 100.0 * (len(before["curves"] & near(kept)) / max(1, len(before["curves"])) - 1.0)
        return out

    def model_area(self, name, patch):
        """Of the surface of a patch; of what is no surface, of the patch before."""
        return (self.areas[name].get(re.sub("_front$|_back$", "", patch)) or self.before[name]["patches"].get(patch) or
                float("inf"))


def figures_of(report):
    quality, walls = report["quality"], [rule for rule in report["layers"] if rule["layers"] > 0]
    area = sum(rule["area"] for rule in walls)
    return {"same": [report[key] for key in ("counts", "quality", "patches", "diagnostics", "layers", "leaks")],
            "elements": report["counts"]["elements"], "invalid": report["invalid_elements"],
            "missed": diagnostics_in(report), **{key: quality[metric][part] for key, (metric, part) in WORST.items()},
            "coverage": 100.0 * sum(r["area"] * r["covered_in_full"] for r in walls) / area if area else 100.0,
            "patches": {patch["name"]: patch["area"] for patch in report["patches"]}}


def diagnostics_in(report):
    """How much the mesher says that it could not follow."""
    return sum(len(kind) if isinstance(kind, list) else kind for kind in report["diagnostics"].values())


def curves_of(file, spacing):
    """Where the borders and creases of the patches are: boxes of a lattice, as a set."""
    reader = vtkXMLPartitionedDataSetCollectionReader()
    reader.SetFileName(str(file))
    reader.Update()
    patches = reader.GetOutputDataObject(0)
    boxes = set()
    for i in range(patches.GetNumberOfPartitionedDataSets()):
        edges = vtkFeatureEdges()
        edges.SetInputData(patches.GetPartition(i, 0))
        edges.ColoringOff()
        edges.Update()
        lines = edges.GetOutput()
        if lines.GetNumberOfCells():
            points = numpy_support.vtk_to_numpy(lines.GetPoints().GetData()).astype(float)
            ends = numpy_support.vtk_to_numpy(lines.GetLines().GetConnectivityArray()).reshape(-1, 2)
            boxes |= boxes_of(points[ends[:, 0]], points[ends[:, 1]], spacing)
    return boxes


def boxes_of(begins, ends, spacing):
    """Boxes with samples of lines."""
    count = int(numpy.ceil(numpy.linalg.norm(ends - begins, axis=1).max() / spacing)) + 1
    parts = numpy.linspace(0.0, 1.0, count)[:, None, None]
    samples = (begins + parts * (ends - begins)).reshape(-1, 3)
    return set(map(tuple, numpy.unique(numpy.floor(samples / spacing).astype(int), axis=0).tolist()))


def near(boxes):
    """These and those beside them."""
    steps = (-1, 0, 1)
    return {(x + i, y + j, z + k) for x, y, z in boxes for i in steps for j in steps for k in steps}


COLUMNS = (("angle", "worst angle, °", "{:+.1f}"),)  # the results have skewness, curves and seconds, too


def cell(values, none):
    """Of the smaller and the larger constant; `none` where neither changes anything."""
    return none if set(values) == {"0"} else "/".join(values)


def meshed(by_model):
    return [found["differs"] for found in by_model.values() if found["differs"] not in (None, "not meshed")]


def greatest(by_model, key, form):
    text = form.format(max((differs[key] for differs in meshed(by_model)), key=abs, default=0.0))
    return text if float(text) else "0"


def count(by_model):
    """How many meshes differ, and how many of them are not made."""
    differing = sum(bool(found["differs"]) for found in by_model.values())
    failed = differing - len(meshed(by_model))
    return f"{differing}" + (f" ({failed} not meshed)" if failed else "")


def entry(constant, changes):
    """Of each figure the greatest change in any model, of the smaller and the larger constant."""
    signs = [changes[sign] for sign in SIGNS]
    cells = [cell([greatest(by_model, key, form) for by_model in signs], "") for key, _, form in COLUMNS]
    return ", ".join(filter(None, (f"`{constant.name}` {cell([count(by_model) for by_model in signs], '0')}", *cells)))


def table(constants, results):
    """A line for each file. Constants that nothing notices come last, in a list by file."""
    noticed, silent, unmeasured = {}, {}, 0
    for constant in constants:
        changes = results["changes"].get(constant.key)
        if not changes:
            unmeasured += 1
        elif any(model["differs"] for by_model in changes.values() for model in by_model.values()):
            noticed.setdefault(constant.file, []).append(entry(constant, changes))
        else:
            silent.setdefault(constant.file, []).append(f"`{constant.name}`")
    lines = ["| file | constants: models, " + ", ".join(title for _, title, _ in COLUMNS) + " |", "|---|---|"]
    lines += [f"| `{file}` | " + "; ".join(found) + " |" for file, found in noticed.items()]
    names = [textwrap.fill(f"- `{file}`: " + ", ".join(found), 118, subsequent_indent="  ", break_long_words=False,
                           break_on_hyphens=False) for file, found in silent.items()]
    return "\n".join([*lines, "", f"Nothing in these meshes notices {sum(map(len, silent.values()))} constants "
                      f"({unmeasured} more are not measured):", "", *names, ""])


def write_report(file, text):
    parts = file.read_text().split(MARK)
    file.write_text(parts[0] + MARK + text + MARK + parts[2])


def load(file):
    return json.loads(file.read_text()) if file.exists() else {"jobs": {}, "changes": {}}


def forget_others(results, mesher):
    """What was measured with other models or options does not count."""
    now = {name: [str(part) for part in (model, *options)] for name, (model, options) in mesher.jobs.items()}
    kept = {name for name in now if results["jobs"].get(name) == now[name]}
    for changes in results["changes"].values():
        for sign, by_model in changes.items():
            changes[sign] = {name: found for name, found in by_model.items() if name in kept}
    results["jobs"] = now
    results["seconds"] = sum(figures["seconds"] for figures in mesher.before.values())


def measure(constants, mesher, results, file, minutes):
    end = time.monotonic() + 60.0 * minutes
    forget_others(results, mesher)
    for constant in constants:
        if time.monotonic() > end:
            return
        changes = results["changes"].setdefault(constant.key, {sign: {} for sign in SIGNS})
        for sign, name in itertools.product(SIGNS, mesher.jobs):
            if name not in changes[sign]:
                changes[sign][name] = mesher.changed(name, constant.key, SIGNS[sign])
        file.write_text(json.dumps(results, indent=1))
        moved = [sum(bool(found["differs"]) for found in by_model.values()) for by_model in changes.values()]
        print(f"{constant.key} = {constant.value:.60}: {moved[0]} and {moved[1]} models", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--minutes", type=float, default=float("inf"))
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--report", type=pathlib.Path)
    arguments = parser.parse_args()
    work = arguments.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    constants = [c for c in tunable.constants_of(work) if re.search(arguments.only, c.key)]
    results_file = work / "results.json"
    results = load(results_file)
    if arguments.list:
        print("\n".join(f"{c.key} = {c.value} ({c.vary})" for c in constants))
    elif arguments.report:
        write_report(arguments.report, table(constants, results))
    else:
        corpus = pathlib.Path(os.environ["ATRIA_CORPUS"]) if os.environ.get("ATRIA_CORPUS") else None
        measure(constants, Mesher(tunable.build(work), work, corpus), results, results_file, arguments.minutes)


if __name__ == "__main__":
    main()
