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
        self.assertNotIn("warning", run.stderr)
        self.assertIn("insides of solids", run.stderr)
        self.assertEqual({zone["kind"] for zone in report["zones"]}, {"open", "ground", "solid"})
        self.assertIn("spaces under the ground 1", run.stdout)
        self.assertEqual(report["audit"]["closed_bodies"], 1)
        self.assertEqual([body["state"] for body in report["audit"]["bodies"]], ["below ground"])

    def test_a_house_without_a_wall_is_said_to_be_open(self):
        run, report = self.mesh("house-open-to-the-side.obj")
        self.assertNotIn("warning", run.stderr)
        self.assertIn("1 body is open, and air is meshed inside of it: House (about 5 4 3)", run.stderr)
        self.assertIn("1 open, with air inside (House)", run.stdout)
        (body,) = report["audit"]["bodies"]
        self.assertEqual((body["body"], body["state"]), ("House", "open"))
        self.assertAlmostEqual(body["volume"], 480, places=3)

    def test_notes_name_what_the_table_names(self):
        run = self.atria("inspect", DATA / "note-names-no-surface.wrl")
        self.assertIn("all faces of 'WALL_3' coincide", run.stderr)
        self.assertIn("18 square meters with 'WALL_2'", run.stderr)
        self.assertIn("\nWALL_2 ", run.stdout)
        self.assertNotIn("Shape", run.stderr)

    def test_a_wall_of_a_newer_schema_is_read(self):
        (warning,) = self.warnings(DATA / "ifc4-wall-only.ifc")
        self.assertIn("its schema is IFC4", warning)
        found = json.loads(self.atria("inspect", DATA / "ifc4-wall-only.ifc", "--json").stdout)
        self.assertEqual([surface["name"] for surface in found["surfaces"]], ["IfcWallStandardCase_Wall"])
        self.assertAlmostEqual(found["surfaces"][0]["area"], 2 * (6 * 3 + 6 * 0.3 + 3 * 0.3), delta=1e-4)

    def test_small_balls_have_few_facets(self):
        model = self.folder / "balls.wrl"
        balls = "".join(f"Transform {{ translation {0.5 * (i % 40)} {0.5 * (i // 40)} 0 children USE Leg }}\n"
                        for i in range(1, 1000))
        model.write_text("#VRML V2.0 utf8\nDEF Leg Shape { geometry Sphere { radius 0.025 } }\n" + balls)
        found = json.loads(self.atria("inspect", model, "--json", "--no-problems").stdout)
        self.assertEqual(len(found["surfaces"]), 1000)
        self.assertLess(max(surface["triangles"] for surface in found["surfaces"]), 300)

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
