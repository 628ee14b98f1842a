# SPDX-License-Identifier: GPL-3.0-or-later
"""Models as they are read: surfaces, units, places far from the origin, features.

Usage: test_inspect.py ATRIA FOLDER_OF_MODELS
"""

import json
import re
import struct
import sys
import unittest

from command_line import COARSE, DATA, expected_status, HOUSE, CommandLineTest


class Inspect(CommandLineTest):
    def test_inspect(self):
        report = json.loads(self.atria("inspect", HOUSE, "--json").stdout)
        surfaces = {surface["name"]: surface for surface in report["surfaces"]}
        self.assertEqual(len(surfaces), 13)
        self.assertAlmostEqual(surfaces["WallSouth"]["area"], 24 * 7 - 4 * 3, places=9)
        self.assertEqual(surfaces["Site"]["bounds"], [-90, 137, -84, 98, 0, 0])
        self.assertEqual(surfaces["Neighbor"]["open_edges"], 0)
        self.assertEqual(surfaces["Site"]["open_edges"], 4)
        self.assertGreater(report["total"]["non_manifold_edges"], 0)
        edges = [problem for problem in report["problems"] if problem["kind"] == "open edges"]
        self.assertEqual(sum(problem["count"] for problem in edges), report["total"]["open_edges"])
        self.assertTrue(any(problem["kind"] == "non-manifold edges" for problem in report["problems"]))
        for problem in report["problems"]:
            self.assertEqual(len(problem["place"]), 3)
            self.assertLessEqual(set(problem["surfaces"]), set(surfaces))
        table = self.atria("inspect", HOUSE)
        self.assertEqual((table.returncode, table.stderr), (0, ""))
        self.assertIn("PartitionB", table.stdout)
        self.assertIn("open edges", table.stdout)
        self.assertNotIn("open edges", self.atria("inspect", HOUSE, "--no-problems").stdout)

    def test_inspect_lists_what_makes_no_surface(self):
        model = self.folder / "lines.wrl"
        model.write_text("#VRML V2.0 utf8\nShape { geometry Box {} } Shape { geometry IndexedLineSet {} }\n"
                         "Shape { geometry PointSet {} } Viewpoint {}\n")
        skipped = ["IndexedLineSet: 1", "PointSet: 1", "Viewpoint: 1"]
        self.assertIn(": " + ", ".join(skipped) + "\n", self.atria("inspect", model).stdout)
        self.assertEqual(json.loads(self.atria("inspect", model, "--json").stdout)["skipped"], skipped)

    def test_inspect_tells_places_far_from_the_origin(self):
        model = self.folder / "far.wrl"
        model.write_text("#VRML V2.0 utf8\nTransform { translation 3500000 5400000.25 0 children Shape { geometry Box {} } }\n")
        self.assertIn("3499999..3500001  5399999.25..5400001.25  -1..1", self.atria("inspect", model).stdout)

    def test_places_at_zero_are_zero(self):
        """Points of a repaired model lie a rounding of its grid off."""
        for model in (HOUSE, DATA / "building.wrl"):
            self.assertNotRegex(self.atria("inspect", model).stdout, r"\de-\d")
            self.assertNotRegex(self.atria("mesh", model, "--preflight").stdout, r"\de-\d")

    def test_model_options(self):
        model = self.folder / "options.wrl"
        square = "coord Coordinate { point [0 0 0, 400 0 0, 400 400 0, 0 400 0] } coordIndex [0 1 2 3]"
        shape = "Shape { appearance Appearance { material DEF %s Material {} } geometry IndexedFaceSet { %s } }"
        model.write_text("#VRML V2.0 utf8\n# Exported by SketchUp\nDEF G Group { children [" + shape % ("Front", square) +
                         shape % ("Back", square) + "] }")
        run = self.atria("inspect", model, "--json")
        self.assertIn("SketchUp", run.stderr)
        self.assertIn("note: ", run.stderr)
        report = json.loads(run.stdout)
        self.assertEqual(report["merged_faces"], 1)
        self.assertEqual([surface["name"] for surface in report["surfaces"]], ["G"])
        run = self.atria("inspect", model, "--json", "--unit", "in", "--up", "y", "--scale", "2", "--keep-duplicates",
                         "--surfaces-by", "material")
        self.assertEqual(run.stderr, "")
        report = json.loads(run.stdout)
        self.assertEqual([surface["name"] for surface in report["surfaces"]], ["Front", "Back"])
        for value, expected in zip(report["total"]["bounds"], [0, 20.32, 0, 0, 0, 20.32]):
            self.assertAlmostEqual(value, expected, places=9)
        self.refuses(2, "--unit", "inspect", model, "--unit", "yd")

    def test_a_model_far_off_meshes_as_at_the_origin(self):
        """And OpenFOAM's points come back to where it was."""
        shift = [500_000, -300_000, 0]
        far = self.folder / "far.wrl"
        far.write_text("#VRML V2.0 utf8\nTransform { translation %d %d %d children Inline { url \"%s\" } }\n" %
                       (*shift, HOUSE.resolve()))
        reports, points = [], []
        for model, options in ((HOUSE, []), (far, ["--recenter", "--restore-offset"])):
            name = model.stem + "_recentered"
            outputs = [self.folder / (name + ending) for ending in (".vtu", "_case", ".json")]
            run = self.atria("mesh", model, *COARSE, "-o", outputs[0], "--openfoam", outputs[1], "--report", outputs[2],
                             *options)
            reports.append(json.loads(outputs[2].read_text()))
            self.assertEqual(reports[-1]["invalid_elements"], 0)
            self.assertEqual(run.returncode, expected_status(reports[-1]), run.stderr)
            data = (outputs[1] / "constant/polyMesh/points").read_bytes()
            count = re.search(rb"\n(\d+)\s*\(", data)
            values = struct.iter_unpack("<3d", data[count.end():count.end() + 24 * int(count.group(1))])
            points.append(list(values))
            offset = re.search(rb'Name="ModelOffset"[^>]*RangeMax="([^"]*)"', outputs[0].read_bytes())
            length = sum(x * x for x in shift) ** 0.5 if options else 0.0
            self.assertAlmostEqual(float(offset.group(1)), length, places=3)
        for key in ("counts", "quality", "patches", "invalid_elements", "zones"):
            self.assertEqual(reports[0][key], reports[1][key])
        self.assertEqual(len(points[0]), reports[0]["counts"]["vertices"])
        self.assertEqual(len(points[0]), len(points[1]))
        for here, there in zip(*points):
            for axis in range(3):
                self.assertAlmostEqual(here[axis] + shift[axis], there[axis], places=5)

    def test_a_model_far_off_loses_nothing_where_it_is(self):
        shift = [10_000_000, -20_000_000, 0]
        far = self.folder / "farther.wrl"
        far.write_text("#VRML V2.0 utf8\nTransform { translation %d %d %d children Inline { url \"%s\" } }\n" %
                       (*shift, HOUSE.resolve()))
        reports = []
        for model in (HOUSE, far):
            outputs = [self.folder / (model.stem + "_in_place" + ending) for ending in (".vtu", ".json")]
            run = self.atria("mesh", model, *COARSE, "-o", outputs[0], "--report", outputs[1])
            self.assertEqual(run.returncode, 0, run.stderr)
            reports.append(json.loads(outputs[1].read_text()))
        self.assertEqual(reports[0]["counts"], reports[1]["counts"])
        self.assertEqual(reports[0]["repair"], reports[1]["repair"])
        for here, there in zip(reports[0]["patches"], reports[1]["patches"]):
            self.assertEqual((here["name"], here["faces"]), (there["name"], there["faces"]))
            # Points are rounded to nanometers there: those that slide to make elements better end elsewhere.
            self.assertAlmostEqual(there["area"] / here["area"], 1, delta=1e-3)

    def test_round_solids(self):
        model = self.folder / "round.wrl"
        model.write_text("#VRML V2.0 utf8\nShape { geometry Cone { bottomRadius 100 height 1 } }\n")
        def triangles(*options):
            return json.loads(self.atria("inspect", model, "--json", "--unit", "m", *options).stdout)["total"]["triangles"]
        self.assertEqual(triangles(), 2 * 36 - 2)
        self.assertEqual(triangles("--round-angle", 7.2), 2 * 50 - 2)
        self.assertEqual(triangles("--round-error", 0.1), 2 * 71 - 2)  # pi / acos(1 - 0.001) = 70.2
        self.refuses(2, "--round-error", "inspect", model, "--round-error", "-1")

    def test_inspect_writes_features(self):
        out = self.folder / "features.vtp"
        run = self.atria("inspect", HOUSE, "--features", out)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("PartitionB", run.stdout)
        self.assertIn(b"CurveKind", out.read_bytes())
        self.refuses(2, ".vtp", "inspect", HOUSE, "--features", self.folder / "features.vtu")

    def test_turned_model_has_the_same_area(self):
        straight, turned = (
            json.loads(self.atria("inspect", DATA / name, "--json").stdout)["total"]
            for name in ("house.wrl", "house_turned17.wrl")
        )
        self.assertAlmostEqual(straight["area"], turned["area"], places=6)
        self.assertEqual(straight["non_manifold_edges"], turned["non_manifold_edges"])
        self.assertEqual(straight["open_edges"], turned["open_edges"])

    def test_a_house_in_inches_is_told_before_it_is_meshed(self):
        model = self.folder / "inches.wrl"
        model.write_text("#VRML V2.0 utf8\nTransform { scale 39.37 39.37 39.37 children Inline { url \"%s\" } }\n" %
                         HOUSE.resolve())
        self.assertIn("inches (227 by 182 by 11 m)", self.atria("inspect", model).stderr)
        fixed = ["--size-max", "8", "--size-mid", "2", "--size-min", "1", "--site", "Site"]
        run = self.atria("mesh", model, *fixed, "--estimate", "--memory-limit", "8")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("inches (227 by 182 by 11 m)", run.stderr)
        self.assertIn("the model 8937 by 7165 by 433.1 m: if that is not what it should, state its unit", run.stderr)
        self.refuses(3, "--unit", "mesh", model, *fixed, "-o", self.folder / "inches.vtu", "--memory-limit", "8")
        run = self.atria("mesh", model, *fixed, "--unit", "in", "--estimate")
        self.assertEqual((run.returncode, run.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
