# SPDX-License-Identifier: GPL-3.0-or-later
"""Grounds of cases: roughness lengths by name, and how the wind's profile changes before the buildings.

Usage: test_profile.py ATRIA
"""

import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from atria.report import Case
from box_mesh import BOX, BoxCase, write_box

ATRIA = pathlib.Path(sys.argv[1])
HAVE_OPENFOAM = shutil.which("simpleFoam") is not None and shutil.which("blockMesh") is not None
# Patches of the ground that a model would have: lawn, a road across and a yard behind it.
GROUNDS = ("lawn", "lawn", "road", "yard", "yard")


def ground_of(side, cell):
    return GROUNDS[cell[0] * len(GROUNDS) // 20] if side == "zMin" else side


def fine_below(point):
    """Cells that are finer at the ground: the first is 0.56 m high, 0.28 m of it below its center."""
    x, y, z = point
    return x, y, 40.0 * (0.05 * z / 40.0 + 0.95 * (z / 40.0) ** 2)


class Profiles(BoxCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        write_box(cls.folder / "site", (20, 8, 16), BOX, patch_of=ground_of, turned=fine_below)
        cls.site = cls.folder / "site"

    def atria(self, *arguments):
        return subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)

    def case(self, name, *arguments, mesh=None):
        folder = self.folder / name
        run = self.atria("case", mesh or self.site, "-o", folder, *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return folder, run.stderr

    def described(self, folder):
        return json.loads((folder / "case.json").read_text())["directions"]

    def roughness_of(self, folder, patch):
        block = re.search(rf"^    {patch}\n    {{\n(.*?)^    }}", (folder / "0/nut").read_text(), re.DOTALL | re.MULTILINE)
        return re.search(r"z0 +uniform (\S+);", block[1])[1]

    def test_grounds_by_name(self):
        folder, messages = self.case("grounds", "--roughness", "0.1", "--ground", "*a*d", "0.07", "--ground", "lawn", "crops",
                                     "--ground", "road", "grass")
        self.assertEqual(messages, "")
        self.assertEqual([self.roughness_of(folder, patch) for patch in ("lawn", "road", "yard")], ["0.1", "0.03", "0.07"])
        direction = self.described(folder)[0]
        self.assertEqual([direction["patches"][patch] for patch in ("lawn", "road", "yard")], ["ground"] * 3)
        self.assertEqual(direction["roughness_lengths"], {"lawn": 0.1, "road": 0.03, "yard": 0.07})
        self.assertIn("z0              uniform 0.1;", (folder / "0/U").read_text())  # of the inlet

    def test_what_is_refused(self):
        for ground, text in ((("lawn", "gras"), "did you mean 'grass'?"), (("lawm", "grass"), "did you mean 'lawn'?"),
                             (("lawn", "-1"), "not above 0"), (("lawn", "moon"), "water, smooth, grass, crops")):
            run = self.atria("case", self.site, "-o", self.folder / "no", "--ground", *ground)
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertIn(text, run.stderr)
            self.assertFalse((self.folder / "no").exists())

    def test_warnings(self):
        _, messages = self.case("rougher", "--roughness", "0.03", "--ground", "lawn", "city")
        self.assertIn("too low for the roughness length of 'lawn' (2 m)", messages)
        self.assertIn("on average, the wind's profile one of 0.03 m", messages)
        self.assertIn("set --roughness to 0.", messages)
        _, messages = self.case("high", "--roughness", "0.03", "--ground", "lawn", "20")
        self.assertIn("'lawn' (20 m) is more than the wind's reference height, 10 m", messages)

    def test_config(self):
        config = self.folder / "ground.toml"
        run = self.atria("case", "--write-config", config, "--ground", "lawn", "grass", "--ground", "road", "0.02", "--check-profile")
        self.assertEqual(run.returncode, 0, run.stderr)
        folder, _ = self.case("config", "--config", config)
        self.assertEqual(self.described(folder)[0]["roughness_lengths"], {"lawn": 0.03, "road": 0.02})
        self.assertTrue((folder / "empty_domain/system/blockMeshDict").exists())

    def test_each_direction_has_an_empty_domain(self):
        folder, _ = self.case("rose", "--rose", "4", "--check-profile")
        for direction in self.described(folder):
            inside = direction["folder"] + "/empty_domain"
            length = 100.0 if direction["from"] in (90.0, 270.0) else 40.0
            self.assertAlmostEqual(direction["empty_domain"]["length"], length)
            self.assertIn("empty_domain/Allrun", (folder / direction["folder"] / "Allrun").read_text())
            self.assertTrue((folder / inside / "system/blockMeshDict").exists())

    def test_results_are_kept(self):
        folder, _ = self.case("kept", "--check-profile")
        (folder / "empty_domain/log.simpleFoam").write_text("results\n")
        run = self.atria("case", self.site, "-o", folder)
        self.assertIn("holds results of a run (empty_domain/log.simpleFoam)", run.stderr)
        subprocess.run([folder / "Allclean"], check=True)
        self.case("kept")
        self.assertFalse((folder / "empty_domain").exists())

    def report(self, folder):
        environment = os.environ | {"PYTHONPATH": str(ATRIA.parent.parent / "lib/python3/dist-packages")}
        return subprocess.run([sys.executable, "-m", "atria.report", folder], env=environment, capture_output=True, text=True,
                              check=False)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_the_profile_before_the_buildings(self):
        """It stays near the inlet's where first cells are above the roughness length, and not where they are below."""
        changes = {}
        for roughness in (0.03, 0.6):
            folder, _ = self.case(f"profile{roughness}", "--roughness", roughness, "--check-profile")
            run = subprocess.run([folder / "empty_domain/Allrun"], capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            self.assertIn("\nEnd\n", (folder / "empty_domain/log.simpleFoam").read_text())
            profile = Case(folder).runs[0].profile
            self.assertTrue(profile.ran)
            wind = 5.0 / math.log((10.0 + roughness) / roughness)
            for height, speed, k in zip(profile.heights, profile.speed[0], profile.k[0].ravel()):
                self.assertAlmostEqual(speed, wind * math.log((height + roughness) / roughness), places=6)
                self.assertAlmostEqual(k, (0.41 * wind) ** 2 / 0.3, places=6)
            changes[roughness] = abs(profile.change_of_speed().percent), abs(profile.change_of_k().percent)
            messages = self.report(folder).stderr
            self.assertEqual("without buildings the wind changes" in messages, changes[roughness][0] > 5 or changes[roughness][1] > 20)
            page = (folder / "report.html").read_text()
            self.assertIn("The wind before the buildings", page)
        self.assertLess(changes[0.03][0], 10.0)
        self.assertLess(changes[0.03][1], 20.0)
        self.assertGreater(changes[0.6][0], 20.0)
        self.assertGreater(changes[0.6][1], 20.0)
        self.assertIn("must be above the roughness length, 0.6 m", messages)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
