#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes models as people draw them by Atria and by snappyHexMesh, whole commands on one thread, with the same sizes, and
tables what both take and get: houses full of detail, buildings at four angles, a body of two million triangles, and models
that others wrote (left out where ATRIA_CORPUS names no folder).

Usage: real_models.py ATRIA RESULTS.json                  measures what is not in the results yet
       real_models.py ATRIA RESULTS.json --models NAME    of those whose names hold it
       real_models.py ATRIA RESULTS.json --again          measures Atria again, and keeps what is known of snappyHexMesh
       real_models.py ATRIA RESULTS.json --report FILE    also writes the table

PYTHONPATH must hold the package `atria` of the same build, which reads models for snappyHexMesh.
"""

import argparse
import collections
import dataclasses
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkIOGeometry import vtkSTLWriter

from compare import box_about, machine, measure, sizes_along, write_sphere
from fingerprints import DATA, building
from peers import FOAM, SIDES, checked
from snappy_dictionaries import begin, block_mesh, controls, words, write, write_feature_extraction
from tables import heading, row

import atria

LONGEST = 900  # seconds that a mesher may take
ASKED = 25  # times snappyHexMesh
SLOWEST = ("crossings", "layers")
ACROSS = 60  # octants of the smallest size along a model
OTHERS = ("d01_castle_blender_v97.wrl", "d09_nonplanar_quads_sci.wrl.gz", "d10_forest_v1_crlf.wrl", "d13_sketchup_car_door.wrl",
          "d14_labo1/pipes.wrl", "d14_labo1/rack1.wrl", "d14_labo1/tank.wrl", "d19_single_line_arrays.wrl",
          "d22_rotating_fan_room.wrl", "d23_rotterdam_lod2.wrl")
SNAPPY = """
castellatedMesh true; snap true; addLayers {layered};
geometry {{ model.stl {{ type triSurfaceMesh; name model; }} }}
castellatedMeshControls
{{
  maxLocalCells 200000000; maxGlobalCells 200000000; minRefinementCells 0; maxLoadUnbalance 0.1;
  nCellsBetweenLevels 1; features ({{ file "model.eMesh"; level {fine}; }});
  refinementSurfaces {{ model {{ level ({surface} {fine}); }} }}
  resolveFeatureAngle 30; refinementRegions {{ }} locationInMesh ({inside}); allowFreeStandingZoneFaces false;
}}
"""


@dataclasses.dataclass
class Work:
    name: str
    make: object  # writes the model into a folder and returns its path
    layers: int = 1
    sizes: tuple = ()  # largest, at surfaces, at edges; by the model's length where not given
    options: tuple = ()


def organic(folder):
    """A body with bumps, as a scan has."""
    def bumps(points):
        return 1.0 + 0.12 * numpy.sin(4.0 * points).prod(axis=-1) + 0.03 * numpy.sin(17.0 * points).prod(axis=-1)

    write_sphere(folder / "organic.stl", 316, bumps)
    return folder / "organic.stl"


def house(triangles, *kinds):
    def make(folder):
        only = ["--only", *kinds] if kinds else []
        subprocess.run([sys.executable, DATA / "make_detailed_house.py", folder / "house.wrl", "--triangles", str(triangles),
                        "--seed", "3", *only], check=True, stdout=subprocess.DEVNULL)
        return folder / "house.wrl"

    return make


def works(corpus):
    for angle in (0, 17, 30, 45):
        for layers in (0, 1, 5):
            yield Work(f"building of sheets, {angle}°, {layers} layers", lambda folder, angle=angle: building(folder, angle),
                       layers, (8.0, 2.0, 1.0), ("--without", "Site"))
    for triangles in (1_000, 10_000, 100_000):
        yield Work(f"furnished house, {triangles:,} triangles", house(triangles))
    yield Work("furnished house, 10,000 triangles, 5 layers", house(10_000), 5)
    for kind in ("foliage", "railing", "pipes"):
        yield Work(f"house with {kind}, 10,000 triangles", house(10_000, kind))
    yield Work("organic body, 2 million triangles", organic)
    for name in OTHERS if corpus else ():
        yield Work(name.split("/")[-1].split(".")[0], lambda _, name=name: corpus / name)


def surface_of(model, without):
    """All triangles of a model."""
    surfaces = atria.vtkAtriaModelReader() if atria.vtkAtriaModelReader.CanReadFile(str(model)) else atria.vtkAtriaVRMLReader()
    surfaces.SetFileName(str(model))
    for pattern in without:
        surfaces.AddExcludedSurface(pattern)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(surfaces.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def run_atria(program, model, work, sizes, box, folder):
    options = [*work.options, "--domain", *(repr(bound) for pair in box for bound in pair), "--layers", work.layers,
               "--size-max", sizes[0], "--size-mid", sizes[1], "--size-min", sizes[2]]
    command = [program, "mesh", model, "--openfoam", "case", "--report", "report.json", "--threads", 1, *options]
    result, _ = measure(["timeout", LONGEST, *command], folder, accepted=(0, 4, 5))
    report = json.loads((folder / "report.json").read_text())
    walls = sum(layer["area"] for layer in report["layers"])
    covered = sum(layer["area"] * layer["covered_in_full"] for layer in report["layers"]) / walls if walls else 0.0
    return result | {"elements": report["counts"]["elements"], "covered": covered,
                     "seconds": report["seconds"], "failed": checked(folder / "case")}


def run_snappy(surface, work, sizes, box, folder):
    begin(folder)
    writer = vtkSTLWriter()
    writer.SetFileName(str(folder / "constant" / "triSurface" / "model.stl"))
    writer.SetFileTypeToBinary()
    writer.SetInputData(surface)
    writer.Write()
    write(folder, "blockMeshDict", block_mesh(box, [round((high - low) / sizes[0]) for low, high in box], SIDES))
    write_feature_extraction(folder, ["model"])
    levels = [round(math.log2(sizes[0] / size)) for size in sizes[1:]]
    inside = [high - (0.31 + 0.01 * i) * sizes[2] for i, (_, high) in enumerate(box)]
    write(folder, "snappyHexMeshDict", SNAPPY.format(layered="true" if work.layers else "false", surface=levels[0],
                                                     fine=levels[1], inside=words(inside))
          + controls(True, "model.*", work.layers))
    total = {"wall": 0.0, "processor": 0.0, "bytes": 0}
    for command in (["surfaceFeatureExtract"], ["blockMesh"], ["snappyHexMesh", "-overwrite"]):
        one, text = measure(["timeout", LONGEST, *command], folder, FOAM)
        total = {"wall": total["wall"] + one["wall"], "processor": total["processor"] + one["processor"],
                 "bytes": max(total["bytes"], one["bytes"])}
    grown = re.findall(r"^model\S* +\d+ +([\d.]+) +[\d.e+-]+ +[\d.]+ *$", text, re.MULTILINE)
    covered = float(grown[-1]) / work.layers if grown and work.layers else 0.0
    return total | {"elements": int(re.findall(r"cells:\s*(\d+)", text)[-1]), "covered": covered, "failed": checked(folder)}


def attempt(run):
    with tempfile.TemporaryDirectory() as folder:
        try:
            return run(pathlib.Path(folder))
        except RuntimeError as failure:
            text = str(failure)
            return {"refused": f"more than {LONGEST} s" if "ended with 124" in text else text.strip().splitlines()[-1][:120]}


def compared(program, work, known):
    """What is known already stays."""
    with tempfile.TemporaryDirectory() as folder:
        model = work.make(pathlib.Path(folder))
        surface = surface_of(model, work.options[1:])
        bounds = surface.GetBounds()
        sizes = work.sizes or sizes_along(bounds, ACROSS)
        box = box_about(bounds, sizes)
        meshers = {"Atria": lambda place: run_atria(program, model, work, sizes, box, place),
                   "snappyHexMesh": lambda place: run_snappy(surface, work, sizes, box, place)}
        return {"triangles": surface.GetNumberOfCells(), "layers": work.layers} | {
            mesher: known.get(mesher) or attempt(run) for mesher, run in meshers.items()}


def rate(result):
    """Elements a second of the processor; nothing of a mesh that there is not."""
    return result["elements"] / result["processor"] if "elements" in result else 0.0


def bound_of(result, peer):
    """How many times the peer's elements a second there would be if the stages that take longest took no time."""
    rest = result["processor"] - sum(result["seconds"].get(stage, 0.0) for stage in SLOWEST)
    return result["elements"] / rest / rate(peer)


FAILURES = {"small determinant": "small determinants", "Concave": "concave cells", "interpolation weight": "small weights",
            "Max skewness": "skewness"}


def failures(results):
    """How many meshes fail each check, the most frequent first."""
    found = collections.Counter(next((name for text, name in FAILURES.items() if text in check), check)
                                for result in results for check in result.get("failed", []))
    return ", ".join(f"{name} in {count}" for name, count in found.most_common()) or "none"


def cells_of(result, layers):
    """Elements, seconds, coverage in percent."""
    if "refused" in result:
        return [result["refused"], "", ""]
    return [f"{result['elements']:,}", f"{result['processor']:.1f}", f"{100 * result['covered']:.0f}" if layers else ""]


def report(results):
    m = results["machine"]
    found = results["models"]
    ratios = {name: rate(r["Atria"]) / rate(r["snappyHexMesh"]) for name, r in found.items()
              if rate(r["Atria"]) and rate(r["snappyHexMesh"])}
    bounds = {name: bound_of(found[name]["Atria"], found[name]["snappyHexMesh"]) for name in ratios}
    rates = sorted((rate(r["Atria"]), name) for name, r in found.items())
    mean = math.exp(sum(math.log(value) for value, _ in rates if value) / len(rates))
    lines = [
        "# Benchmarks", "",
        "Models as people draw them, written by `Testing/Benchmarks/real_models.py`;",
        "[smooth and aligned ones](benchmarks-smooth.md) are apart. Runs are whole commands on one thread, from the file of the model to",
        "the mesh as files of OpenFOAM, against snappyHexMesh from STL on with the same sizes, domain and thickness of layers.",
        f"{m['processor']}, {m['cores']} cores, {m['date']}.", "",
        f"- Sizes: the model's length / {ACROSS} at edges, twice that at surfaces, four times away from them; of buildings 1, 2 and 8 m.",
        "- Atria/snappyHexMesh: elements, seconds of the processor, and layers, the part of the walls' area with all of them, % (of",
        "  snappyHexMesh the mean number over the requested one).",
        "- Times: elements a second of the processor over snappyHexMesh's.",
        *(f"- Checks of `checkMesh -allGeometry -allTopology` that {mesher} fails: {failures(r[mesher] for r in found.values())}."
          for mesher in ("Atria", "snappyHexMesh")), "",
        *heading("headline", "got")]
    for name, ratio in sorted(ratios.items(), key=lambda item: item[1])[:1]:
        lines.append(row("Elements a second of the processor over snappyHexMesh's, the worst of all models", f"{ratio:.1f} times, {name}"))
    refused = [name for name, r in found.items() if "refused" in r["snappyHexMesh"]]
    lines += [row("The same, median", f"{sorted(ratios.values())[len(ratios) // 2]:.1f} times"),
              row(f"Models with {ASKED} times as many or more", f"{sum(ratio >= ASKED for ratio in ratios.values())} of {len(ratios)}"),
              row(f"The same, if {' and '.join(SLOWEST)} took no time", f"{sum(bound >= ASKED for bound in bounds.values())} of {len(bounds)}"),
              row("Elements a second of the processor, the least", f"{rates[0][0]:,.0f}, {rates[0][1]}"),
              row("The same, geometric mean", f"{mean:,.0f}"),
              row("Models of which all checks pass", *[" / ".join(
                  f"{mesher} {sum(r[mesher].get('failed') == [] for r in found.values())}" for mesher in ("Atria", "snappyHexMesh"))
                  + f" of {len(found)}"])]
    if refused:
        lines.append(row("Models that snappyHexMesh did not mesh", ", ".join(refused)))
    lines += ["", *heading("model", "triangles", "elements", "s", "layers, %", "times")]
    for name, result in sorted(found.items(), key=lambda item: ratios.get(item[0], math.inf)):
        own, peers = (cells_of(result[mesher], result["layers"]) for mesher in ("Atria", "snappyHexMesh"))
        both = ["/".join(filter(None, pair)) for pair in zip(own, peers)]
        lines.append(row(name, f"{result['triangles']:,}", *both, f"{ratios[name]:.1f}" if name in ratios else ""))
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--models", nargs="+", default=[])
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--report", type=pathlib.Path)
    arguments = parser.parse_args()
    vtkObject.GlobalWarningDisplayOff()  # of what is wrong with a model, which Atria tells as it meshes
    corpus = pathlib.Path(os.environ["ATRIA_CORPUS"]) if os.environ.get("ATRIA_CORPUS") else None
    results = json.loads(arguments.results.read_text()) if arguments.results.exists() else {"models": {}}
    results["machine"] = machine()
    for work in works(corpus):
        known = results["models"].get(work.name, {})
        if arguments.again:
            known.pop("Atria", None)
        if "Atria" in known or arguments.models and not any(part in work.name for part in arguments.models):
            continue
        found = results["models"][work.name] = compared(arguments.program.resolve(), work, known)
        arguments.results.write_text(json.dumps(results, indent=1) + "\n")
        print(work.name, *(f"{mesher}: {' '.join(cells_of(found[mesher], work.layers))}" for mesher in ("Atria", "snappyHexMesh")),
              sep="\n  ", flush=True)
    if arguments.report:
        arguments.report.write_text(report(results))


if __name__ == "__main__":
    main()
