# SPDX-License-Identifier: GPL-3.0-or-later
"""A district on its site, small; and at a kilometer's length where ATRIA_TEST_FULL is set.

Usage: test_site.py ATRIA FOLDER_OF_MODELS
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ATRIA, DATA = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def model(self, *options):
        run = subprocess.run([sys.executable, DATA / "make_site.py", *options, self.folder], capture_output=True, text=True, check=True)
        file, buildings = re.fullmatch(r"(.*): (\d+) buildings\n", run.stdout).groups()
        return file, int(buildings)

    def atria(self, model, *options):
        report = self.folder / "report.json"
        command = [ATRIA, "mesh", model, *map(str, options), "--report", report]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        return json.loads(report.read_text())

    def check(self, model, buildings, size, sizes):
        """A mesh of the site's domain: every name is a patch, details have two sides, the inside of buildings is left out."""
        surfaces = {s["name"]: s for s in json.loads(
            subprocess.run([ATRIA, "inspect", model, "--json"], capture_output=True, text=True, check=True).stdout)["surfaces"]}
        options = ["--site", "Site", "--size-max", sizes[0], "--size-mid", sizes[1], "--size-min", sizes[2]]
        preflight = self.atria(model, *options, "--preflight")
        height = 0.3 * max(size)
        self.assertAlmostEqual(preflight["DomainZMax"], height, places=6)
        data = self.atria(model, *options, "--layers", 0, "--no-support", "-o", self.folder / "site.vtu")
        areas = {patch["name"]: patch["area"] for patch in data["patches"]}
        self.assertAlmostEqual(areas["zMax"], size[0] * size[1], delta=1e-6 * size[0] * size[1])
        details = [name for name in surfaces if name.startswith(("Canopy", "Screen"))]
        self.assertGreater(len(details), 4)
        self.assertEqual(sum(name.startswith(("House", "Building")) for name in surfaces), buildings)
        for name in surfaces:
            for patch in ([name + "_front", name + "_back"] if name in details else [name]):
                self.assertIn(patch, areas)
        # The air and the buildings, which stand on the part of the site that is not in the mesh, fill the domain.
        air = sum(zone["volume"] or 0 for zone in data["zones"])
        footprints = size[0] * size[1] - areas["Site"]
        self.assertLess(air, size[0] * size[1] * height - 5.0 * footprints)
        self.assertGreater(air, size[0] * size[1] * height - 60.0 * footprints)
        self.assertLess(data["invalid_elements"], 0.005 * data["counts"]["elements"])
        # Octants are counted, those inside of buildings too, and no layers.
        self.assertLess(abs(data["counts"]["elements"] / preflight["EstimatedElements"] - 1), 0.1)
        return data

    def test_small(self):
        model, buildings = self.model("--small")
        self.check(model, buildings, (240, 300), (8, 4, 1))

    def test_the_same_model_every_time(self):
        first = pathlib.Path(self.model("--small")[0]).read_bytes()
        self.assertEqual(first, pathlib.Path(self.model("--small")[0]).read_bytes())

    def test_small_in_an_automatic_domain_along_the_turned_blocks(self):
        model, _ = self.model("--small")
        data = self.atria(model, "--automatic", "--wind", "20", "--size-max", "16", "--size-mid", "8", "--size-min", "2",
                          "-o", self.folder / "site.vtu")
        plan = self.atria(model, "--automatic", "--wind", "20", "--size-max", "16", "--size-mid", "8", "--size-min", "2", "--preflight")
        self.assertAlmostEqual(plan["DistanceXMin"], 5)
        self.assertAlmostEqual(plan["DistanceXMax"], 15)
        self.assertLessEqual(plan["Blockage"], 0.03 * (1 + 1e-9))
        areas = {patch["name"]: patch["area"] for patch in data["patches"]}
        section = (plan["DomainYMax"] - plan["DomainYMin"]) * (plan["DomainZMax"] - plan["DomainZMin"])
        self.assertAlmostEqual(areas["xMin"] / section, 1, places=3)
        self.assertAlmostEqual(areas["xMax"] / section, 1, places=3)

    @unittest.skipUnless(os.environ.get("ATRIA_TEST_FULL"), "long")
    def test_a_kilometer(self):
        model, buildings = self.model()
        self.assertGreater(buildings, 200)
        for sizes, most in (((16, 4, 1), 1.5e6), ((8, 8, 1), 4e6)):
            data = self.check(model, buildings, (1343, 1692), sizes)
            self.assertLess(data["counts"]["elements"], most)
            print(sizes, data["counts"]["elements"], data["seconds"], data["peak_memory_bytes"], file=sys.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
