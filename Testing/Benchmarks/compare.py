#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs Atria, snappyHexMesh and gmsh on the same work, one after the other, and tables what they take.

Usage: compare.py BUILD [--report FILE.md] [--json FILE.json] [--threads 1 2] [--cases NAME ...] [--without PEER ...]
                  [--growth LARGEST] [--triangles LARGEST] [--runs N]

BUILD is the build's folder. Of N runs the one that took the least of the processor counts. Atria's runs end with the
mesh as VTK data; no mesher's run has its output in it but snappyHexMesh's, whose log tells the time until it is written.
--growth makes spheres of up to LARGEST elements, --triangles one mesh of models of up to LARGEST triangles.
Peers that are not installed are left out: apt-get install openfoam gmsh.
"""

import argparse
import dataclasses
import datetime
import json
import math
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time

import numpy

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = HERE.parents[1] / "Examples"
sys.path[:0] = [str(HERE), str(EXAMPLES / "Data"), str(EXAMPLES / "Study")]

import make_building  # noqa: E402
import make_sphere  # noqa: E402
import peers  # noqa: E402
import tables  # noqa: E402


@dataclasses.dataclass
class Case:
    name: str
    title: str
    model: str
    sizes: tuple  # largest, at surfaces, at features
    layers: int
    box: list
    inside: tuple
    levels: tuple  # snappyHexMesh's at surfaces and at features, and how many halvings of its grid give the finest size
    polygons: list
    target: float = 0.0  # times faster than snappyHexMesh on two threads; 0 where nothing is aimed for
    sphere: float = 0.0
    creases: bool = False
    near: list = None  # box at whose surface cells are as at the model's
    site: str = ""
    curved: tuple = ()  # degrees and skewness asked for at curved walls
    like: str = ""  # the case whose peers' runs count here as well
    walls: str = ".*"  # snappyHexMesh's patches that have layers
    bare: str = ""  # the case without a layer


def cases():
    cube = [(-5.0, 5.0)] * 3
    ball = make_sphere.sphere(2.0, 5)
    house = [polygon for polygons, _ in make_building.sheets().values() for polygon in polygons]
    x0, y0, x1, y1 = make_building.SITE
    site = [(x0, x1), (y0, y1), (0.0, 0.3 * max(x1 - x0, y1 - y0))]
    sphere = {"model": "sphere_in_cube.wrl", "box": cube, "inside": (3.01, 3.02, 3.03), "polygons": ball, "sphere": 2.0}
    building = {"model": "building.wrl", "sizes": (8.0, 2.0, 1.0), "box": site, "inside": (-50.0, 60.0, 40.0),
                "levels": (2, 3, 3), "polygons": house, "creases": True, "near": [*site[:2], (-1.0, 0.0)], "site": "Site"}
    return [
        Case("uniform", "Sphere, uniform 0.1 m, no layer", sizes=(0.1, 0.1, 0.1), layers=0, levels=(0, 0, 0),
             target=150.0, **sphere),
        Case("adaptive", "Sphere, adaptive 0.1 m, with a layer", sizes=(0.8, 0.1, 0.1), layers=1, levels=(3, 3, 3),
             target=60.0, near=cube, bare="plain", **sphere),
        Case("plain", "Sphere, adaptive 0.1 m, no layer", sizes=(0.8, 0.1, 0.1), layers=0, levels=(3, 3, 3),
             target=60.0, near=cube, **sphere),
        Case("loose", "Sphere, adaptive 0.1 m, with a layer of 30° and skewness 0.75", sizes=(0.8, 0.1, 0.1), layers=1,
             levels=(3, 3, 3), near=cube, curved=(30.0, 0.75), like="adaptive", **sphere),
        Case("building", "Building with sheets, 1, 2 and 8 m, with a layer", layers=1, target=25.0, walls="model",
             bare="bare", **building),
        Case("bare", "Building with sheets, 1, 2 and 8 m, no layer", layers=0, **building),
    ]


def measure(command, folder, environment=None, accepted=(0,)):
    """Seconds of the clock and of the processor, bytes of the largest process, and what was printed. RuntimeError where its
    exit status is not accepted."""
    log = folder / "log"
    with log.open("w") as out:
        start = time.monotonic()
        process = subprocess.Popen([str(c) for c in command], cwd=folder, stdout=out, stderr=subprocess.STDOUT,
                                   env=os.environ | (environment or {}))
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    text = log.read_text(errors="replace")
    if process.returncode not in accepted:
        raise RuntimeError(f"{command[0]} ended with {process.returncode}:\n{text[-2000:]}")
    return {"wall": wall, "processor": usage.ru_utime + usage.ru_stime, "bytes": 1024 * usage.ru_maxrss}, text


def length_of(bounds):
    return max(bounds[i + 1] - bounds[i] for i in (0, 2, 4))


def sizes_along(bounds, octants):
    """Away from surfaces, at them and at edges; of the last so many along a model."""
    size = length_of(bounds) / octants
    return 4 * size, 2 * size, size


def box_about(bounds, sizes):
    """A quarter of the model's length on all sides, in whole octants of the largest size."""
    margin = 0.25 * length_of(bounds)
    return [(sizes[0] * math.floor((bounds[i] - margin) / sizes[0]), sizes[0] * math.ceil((bounds[i + 1] + margin) / sizes[0]))
            for i in (0, 2, 4)]


def run_atria(program, model, case, threads, folder):
    command = [program, model, *case.sizes, case.layers, threads, case.site, *case.curved]
    result, text = measure(command, folder)
    told = json.loads(text)
    result["bytes"] = max(peak for _, peak in told["peaks"])  # asking for the peaks resets what the system knows
    return result | {"elements": told["elements"], "stages": told["stages"], "peaks": told["peaks"]}


def run_snappy(case, threads, folder):
    command = peers.snappy_case(folder, case, threads)
    before = {"wall": 0.0, "processor": 0.0}
    if threads == 1:  # with more, the decomposed base mesh was made before
        before, _ = measure(["blockMesh"], folder, peers.FOAM)
    result, text = measure(command, folder, peers.FOAM)
    finished = float(re.findall(r"Finished meshing in = ([\d.]+) s", text)[-1])
    written = max(0.0, result["wall"] - finished) * result["processor"] / result["wall"]
    result["processor"] += before["processor"] - written
    result["wall"] = finished + before["wall"]
    result["bytes"] *= threads
    result["elements"] = int(re.findall(r"cells:\s*(\d+)", text)[-1])
    if extruded := re.findall(r"Extruding (\d+) out of (\d+) faces", text):
        result["covered"] = int(extruded[-1][0]) / int(extruded[-1][1])
    return result


def run_gmsh(case, threads, folder):
    (folder / "work.geo").write_text(peers.gmsh_script(case, threads))
    result, text = measure(["gmsh", "work.geo", "-"], folder)
    found = re.findall(r"^elements (\d[\d.e+]*)", text, re.MULTILINE)
    if not found or float(found[-1]) == 0:
        raise RuntimeError("gmsh made no tetrahedra: " + " / ".join(re.findall(r"Error\s*: (.*)", text)[:3]))
    return result | {"elements": int(float(found[-1]))}


def best(run, runs):
    """In a folder of its own each time; None where it fails, with a note."""
    results = []
    for _ in range(runs):
        with tempfile.TemporaryDirectory() as name:
            try:
                results.append(run(pathlib.Path(name)))
            except (RuntimeError, subprocess.CalledProcessError) as failure:
                print(f"  failed: {failure}", file=sys.stderr)
                return None
    return min(results, key=lambda r: r["processor"])


def compare(arguments, benchmark):
    data = HERE.parents[1] / "Examples" / "Data"
    meshers = {
        "Atria": lambda case, threads, folder: run_atria(benchmark, data / case.model, case, threads, folder),
        "snappyHexMesh": run_snappy,
        "gmsh": run_gmsh,
    }
    have = {"Atria": True} | peers.available()
    results = {}
    for case in cases():
        if arguments.cases and case.name not in arguments.cases:
            continue
        for threads in arguments.threads:
            for mesher, run in meshers.items():
                if not have[mesher] or mesher in arguments.without:
                    continue
                known = results.get(case.like, {}).get(mesher)
                if known and mesher != "Atria":
                    results.setdefault(case.name, {})[mesher] = known
                    continue
                runs = arguments.runs if mesher == "Atria" else 1
                result = best(lambda folder, run=run: run(case, threads, folder), runs)
                print(f"{case.name} {mesher} {threads}: {tables.short(result)}", flush=True)
                results.setdefault(case.name, {}).setdefault(mesher, {})[str(threads)] = result
    return results


def growth_in_elements(benchmark, largest, data):
    series = {"uniform": [], "adaptive": []}
    for name in series:
        case = next(c for c in cases() if c.name == name)
        step = 0
        expected = 0.0
        while step < 12:
            size = 0.2 * 2 ** (-step / (2 if name == "uniform" else 1))
            if name == "uniform" and 966.0 / size**3 > largest or name == "adaptive" and expected > largest:
                break
            sizes = (size, size, size) if name == "uniform" else (8 * size, size, size)
            work = dataclasses.replace(case, sizes=sizes)
            result = best(lambda folder, work=work: run_atria(benchmark, data / work.model, work, 1, folder), 1)
            if not result:
                break
            print(f"growth {name} {size:.4f}: {tables.short(result)}", flush=True)
            series[name].append(result)
            expected = 4.2 * result["elements"]
            step += 1
    return series


def write_sphere(file, parts, radius=lambda directions: numpy.ones(directions.shape[:-1])):
    """A sphere of 20 * parts^2 triangles as binary STL, or a body of other radii by direction, without a list of Python's
    for each."""
    corners = numpy.array(make_sphere.sphere(1.0, 0))
    a, b, c = (corners[:, i][:, None, None, :] for i in range(3))
    i, j = (n[None, :, :, None] for n in numpy.mgrid[0 : parts + 1, 0 : parts + 1])
    grid = a * ((parts - i - j) / parts) + b * (i / parts) + c * (j / parts)
    grid /= numpy.linalg.norm(grid, axis=3)[..., None]
    grid = (grid * radius(grid)[..., None]).round(6)  # the same from both sides of an edge
    up = numpy.stack([grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, :-1, 1:]], axis=3)
    down = numpy.stack([grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:]], axis=3)
    place = numpy.add.outer(numpy.arange(parts), numpy.arange(parts))
    corners = numpy.concatenate([up[:, place < parts].reshape(-1, 3, 3), down[:, place < parts - 1].reshape(-1, 3, 3)])
    facets = numpy.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("zero", "<u2")])
    facets["corners"] = 2.0 * corners
    with file.open("wb") as out:
        out.write(b"sphere".ljust(80) + len(corners).to_bytes(4, "little"))
        facets.tofile(out)
    return len(corners)


def growth_in_triangles(benchmark, largest):
    series = []
    case = dataclasses.replace(cases()[0], layers=0)
    for parts in (8, 32, 128, 512, 710):
        if 20 * parts**2 > largest:
            break
        with tempfile.TemporaryDirectory() as name:
            file = pathlib.Path(name) / "sphere.stl"
            triangles = write_sphere(file, parts)
            result = best(lambda folder, file=file: run_atria(benchmark, file, case, 1, folder), 1)
        if result:
            print(f"growth triangles {triangles}: {tables.short(result)}", flush=True)
            series.append(result | {"triangles": triangles})
    return series


def octrees(program):
    """Octree and balance, ours and p4est's; nothing where that was not built."""
    if not program.exists():
        return []
    text = subprocess.run([program, "--benchmark_format=json"], check=True, capture_output=True, text=True).stdout
    return [{"name": b["name"], "seconds": 1e-3 * b["cpu_time"], "leaves": int(b["leaves"])}
            for b in json.loads(text)["benchmarks"]]


def after_meshing(program, names):
    """Seconds of the quality filter and of the writers by case and threads; nothing where benchmark_stages was not built."""
    if not program.exists():
        return {}
    command = [program, "--benchmark_format=json", f"--benchmark_filter=^(quality|write_.*)/({'|'.join(names)})/"]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    found = {}
    for b in json.loads(text)["benchmarks"]:
        stage, case, threads = b["name"].split("/")[:3]
        found.setdefault(case, {}).setdefault(threads.removeprefix("threads:"), {})[stage] = 1e-3 * b["real_time"]
    return found


def machine():
    cpu = platform.processor() or "unknown"
    info = pathlib.Path("/proc/cpuinfo")
    if info.exists():
        cpu = re.findall(r"model name\s*: (.*)", info.read_text())[0]
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return {"processor": cpu, "cores": os.cpu_count(), "memory": memory, "system": platform.platform(),
            "date": datetime.date.today().isoformat(), "load": os.getloadavg()[0]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--report", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--from-json", type=pathlib.Path, help="write the report of an earlier run, and run nothing")
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--cases", nargs="+", choices=[case.name for case in cases()])
    parser.add_argument("--without", nargs="+", default=[], choices=["snappyHexMesh", "gmsh"])
    parser.add_argument("--growth", type=float, default=0.0, metavar="LARGEST")
    parser.add_argument("--triangles", type=float, default=0.0, metavar="LARGEST")
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    if arguments.from_json:
        results = json.loads(arguments.from_json.read_text())
    else:
        benchmark = arguments.build.resolve() / "bin" / "benchmark_mesh"
        results = {"machine": machine(), "meshers": compare(arguments, benchmark)}
        results["after"] = after_meshing(benchmark.with_name("benchmark_stages"), list(results["meshers"]))
        results["octrees"] = octrees(benchmark.with_name("benchmark_p4est"))
        if arguments.growth > 0:
            data = HERE.parents[1] / "Examples" / "Data"
            results["elements"] = growth_in_elements(benchmark, arguments.growth, data)
        if arguments.triangles > 0:
            results["triangles"] = growth_in_triangles(benchmark, arguments.triangles)
    if arguments.json:
        arguments.json.write_text(json.dumps(results, indent=1) + "\n")
    text = tables.report(results, cases())
    print(text)
    if arguments.report:
        arguments.report.write_text(text)


if __name__ == "__main__":
    main()
