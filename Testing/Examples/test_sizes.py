# SPDX-License-Identifier: GPL-3.0-or-later
"""Sizes: estimates, budgets of elements, limits of memory.

Usage: test_sizes.py ATRIA FOLDER_OF_MODELS
"""

import json
import re
import resource
import subprocess
import sys
import unittest

from command_line import ATRIA, COARSE, HOUSE, CommandLineTest


class Sizes(CommandLineTest):
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

    def write_tower(self):
        model = self.folder / "tower.obj"
        corners = [(x, y, z) for z in (0, 100) for y in (0, 20) for x in (0, 20)]
        faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
        model.write_text("o Tower\n" + "".join("v %g %g %g\n" % c for c in corners) + "".join("f %d %d %d %d\n" % f for f in faces))
        return model

    def test_a_mesh_has_hexahedra_only_on_request(self):
        model = self.write_tower()
        counts = {}
        for option in ([], ["--hex"]):
            report = self.folder / "report.json"
            run = self.atria("mesh", model, "--size-min", "5", "--size-mid", "5", *option, "-o", self.folder / "tower.vtu", "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertNotIn("no hexahedra", run.stderr)
            written = json.loads(report.read_text())
            counts[bool(option)] = written["counts"]
            self.assertEqual(written["invalid_elements"], 0)
        self.assertEqual(counts[True]["hexahedra"], counts[True]["elements"])
        self.assertLess(counts[False]["hexahedra"], counts[False]["elements"])
        self.assertLess(counts[True]["elements"], 2.2 * counts[False]["elements"])

    def test_a_budget_keeps_the_tower_and_coarsens_the_far_field(self):
        """Sizes on the tower are as requested; the warning gives options that make the same mesh."""
        model = self.write_tower()
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
        self.assertIn("warning: the requested sizes make about", run.stderr)
        self.assertGreater(int(run.stdout.split("elements: ")[1].split()[0]), 1e9)
        self.assertRegex(run.stdout, r"memory: about \d{2,} GB or more")
        report = self.folder / "fine.json"
        run = self.atria("mesh", HOUSE, *fine, "--preflight", "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("--memory-limit", json.loads(report.read_text())["warnings"][0])
        self.refuses(3, "there are 0.001 GB", "mesh", HOUSE, *COARSE, "-o", out, "--memory-limit", "0.001")
        self.refuses(3, "fewer layers", "mesh", HOUSE, *COARSE, "-o", out, "--layers", "90", "--memory-limit", "0.05")
        self.refuses(2, "--memory-limit", "mesh", HOUSE, *COARSE, "-o", out, "--memory-limit", "0")

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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
