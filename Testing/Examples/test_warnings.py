# SPDX-License-Identifier: GPL-3.0-or-later
"""Warnings reach their reader: counted, the gravest first, and none without a reason.

Usage: test_warnings.py ATRIA FOLDER_OF_MODELS
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ATRIA = pathlib.Path(sys.argv[1])
DATA = pathlib.Path(sys.argv[2])


class Warnings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def atria(self, *arguments, status=0):
        run = subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, status, run.stderr)
        return run

    def warnings(self, *arguments):
        """Those of atria inspect."""
        lines = self.atria("inspect", *arguments, "--no-problems").stderr.splitlines()
        return [line for line in lines if line.startswith("atria: warning: ")]

    def test_the_unit_comes_before_many_of_one_kind(self):
        told = self.warnings(DATA / "warning-hidden-behind-many.wrl")
        self.assertEqual(len(told), 2, told)
        self.assertIn("--unit", told[0])
        self.assertIn("and 29 more like it", told[1])

    def test_a_tower_that_lies_is_told(self):
        self.assertIn("--up", "".join(self.warnings(DATA / "tower-y-up.obj")))
        self.assertEqual(self.warnings(DATA / "tower-y-up.obj", "--up", "y"), [])

    def test_a_hall_of_kilometers_is_told_in_a_format_of_meters(self):
        told = self.warnings(DATA / "gltf-in-millimeters.gltf")
        self.assertEqual(len(told), 1, told)
        self.assertIn("millimeters", told[0])
        self.assertEqual(self.warnings(DATA / "gltf-in-millimeters.gltf", "--unit", "mm"), [])

    def mesh(self, model, *arguments):
        report = self.folder / (pathlib.Path(model).stem + ".json")
        run = self.atria("mesh", DATA / model, "-o", self.folder / "mesh.vtu", "--report", report, *arguments)
        return run, json.loads(report.read_text())

    def test_a_solid_in_a_slope_is_no_closed_room(self):
        run, report = self.mesh("solid-sunk-in-slope.obj", "--terrain", "Terrain*")
        self.assertNotIn("closed space", run.stderr)
        self.assertEqual(run.stderr.count("warning"), 1, "that of the space under the terrain")
        self.assertIn("insides of solids", run.stderr)
        self.assertNotIn("room", [zone["kind"] for zone in report["zones"]])

    def test_a_room_with_thick_walls_is_meshed(self):
        run, report = self.mesh("room-thick-walls.obj", "--model-bounds", "--size-min", "0.1")
        volume = sum(zone["volume"] for zone in report["zones"] if zone["kept"])
        self.assertAlmostEqual(volume, 5.4 * 4.4 * 2.4, delta=0.005 * 57)
        (warning,) = [line for line in run.stderr.splitlines() if "warning" in line]
        self.assertIn("1 surface without a face in the mesh: Outside (126 m², inside a solid)", warning)

    def test_quality_gives_the_verdict_of_the_writer(self):
        mesh, report = self.folder / "judged.vtu", self.folder / "judged.json"
        run = subprocess.run([ATRIA, "mesh", DATA / "solid-sunk-in-slope.obj", "--terrain", "Terrain*", "--no-support",
                              "--layers", "0", "-o", mesh, "--report", report, "--openfoam", self.folder / "case"],
                             capture_output=True, text=True, check=False)
        self.assertIn(run.returncode, (0, 5), run.stderr)
        written = json.loads(report.read_text())["openfoam"]
        judged = self.atria("quality", mesh, "--checks", "--json", status=run.returncode)
        checks = json.loads(judged.stdout)
        self.assertEqual(checks["failed_checks"], written["failed_checks"])
        self.assertEqual({name: check["failing"] for name, check in checks["checks"].items()},
                         {name: check["failing"] for name, check in written["checks"].items()})
        self.assertGreater(written["merged_faces"] + written["merged_cells"], 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
