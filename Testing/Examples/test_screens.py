# SPDX-License-Identifier: GPL-3.0-or-later
"""atria case --screen and --fan: what they do to the pressure in ducts, where they are written, and what is refused.

Usage: test_screens.py ATRIA
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from atria.report import Case, screens
from box_mesh import header, write_box
from decomposed import MPI

ATRIA = pathlib.Path(sys.argv[1])
HAVE_OPENFOAM = shutil.which("simpleFoam") is not None
ALONG, ACROSS = 32, 4  # cells of a duct of 8 m × 1 m × 1 m
DENSITY = 1.225
WALLS = ("--kind", "room", "--patch", "y*", "slip", "--patch", "z*", "slip", "--patch", "xMax", "outlet")
BLOWN = (*WALLS, "--patch", "xMin", "inlet:2m/s")
# Air from still surroundings, for which no role of a room's inlet stands.
DRAWN = (*WALLS, "--patch", "xMin", "inlet:1m/s", "--condition", "xMin", "U", "type pressureInletOutletVelocity; value uniform (0 0 0);",
         "--condition", "xMin", "p", "type totalPressure; p0 uniform 0; value uniform 0;")


class Screens(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.duct = self.folder / "duct"
        write_box(self.duct, (ALONG, ACROSS, ACROSS), ((0.0, 8.0), (0.0, 1.0), (0.0, 1.0)), zone_at=ALONG // 2)
        self.add_zone("Fan", ALONG // 4)

    def add_zone(self, name, at):
        """A second face zone across, its normal along the duct."""
        mesh = self.duct / "constant/polyMesh"
        numbers = lambda file: [int(row) for row in (mesh / file).read_text().split("(", 1)[1].split(")")[0].split()]
        pairs = zip(numbers("owner"), numbers("neighbour"))
        chosen = [str(face) for face, (owner, other) in enumerate(pairs) if other == owner + 1 and other % ALONG == at]
        first = (mesh / "faceZones").read_text().split("(\n", 1)[1].rsplit(")", 1)[0]
        (mesh / "faceZones").write_text(header("faceZones", "regIOobject") + f"2\n(\n{first}{name} {{ type faceZone; faceLabels "
                                        f"List<label> {len(chosen)}({' '.join(chosen)}); flipMap List<bool> {len(chosen)}{{0}}; }}\n)\n")

    def atria(self, *arguments):
        return subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)

    def case(self, *arguments, mesh=None, name="case"):
        folder = self.folder / name
        run = self.atria("case", mesh or self.duct, "-o", folder, *arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return folder

    def run_case(self, folder):
        run = subprocess.run([folder / "Allrun"], capture_output=True, text=True, check=False, env=os.environ | MPI)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def pressures(self, folder):
        """Along the duct, m2/s2."""
        array = Case(folder).runs[0].fields.mesh.GetCellData().GetArray("p")
        return [array.GetValue(i) for i in range(ALONG)]

    def flow(self, folder, name):
        return float((folder / f"postProcessing/flow_{name}/0/surfaceFieldValue.dat").read_text().split()[-1])

    def refuses(self, text, *arguments):
        run = self.atria("case", self.duct, "-o", self.folder / "refused", *BLOWN, *arguments)
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertIn(text, run.stderr)

    def test_zones_are_divided_and_united(self):
        """Written again into its own folder, a case without the screen has the mesh it began with."""
        folder = self.case(*BLOWN, "--screen", "Wall*", "2")
        boundary = folder / "constant/polyMesh/boundary"
        self.assertEqual(boundary.read_text().count("neighbourPatch"), 2)
        described = json.loads((folder / "case.json").read_text())
        self.assertEqual(described["screens"], [{"zone": "Wall_opening_1", "resistance": 2.0, "linear": 0.0}])
        self.assertEqual([opening["name"] for opening in described["openings"]], ["Wall_opening_1", "Fan"])
        self.assertEqual([room["name"] for room in described["rooms"]], ["hall"])
        again = self.case(*BLOWN, "--fan", "Fan", "-5", mesh=folder)
        self.assertEqual(boundary.read_text().count("neighbourPatch"), 2)
        self.assertIn("Fan_side2", boundary.read_text())
        self.assertFalse((again / "constant/fvOptions").exists())  # a constant pressure needs no model
        self.case(*BLOWN, mesh=folder)
        self.assertNotIn("cyclic", boundary.read_text())
        self.assertNotIn("_side", (folder / "0/p").read_text() + (folder / "constant/polyMesh/cellZones").read_text(errors="replace"))
        plain = self.case(*BLOWN, name="plain")
        for file in ("owner", "neighbour"):
            labels = [self.labels(place / "constant/polyMesh" / file) for place in (folder, plain)]
            self.assertEqual(labels[0], labels[1], file)

    def labels(self, file):
        """Of a list in text or binary."""
        head, _, data = file.read_bytes().partition(b"}")[2].partition(b"(")
        count = int(head.split()[-1])
        if b"binary" in file.read_bytes()[:400]:
            return [int.from_bytes(data[4 * i:4 * i + 4], "little") for i in range(count)]
        return [int(word) for word in data.split(b")")[0].split()]

    def test_what_is_refused(self):
        self.refuses("did you mean 'Fan'?", "--screen", "Fen", "2")
        self.refuses("'hall' is a cell zone, and no face zone", "--screen", "hall", "2")
        self.refuses("'xMin' is a patch, and no face zone", "--fan", "xMin", "2")
        self.refuses("PATTERN RESISTANCE", "--screen", "Fan", "-2")
        self.refuses("has a screen and a fan", "--screen", "*", "2", "--fan", "Fan", "20")
        curve = self.folder / "fan.csv"
        self.refuses("is neither a number of Pa, without a unit, nor a file", "--fan", "Fan", curve)
        self.refuses("is neither a number of Pa, without a unit, nor a file", "--fan", "Fan", "40Pa")
        curve.write_text("flow, pressure\n0, 40\n1, 50\n")
        self.refuses("fan.csv', line 3: the pressure is above that of the line before", "--fan", "Fan", curve)

    def test_config(self):
        config = self.folder / "case.toml"
        run = self.atria("case", "--write-config", config, *BLOWN, "--screen", "Wall*", "2,0.5", "--fan", "Fan", "20")
        self.assertEqual(run.returncode, 0, run.stderr)
        described = json.loads((self.case("--config", config) / "case.json").read_text())
        self.assertEqual(described["screens"][0]["linear"], 0.5)
        self.assertEqual(described["fans"], [{"zone": "Fan", "blows_back": False, "curve": [[0.0, 20.0]]}])

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_screen_takes_its_pressure(self):
        """Also on two processors; the solver diverges within 20 iterations without the model that steadies it."""
        for resistance, linear, processors in ((0.5, 0.0, 1), (10.0, 0.0, 2), (2.0, 3.0, 1)):
            folder = self.case(*BLOWN, "--screen", "Wall*", f"{resistance},{linear}", "--iterations", "250", "--processors", processors,
                               name=f"screen{resistance}")
            self.run_case(folder)
            pressure = self.pressures(folder)
            wanted = resistance * 2.0**2 / 2.0 + linear * 2.0 / DENSITY
            self.assertAlmostEqual((pressure[10] - pressure[20]) / wanted, 1.0, delta=0.002, msg=folder.name)
            self.assertAlmostEqual(self.flow(folder, "Wall_opening_1"), 2.0, delta=1e-4)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_fan_finds_its_working_point(self):
        """40 Pa - 10 Pa s/m3 Q = density (K + 1) U^2 / 2: the air leaves with its speed."""
        curve = self.folder / "fan.csv"
        curve.write_text("flow, pressure\n0, 40\n2, 20\n4, 0\n")
        folder = self.case(*DRAWN, "--fan", "Fan", curve, "--screen", "Wall*", "3", "--iterations", "500")
        self.run_case(folder)
        loss = DENSITY * (3.0 + 1.0) / 2.0
        speed = (math.sqrt(100.0 + 4.0 * loss * 40.0) - 10.0) / (2.0 * loss)
        self.assertAlmostEqual(self.flow(folder, "Fan") / speed, 1.0, delta=0.01)
        self.assertAlmostEqual(self.flow(folder, "Wall_opening_1") / speed, 1.0, delta=0.01)
        pressure = self.pressures(folder)
        self.assertAlmostEqual((pressure[12] - pressure[4]) * DENSITY / (40.0 - 10.0 * speed), 1.0, delta=0.02)
        report = self.atria("report", folder)
        self.assertEqual((report.returncode, report.stderr), (0, ""))
        page = (folder / "report.html").read_text(encoding="utf-8")
        self.assertIn("<td>fan, 0 to 40 Pa</td>", page)
        self.assertIn("<td>screen, K = 3</td>", page)
        case = Case(folder)
        rows = {name: values for name, _, *values in screens.rows(case.screens, case.runs[0].openings, case.runs[0].fields)}
        for name, wanted in (("Fan", 40.0 - 10.0 * speed), ("Wall_opening_1", -3.0 * DENSITY * speed**2 / 2.0)):
            flow, mean, measured, by_rule = rows[name]
            self.assertAlmostEqual(flow / speed, 1.0, delta=0.01)
            self.assertAlmostEqual(mean / speed, 1.0, delta=0.01)
            self.assertAlmostEqual(measured / wanted, 1.0, delta=0.03, msg=name)
            self.assertAlmostEqual(by_rule / wanted, 1.0, delta=0.03, msg=name)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_fan_moves_still_air(self):
        """Its pressure becomes speed."""
        folder = self.case(*WALLS[:-3], "--patch", "x*", "inletOutlet", "--calm", "--outdoor-temperature", "20", "--fan", "Fan", "40",
                           "--iterations", "800")
        self.assertAlmostEqual(Case(folder).described["reference_speed"], math.sqrt(2.0 * 40.0 / DENSITY), delta=1e-6)
        self.run_case(folder)
        self.assertAlmostEqual(self.flow(folder, "Fan") / math.sqrt(2.0 * 40.0 / DENSITY), 1.0, delta=0.01)

    def test_a_fan_may_blow_back(self):
        fan, screen = screens.screens_of({"fans": [{"zone": "f", "blows_back": True, "curve": [[0, 40], [2, 0]]}],
                                          "screens": [{"zone": "s", "resistance": 2.0, "linear": 4.0}]})[::-1]
        self.assertEqual((fan.words, screen.words), ("fan, 0 to 40 Pa", "screen, K = 2, 4 Pa s/m"))
        self.assertEqual(fan.rise(-1.0, 1.0), -20.0)
        self.assertAlmostEqual(screen.rise(-1.0, 0.5), DENSITY * 2.0**2 + 4.0 * 2.0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
