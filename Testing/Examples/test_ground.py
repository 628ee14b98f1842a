# SPDX-License-Identifier: GPL-3.0-or-later
"""Models whose ground has to be found: houses on different bases, a slab, a site of IFC that is a block.

Usage: test_ground.py ATRIA FOLDER_OF_MODELS
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ATRIA, DATA = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])


class Ground(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def mesh(self, model, *options):
        """The report, and what was printed beside it."""
        report = self.folder / "report.json"
        command = [ATRIA, "mesh", DATA / model, "-o", self.folder / "mesh.vtu", "--report", report, *map(str, options)]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        return json.loads(report.read_text()), run.stderr

    def plan(self, model, *options):
        report = self.folder / "plan.json"
        subprocess.run([ATRIA, "mesh", DATA / model, "--preflight", "--report", report, *map(str, options)],
                       capture_output=True, text=True, check=True)
        return json.loads(report.read_text())

    def areas(self, report):
        return {patch["name"]: patch["area"] for patch in report["patches"]}

    def bottom(self, model, *options):
        """Area of the domain's bottom."""
        plan = self.plan(model, *options)
        return (plan["DomainXMax"] - plan["DomainXMin"]) * (plan["DomainYMax"] - plan["DomainYMin"])

    def check_footprint(self, model, ground, footprint, *options):
        report, told = self.mesh(model, *options)
        areas = self.areas(report)
        covered = self.bottom(model, *options) - sum(areas.get(name, 0.0) for name in ground)
        self.assertAlmostEqual(covered, footprint, delta=0.005 * footprint)
        return report, told

    SIZES = ("--size-min", 0.5, "--size-mid", 1, "--size-max", 8)

    def test_houses_on_different_bases_are_let_down(self):
        report, told = self.check_footprint("houses-different-bases.obj", ["zMin"], 300, *self.SIZES)
        self.assertIn("2 bodies that hover were let down to the ground at z = 1 m: 'C' by 1.8 m and 'B' by 0.4 m", told)
        self.assertIn("--ground-snap", told)
        self.assertEqual(len(report["diagnostics"]["InputNote"]), 1)
        self.assertEqual(report["diagnostics"]["InputWarning"], [])
        areas = self.areas(report)
        for name, height in (("A", 8.0), ("B", 8.4), ("C", 9.8)):
            self.assertAlmostEqual(areas[name], 100 + 40 * height, delta=0.005 * areas[name])

    def test_without_letting_down_they_are_warned_of(self):
        _, told = self.mesh("houses-different-bases.obj", *self.SIZES, "--ground-snap", 0)
        self.assertIn("'B' by 0.4 m", told)
        self.assertIn("'C' by 1.8 m", told)
        self.assertNotIn("GroundSnapRatio", told)

    def test_a_slabs_upper_side_is_the_ground(self):
        for named in (["--ground", "Base"], []):
            with self.subTest(named=named):
                options = (*named, "--size-min", 1, "--size-mid", 2, "--size-max", 16)
                report, told = self.check_footprint("box-on-closed-slab.obj", ["zMin", "Base"], 100, *options)
                self.assertIn("'Base' is ground drawn as a solid", told)
                self.assertAlmostEqual(self.areas(report)["Base"], 9900, delta=50)
                self.assertAlmostEqual(self.plan("box-on-closed-slab.obj", *options)["BuildingHeight"], 20)

    def test_the_site_of_ifc_is_the_ground(self):
        report, _ = self.check_footprint("ifc-site-is-a-block.ifc", ["zMin", "IfcSite_Ground"], 1.8,
                                         "--size-min", 0.1, "--size-mid", 0.3, "--size-max", 2)
        self.assertAlmostEqual(self.areas(report)["IfcSite_Ground"], 400 - 1.8, delta=0.5)
        plan = self.plan("ifc-site-is-a-block.ifc")
        self.assertAlmostEqual(plan["BuildingHeight"], 3, places=5)
        self.assertAlmostEqual(plan["DomainZMin"], 0, places=5)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
