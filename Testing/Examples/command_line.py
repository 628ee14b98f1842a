# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line as tests run it: a folder for files, refusals, and options of the example house.

Tests that import this take the program and the folder of models as their first arguments.
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ATRIA = pathlib.Path(sys.argv[1])
DATA = pathlib.Path(sys.argv[2])
HOUSE = DATA / "house.wrl"
COARSE = ["--size-max", "16", "--size-mid", "4", "--size-min", "2", "--site", "Site"]
FINE = ["--size-max", "16", "--size-mid", "2", "--size-min", "1", "--site", "Site"]


def expected_status(report):
    """Of atria mesh: 4 for elements that are not valid, 5 for checks that fail."""
    checks = (report["openfoam"] or {"checks": {}})["checks"]
    failed = {name for name, check in checks.items() if check["is_error"] and check["failing"]}
    failed -= set(report["failing_by_thin_layers"])
    return 4 if report["invalid_elements"] else 5 if failed else 0


class CommandLineTest(unittest.TestCase):
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
