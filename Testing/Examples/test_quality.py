# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers, quality and the improver: reports, exit status, pictures.

Usage: test_quality.py ATRIA FOLDER_OF_MODELS
"""

import json
import os
import re
import struct
import subprocess
import sys
import unittest
import xml.etree.ElementTree

from command_line import ATRIA, COARSE, expected_status, HOUSE, CommandLineTest

REPORT_KEYS = [
    "counts", "zones", "rooms", "openings", "leaks", "patches", "quality", "invalid_elements", "max_level", "seconds",
    "peak_memory_bytes", "threads", "repair", "hidden_detail", "layers", "failing_by_thin_layers", "audit", "left_out_elements", "diagnostics", "openfoam",
]


class Quality(CommandLineTest):
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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
