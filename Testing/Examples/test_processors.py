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

ATRIA = pathlib.Path(sys.argv[1])
DATA = pathlib.Path(sys.argv[2])
HOUSE = ["--size-max", "16", "--size-mid", "4", "--size-min", "1", "--site", "Site", "--openings"]
HAVE_OPENFOAM = shutil.which("simpleFoam") is not None
# Of Open MPI, for root, and for more processors than this machine has.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_mpi_yield_when_idle": "1", "WM_PROJECT_DIR": "/usr/share/openfoam"}
PARTS = 3


def content(file):
    """Words and numbers of a file of OpenFOAM, without its header, comments and marks."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", file.read_text(), flags=re.DOTALL)
    text = re.sub(r"^\s*FoamFile\s*\{.*?\}", " ", text, flags=re.DOTALL)
    text = re.sub(r"(\d+)\{([-\d]+)\}", lambda same: same[1] + int(same[1]) * f" {same[2]}", text.replace("List<label>", "")
                  .replace("List<bool>", ""))
    words = re.findall(r'[^\s(){};]+', text)
    return [float(word) if re.fullmatch(r"[-+.\d][-+.\de]*", word) else word for word in words]


def patches(file):
    """Each patch of `boundary`, in order, with its entries."""
    text = re.sub(r"//[^\n]*", "", file.read_text())
    found = re.findall(r"(\w+)\s*\{([^}]*)\}", text)
    entries_of = lambda text: {key: value for key, value in re.findall(r"(\w+)\s+([^;]*);", text) if value != "1(wall)"}
    return [(name, entries_of(entries)) for name, entries in found if name != "FoamFile"]  # each wall is in group wall


def labels(file):
    return [int(number) for number in content(file)[1:]]


def all_of(part, parts):
    return [case / f"processor{part}" / "constant" / "polyMesh" for case in parts]


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
        run = subprocess.run(list(map(str, command)), cwd=folder, env=os.environ | MPI, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout[-3000:] + run.stderr)
        return run.stdout

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
        other = self.folder / "decomposed"
        shutil.copytree(self.case, other, ignore=shutil.ignore_patterns("processor*"))
        part_of = {}
        for part in range(PARTS):
            for cell in labels(self.case / f"processor{part}/constant/polyMesh/cellProcAddressing"):
                part_of[cell] = part
        header = 'FoamFile { version 2.0; format ascii; class %s; location "%s"; object %s; }\n'
        (other / "constant/division").write_text(header % ("labelList", "constant", "division") + f"{len(part_of)}\n(\n" +
                                                 "\n".join(str(part_of[c]) for c in range(len(part_of))) + "\n)\n")
        (other / "system/decomposeParDict").write_text(
            header % ("dictionary", "system", "decomposeParDict") +
            f"numberOfSubdomains {PARTS};\nmethod manual;\nmanualCoeffs {{ dataFile \"division\"; }}\n")
        self.run_in(other, "decomposePar")
        for part in range(PARTS):
            own, theirs = all_of(part, (self.case, other))
            for name in ("faces", "owner", "neighbour", "cellProcAddressing", "faceProcAddressing", "pointProcAddressing",
                         "boundaryProcAddressing", "faceZones", "cellZones"):
                self.assertEqual(content(own / name), content(theirs / name), f"{part} {name}")
            for a, b in itertools.zip_longest(content(own / "points"), content(theirs / "points")):
                self.assertAlmostEqual(a, b, delta=1e-9)
            self.assertEqual(patches(own / "boundary"), patches(theirs / "boundary"))
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
