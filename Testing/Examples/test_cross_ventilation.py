# SPDX-License-Identifier: GPL-3.0-or-later
"""The study of a cross-ventilated building in a wind tunnel: its meshes and cases, and its table.

Usage: test_cross_ventilation.py FOLDER_OF_THE_STUDY ATRIA
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(sys.argv[1])
ATRIA = pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, str(FOLDER))

import make_building  # noqa: E402
import study  # noqa: E402
from kept_rows import keep  # noqa: E402  (study knows where it is)
from polygons import area  # noqa: E402


class CrossVentilation(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.out = pathlib.Path(scratch.name)

    def test_walls_and_openings_fill_each_plane(self):
        for name, x in (("WallFront", 0.0), ("WallBack", make_building.LENGTH)):
            walls = sum(map(area, make_building.sheets()[name][0]))
            self.assertAlmostEqual(walls + area(make_building.opening(x)[0]), make_building.LENGTH * make_building.HEIGHT)
        self.assertAlmostEqual(2 * make_building.opening_area(), area(make_building.opening(0.0)[0]))

    def test_half_of_the_tunnel_is_meshed_with_half_of_both_openings(self):
        model = self.out / "box.wrl"
        make_building.main(model)
        for row in study.ROWS[:3]:
            folder = self.out / row.name
            folder.mkdir()
            study.mesh(ATRIA, row, model, folder)
            subprocess.run(study.case_command(ATRIA, row, folder), check=True, capture_output=True)
            described = json.loads((folder / "case/case.json").read_text())
            self.assertEqual(described["mesh"]["failed_checks"], 0)
            self.assertEqual([opening["name"] for opening in described["openings"]], ["WallFront_opening_1", "WallBack_opening_1"])
            for opening in described["openings"]:
                self.assertAlmostEqual(opening["area"] / make_building.opening_area(), 1.0, places=5)
            roles = described["directions"][0]["patches"]
            self.assertEqual([roles[patch] for patch in ("xMin", "xMax", "yMin", "yMax", "zMax", "Ground", "Roof_front")],
                             ["inlet", "outlet", "slip", "slip", "slip", "ground", "wall"])
            if not row.adaptive:
                volume = math.prod(high - low for low, high in make_building.DOMAIN)
                self.assertAlmostEqual(described["mesh"]["cells"], volume / (row.finest / 1000) ** 3, delta=1)

    def test_the_table_compares_with_the_uniform_mesh_of_that_size(self):
        for row, cells, flow, speed in zip(study.ROWS, (1000, 100, 150), (0.5, 0.51, 0.48), (0.3, 0.4, 0.3)):
            keep(row, self.out, {"cells": cells, "worst_non_orthogonality": 50.0, "mesh_seconds": 1.0, "solve_seconds": 2.0,
                                 "iterations": 3, "flow": flow, "drift": 1e-4, "speeds": [speed] * 4})
        text = study.tables(self.out)
        lines = text.split("\n\n")[1].splitlines()
        self.assertEqual(len({line.count("|") for line in lines}), 1, text)
        self.assertIn("| 0.500 |  |", lines[2])
        self.assertIn("| 100 (10 %) |", lines[3])
        self.assertIn("| 0.510 (+2.0 %) | 0.100 |", lines[3])
        self.assertIn("not run", lines[5])

    def test_a_kind_with_all_sizes_tells_what_its_flow_tends_to(self):
        for row in study.ROWS:
            if row.adaptive and not row.layers:
                keep(row, self.out, {"cells": 1, "worst_non_orthogonality": 0.0, "mesh_seconds": 1.0, "solve_seconds": 2.0, "iterations": 3,
                                     "flow": 0.5 + 0.001 * row.finest**2, "drift": 0.0, "speeds": []})
        found = list(study.convergences(self.out))
        self.assertEqual([line[:2] for line in found], [["adaptive", "0.600"]])
        self.assertEqual(found[0][4:7], ["monotonic", "2.0", "0.500"])

    def test_a_name_means_one_row(self):
        self.assertEqual(len({row.name for row in study.rows()}), len(study.ROWS))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
