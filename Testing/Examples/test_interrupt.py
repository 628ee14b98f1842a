#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line's progress bar, and what Ctrl-C leaves.

Usage: test_interrupt.py ATRIA FOLDER_OF_MODELS
"""

import os
import pathlib
import pty
import re
import signal
import subprocess
import sys
import tempfile
import unittest

ATRIA = pathlib.Path(sys.argv[1])
HOUSE = pathlib.Path(sys.argv[2]) / "house.wrl"
COARSE = ["--size-max", "16", "--size-mid", "4", "--size-min", "2", "--site", "Site"]
FINE = ["--size-max", "8", "--size-mid", "1", "--size-min", "0.5", "--site", "Site"]


class OnTerminal:
    """A run whose standard error is a terminal."""

    def __init__(self, *arguments):
        ours, theirs = pty.openpty()
        self.terminal = os.fdopen(ours, "rb", buffering=0)
        self.process = subprocess.Popen([ATRIA, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=theirs)
        os.close(theirs)
        self.shown = ""

    def read(self):
        """More of what is shown; false at the end."""
        try:
            more = self.terminal.read(4096)
        except OSError:  # the other end is closed
            return False
        self.shown += more.decode()
        return bool(more)

    def read_until(self, text):
        while text not in self.shown:
            if not self.read():
                raise AssertionError(f"'{text}' is not in: {self.shown}")

    def finish(self):
        while self.read():
            pass
        self.terminal.close()
        return self.process.wait()


class Interrupt(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)

    def outputs(self):
        return ["-o", self.folder / "mesh.vtu", "--patches", self.folder / "mesh.vtpc", "--openfoam", self.folder / "case",
                "--report", self.folder / "mesh.json"]

    def files(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*"))

    def test_the_bar_rises_to_the_end_and_is_removed(self):
        run = OnTerminal("mesh", HOUSE, *COARSE, *self.outputs())
        self.assertIn(run.finish(), (0, 4, 5), run.shown)
        shares = [int(n) for n in re.findall(r"\] +(\d+) %", run.shown)]
        self.assertGreater(len(shares), 10)
        self.assertEqual(shares, sorted(shares))
        self.assertGreaterEqual(shares[-1], 90)
        for phase in ("Finding grid points", "Growing layers", "Writing"):
            self.assertIn(phase, run.shown)
        lines = run.shown.replace("\r\n", "\n").split("\n")
        self.assertTrue(not any(re.search(r"\] +\d+ %", line.split("\r")[-1]) for line in lines), run.shown)

    def test_there_is_no_bar_without_a_terminal(self):
        run = subprocess.run([ATRIA, "mesh", HOUSE, *COARSE, "-o", self.folder / "mesh.vtu"], capture_output=True, text=True,
                             check=False)
        self.assertNotRegex(run.stderr, r"\] +\d+ %")
        self.assertNotIn("\r", run.stderr)

    def test_ctrl_c_leaves_no_files(self):
        for phase in ("Reading surfaces", "Finding crossings", "Growing layers", "Judging"):
            with self.subTest(phase):
                run = OnTerminal("mesh", HOUSE, *FINE, *self.outputs())
                run.read_until(phase)
                run.process.send_signal(signal.SIGINT)
                self.assertEqual(run.finish(), 130, run.shown)
                self.assertIn("atria: error: interrupted", run.shown)
                self.assertEqual(self.files(), [])

    def test_ctrl_c_while_writing_leaves_whole_files_only(self):
        whole = {"mesh.vtu": b"</VTKFile>", "mesh.vtpc": b"</VTKFile>", "mesh.json": b"}\n"}
        run = OnTerminal("mesh", HOUSE, *FINE, *self.outputs())
        run.read_until("Writing")
        run.process.send_signal(signal.SIGINT)
        status = run.finish()
        self.assertIn(status, (0, 4, 5, 130), run.shown)  # it may have been done
        for file in self.folder.iterdir():
            self.assertFalse(file.name.startswith("."), file)
            if file.name in whole:
                self.assertTrue(file.read_bytes().rstrip(b"\0").endswith(whole[file.name]), file)
        mesh = self.folder / "case" / "constant" / "polyMesh"
        if mesh.exists() and any(mesh.iterdir()):
            self.assertLessEqual({"points", "faces", "owner", "neighbour", "boundary"}, {p.name for p in mesh.iterdir()})

    def test_an_earlier_file_stays_when_interrupted(self):
        out = self.folder / "mesh.vtu"
        out.write_text("earlier")
        run = OnTerminal("mesh", HOUSE, *FINE, "-o", out)
        run.read_until("Growing layers")
        run.process.send_signal(signal.SIGINT)
        self.assertEqual(run.finish(), 130, run.shown)
        self.assertEqual(out.read_text(), "earlier")
        self.assertEqual(self.files(), ["mesh.vtu"])

    def test_inspect_and_estimate_are_interrupted(self):
        for arguments in (["inspect", HOUSE], ["mesh", HOUSE, *FINE, "--estimate"], ["mesh", HOUSE, *FINE, "--preflight"]):
            with self.subTest(arguments[-1]):
                run = OnTerminal(*arguments)
                run.read_until("%")
                run.process.send_signal(signal.SIGINT)
                self.assertIn(run.finish(), (0, 130), run.shown)  # small ones may have been done


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
