# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes divided among processors are what OpenFOAM's decomposePar makes of the same division, and run.

Usage: python3 test_processors.py ATRIA FOLDER_OF_MODELS
"""

import itertools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from box_mesh import BOX, BoxCase, write_box
from decomposed import HAVE_OPENFOAM, content, expect_decompose_par, labels, patches, run_in

ATRIA = pathlib.Path(sys.argv[1])
DATA = pathlib.Path(sys.argv[2])
HOUSE = ["--size-max", "16", "--size-mid", "4", "--size-min", "1", "--site", "Site", "--openings"]
PARTS = 3


class Processors(BoxCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.case = cls.folder / "house"
        run = subprocess.run([ATRIA, "mesh", DATA / "house.wrl", "-o", cls.folder / "house.vtu", *HOUSE, "--openfoam", cls.case,
                              "--ascii", "--processors", str(PARTS)], capture_output=True, text=True, check=False)
        assert run.returncode == 0, run.stderr

    def atria(self, *arguments, status=0):
        run = subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, status, run.stderr)
        return run.stderr

    def run_in(self, folder, *command):
        return run_in(self, folder, *command)

    def test_every_cell_and_face_is_there_once(self):
        whole = self.case / "constant" / "polyMesh"
        cells, faces, shared = [], [], []
        for part in range(PARTS):
            folder = self.case / f"processor{part}" / "constant" / "polyMesh"
            cells += labels(folder / "cellProcAddressing")
            numbers = labels(folder / "faceProcAddressing")
            first = min((int(entries["startFace"]) for _, entries in patches(folder / "boundary")
                         if entries["type"] == "processor"), default=len(numbers))
            faces += numbers[:first]
            shared += numbers[first:]
            self.assertEqual(labels(folder / "pointProcAddressing"), sorted(labels(folder / "pointProcAddressing")))
        self.assertEqual(sorted(cells), list(range(len(cells))))
        self.assertTrue(all(number > 0 for number in faces))
        self.assertEqual(sorted(shared), sorted([n for n in shared if n > 0] + [-n for n in shared if n > 0]))
        owners = int(content(whole / "owner")[0])
        self.assertEqual(sorted(faces + [n for n in shared if n > 0]), list(range(1, owners + 1)))
        # Balanced, and not cut at random.
        most = max(len(labels(self.case / f"processor{p}/constant/polyMesh/cellProcAddressing")) for p in range(PARTS))
        self.assertLess(most, 1.02 * len(cells) / PARTS + 2)
        self.assertLess(len(shared) / 2, 3 * PARTS * len(cells) ** (2 / 3))

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_parts_are_those_of_decompose_par(self):
        expect_decompose_par(self, self.case, self.folder / "decomposed", PARTS)
        self.assertGreater(len(content(self.case / "processor0/constant/polyMesh/faceZones")), 20)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_check_mesh_in_parallel_and_back(self):
        said = self.run_in(self.case, "mpirun", "-np", PARTS, "checkMesh", "-parallel", "-allTopology")
        self.assertIn("Mesh OK.", said)
        copy = self.folder / "back"
        shutil.copytree(self.case, copy)
        shutil.rmtree(copy / "constant")
        self.run_in(copy, "reconstructParMesh", "-constant")
        said = self.run_in(copy, "checkMesh", "-constant")
        self.assertIn("Mesh OK.", said)
        cells = content(self.case / "constant/polyMesh/owner")[0]
        self.assertEqual(content(copy / "constant/polyMesh/owner")[0], cells)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_case_runs_on_processors_as_on_one(self):
        flows = {}
        for parts in (1, 2):
            folder = self.folder / f"run{parts}"
            self.atria("case", self.box, "-o", folder, "--iterations", "30", "--processors", parts)
            self.run_in(folder, "./Allrun")
            self.assertEqual((folder / "processor1").exists(), parts == 2)
            self.assertFalse((folder / "log.decomposePar").exists())
            self.assertTrue((folder / "30/U").exists())
            self.assertIn("\nTime = 30\n", (folder / "log.simpleFoam").read_text())
            for name in ("flow_xMax", "flow_Wall_opening_1"):
                file = folder / f"postProcessing/{name}/0/surfaceFieldValue.dat"
                flows.setdefault(name, []).append(float(file.read_text().split()[-1]))
        for name, (alone, together) in flows.items():
            self.assertAlmostEqual(together / alone, 1.0, delta=1e-4, msg=name)
        # Cleaned, it runs again.
        folder = self.folder / "run2"
        self.run_in(folder, "./Allclean")
        self.assertFalse((folder / "processor0/30").exists() or (folder / "30").exists())
        self.assertEqual((folder / "processor0/0/U").read_bytes(), (folder / "0/U").read_bytes())
        self.atria("case", self.box, "-o", folder, "--iterations", "5", "--processors", 3)
        self.run_in(folder, "./Allrun")
        self.assertTrue((folder / "processor2/5/U").exists())

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_rose_shares_the_parts(self):
        folder = self.folder / "rose"
        self.atria("case", self.box, "-o", folder, "--rose", "2", "--iterations", "3", "--processors", 2)
        for direction in json.loads((folder / "case.json").read_text())["directions"]:
            for part in range(2):
                mesh = folder / direction["folder"] / f"processor{part}/constant/polyMesh"
                self.assertFalse(os.path.isabs(os.readlink(mesh)))
                self.assertTrue(mesh.resolve().samefile(folder / f"processor{part}/constant/polyMesh"))
        self.run_in(folder, "./Allrun")
        self.assertTrue((folder / "wind_180/3/U").exists())

    def test_what_is_refused(self):
        folder = self.folder / "refused"
        self.atria("case", self.box, "-o", folder, "--processors", 2)
        (folder / "processor1/100").mkdir()
        self.assertIn("processor1/100", self.atria("case", self.box, "-o", folder, "--processors", 2, status=3))
        self.assertTrue((folder / "processor1/100").exists())
        tiny = self.folder / "tiny"
        write_box(tiny, (2, 2, 1), BOX)
        self.assertIn("4 cells", self.atria("case", tiny, "-o", self.folder / "few", "--processors", 5, status=3))
        self.atria("case", tiny, "-o", self.folder / "few", "--processors", 4)
        boundary = tiny / "constant/polyMesh/boundary"
        boundary.write_text(boundary.read_text().replace("{ type patch;", "{ type cyclic;", 1))
        self.assertIn("cyclic", self.atria("case", tiny, "-o", self.folder / "cyclic", "--processors", 2, status=3))

    def test_the_same_for_any_number_of_threads(self):
        for name, threads in (("one", "1"), ("two", "2")):
            run = subprocess.run([ATRIA, "convert", self.folder / "house.vtu", "--openfoam", self.folder / name, "--processors", "4"],
                                 env=os.environ | {"VTK_SMP_MAX_THREADS": threads}, capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stderr)
        for file in sorted((self.folder / "one").rglob("processor*/**/*")):
            other = self.folder / "two" / file.relative_to(self.folder / "one")
            self.assertTrue(file.is_dir() or file.read_bytes() == other.read_bytes(), file)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
