# SPDX-License-Identifier: GPL-3.0-or-later
"""The study of the wind behind trees: its mesh has the trees as a cell zone, its case their leaves, its table is whole.

Usage: test_windbreak.py FOLDER_OF_THE_STUDY ATRIA
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

ATRIA = pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, sys.argv[1])

import windbreak  # noqa: E402
from kept_rows import keep  # noqa: E402  (windbreak knows where it is)


class Windbreak(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def test_leaves_stand_across_the_wind(self):
        row = windbreak.Row("coarse", 0.1, finest=2.0)
        windbreak.mesh(ATRIA, row, self.folder)
        command = [str(word) for word in windbreak.case_command(ATRIA, row, self.folder)]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        described = json.loads((self.folder / "case/case.json").read_text())
        canopy, = described["canopies"]
        self.assertEqual((canopy["zone"], canopy["sources"]), ("Trees", "momentum, k, epsilon"))
        self.assertAlmostEqual(canopy["leaf_area_density"] * windbreak.DEPTH, 2.0 * math.log(10.0), places=2)
        volume = windbreak.DEPTH * windbreak.WIDTH * windbreak.HEIGHT
        self.assertAlmostEqual(canopy["volume"] / volume, 1.0, delta=0.05)
        patches = described["directions"][0]["patches"]
        self.assertEqual({patches[name] for name in ("yMin", "yMax", "zMax")}, {"slip"})
        self.assertEqual({patches[name] for name in patches if name in ("zMin", "Trees")}, {"ground"})

    def test_the_table_compares(self):
        count = len(windbreak.PROFILE)
        results = {windbreak.OPEN: ([2.0] * count, [2.0, 2.0, 2.0]), windbreak.ROWS[1]: ([1.0] * 11 + [0.8] + [1.5] * (count - 12), [0.8, 1.4, 1.8])}
        for row, (speeds, at) in results.items():
            keep(row, self.folder, {"cells": 1000, "solve_seconds": 2.0, "speeds": speeds, "at": at})
        lines = windbreak.tables(self.folder).strip().splitlines()[2:]
        self.assertEqual(len({line.count("|") for line in lines}), 1, lines)
        self.assertIn("| 40 % | 3.0 | 60 % | 30 % | 10 % |", lines[2])
        self.assertIn("not run", lines[3])
        self.assertIn("*measured*", lines[-1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
