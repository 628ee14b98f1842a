#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints a fingerprint of each of a fixed list of meshes, to see whether a change of the code changes any bit of them.

The meshes are the sphere, the building at four angles with no, one and five layers, and ten models that others wrote
(left out where ATRIA_CORPUS names no folder). A fingerprint is of points, elements, patches and diagnostics. Each is made
on one and on three threads, which must agree.

Usage: fingerprints.py BUILD                   prints the list
       fingerprints.py BUILD --against FILE    compares with a list printed before; exit status 1 if one differs
"""

import argparse
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import vtkmodules.util.numpy_support as numpy_support
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader, vtkXMLUnstructuredGridReader

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "Examples" / "Data"
ANGLES = (0, 17, 30, 45)
LAYERS = (0, 1, 5)
OTHERS = (
    "d01_castle_blender_v97.wrl",
    "d07_extrusion_concave_cap.wrl",
    "d09_nonplanar_quads_sci.wrl.gz",
    "d11_deranged_house_blender.wrl",
    "d13_sketchup_car_door.wrl",
    "d14_labo1/rack2.wrl",
    "d14_labo1/tank.wrl",
    "d15_pa10_inline/pa10.main.wrl",
    "d22_rotating_fan_room.wrl",
    "d23_rotterdam_lod2.wrl",
)


def building(folder, angle):
    subprocess.run([sys.executable, DATA / "make_building.py", folder, str(angle)], check=True, stdout=subprocess.DEVNULL)
    return next(pathlib.Path(folder).glob("building_turned*.wrl" if angle else "building.wrl"))


def bounds_of(program, model):
    """The box about a model, a quarter of its longest side larger on all sides, and that side."""
    run = subprocess.run([program, "inspect", model, "--json"], capture_output=True, text=True)
    all_bounds = [surface["bounds"] for surface in json.loads(run.stdout)["surfaces"] if surface["triangles"]]
    b = [(max if i % 2 else min)(bounds[i] for bounds in all_bounds) for i in range(6)]
    longest = max(b[1] - b[0], b[3] - b[2], b[5] - b[4])
    return [b[i] + (0.25 if i % 2 else -0.25) * longest for i in range(6)], longest


def jobs(program, folder, corpus):
    """Name, model and options of each mesh."""
    sizes = ["--size-max", "0.8", "--size-mid", "0.2", "--size-min", "0.2"]
    yield "sphere 1", DATA / "sphere_in_cube.wrl", sizes + ["--domain", *"-2 2 -2 2 -2 2".split(), "--zone", "all"]
    for angle in ANGLES:
        model = building(tempfile.mkdtemp(dir=folder), angle)
        for layers in LAYERS:
            yield (f"building {angle} {layers}", model,
                   ["--site", "Site", "--size-max", "8", "--size-mid", "2", "--size-min", "1", "--layers", str(layers)])
    for name in OTHERS if corpus else ():
        bounds, longest = bounds_of(program, corpus / name)
        size = longest / 24
        yield (name, corpus / name,
               ["--domain", *(repr(b) for b in bounds), "--zone", "all", "--layers", "1", "--size-min", repr(size),
                "--size-mid", repr(2 * size), "--size-max", repr(4 * size)])


def add(digest, data):
    for array in (data.GetPoints().GetData(), *arrays_of(data)):
        if array is not None:
            digest.update(numpy_support.vtk_to_numpy(array).tobytes())


def arrays_of(data):
    if data.IsA("vtkUnstructuredGrid"):
        cells = data.GetCells()
        return (cells.GetConnectivityArray(), cells.GetOffsetsArray(), data.GetCellTypesArray(), data.GetFaces())
    polys = data.GetPolys()
    return (polys.GetConnectivityArray(), polys.GetOffsetsArray())


def fingerprint(mesh_file, patches_file):
    digest = hashlib.sha256()
    mesh_reader = vtkXMLUnstructuredGridReader()
    mesh_reader.SetFileName(str(mesh_file))
    mesh_reader.Update()
    add(digest, mesh_reader.GetOutput())
    patches_reader = vtkXMLPartitionedDataSetCollectionReader()
    patches_reader.SetFileName(str(patches_file))
    patches_reader.Update()
    patches = patches_reader.GetOutputDataObject(0)
    for i in range(patches.GetNumberOfPartitionedDataSets()):
        digest.update(patches.GetMetaData(i).Get(patches.NAME()).encode())
        add(digest, patches.GetPartition(i, 0))
    return mesh_reader.GetOutput().GetNumberOfCells(), digest.hexdigest()[:16]


def mesh(program, model, options, threads, folder):
    mesh_file, patches_file = pathlib.Path(folder) / "m.vtu", pathlib.Path(folder) / "p.vtpc"
    run = subprocess.run([program, "mesh", model, "-o", mesh_file, "--patches", patches_file, "--threads", str(threads),
                          *options], capture_output=True, text=True)
    if run.returncode not in (0, 4):
        return f"status {run.returncode}"
    return "{} {}".format(*fingerprint(mesh_file, patches_file))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--against", type=pathlib.Path)
    parser.add_argument("--threads", default="1,3")
    arguments = parser.parse_args()
    program = arguments.build / "bin" / "atria"
    corpus = pathlib.Path(os.environ["ATRIA_CORPUS"]) if os.environ.get("ATRIA_CORPUS") else None
    before = dict(line.rsplit(": ", 1) for line in arguments.against.read_text().splitlines()) if arguments.against else {}
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for name, model, options in jobs(program, folder, corpus):
            found = {mesh(program, model, options, threads, folder) for threads in arguments.threads.split(",")}
            text = " / ".join(sorted(found))
            differs = len(found) > 1 or before.get(name, text) != text
            failed |= differs
            print(f"{name}: {text}" + (f"  DIFFERS from {before.get(name)}" if differs else ""), flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
