# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command line writes, prints and returns.

Usage: test_command_line.py ATRIA FOLDER_OF_MODELS
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ATRIA = pathlib.Path(sys.argv[1])
DATA = pathlib.Path(sys.argv[2])
HOUSE = DATA / "house.wrl"
COARSE = ["--size-max", "16", "--size-mid", "4", "--size-min", "2", "--site", "Site"]
REPORT_KEYS = [
    "counts", "zones", "patches", "quality", "invalid_elements", "max_level", "seconds", "peak_memory_bytes",
    "threads", "diagnostics",
]


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
        self.assertTrue(run.stderr.startswith("atria: error: "), run.stderr)
        self.assertIn(text, run.stderr)
        self.assertNotIn("\r", run.stderr)

    def test_help_is_no_error(self):
        for arguments in (["--help"], ["mesh", "--help"], ["inspect", "--help"], ["quality", "--help"], ["--version"]):
            run = self.atria(*arguments)
            self.assertEqual((run.returncode, run.stderr), (0, ""), arguments)

    def test_usage_errors(self):
        out = self.folder / "out.vtu"
        self.refuses(2, "subcommand")
        self.refuses(2, "--output", "mesh", HOUSE)
        self.refuses(2, "--size-min", "mesh", HOUSE, "-o", out, "--size-min", "-1")
        self.refuses(2, "sizes", "mesh", HOUSE, "-o", out, "--size-mid", "16")
        self.refuses(2, "--domain", "mesh", HOUSE, "-o", out, "--domain", "1", "0", "0", "1", "0", "1")
        self.refuses(2, "--site", "mesh", HOUSE, "-o", out, "--site", "Site", "--domain", "0", "1", "0", "1", "0", "1")
        self.refuses(2, "--zone", "mesh", HOUSE, "-o", out, "--zone", "inside")
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

    def test_the_same_files_whatever_the_threads(self):
        written = []
        for threads in (1, 2, 7):
            out = self.folder / f"threads{threads}.vtu"
            self.assertIn(self.atria("mesh", HOUSE, "-o", out, "--site", "Site", "--threads", threads).returncode, (0, 4))
            written.append(out.read_bytes())
        self.assertEqual(written[0], written[1])
        self.assertEqual(written[0], written[2])

    def test_inspect(self):
        report = json.loads(self.atria("inspect", HOUSE, "--json").stdout)
        surfaces = {surface["name"]: surface for surface in report["surfaces"]}
        self.assertEqual(len(surfaces), 13)
        self.assertAlmostEqual(surfaces["WallSouth"]["area"], 24 * 7 - 4 * 3, places=9)
        self.assertEqual(surfaces["Site"]["bounds"], [-90, 137, -84, 98, 0, 0])
        self.assertEqual(surfaces["Neighbour"]["open_edges"], 0)
        self.assertEqual(surfaces["Site"]["open_edges"], 4)
        self.assertGreater(report["total"]["non_manifold_edges"], 0)
        table = self.atria("inspect", HOUSE)
        self.assertEqual((table.returncode, table.stderr), (0, ""))
        self.assertIn("PartitionB", table.stdout)

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

    def test_mesh_and_quality(self):
        out, patches, report = (self.folder / name for name in ("house.vtu", "house.vtpc", "house.json"))
        case = self.folder / "case"
        run = self.atria("mesh", HOUSE, "-o", out, *COARSE, "--patches", patches, "--report", report,
                         "--openfoam", case, "--threads", "2")
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertNotIn("\r", run.stderr)
        data = json.loads(report.read_text())
        self.assertEqual(list(data), REPORT_KEYS)
        self.assertEqual(run.returncode, 4 if data["invalid_elements"] else 0)
        counts = data["counts"]
        shapes = ["hexahedra", "wedges", "pyramids", "tetrahedra", "polyhedra"]
        self.assertEqual(list(counts), ["vertices", "elements", *shapes])
        self.assertEqual(sum(counts[shape] for shape in shapes), counts["elements"])
        self.assertEqual(sum(zone["elements"] for zone in data["zones"]), counts["elements"])
        self.assertLess(abs(sum(zone["volume"] for zone in data["zones"]) / (227 * 182 * 68.1) - 1), 0.01)
        areas = {patch["name"]: patch["area"] for patch in data["patches"]}
        self.assertAlmostEqual(areas["zMax"], 227 * 182, places=3)
        self.assertEqual(data["threads"], 2)
        self.assertGreater(data["peak_memory_bytes"], 10_000_000)
        self.assertTrue(patches.exists())
        self.assertTrue((case / "constant" / "polyMesh" / "faces").exists())

        again = self.atria("quality", out, "--json")
        self.assertEqual(again.returncode, run.returncode, again.stderr)
        measured = json.loads(again.stdout)
        self.assertEqual(measured["counts"], counts)
        self.assertEqual(measured["quality"]["CellSquish"], data["quality"]["CellSquish"])

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

    def test_seeds_may_be_repeated(self):
        out, report = self.folder / "seeds.vtu", self.folder / "seeds.json"
        run = self.atria("mesh", "--seed", "-20", "-20", "10", "--seed", "12", "7", "2", HOUSE, "-o", out, *COARSE,
                         "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertGreater(json.loads(report.read_text())["counts"]["elements"], 1000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
