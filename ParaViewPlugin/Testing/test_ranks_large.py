# SPDX-License-Identifier: GPL-3.0-or-later
"""Four ranks have large meshes, and those of models that others wrote, bit for bit as one process does: made by the
first rank, and by all in blocks.

Usage: python3 test_ranks_large.py MPIEXEC PVBATCH DATA [NAME ...]; names are as in the table.

DATA is the folder of the example models; the others are looked for in ATRIA_CORPUS. Prints rows of a table: seconds of
the first rank, and the most memory of each. checkMesh has to be content with the processors that the ranks write.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

RANKS = 4
FOLDER = pathlib.Path(os.environ["ATRIA_OUTPUT"]) / "large"
SCRIPT = pathlib.Path(__file__).parent / "large_pipeline.py"
ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                            "WM_PROJECT_DIR": "/usr/share/openfoam"}
CORPUS = {
    "castle": "d01_castle_blender_v97.wrl",
    "house": "d11_deranged_house_blender.wrl",
    "car door": "d13_sketchup_car_door.wrl",
    "tank": "d14_labo1/tank.wrl",
    "district": "d23_rotterdam_lod2.wrl",
}


def made(data, script, name, *arguments):
    """A model that a script writes."""
    subprocess.run([sys.executable, data / script, FOLDER, *arguments], check=True, stdout=subprocess.DEVNULL)
    return FOLDER / name


def models(data):
    """Name, model and properties of the mesher, or octants along the model."""
    site = {"DomainMode": "Site", "SiteName": "Site"}
    yield "building", made(data, "make_building.py", "building.wrl"), {
        **site, "SizeMax": 8, "SizeMid": 2, "SizeMin": 1, "NumberOfLayers": 5}
    yield "building with openings", FOLDER / "building.wrl", {
        **site, "SizeMax": 8, "SizeMid": 2, "SizeMin": 1, "NumberOfLayers": 1, "FindOpenings": 1}
    yield "kilometer", made(data, "make_site.py", "site.wrl"), {
        **site, "SizeMax": 16, "SizeMid": 4, "SizeMin": 1, "NumberOfLayers": 1}
    for layers in (0, 1):
        yield f"sphere, {layers} layers", made(data, "make_sphere.py", "sphere_in_cube.wrl", "6"), {
            "DomainMode": "From Surfaces", "SizeMax": 0.05, "SizeMid": 0.05, "SizeMin": 0.05, "NumberOfLayers": layers}
    corpus = os.environ.get("ATRIA_CORPUS")
    for name, file in CORPUS.items() if corpus else ():
        yield name, pathlib.Path(corpus) / file, {"octants": 48, "ZoneRule": "All", "NumberOfLayers": 1}


def run(mpiexec, pvbatch, ranks, folder, model, properties, *rest):
    """What the ranks found, by rank, and the seconds of the first."""
    folder.mkdir(parents=True)
    command = [mpiexec, "--oversubscribe", "-n", str(ranks), pvbatch, str(SCRIPT), str(folder), str(model),
               json.dumps(properties), *rest]
    result = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    said = result.stdout + result.stderr
    assert result.returncode == 0 and not re.search(r"ERR\||Traceback", said), said
    found = [json.loads((folder / f"rank{rank}.json").read_text()) for rank in range(ranks)]
    return found, json.loads((folder / "time.json").read_text())


def whole(found):
    """Fingerprints of all ranks together."""
    sums = {}
    for piece in found:
        for key, value in {**piece, **{f"patch {name}": number for name, number in piece["patches"].items()}}.items():
            if key != "patches" and "megabytes" not in key:
                sums[key] = (sums.get(key, 0) + value) % 2**64
    return sums


def check_mesh(case):
    command = ["mpirun", "--oversubscribe", "-np", str(RANKS), "checkMesh", "-parallel"]
    said = subprocess.run(command, cwd=case, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    failed = re.findall(r"Failed \d+ mesh checks", said.stdout) or [said.stderr]
    return "Mesh OK" if "Mesh OK." in said.stdout else failed[0]


def row(name, ranks, found, seconds, verdict):
    megabytes = [f"{piece['megabytes']}" for piece in found]
    with_case = [f"{piece.get('megabytes with case', '–')}" for piece in found]
    shares = [piece.get("elements", 0) for piece in found]
    print("|", " | ".join([name, str(ranks), f"{sum(shares):,}", f"{max(shares):,}", f"{seconds['processor']:.1f}",
                            ", ".join(megabytes), ", ".join(with_case), verdict]), "|", flush=True)


def compare(mpiexec, pvbatch, name, model, properties):
    folder = FOLDER / re.sub(r"\W+", "_", name)
    alone, seconds = run(mpiexec, pvbatch, 1, folder / "1", model, properties)
    row(name, 1, alone, seconds, "–")
    together, seconds = run(mpiexec, pvbatch, RANKS, folder / str(RANKS), model, properties, "case")
    verdict = check_mesh(folder / str(RANKS) / "case.openfoam") if shutil.which("checkMesh") else "–"
    row(name, RANKS, together, seconds, verdict)
    shutil.rmtree(folder)
    differing = [key for key, value in whole(alone).items() if whole(together).get(key) != value]
    assert not differing and whole(alone).keys() == whole(together).keys(), (name, differing)
    assert verdict in ("–", "Mesh OK"), (name, verdict)


def main(mpiexec, pvbatch, data, *names):
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    for name, model, properties in models(pathlib.Path(data)):
        for block in (0, 1000 if "octants" in properties or name.startswith("building") else 20000):
            full_name = f"{name}, blocks of {block:,}" if block else name
            if not names or full_name in names:
                compare(mpiexec, pvbatch, full_name, model, properties | {"BlockSize": block})
    print("four ranks make what one process makes")


main(*sys.argv[1:])
