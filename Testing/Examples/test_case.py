# SPDX-License-Identifier: GPL-3.0-or-later
"""atria case: what it writes, that OpenFOAM runs it, and what it refuses.

Usage: test_case.py ATRIA FOLDER_OF_MODELS
"""

import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import unittest

from box_mesh import BOX, BoxCase, write_box

ATRIA = pathlib.Path(sys.argv[1])
DATA = pathlib.Path(sys.argv[2])
COARSE = ["--size-max", "16", "--size-mid", "4", "--size-min", "2", "--site", "Site"]
HAVE_OPENFOAM = shutil.which("simpleFoam") is not None
KAPPA, CMU = 0.41, 0.09


def entry(text, patch, key):
    """An entry of a patch in a field's file; of the pattern for all where the patch has none."""
    for name in (patch, '".*"'):
        block = re.search(r"^    " + re.escape(name) + r"\n    \{\n(.*?)^    \}", text, re.DOTALL | re.MULTILINE)
        if block:
            found = re.search(rf"^\s*{key}\s+(.*);$", block[1], re.MULTILINE)
            return found[1] if found else None
    return None


def field_list(file, patch=None):
    """Numbers of a binary field: of its inside, or of a patch. A uniform one has a single row."""
    data = file.read_bytes()
    at = 0 if patch is None else data.index(f"\n    {patch}\n".encode(), data.index(b"boundaryField"))
    width = 3 if b"volVectorField" in data else 1
    key = b"internalField" if patch is None else b" value "
    found = re.compile(key + rb"\s+(nonuniform List<\w+>\s*(\d+)\s*\(|uniform ([^;]*);)").search(data, at)
    if found[3]:
        return [tuple(float(x) for x in found[3].strip(b"() ").split())]
    numbers = struct.unpack_from(f"<{int(found[2]) * width}d", data, found.end())
    return [numbers[i : i + width] for i in range(0, len(numbers), width)]


class Case(BoxCase):
    def atria(self, *arguments):
        return subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)

    def case(self, mesh, name, *arguments):
        folder = self.folder / name
        run = self.atria("case", mesh, "-o", folder, *arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""), arguments)
        return folder

    def refuses(self, status, text, *arguments):
        run = self.atria("case", *arguments)
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertIn(text, run.stderr)

    def run_case(self, folder):
        run = subprocess.run([folder / "Allrun"], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def described(self, folder):
        return json.loads((folder / "case.json").read_text())

    def test_sides_follow_from_the_wind(self):
        wanted = {
            0: ("inlet", "outlet", "slip", "slip"), 180: ("outlet", "inlet", "slip", "slip"),
            90: ("slip", "slip", "inlet", "outlet"), 45: ("inlet", "outlet", "inlet", "outlet"),
            0.5: ("inlet", "outlet", "slip", "slip"), -20: ("inlet", "outlet", "outlet", "inlet"),
        }
        for angle, roles in wanted.items():
            folder = self.case(self.box, f"wind{angle}", "--wind", angle)
            direction = self.described(folder)["directions"][0]
            self.assertEqual(tuple(direction["patches"][side] for side in ("xMin", "xMax", "yMin", "yMax")), roles)
            self.assertEqual((direction["patches"]["zMin"], direction["patches"]["zMax"]), ("ground", "slip"))
            flow = [float(x) for x in entry((folder / "0/U").read_text(), "xMin" if roles[0] == "inlet" else
                                            "xMax" if roles[1] == "inlet" else "yMin", "flowDir").strip("()").split()]
            self.assertAlmostEqual(math.degrees(math.atan2(flow[1], flow[0])), math.remainder(angle, 360), places=9)
            boundary = (folder / "constant/polyMesh/boundary").read_text()
            self.assertIn("// a comment", boundary)
            self.assertEqual(re.findall(r"(\w+) \{ type (\w+);", boundary)[4], ("zMin", "wall"))

    def test_a_turned_domain_has_wind_along_it(self):
        angle = math.radians(30)
        turn = lambda p: (p[0] * math.cos(angle) - p[1] * math.sin(angle), p[0] * math.sin(angle) + p[1] * math.cos(angle), p[2])
        write_box(self.folder / "turned", (4, 4, 4), BOX, turned=turn)
        direction = self.described(self.case(self.folder / "turned", "turned_case"))["directions"][0]
        self.assertAlmostEqual(direction["towards"], 30.0, places=9)
        self.assertAlmostEqual(direction["from"], 240.0, places=9)
        self.assertEqual([direction["patches"][s] for s in ("xMin", "xMax", "yMin")], ["inlet", "outlet", "slip"])

    def test_rules_by_name(self):
        folder = self.case(self.box, "rules", "--patch", "y*", "wall", "--patch", "yMax", "rough:0.02", "--condition",
                           "yMin", "U", "type fixedValue; value uniform (0 1 0);")
        velocity, viscosity = (folder / "0/U").read_text(), (folder / "0/nut").read_text()
        self.assertEqual(entry(velocity, "yMin", "type"), "fixedValue; value uniform (0 1 0)")
        self.assertEqual(entry(viscosity, "yMin", "type"), "nutkWallFunction")
        self.assertEqual(entry(viscosity, "yMax", "type"), "nutkRoughWallFunction")
        self.assertEqual(entry(viscosity, "yMax", "Ks"), "uniform 0.02")
        self.refuses(3, "did you mean", self.box, "-o", self.folder / "no", "--patch", "xMn", "slip")
        self.refuses(3, "inletOutlet", self.box, "-o", self.folder / "no", "--patch", "xMin", "hole")
        self.refuses(3, "no field 'T'", self.box, "-o", self.folder / "no", "--condition", "xMin", "T", "type slip;")
        self.refuses(3, "PATTERN FIELD ENTRIES", self.box, "-o", self.folder / "no", "--condition", "xMin", "U", "slip")
        self.refuses(3, "no patch lets air out", self.box, "-o", self.folder / "no", "--patch", "*", "inlet")

    def test_what_is_refused(self):
        out = self.folder / "refused"
        self.refuses(2, "MESH is required", "-o", out)
        self.refuses(2, "--output is required", self.box)
        self.refuses(3, "no folder constant/polyMesh", self.folder, "-o", out)
        self.refuses(3, "does not exist", self.folder / "absent.vtu", "-o", out)
        self.refuses(2, "--rose", self.box, "-o", out, "--rose", "4", "--wind", "30")
        self.refuses(2, "--speed", self.box, "-o", out, "--speed", "0")
        self.refuses(2, "realizable", self.box, "-o", out, "--turbulence", "realisable")
        self.refuses(3, "given twice", self.box, "-o", out, "--from", "0", "--from", "360")
        for name, text, where in (("faces", "4(0 1 2 900000)", "faces"), ("owner", "3\n(\n0\n1\n", "owner"),
                                  ("boundary", "1\n(\nxMin { type patch; nFaces x; startFace 0; }\n)\n", "'xMin' has no number"),
                                  ("points", "nonsense", "points:2")):
            broken = self.folder / f"broken_{name}"
            shutil.copytree(self.box, broken)
            file = broken / "constant/polyMesh" / name
            head = file.read_text().splitlines()[0]
            file.write_text(head + "\n" + ("1\n(\n" + text + "\n)\n" if name == "faces" else text))
            self.refuses(3, where, broken, "-o", out)

    def test_results_are_kept(self):
        folder = self.case(self.box, "kept")
        (folder / "log.simpleFoam").write_text("results\n")
        self.refuses(3, "log.simpleFoam", self.box, "-o", folder)
        self.assertTrue((folder / "log.simpleFoam").exists())
        subprocess.run([folder / "Allclean"], check=True)
        self.case(self.box, "kept")
        (folder / "0.5").mkdir()  # of a run without Allrun
        self.refuses(3, "holds results of a run (0.5)", self.box, "-o", folder)
        subprocess.run([folder / "Allclean"], check=True)
        self.case(self.box, "kept")

    def test_config(self):
        config = self.folder / "case.toml"
        run = self.atria("case", "--write-config", config, "--speed", "3", "--patch", "yMin", "wall", "--patch", "yMax", "wall")
        self.assertEqual(run.returncode, 0, run.stderr)
        text = config.read_text()
        self.assertIn("[case]\n", text)
        self.assertIn("speed = 3\n", text)
        folder = self.case(self.box, "config", "--config", config)
        self.assertEqual(self.described(folder)["reference_speed"], 3.0)
        self.assertEqual(self.described(folder)["directions"][0]["patches"]["yMax"], "wall")

    def test_a_rose_shares_the_mesh(self):
        folder = self.case(self.box, "rose", "--rose", "4", "--north", "10", "--iterations", "5")
        report = self.described(folder)
        self.assertEqual([d["from"] for d in report["directions"]], [0.0, 90.0, 180.0, 270.0])
        self.assertEqual([d["towards"] for d in report["directions"]], [280.0, 190.0, 100.0, 10.0])
        for direction in report["directions"]:
            mesh = folder / direction["folder"] / "constant/polyMesh"
            self.assertTrue(mesh.is_symlink())
            self.assertFalse(os.path.isabs(os.readlink(mesh)))
            self.assertTrue(mesh.resolve().samefile(folder / "constant/polyMesh"))
        self.assertEqual(report["directions"][1]["folder"], "wind_090")
        if HAVE_OPENFOAM:
            self.run_case(folder)
            for direction in report["directions"]:
                self.assertIn("\nTime = 5\n", (folder / direction["folder"] / "log.simpleFoam").read_text())

    def test_schemes_hold_for_the_mesh(self):
        for shear, correction, correctors in ((0.0, "corrected", "0"), (2.0, "limited corrected 0.5", "1"),
                                              (3.5, "limited corrected 0.333", "2")):
            write_box(self.folder / f"sheared{shear}", (6, 6, 6), ((0, 6), (0, 6), (0, 6)),
                      turned=lambda p, shear=shear: (p[0] + shear * p[2], p[1], p[2]))
            folder = self.case(self.folder / f"sheared{shear}", f"sheared{shear}_case", "--wind", "90")
            self.assertIn(f"Gauss linear {correction};", (folder / "system/fvSchemes").read_text())
            self.assertRegex((folder / "system/fvSolution").read_text(),
                             rf"consistent +yes;\n +nNonOrthogonalCorrectors {correctors};")

    def test_turbulence_is_corrected_less(self):
        """Its scheme is found by OpenFOAM, which would take the default for a name that it does not know."""
        for model, field in (("k-epsilon", "epsilon"), ("realizable", "epsilon"), ("k-omega-sst", "omega")):
            folder = self.case(self.box, f"less_{model}", "--turbulence", model, "--iterations", "1")
            schemes = folder / "system/fvSchemes"
            text = schemes.read_text()
            self.assertIn(f'"laplacian\\(.*,(k|{field})\\)" Gauss linear limited corrected 0.3;', text)
            parts = text.partition("laplacianSchemes\n{\n    default         Gauss linear corrected;\n")
            self.assertTrue(parts[1])
            schemes.write_text(parts[0] + 'laplacianSchemes\n{\n    default none;\n    "laplacian\\(.*,(U|p)\\)" Gauss linear corrected;\n' +
                               parts[2])
            if HAVE_OPENFOAM:
                self.run_case(folder)
                self.assertIn("\nTime = 1\n", (folder / "log.simpleFoam").read_text())

    def test_one_prism_serves_all_directions(self):
        """Each side is what the wind makes of it; what comes in goes out."""
        run = self.atria("mesh", DATA / "house.wrl", "-o", self.folder / "prism.vtu", "--size-max", "16", "--size-mid", "4",
                         "--size-min", "2", "--domain-sides", "8", "--wind", "10")
        self.assertEqual(run.returncode, 0, run.stderr)
        folder = self.folder / "prism"
        run = self.atria("case", self.folder / "prism.vtu", "-o", folder, "--wind", "10", "--wind", "120", "--iterations", "50")
        self.assertEqual(run.returncode, 0, run.stderr)
        for direction in self.described(folder)["directions"]:
            sides = {name: role for name, role in direction["patches"].items() if name.startswith("domainSide")}
            self.assertEqual(len(sides), 8)
            for i in range(8):
                outwards = math.cos(math.radians(190 + 45 * i - direction["towards"]))  # side 1 faces the wind of the mesh
                wanted = "slip" if abs(outwards) < 0.01 else "outlet" if outwards > 0 else "inlet"
                self.assertEqual(sides[f"domainSide{i + 1}"], wanted, (direction["towards"], i))
            if not HAVE_OPENFOAM:
                continue
            self.run_case(folder / direction["folder"])
            speeds = [math.hypot(*u) for u in field_list(folder / direction["folder"] / "50/U")]
            self.assertLess(max(speeds), 3 * 4.0)
            flow = [float(file.read_text().split()[-1])
                    for file in (folder / direction["folder"] / "postProcessing").glob("flow_domainSide*/0/*.dat")]
            self.assertAlmostEqual(sum(flow) / max(flow), 0.0, delta=0.01)

    def test_dialects(self):
        current = self.case(self.box, "opencfd", "--dialect", "opencfd-2006", "--turbulence", "k-omega-sst")
        self.assertEqual(entry((current / "0/nut").read_text(), "zMin", "type"), "atmNutkWallFunction")
        self.assertEqual(entry((current / "0/omega").read_text(), "xMin", "type"), "atmBoundaryLayerInletOmega")
        self.assertEqual(entry((current / "0/U").read_text(), "xMin", "d"), "uniform 0")
        other = self.case(self.box, "foundation", "--dialect", "foundation-11")
        self.assertIn("solver          incompressibleFluid;", (other / "system/controlDict").read_text())
        self.assertTrue((other / "constant/momentumTransport").exists())
        self.assertIn("foamRun", (other / "Allrun").read_text())

    def test_processors_share_the_cells(self):
        """Where decomposePar divides anew: along both sides of the ground, the more along the longer one."""
        for count, parts in ((6, "(3 2 1)"), (7, "(7 1 1)"), (16, "(4 4 1)")):
            folder = self.case(self.box, f"parts{count}", "--processors", count)
            self.assertRegex((folder / "system/decomposeParDict").read_text(), rf"n +{re.escape(parts)};")
        if HAVE_OPENFOAM:
            folder = self.case(self.box, "two", "--processors", "2")
            run = subprocess.run(["decomposePar", "-force"], cwd=folder, env=os.environ | {"WM_PROJECT_DIR": "/usr/share/openfoam"},
                                 capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            self.assertEqual(sorted(map(int, re.findall(r"Number of cells = (\d+)", run.stdout))), [640, 640])

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_air_through_an_opening(self):
        """Through a face zone across the whole box goes what comes in, whatever the model."""
        for model in ("k-epsilon", "k-omega-sst"):
            folder = self.case(self.box, f"opening_{model}", "--turbulence", model, "--age-of-air", "--iterations", "60")
            report = self.described(folder)
            self.assertEqual(report["openings"], [{"name": "Wall_opening_1", "area": 1600.0, "rooms": ["hall", "outside"]}])
            self.assertEqual(report["rooms"], [{"name": "hall", "volume": 80000.0}])
            self.run_case(folder)
            flow = {}
            for file in (folder / "postProcessing").glob("flow*/0/surfaceFieldValue.dat"):
                flow[file.parts[-3]] = float(file.read_text().split()[-1])
            self.assertAlmostEqual(flow["flow_xMin"] + flow["flow_xMax"], 0.0, delta=1e-3 * flow["flow_xMax"])
            self.assertAlmostEqual(flow["flow_Wall_opening_1"], flow["flow_xMax"], delta=1e-3 * flow["flow_xMax"])
            self.assertAlmostEqual(flow["flowBothWays_Wall_opening_1"], flow["flow_xMax"], delta=1e-3 * flow["flow_xMax"])
            ages = [row[0] for row in field_list(folder / "60/age")]
            self.assertGreaterEqual(min(ages), 0.0)
            self.assertGreater(max(ages), 10.0) # 100 m at some 6 m/s at most

    def test_the_last_iteration_is_written(self):
        """OpenFOAM writes fields at multiples of an interval, and none at the end by itself."""
        for iterations in (1, 12, 500, 501, 600, 750, 751, 1000, 1499, 1500, 2200):
            folder = self.case(self.box, f"last{iterations}", "--iterations", iterations)
            text = (folder / "system/controlDict").read_text()
            end, interval = (int(re.search(rf"^{key}\s+(\d+);", text, re.MULTILINE)[1]) for key in ("endTime", "writeInterval"))
            self.assertEqual((end, end % interval), (iterations, 0))

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_run_starts_without_overshoot(self):
        """At a size at which some cells at walls are flat."""
        mesh = self.folder / "fine.vtu"
        self.assertEqual(self.atria("mesh", DATA / "house.wrl", "-o", mesh, "--size-min", "0.5", "--size-mid", "1", "--size-max",
                                    "8").returncode, 0)
        folder = self.folder / "start"
        self.assertEqual(self.atria("case", mesh, "-o", folder, "--speed", "5", "--iterations", "12").returncode, 0)
        control = folder / "system/controlDict"
        control.write_text(control.read_text().replace("functions\n{", """functions
{
    fastest { type fieldMinMax; libs ("libfieldFunctionObjects.so"); fields (U); mode magnitude; writeControl timeStep; }""", 1))
        self.run_case(folder)
        friction = 5.0 * KAPPA / math.log(10.1 / 0.1)
        top = friction / KAPPA * math.log((self.described(folder)["mesh"]["bounds"][5] + 0.1) / 0.1)
        rows = [line.split("\t") for line in (folder / "postProcessing/fastest/0/fieldMinMax.dat").read_text().splitlines()]
        fastest = [float(row[-2]) for row in rows if not row[0].startswith("#")]
        self.assertEqual(len(fastest), 12)
        self.assertLess(max(fastest), 2.0 * top)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_house_in_the_wind(self):
        speed, height, roughness = 4.0, 8.0, 0.3
        mesh = self.folder / "house.vtu"
        self.assertEqual(self.atria("mesh", DATA / "house.wrl", "-o", mesh, *COARSE).returncode, 0)
        folder = self.case(mesh, "house", "--speed", speed, "--height", height, "--roughness", roughness, "--iterations", "40")
        report = self.described(folder)
        self.assertLess(report["mesh"]["cells"], 15000)
        self.assertEqual(report["directions"][0]["patches"]["Site"], "ground")
        self.assertEqual(report["directions"][0]["patches"]["WallSouth_front"], "wall")
        self.run_case(folder)
        log = (folder / "log.simpleFoam").read_text()
        self.assertIn("\nTime = 40\n", log)
        self.assertNotIn("nan", log)
        friction = speed * KAPPA / math.log((height + roughness) / roughness)
        top = friction / KAPPA * math.log((report["mesh"]["bounds"][5] + roughness) / roughness)
        speeds = [math.hypot(*u) for u in field_list(folder / "40/U")]
        self.assertEqual(len(speeds), report["mesh"]["cells"])
        self.assertLess(max(speeds), 2.0 * top)
        for name in ("k", "epsilon", "nut"):
            self.assertGreaterEqual(min(row[0] for row in field_list(folder / "40" / name)), 0.0, name)
        # Richards and Hoxey at the inlet. Its faces are at heights of the grid: every speed says its height.
        inlet = field_list(folder / "40/U", "xMin")
        epsilon = field_list(folder / "40/epsilon", "xMin")
        self.assertEqual(len(inlet), len(epsilon))
        for (u, v, w), (dissipation,) in zip(inlet, epsilon):
            self.assertEqual((v, w), (0.0, 0.0))
            z = roughness * math.exp(KAPPA * u / friction) - roughness
            self.assertGreater(z, 0.0)
            self.assertLess(z, report["mesh"]["bounds"][5])
            self.assertAlmostEqual(dissipation / (friction**3 / (KAPPA * (z + roughness))), 1.0, places=6)
        for (k,) in field_list(folder / "40/k", "xMin"):
            self.assertAlmostEqual(k, friction**2 / math.sqrt(CMU), places=6)
        flows = [float((folder / f"postProcessing/flow_{side}/0/surfaceFieldValue.dat").read_text().split()[-1])
                 for side in ("xMin", "xMax")]
        self.assertLess(abs(sum(flows)), 1e-3 * flows[1])
        probes = (folder / "postProcessing/pedestrians/0/U").read_text()
        places = re.findall(r"# Probe \d+ \((\S+) (\S+) (\S+)\)", probes)
        self.assertGreater(len(places), 20)
        self.assertEqual({float(place[2]) for place in places}, {1.75})
        subprocess.run([folder / "Allclean"], check=True)
        self.assertFalse((folder / "40").exists() or (folder / "postProcessing").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
