# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command line writes, prints and returns.

Usage: test_command_line.py ATRIA FOLDER_OF_MODELS
"""

import json
import os
import pathlib
import re
import resource
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ATRIA = pathlib.Path(sys.argv[1])
DATA = pathlib.Path(sys.argv[2])
HOUSE = DATA / "house.wrl"
COARSE = ["--size-max", "16", "--size-mid", "4", "--size-min", "2", "--site", "Site"]
FINE = ["--size-max", "16", "--size-mid", "2", "--size-min", "1", "--site", "Site"]
REPORT_KEYS = [
    "counts", "zones", "rooms", "openings", "leaks", "patches", "quality", "invalid_elements", "max_level", "seconds",
    "peak_memory_bytes", "threads", "repair", "hidden_detail", "layers", "failing_by_thin_layers", "audit", "left_out_elements", "diagnostics", "openfoam",
]


def expected_status(report):
    """Of atria mesh: 4 for elements that are not valid, 5 for checks that fail."""
    checks = (report["openfoam"] or {"checks": {}})["checks"]
    failed = {name for name, check in checks.items() if check["is_error"] and check["failing"]}
    failed -= set(report["failing_by_thin_layers"])
    return 4 if report["invalid_elements"] else 5 if failed else 0


class CommandLine(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def atria(self, *arguments):
        return subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)

    def refuses(self, status, text, *arguments):
        run = self.atria(*arguments)
        self.assertEqual(run.returncode, status, run.stderr)
        # Warnings may stand ahead: what was found in a file before it was refused.
        last = [line for line in run.stderr.splitlines() if line.startswith("atria: ")][-1]
        self.assertTrue(last.startswith("atria: error: "), run.stderr)
        self.assertIn(text, run.stderr)
        self.assertNotIn("\r", run.stderr)

    def test_help_is_no_error(self):
        for arguments in (["--help"], ["mesh", "--help"], ["inspect", "--help"], ["quality", "--help"], ["improve", "--help"],
                          ["convert", "--help"], ["climate", "--help"], ["--version"]):
            run = self.atria(*arguments)
            self.assertEqual((run.returncode, run.stderr), (0, ""), arguments)

    def test_usage_errors(self):
        out = self.folder / "out.vtu"
        self.refuses(2, "subcommand")
        self.refuses(2, "MODEL", "mesh", "-o", out)
        self.refuses(2, "--size-min", "mesh", HOUSE, "-o", out, "--size-min", "-1")
        self.refuses(2, "'0,5' is not a number more than 0; decimals follow a point: 0.5", "mesh", HOUSE, "--size-min", "0,5")
        self.refuses(2, "sizes", "mesh", HOUSE, "-o", out, "--size-mid", "16", "--size-max", "8")
        self.refuses(2, "--domain", "mesh", HOUSE, "-o", out, "--domain", "1", "0", "0", "1", "0", "1")
        self.refuses(2, "--site", "mesh", HOUSE, "-o", out, "--site", "Site", "--domain", "0", "1", "0", "1", "0", "1")
        self.refuses(2, "--zone", "mesh", HOUSE, "-o", out, "--zone", "inside")
        self.refuses(2, "--size", "mesh", HOUSE, "-o", out, "--size", "Wall*", "0.5:x")
        self.refuses(2, "--gap-cells", "mesh", HOUSE, "-o", out, "--gap-cells", "-1")
        self.refuses(2, "--cells-per-level", "mesh", HOUSE, "-o", out, "--cells-per-level", "0")
        for wrong in ("x", "-1", "1.5", "101", "1:2", "Wall*=", "Wall*=1:x", "Wall*=1:1:1:1"):
            self.refuses(2, "--layers", "mesh", HOUSE, "-o", out, f"--layers={wrong}")
        self.refuses(2, "--layer-growth", "mesh", HOUSE, "-o", out, "--layer-growth", "0")
        self.refuses(2, "--first-layer", "mesh", HOUSE, "-o", out, "--first-layer", "-1")
        self.refuses(2, "--threads", "mesh", HOUSE, "-o", out, "--threads", "0")
        self.refuses(2, ".vtu", "mesh", HOUSE, "-o", self.folder / "out.vtk")
        self.refuses(2, ".vtpc", "mesh", HOUSE, "-o", out, "--patches", self.folder / "out.vtm")
        self.refuses(2, "does not exist", "mesh", HOUSE, "-o", self.folder / "absent" / "out.vtu")
        self.refuses(2, "WallSouth", "mesh", HOUSE, "-o", out, "--site", "Lawn")
        self.assertFalse(out.exists())

    def test_bad_input(self):
        out = self.folder / "bad.vtu"
        self.refuses(3, "does not exist", "mesh", self.folder / "absent.wrl", "-o", out)
        self.refuses(3, "is a folder", "inspect", self.folder)
        text = self.folder / "text.wrl"
        text.write_text("This is no model.\n")
        self.refuses(3, "text.wrl", "inspect", text)
        self.refuses(3, "text.wrl", "quality", text)
        self.assertFalse(out.exists())
        parts = self.folder / "parts.wrl"
        parts.write_text('#VRML V2.0 utf8\nInline { url "gone.wrl" }\n')
        self.refuses(3, "parts.wrl:2:1: Inline: cannot read 'gone.wrl'", "inspect", parts)

    def test_other_formats(self):
        faces = {"Floor": "1 4 3 2", "Wall South": "1 2 6 5", "Wall North": "3 4 8 7", "Wall West": "4 1 5 8", "Roof": "5 6 7 8"}
        points = "".join(f"v {x} {y} {z}\n" for z in (0, 6) for x, y in ((0, 0), (8, 0), (8, 6), (0, 6)))
        obj = self.folder / "shed.obj"
        obj.write_text(points + "".join(f"g {name}\nf {face}\n" for name, face in faces.items()) + "l 1 2\n")
        run = self.atria("inspect", obj, "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("shed.obj: 1 lines", run.stderr)
        report = json.loads(run.stdout)
        self.assertEqual([surface["name"] for surface in report["surfaces"]], list(faces))
        self.assertAlmostEqual(report["total"]["area"], 2 * 48 + 2 * 48 + 36)
        self.assertEqual(len(report["warnings"]), 1)
        out = self.folder / "shed.json"
        run = self.atria("mesh", obj, "-o", self.folder / "shed.vtu", *COARSE[:6], "--domain", "-16", "24", "-16", "24",
                         "0", "24", "--report", out)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        patches = {patch["name"] for patch in json.loads(out.read_text())["patches"]}
        self.assertLessEqual({"Roof_front", "Wall South_back", "Floor"}, patches)
        self.assertEqual(self.atria("mesh", obj, "--preflight", "--automatic").returncode, 0)
        unknown = "of no format that is known; give VRML"
        for name, what in (("shed.xyz", unknown), ("shed", unknown), ("shed.obj.gz", "is an archive; unpack it first"),
                           ("shed.dwg", "AutoCAD's own format, which is not read; export it there as DXF"),
                           ("shed.SKP", "SketchUp's own format"), ("shed.stp", "export it as OBJ or STL")):
            other = self.folder / name
            other.write_text("0\nSECTION\n")
            self.refuses(3, what, "inspect", other)
        for ending in ("wrl", "obj", "stl", "ply", "glb", "dae", "ifc", "dxf", "json", "vtp"):
            other = self.folder / f"empty.{ending}"
            other.write_text("")
            self.refuses(3, "holds no surfaces: it is empty", "mesh", other)
            self.assertNotIn("warning", self.atria("mesh", other).stderr)
        broken = self.folder / "broken.stl"
        broken.write_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n")
        self.refuses(3, "broken.stl", "inspect", broken)

    def test_the_same_files_whatever_the_threads(self):
        written = []
        for threads in (1, 2, 7):
            out = self.folder / f"threads{threads}.vtu"
            self.assertIn(self.atria("mesh", HOUSE, "-o", out, "--site", "Site", "--threads", threads).returncode, (0, 4))
            written.append(out.read_bytes())
        self.assertEqual(written[0], written[1])
        self.assertEqual(written[0], written[2])

    def test_vrml_by_any_of_its_endings(self):
        wanted = self.atria("inspect", HOUSE, "--json")
        self.assertEqual(wanted.returncode, 0, wanted.stderr)
        for name in ("house.vrml", "HOUSE.VRML"):
            copy = self.folder / name
            copy.write_bytes(HOUSE.read_bytes())
            run = self.atria("inspect", copy, "--json")
            self.assertEqual((run.returncode, run.stdout), (0, wanted.stdout), run.stderr)

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

    def test_layers(self):
        out, report, case = self.folder / "layers.vtu", self.folder / "layers.json", self.folder / "layers"
        options = ["--layers", "1", "--layers", "Wall*=3:0.05:1.5", "--layers", "Site=0", "--report", report]
        run = self.atria("mesh", HOUSE, "-o", out, *COARSE, *options, "--openfoam", case)
        self.assertEqual(run.returncode, expected_status(json.loads(report.read_text())), run.stderr)
        self.assertIn("WallSouth", run.stdout)
        layers = {entry["surface"]: entry for entry in json.loads(report.read_text())["layers"]}
        self.assertEqual(layers["WallSouth"]["layers"], 3)
        self.assertEqual(layers["RoofSouth"]["layers"], 1)
        # None was asked for, but elements there may need one.
        self.assertEqual(layers.get("Site", {"layers": 0})["layers"], 0)
        for entry in layers.values():
            self.assertGreaterEqual(entry["covered"], entry["covered_in_full"])
            self.assertTrue(0.0 < entry["covered"] <= 1.0, entry)
        # The layer tapers to nothing at openings, which are many in faces of two meters.
        self.assertGreater(layers["Neighbor"]["covered"], 0.9)
        plain = self.atria("mesh", HOUSE, "-o", out, *COARSE, "--layers", "0", "--no-support", "--report", report)
        self.assertNotIn("covered", plain.stdout)
        self.assertEqual(json.loads(report.read_text())["layers"], [])
        self.refuses(3, "no surface matches 'Wal'", "mesh", HOUSE, "-o", out, *COARSE, "--layers", "Wal=1")

    def test_heights_by_y_plus(self):
        out, report = self.folder / "viscous.vtu", self.folder / "viscous.json"
        def layers(*options):
            run = self.atria("mesh", HOUSE, "-o", out, *COARSE, "--report", report, *options)
            self.assertIn(run.returncode, (0, 4, 5), run.stderr)
            return run.stdout, {entry["surface"]: entry for entry in json.loads(report.read_text())["layers"]}
        # 40 viscosities of air over a speed of 0.1: 6 mm for each y+.
        shown, by_y_plus = layers("--layers", "*=2", "--y-plus", "25", "--speed", "0.1")
        self.assertRegex(shown, r"thickness +y\+\n")
        roof = by_y_plus["RoofSouth"]
        self.assertAlmostEqual(roof["first_height"], 0.15, delta=0.015)
        self.assertAlmostEqual(roof["y_plus"], roof["first_height"] / 0.006, places=9)
        shown, without = layers("--layers", "*=2:0.15")
        self.assertAlmostEqual(without["RoofSouth"]["first_height"], roof["first_height"], places=5)
        self.assertNotIn("y+", shown)
        self.assertNotIn("y_plus", without["RoofSouth"])
        shown, bare = layers("--speed", "0.1")
        self.assertIn("y+", shown)
        self.assertGreater(bare["RoofSouth"]["y_plus"], roof["y_plus"])
        self.refuses(2, "--speed", "mesh", HOUSE, "-o", out, *COARSE, "--y-plus", "50")
        self.refuses(2, "--first-layer", "mesh", HOUSE, "-o", out, *COARSE, "--y-plus", "50", "--speed", "5", "--first-layer", "1")
        self.refuses(2, "--y-plus", "mesh", HOUSE, "-o", out, *COARSE, "--y-plus", "0", "--speed", "5")

    def test_preflight(self):
        report = self.folder / "preflight.json"
        run = self.atria("mesh", HOUSE, *COARSE, "--preflight", "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("BuildingHeight", run.stdout)
        self.assertIn("narrowest opening", run.stderr)
        data = json.loads(report.read_text())
        self.assertAlmostEqual(data["BuildingHeight"], 11)
        self.assertAlmostEqual(data["OpeningWidth"], 1.0)
        self.assertAlmostEqual(data["DomainZMax"], 68.1)
        self.assertAlmostEqual(data["Blockage"], (14 * 7 + 14 * 2) / (182 * 68.1), places=6)
        self.assertTrue(data["warnings"])
        # The filter itself warns, as ParaView shows nothing of a table's field arrays.
        self.assertEqual(run.stderr.count("warning:"), len(data["warnings"]), run.stderr)

    def test_domain_and_grid_options(self):
        turned = DATA / "house_turned17.wrl"
        report, out = self.folder / "turned.json", self.folder / "turned.vtu"
        run = self.atria("mesh", turned, "-o", out, "--automatic", "--wind", "30", "--align", "walls", "--size-max", "16",
                         "--size-mid", "4", "--size-min", "2", "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        areas = {patch["name"]: patch["area"] for patch in json.loads(report.read_text())["patches"]}
        self.assertAlmostEqual(areas["xMin"] / areas["xMax"], 1, places=2)
        self.refuses(2, "--automatic", "mesh", HOUSE, "-o", out, "--automatic", "--site", "Site")
        self.refuses(2, "--wind", "mesh", HOUSE, "-o", out, "--wind", "10", "--site", "Site")
        self.refuses(2, "--model-bounds", "mesh", HOUSE, "-o", out, "--model-bounds", "--site", "Site")
        self.refuses(2, "--domain-angle needs", "mesh", HOUSE, "-o", out, "--domain-angle", "10")
        self.refuses(2, "--domain-sides", "mesh", HOUSE, "-o", out, "--domain-sides", "2")
        self.refuses(2, "R must be above 0", "mesh", HOUSE, "-o", out, "--domain-cylinder", "0", "0", "0", "0", "5")
        self.refuses(2, "'1' is no corner", "mesh", HOUSE, "-o", out, "--domain-polygon", "0,0 1")
        self.refuses(2, "--domain-sides", "mesh", HOUSE, "-o", out, "--domain-polygon", "0,0 9,0 0,9", "--domain-sides", "3")
        self.refuses(2, "--domain-polygon", "mesh", HOUSE, "-o", out, "--domain-heights", "0", "9")
        self.refuses(2, "Z0 must be less", "mesh", HOUSE, "-o", out, "--domain-polygon", "0,0 9,0 0,9", "--domain-heights", "9", "0")
        self.refuses(3, "not convex at corner 3 (1, 1)", "mesh", HOUSE, "-o", out, "--domain-polygon", "0,0 9,0 1,1 0,9")
        self.refuses(2, "--align", "mesh", HOUSE, "-o", out, "--align", "roof")
        self.refuses(3, "dgm*", "mesh", HOUSE, "-o", out, "--terrain", "dgm*")

    def preflight(self, *options):
        report = self.folder / "domain.json"
        run = self.atria("mesh", *options, "--preflight", "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(report.read_text())

    def test_the_domain_follows_from_the_buildings_unless_it_is_given(self):
        sizes = COARSE[:6]
        plain = self.preflight(HOUSE, *sizes)
        self.assertEqual(plain, self.preflight(HOUSE, *sizes, "--automatic"))
        for side, heights in (("XMin", 5), ("XMax", 15), ("YMin", 5), ("YMax", 5), ("ZMax", 5)):
            self.assertAlmostEqual(plain["Distance" + side], heights)
        self.assertEqual(plain["DomainAngle"], 0)
        self.assertEqual(self.preflight(HOUSE, *sizes, "--wind", 20)["DomainAngle"], 20)
        bounds = self.preflight(HOUSE, *sizes, "--model-bounds")
        self.assertEqual([bounds["Domain" + side] for side in ("XMin", "XMax", "YMin", "YMax", "ZMin", "ZMax")],
                         [-90, 137, -84, 98, 0, 11])
        self.assertEqual(self.preflight(HOUSE, *sizes, "--model-bounds", "--domain-angle", 5)["DomainAngle"], 5)
        self.assertEqual((plain["DomainSides"], self.preflight(HOUSE, *sizes, "--domain-sides", 8)["DomainSides"]), (4, 8))
        cylinder = self.preflight(HOUSE, *sizes, "--domain-cylinder", 30, 5, 200, 0, 60)
        self.assertEqual(cylinder["DomainSides"], 16)
        triangle = self.preflight(HOUSE, *sizes, "--domain-polygon", "-90,-80 130,-70 20,95")
        self.assertEqual((triangle["DomainSides"], triangle["DomainXMin"], triangle["DomainYMax"]), (3, -90, 95))
        self.assertEqual((triangle["DomainZMin"], triangle["DomainZMax"]), (plain["DomainZMin"], plain["DomainZMax"]))
        self.assertEqual({name for name in triangle if name.startswith("DistanceDomainSide")},
                         {f"DistanceDomainSide{i}" for i in (1, 2, 3)})
        high = self.preflight(HOUSE, *sizes, "--domain-polygon", "-90,-80 130,-70 20,95", "--domain-heights", -1, 70)
        self.assertEqual((high["DomainZMin"], high["DomainZMax"]), (-1, 70))
        for side, wanted in (("XMin", -170), ("XMax", 230), ("YMin", -195), ("YMax", 205), ("ZMin", 0), ("ZMax", 60)):
            self.assertAlmostEqual(cylinder["Domain" + side], wanted, places=6)

    def test_a_room_is_meshed_by_its_bounds_or_by_a_seed(self):
        model = self.folder / "room.wrl"
        model.write_text("#VRML V2.0 utf8\nDEF Room Shape { geometry Box { size 8 6 3 } }\n")
        sizes = ["--size-max", "1", "--size-mid", "0.5", "--size-min", "0.5", "--layers", "0"]
        out, report = self.folder / "room.vtu", self.folder / "room.json"
        for options in (["--model-bounds"], ["--seed", "0", "0", "0"]):
            run = self.atria("mesh", model, *sizes, *options, "-o", out, "--report", report)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            zones = [zone for zone in json.loads(report.read_text())["zones"] if zone["kept"]]
            self.assertEqual(len(zones), 1)
            self.assertAlmostEqual(zones[0]["volume"], 8 * 6 * 3, places=6)

    def test_domains_that_do_not_suit_the_model_are_told(self):
        out, report = self.folder / "domain.vtu", self.folder / "domain.json"
        beside = ["--domain", 200, 300, 200, 300, 0, 50]
        self.refuses(3, "holds nothing of the model: it reaches x from 200 to 300", "mesh", HOUSE, *COARSE[:6], *beside, "-o", out)
        self.refuses(3, "holds nothing of the model", "mesh", HOUSE, *COARSE[:6], *beside, "--estimate")
        self.refuses(3, "holds nothing of the model", "mesh", HOUSE, *COARSE[:6], *beside, "--preflight")
        self.assertFalse(out.exists())
        through = ["--domain", -90, 137, -84, 98, 0, 8]
        run = self.atria("mesh", HOUSE, *COARSE[:6], *through, "-o", out, "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertEqual(run.stderr.count("cuts through surfaces at zMax"), 1)
        self.assertIn("'RoofSouth'", run.stderr)
        self.assertEqual(len(json.loads(report.read_text())["diagnostics"]["InputWarning"]), 1)
        self.assertIn("cuts through surfaces at zMax", self.atria("mesh", HOUSE, *COARSE[:6], *through, "--estimate").stderr)
        self.assertIn("cuts through surfaces at zMax", self.preflight(HOUSE, *COARSE[:6], *through)["warnings"][0])
        ridge = ["--domain", -90, 137, -84, 98, 0, 11]
        self.assertIn("without air between: zMax", self.preflight(HOUSE, *COARSE[:6], *ridge)["warnings"][0])

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

    def test_checks_that_thin_layers_fail_are_a_note(self):
        out, case, report = (self.folder / name for name in ("thin.vtu", "thin", "thin.json"))
        flat = ["--layers", "0", "--layers", "Site=2:0.05:1.2", *COARSE, "-o", out, "--openfoam", case, "--report", report]
        run = self.atria("mesh", HOUSE, *flat)
        data = json.loads(report.read_text())
        failing = {name for name, check in data["openfoam"]["checks"].items() if check["is_error"] and check["failing"]}
        self.assertIn("Determinant", failing)
        self.assertEqual(data["failing_by_thin_layers"], ["Determinant", "FaceWeight"])
        self.assertEqual(run.returncode, 5 if failing - {"Determinant", "FaceWeight"} else 0)
        self.assertIn("layers are so thin that Determinant and FaceWeight of checkMesh fail on any wall", run.stderr)

    def test_mesh_and_quality(self):
        out, patches, report = (self.folder / name for name in ("house.vtu", "house.vtpc", "house.json"))
        case = self.folder / "case"
        run = self.atria("mesh", HOUSE, "-o", out, *COARSE, "--patches", patches, "--report", report,
                         "--openfoam", case, "--threads", "2")
        self.assertNotIn("\r", run.stderr)
        data = json.loads(report.read_text())
        self.assertEqual(list(data), REPORT_KEYS)
        self.assertEqual(run.returncode, expected_status(data), run.stderr)
        for name, check in data["openfoam"]["checks"].items():
            fails = check["is_error"] and check["failing"] > 0
            self.assertEqual(f"check {name} fails" in run.stderr, fails, run.stderr)
            self.assertEqual(f"{name} at {check['failing']} " in run.stdout, fails, run.stdout)
            self.assertEqual(bool(check["advice"]), check["is_error"], name)
        counts = data["counts"]
        shapes = ["hexahedra", "wedges", "pyramids", "tetrahedra", "polyhedra"]
        self.assertEqual(list(counts), ["vertices", "elements", *shapes])
        self.assertEqual(sum(counts[shape] for shape in shapes), counts["elements"])
        self.assertEqual(sum(zone["elements"] for zone in data["zones"] if zone["kept"]), counts["elements"])
        self.assertLess(abs(sum(zone["volume"] for zone in data["zones"] if zone["kept"]) / (227 * 182 * 68.1) - 1), 0.01)
        areas = {patch["name"]: patch["area"] for patch in data["patches"]}
        self.assertAlmostEqual(areas["zMax"], 227 * 182, places=3)
        self.assertEqual(data["threads"], 2)
        self.assertGreater(data["peak_memory_bytes"], 10_000_000)
        self.assertTrue(patches.exists())
        self.assertTrue((case / "constant" / "polyMesh" / "faces").exists())

        again = self.atria("quality", out, "--json")
        self.assertEqual(again.returncode, 4 if data["invalid_elements"] else 0, again.stderr)
        measured = json.loads(again.stdout)
        self.assertEqual(measured["counts"], counts)
        self.assertEqual(measured["quality"]["CellSquish"], data["quality"]["CellSquish"])
        self.assertEqual(measured["quality"], data["quality"])
        parted = self.atria("quality", out, "--patches", patches, "--json")
        self.assertEqual(json.loads(parted.stdout)["quality"], data["quality"], parted.stderr)
        self.refuses(3, "atria mesh --patches", "quality", out, "--patches", out)

    def small_mesh(self):
        out = self.folder / "small.vtu"
        if not out.exists():
            self.assertIn(self.atria("mesh", HOUSE, "-o", out, *COARSE).returncode, (0, 4))
        return out

    def test_quality_judges_as_checkmesh_does(self):
        mesh = self.small_mesh()
        run = self.atria("quality", mesh, "--json", "--checks")
        report = json.loads(run.stdout)
        self.assertEqual(run.returncode, 4 if report["invalid_elements"] else 5 if report["failed_checks"] else 0)
        failed = [name for name, check in report["checks"].items() if check["is_error"] and check["failing"]]
        self.assertLessEqual(report["failed_checks"], len(failed))
        self.assertIn("Concavity", report["checks"])
        self.assertIn("Determinant", report["quality"])
        table = self.atria("quality", mesh, "--checks").stdout
        self.assertIn("failed checks of checkMesh -allGeometry: " + str(report["failed_checks"]), table)
        self.assertNotIn("checks", json.loads(self.atria("quality", mesh, "--json").stdout))

    def test_quality_extracts_the_worst(self):
        mesh, worst, all_worse = self.small_mesh(), self.folder / "worst.vtu", self.folder / "worse.vtu"
        run = self.atria("quality", mesh, "--worst", 5, "--metric", "NonOrthogonality", "--rings", 2, "-o", worst)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        content = worst.read_bytes()
        for name in (b"WorstRank", b"Ring", b"vtkOriginalCellIds", b"NonOrthogonality"):
            self.assertIn(b'Name="' + name, content)
        whole = json.loads(self.atria("quality", mesh, "--json").stdout)
        part = json.loads(self.atria("quality", worst, "--json").stdout)
        self.assertLess(part["counts"]["elements"], whole["counts"]["elements"])
        self.assertAlmostEqual(part["quality"]["NonOrthogonality"]["max"], whole["quality"]["NonOrthogonality"]["max"])
        run = self.atria("quality", mesh, "--beyond", 0.3, "--rings", 0, "-o", all_worse)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertGreater(json.loads(self.atria("quality", all_worse, "--json").stdout)["quality"]["CellSquish"]["min"], 0.3)
        self.refuses(2, "--output", "quality", mesh, "--worst", 5)
        self.refuses(2, "--beyond", "quality", mesh, "--worst", 5, "--beyond", 1, "-o", worst)
        self.refuses(3, "CellSquish", "quality", mesh, "--worst", 5, "--metric", "Beauty", "-o", worst)
        run = self.atria("improve", worst, "-o", self.folder / "few.vtu", "--openfoam", self.folder / "few")
        self.assertIn("names of the patches are lost", run.stderr)

    def test_improve_moves_points_and_tells(self):
        mesh, patches = self.folder / "rough.vtu", self.folder / "rough.vtpc"
        better, patches_then, case = self.folder / "better.vtu", self.folder / "better.vtpc", self.folder / "better"
        run = self.atria("mesh", HOUSE, "-o", mesh, "--patches", patches, *COARSE)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        strict = ["--squish", 0.5, "--non-orthogonality", 40]
        run = self.atria("improve", mesh, "--patches", patches, "-o", better, "--patches-output", patches_then,
                         "--openfoam", case, "--json", *strict)
        report, warnings, status = json.loads(run.stdout), run.stderr, run.returncode
        failed = [name for name, check in report["openfoam"]["checks"].items() if check["is_error"] and check["failing"]]
        self.assertEqual(status, 4 if report["after"]["invalid_elements"] else 5 if failed else 0, warnings)
        self.assertEqual(len(warnings.splitlines()), len(failed), warnings)
        for name in failed:
            self.assertIn(f"check {name} fails", warnings)
        before, after = report["before"], report["after"]
        self.assertGreater(report["moved_points"], 0)
        self.assertLess(after["poor_elements"], before["poor_elements"])
        self.assertLessEqual(after["invalid_elements"], before["invalid_elements"])
        for metric in ("CellSquish", "FaceSquish", "NonOrthogonality"):
            self.assertLessEqual(after["quality"][metric]["max"], before["quality"][metric]["max"] + 1e-9)
        measured = json.loads(self.atria("quality", better, "--patches", patches_then, "--json").stdout)
        self.assertEqual(measured["quality"], after["quality"])
        self.assertTrue((case / "constant" / "polyMesh" / "points").exists())
        again = self.folder / "again.vtu"
        table = self.atria("improve", mesh, "--patches", patches, "-o", again, "--threads", 1, *strict)
        self.assertIn("points moved", table.stdout)
        self.assertEqual(again.read_bytes(), better.read_bytes())
        self.refuses(2, "--output", "improve", mesh)
        self.refuses(2, ".vtu", "improve", mesh, "-o", self.folder / "better.vtk")
        alone = self.folder / "alone"
        run = self.atria("improve", mesh, "-o", again, "--openfoam", alone, *strict)
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertEqual(run.stderr.replace(str(alone), str(case)), warnings)
        self.assertEqual(again.read_bytes(), better.read_bytes())
        for name in ("points", "faces", "owner", "neighbour", "boundary"):
            self.assertEqual((alone / "constant/polyMesh" / name).read_bytes(), (case / "constant/polyMesh" / name).read_bytes())
        self.assertIn("WallSouth_front", (alone / "constant/polyMesh/boundary").read_text())
        self.refuses(2, "--patches", "improve", mesh, "-o", again, "--patches-output", patches_then)
        self.refuses(2, "--squish", "improve", mesh, "-o", again, "--squish", 2)
        self.refuses(3, "does not exist", "improve", self.folder / "absent.vtu", "-o", again)

    def test_quality_is_drawn_without_a_display(self):
        mesh, page, image = self.small_mesh(), self.folder / "plot.html", self.folder / "plot.png"
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        run = subprocess.run([ATRIA, "quality", mesh, "--plot", page, "--plot", image], capture_output=True, text=True,
                             check=False, env=environment)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        metrics = json.loads(self.atria("quality", mesh, "--json").stdout)["quality"]
        text = page.read_text()
        charts = re.findall(r"<svg.*?</svg>", text, re.DOTALL)
        self.assertEqual(len(charts), len(metrics))
        for chart, name in zip(charts, metrics):
            drawing = xml.etree.ElementTree.fromstring(chart)
            self.assertIn(name, "".join(drawing.itertext()))
            bars = [e for e in drawing if e.tag.endswith("rect")]
            self.assertEqual(len(bars), 50)
            bottoms = {round(float(bar.get("y")) + float(bar.get("height")), 1) for bar in bars}
            self.assertLessEqual(max(bottoms) - min(bottoms), 0.2)
            cdf = [e for e in drawing if e.tag.endswith("polyline")][-1].get("points").split()
            heights = [float(point.split(",")[1]) for point in cdf]
            self.assertEqual(heights, sorted(heights, reverse=True))
        self.assertNotIn("http", text.replace("http://www.w3.org/2000/svg", ""))
        data = image.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", data[16:24])
        self.assertGreater(width, 1000)
        self.assertGreater(height, 1000)
        self.refuses(2, ".html", "quality", mesh, "--plot", self.folder / "plot.jpg")
        self.refuses(2, "does not exist", "quality", mesh, "--plot", self.folder / "absent" / "plot.png")

    def test_same_mesh_from_any_number_of_threads(self):
        files = []
        for threads in ("1", "3"):
            files.append(self.folder / f"threads{threads}.vtu")
            run = self.atria("mesh", HOUSE, "-o", files[-1], *COARSE, "--threads", threads)
            self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertEqual(*(self.without_seconds(file) for file in files))

    def without_seconds(self, file):
        """Counts and metrics to the last digit. (The files differ in the seconds they hold.)"""
        return self.atria("quality", file, "--json").stdout

    def elements_estimated(self, *options):
        run = self.atria("mesh", HOUSE, *COARSE, *options, "--estimate")
        self.assertEqual(run.returncode, 0, run.stderr)
        return int(run.stdout.split("elements: ")[1].split()[0]), run

    def test_estimate_is_the_mesh_of_all_zones(self):
        options = ["--zone", "all", "--size", "Wall*", "1:0.5", "--size", "Roof*", "2", "--refine-box", *"-1 1 -1 1 0 2 1".split(),
                   "--refine-near", "Neighbor", "3", "2", "--curvature-angle", "20", "--gap-cells", "2", "--cells-per-level", "2"]
        report = self.folder / "estimate.json"
        out = self.folder / "estimate.vtu"
        elements, run = self.elements_estimated(*options)
        plain = ["--layers", "0", "--no-support"]
        self.assertIn(self.atria("mesh", HOUSE, *COARSE, *options, *plain, "-o", out, "--report", report).returncode, (0, 4))
        self.assertEqual(json.loads(report.read_text())["counts"]["elements"], elements)
        self.assertIn("memory: about", run.stdout)
        sizes = [float(line.split()[1]) for line in run.stdout.splitlines() if line[:5].strip().isdigit()]
        self.assertEqual(sizes[-1], 0.5)
        plain, _ = self.elements_estimated()
        self.assertGreater(elements, plain)

    def test_max_elements_is_kept_to_and_said(self):
        size = ["--size", "*", "0.5:0.25"]
        wanted, _ = self.elements_estimated(*size)
        limit = wanted // 2
        report = self.folder / "limit.json"
        run = self.atria("mesh", HOUSE, *COARSE, *size, "--max-elements", limit, "--layers", "0", "-o", self.folder / "limit.vtu", "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertIn(f"--max-elements {limit}", run.stderr)
        written = json.loads(report.read_text())
        self.assertLessEqual(written["counts"]["elements"], limit)
        self.assertIn(f"--max-elements {limit}", written["diagnostics"]["SizingWarning"][0])
        estimated, run = self.elements_estimated(*size, "--max-elements", limit)
        self.assertLessEqual(estimated, limit)
        self.assertIn(f"--max-elements {limit}", run.stderr)

    def test_a_budget_keeps_the_tower_and_coarsens_the_far_field(self):
        """Sizes on the tower are as requested; the warning gives options that make the same mesh."""
        model = self.folder / "tower.obj"
        corners = [(x, y, z) for z in (0, 100) for y in (0, 20) for x in (0, 20)]
        faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
        model.write_text("o Tower\n" + "".join("v %g %g %g\n" % c for c in corners) + "".join("f %d %d %d %d\n" % f for f in faces))
        sizes = ["--size-min", "1", "--size-mid", "2", "--layers", "0"]

        def made(*options):
            out, report = self.folder / "tower.vtu", self.folder / "tower.json"
            run = self.atria("mesh", model, *sizes, *options, "-o", out, "--report", report)
            self.assertIn(run.returncode, (0, 4), run.stderr)
            written = json.loads(report.read_text())
            faces = {patch["name"]: patch["faces"] for patch in written["patches"]}
            return written["counts"]["elements"], faces["Tower"], run.stderr

        elements, faces, told = made("--size-max", "8", "--max-elements", 300000)
        self.assertLessEqual(elements, 300000)
        self.assertGreater(faces, 2000)
        options = re.search(r"--size-max (\S+) instead of 8;", told)
        self.assertIsNotNone(options, told)
        again = made("--size-max", options.group(1))
        self.assertEqual((elements, faces), again[:2])
        self.assertNotIn("--max-elements", again[2])
        fewest = made("--size-max", "8", "--max-elements", 15000)
        self.assertLessEqual(fewest[0], 15000)
        self.assertRegex(fewest[2], r"--size-mid \d+ instead of 2")

    def test_sizes_beyond_the_memory_are_refused_at_once(self):
        """Either would run for hours, and fill any machine."""
        fine = ["--size-max", "8", "--size-mid", "0.001", "--size-min", "0.001", "--site", "Site"]
        out = self.folder / "fine.vtu"
        self.refuses(3, "raise --size-min and --size-mid", "mesh", HOUSE, *fine, "-o", out)
        self.assertFalse(out.exists())
        run = self.atria("mesh", HOUSE, *fine, "--estimate")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("warning: the sizes asked for make about", run.stderr)
        self.assertGreater(int(run.stdout.split("elements: ")[1].split()[0]), 1e9)
        self.assertRegex(run.stdout, r"memory: about \d{2,} GB or more")
        report = self.folder / "fine.json"
        run = self.atria("mesh", HOUSE, *fine, "--preflight", "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("--memory-limit", json.loads(report.read_text())["warnings"][0])
        self.refuses(3, "there are 0.001 GB", "mesh", HOUSE, *COARSE, "-o", out, "--memory-limit", "0.001")
        self.refuses(3, "fewer layers", "mesh", HOUSE, *COARSE, "-o", out, "--layers", "90", "--memory-limit", "0.05")
        self.refuses(2, "--memory-limit", "mesh", HOUSE, *COARSE, "-o", out, "--memory-limit", "0")

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

    def test_what_ulimit_allows_is_the_memory_there_is(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_DATA, (6_000_000_000, 6_000_000_000))
        run = subprocess.run([ATRIA, "mesh", HOUSE, "-o", self.folder / "fine.vtu", "--site", "Site", "--size-mid", "0.01",
                              "--size-min", "0.01"], capture_output=True, text=True, check=False, preexec_fn=limit)
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertIn("there are 6 GB", run.stderr)

    def test_sizes_of_unknown_surfaces_are_refused(self):
        self.refuses(3, "WallSouth", "mesh", HOUSE, "-o", self.folder / "out.vtu", "--size", "Wand*", "1")
        self.refuses(3, "WallSouth", "mesh", HOUSE, "--estimate", "--refine-near", "Wand*", "1", "1")
        self.refuses(3, "domain", "mesh", HOUSE, "--estimate", "--refine-box", *"900 901 0 1 0 1 1".split())

    def test_seeds_may_be_repeated(self):
        out, report = self.folder / "seeds.vtu", self.folder / "seeds.json"
        run = self.atria("mesh", "--seed", "-20", "-20", "10", "--seed", "12", "7", "2", HOUSE, "-o", out, *COARSE,
                         "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertGreater(json.loads(report.read_text())["counts"]["elements"], 1000)

    def test_what_is_left_out_at_lateral_sides_is_warned_of(self):
        model, out, report = (self.folder / name for name in ("terrain.wrl", "terrain.vtu", "terrain.json"))
        model.write_text("""#VRML V2.0 utf8
DEF Terrain Shape { geometry IndexedFaceSet {
  coord Coordinate { point [ -30 -30 6, 30 -30 7, 30 30 9, -30 30 8 ] } coordIndex [ 0 1 2 3 -1 ] } }
""")
        run = self.atria("mesh", model, "-o", out, "--report", report, "--domain", -20, 20, -20, 20, 0, 30)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        kept, left_out = json.loads(report.read_text())["zones"]
        self.assertTrue(kept["kept"])
        self.assertFalse(left_out["kept"])
        self.assertEqual(left_out["surfaces"], ["Terrain"])
        seed = re.search("--seed (\\S+) (\\S+) ([^\\s;,]+)", run.stderr).groups()
        for said, inside in zip(seed, left_out["inside"]):
            self.assertAlmostEqual(float(said), inside, delta=0.01)
        run = self.atria("mesh", model, "-o", out, "--report", report, "--domain", -20, 20, -20, 20, 0, 30, "--layers", 0,
                         "--no-support", "--seed", *seed)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertNotIn("left out", run.stderr)
        self.assertEqual(json.loads(report.read_text())["counts"]["elements"], left_out["elements"])

    def test_rooms_that_nothing_opens_are_told_with_a_seed(self):
        model, out, report = (self.folder / name for name in ("rooms.wrl", "rooms.vtu", "rooms.json"))
        sheet = "DEF %s Shape { geometry IndexedFaceSet { coord Coordinate { point [ %s ] } coordIndex [ 0 1 2 3 ] } }\n"
        corners = [(x, y, z) for z in (0, 4) for y in (0, 6) for x in (0, 8)]
        sides = {"Floor": (0, 1, 3, 2), "Roof": (4, 5, 7, 6), "South": (0, 1, 5, 4), "North": (2, 3, 7, 6),
                 "West": (0, 2, 6, 4), "East": (1, 3, 7, 5)}
        def room(prefix, left_out=()):
            # A wall stands 2 cm apart: what is closed as drawn is taken for a solid.
            shift = {"West": -0.02}
            return "".join(sheet % (prefix + name, ", ".join(
                               "%g %d %d" % (corners[i][0] + shift.get(name, 0), *corners[i][1:]) for i in side))
                           for name, side in sides.items() if name not in left_out)
        model.write_text("#VRML V2.0 utf8\n" + room("") + "Transform { translation 0 20 0 children [ " + room("Open", ["East"]) +
                         "] }\nTransform { translation 20 0 2 children DEF Block Shape { geometry Box { size 6 6 4 } } }\n")
        options = [model, "-o", out, "--report", report, "--size-max", "4", "--size-mid", "1", "--size-min", "1",
                   "--domain", -20, 40, -20, 40, -4, 24]
        run = self.atria("mesh", *options)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        (warning,) = [line for line in run.stderr.splitlines() if "closed space" in line]
        (note,) = [line for line in run.stderr.splitlines() if "insides of solids" in line]
        self.assertIn("atria: warning: ", warning)
        self.assertIn("left out: 1 (", note)
        self.assertIn("the largest of Block", note)
        self.assertIn("atria: note: ", note)
        left_out = {zone["kind"]: zone for zone in json.loads(report.read_text())["zones"] if not zone["kept"]}
        self.assertEqual(set(left_out), {"room", "solid"})
        self.assertEqual(set(left_out["room"]["surfaces"]), set(sides))
        self.assertAlmostEqual(left_out["room"]["rough_volume"], 8 * 6 * 4, delta=0.3 * 8 * 6 * 4)
        self.assertIn("%d elements, about %.3g m3" % (left_out["room"]["elements"], left_out["room"]["rough_volume"]), warning)
        seed = warning.split("--seed ")[1].split()
        self.assertEqual([float(x) for x in seed], left_out["room"]["inside"])
        run = self.atria("mesh", *options, "--layers", 0, "--seed", *seed)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertNotIn("left out", run.stderr)
        (kept,) = [zone for zone in json.loads(report.read_text())["zones"] if zone["kept"]]
        self.assertEqual(kept["kind"], "room")
        self.assertNotIn("left out", self.atria("mesh", *options, "--zone", "all").stderr)

    def test_a_leak_is_a_warning_that_names_place_and_surfaces(self):
        out, report = self.folder / "leak.vtu", self.folder / "leak.json"
        run = self.atria("mesh", "--sealed-seed", "12", "7", "2", HOUSE, "-o", out, *FINE, "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertIn("atria: warning: ", run.stderr)
        self.assertIn("should be sealed", run.stderr)
        data = json.loads(report.read_text())
        (leak,) = data["leaks"]
        self.assertEqual(leak["seed"], [12, 7, 2])
        self.assertGreater(leak["width"], 0)
        self.assertTrue(leak["surfaces"])
        self.assertIn(leak["surfaces"][0], run.stderr)
        self.assertEqual(data["diagnostics"]["LeakPath"], 1)
        self.refuses(3, "sealed seed", "mesh", "--sealed-seed", "0", "0", "999", HOUSE, "-o", out, *COARSE)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
