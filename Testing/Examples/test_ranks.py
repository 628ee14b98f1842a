#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line under mpiexec does what it does alone.

Usage: test_ranks.py MPIEXEC ATRIA FOLDER_OF_MODELS
"""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from decomposed import HAVE_OPENFOAM, expect_decompose_par, run_in

MPIEXEC = sys.argv[1]
ATRIA = pathlib.Path(sys.argv[2])
HOUSE = pathlib.Path(sys.argv[3]) / "house.wrl"
COARSE = ["--size-max", "16", "--size-mid", "4", "--size-min", "2", "--site", "Site"]
# With face zones in openings.
OPEN = ["--size-max", "16", "--size-mid", "4", "--size-min", "1", "--site", "Site", "--openings"]
# What takes some time to write.
MANY = ["--size-max", "8", "--size-mid", "1", "--size-min", "1", "--site", "Site"]
# What takes longer than a test waits.
FINE = ["--size-max", "8", "--size-mid", "0.3", "--size-min", "0.3", "--site", "Site"]
# How many ranks what one process makes is compared with: fewer, more than there are processors, and odd.
RANKS = (2, 3, 5, 8) if "ATRIA_TEST_FULL" in os.environ else (2, 5)
ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def launched(ranks, *arguments):
    """The command on so many ranks; alone without mpiexec for 0."""
    launcher = [MPIEXEC, "--oversubscribe", "-n", str(ranks)] if ranks else []
    return [*launcher, str(ATRIA), *map(str, arguments)]


def run(ranks, *arguments, **options):
    return subprocess.run(launched(ranks, *arguments), env=ENVIRONMENT, capture_output=True, text=True, timeout=300,
                          **options)


def said(result):
    """What the program told, without what differs from run to run and what mpiexec says of a status other than 0."""
    lines = [line for line in result.stdout.splitlines() if not line.startswith(("time ", "memory "))]
    lines = [re.sub(r"(\.json) \(.*\)$", r"\1", line) for line in lines]  # reports have seconds in them
    return lines, [line for line in result.stderr.splitlines() if line.startswith("atria: ")]


def processes_of(launcher):
    """Process ids of the program under mpiexec, by rank."""
    found = {}
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            parent = re.search(r"^PPid:\s+(\d+)", (folder / "status").read_text(), re.MULTILINE)
            if int(parent[1]) == launcher.pid and os.readlink(folder / "exe") == str(ATRIA.resolve()):
                rank = re.search(rb"\0OMPI_COMM_WORLD_RANK=(\d+)", (folder / "environ").read_bytes())
                found[int(rank[1])] = int(folder.name)
        except (OSError, TypeError):  # it has ended, or has not begun
            continue
    return found


def runs(process):
    """Whether there is such a process, other than one whose end nobody has asked for."""
    try:
        return "State:\tZ" not in pathlib.Path(f"/proc/{process}/status").read_text()
    except OSError:
        return False


def catches(process, number):
    """Whether a process has a handler for a signal."""
    try:
        caught = re.search(r"^SigCgt:\s+(\w+)", pathlib.Path(f"/proc/{process}/status").read_text(), re.MULTILINE)
        return int(caught[1], 16) >> (number - 1) & 1 == 1
    except OSError:
        return False


class Ranks(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)

    def folder(self, name):
        path = pathlib.Path(self.scratch.name) / name
        path.mkdir()
        return path

    def contents(self, folder):
        return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}

    def test_any_number_of_ranks_writes_and_tells_what_one_process_does(self):
        outputs = ["-o", "mesh.vtu", "--patches", "mesh.vtpc", "--openfoam", "case", "--processors", "2", "--su2", "mesh.su2"]
        results = {}
        for ranks in (0, 1, *RANKS):
            folder = self.folder(str(ranks))
            result = run(ranks, "mesh", HOUSE, *COARSE, "--layers", "2", *outputs, cwd=folder)
            results[ranks] = (result.returncode, said(result), self.contents(folder))
        self.assertIn("case/processor1/constant/polyMesh/owner", results[0][2])
        for ranks, (status, texts, files) in results.items():
            self.assertEqual(status, results[0][0])
            self.assertEqual(texts, results[0][1], ranks)
            self.assertEqual(files.keys(), results[0][2].keys())
            for name, data in files.items():
                self.assertEqual(data, results[0][2][name], (ranks, name))

    def test_ranks_write_hexahedra_that_one_process_makes(self):
        written = []
        for ranks in (0, 2):
            folder = self.folder(str(ranks))
            result = run(ranks, "mesh", HOUSE, *COARSE, "--hex", "--layers", "0", "--block-size", "300", "-o", "mesh.vtu", cwd=folder)
            self.assertIn(result.returncode, (0, 4), result.stderr)
            written.append((result.returncode, said(result), self.contents(folder)))
        self.assertEqual(*written)
        self.assertRegex("\n".join(written[0][1][0]), r"(?m)^elements +(\d+): \1 hexahedra")

    def expect_that_of_one_process(self, *options):
        """With blocks the ranks make the mesh, and not the first one alone."""
        outputs = ["-o", "mesh.vtu", "--patches", "mesh.vtpc", "--openfoam", "case", "--processors", "1", "--report", "r.json"]
        results = {}
        for ranks in (0, *RANKS):
            folder = self.folder(str(ranks) + "-".join(options).replace("/", "_"))
            result = run(ranks, "mesh", HOUSE, *options, *outputs, "--block-size", "300", "--threads", "1", cwd=folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            report = json.loads((folder / "r.json").read_text())
            stages = report.pop("seconds")
            del report["peak_memory_bytes"]
            (folder / "r.json").unlink()
            results[ranks] = (said(result), report, self.contents(folder))
            self.assertEqual("numbers" in stages, bool(ranks))  # a stage that one process does not have
            self.assertEqual(results[ranks], results[0])

    def test_ranks_make_a_mesh_together(self):
        self.expect_that_of_one_process(*COARSE, "--layers", "2")

    def test_all_ranks_know_the_options(self):
        (self.folder("given") / "options.toml").write_text("[mesh]\nlayers = \"*=1\"\nsize-mid = 4\n")
        self.expect_that_of_one_process("--domain-polygon", "-30,-30 50,-30 60,20 10,60 -30,40", "--domain-heights", "0", "30",
                                        "--seed", "-20", "-20", "20", "--config", f"{self.scratch.name}/given/options.toml")

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_each_rank_writes_the_processor_of_its_number(self):
        options = [*OPEN, "--layers", "2", "-o", "mesh.vtu", "--openfoam", "case", "--ascii"]
        alone = self.folder("alone")
        self.assertEqual(run(0, "mesh", HOUSE, *options, cwd=alone).returncode, 0)
        for ranks in RANKS:
            folder = self.folder(f"on{ranks}")
            result = run(ranks, "mesh", HOUSE, *options, cwd=folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            written = self.contents(folder)
            for name, data in self.contents(alone).items():
                self.assertEqual(written[name], data, name)
            # Read from file, the mesh is divided alike.
            converted = run(ranks, "convert", "mesh.vtu", "--openfoam", "again", "--ascii", cwd=folder)
            self.assertEqual(converted.returncode, 0, converted.stderr)
            again = self.contents(folder / "again")
            for name, data in self.contents(folder / "case").items():
                self.assertEqual(again[name.replace("case.foam", "again.foam")], data, name)
            expect_decompose_par(self, folder / "case", folder / "decomposed", ranks)
            said = run_in(self, folder / "case", "mpirun", "-np", ranks, "checkMesh", "-parallel", "-allTopology", "-allGeometry")
            self.assertIn("Mesh OK.", said)

    # Without the whole mesh, of a mesh that the first rank deals out.
    def test_processors_are_the_same_without_the_whole_mesh(self):
        options = [*COARSE, "--layers", "2", "--recenter", "--openfoam", "case", "--restore-offset"]
        for name, more in (("pieces", ["-o", "mesh.pvtu", "--ascii"]), ("whole", ["-o", "mesh.vtu"])):
            folders = self.folder(name), self.folder(name + "-only")
            results = [run(3, "mesh", HOUSE, *options, *more, *only, cwd=folder)
                       for folder, only in zip(folders, ([], ["--processors-only"]))]
            for result in results:
                self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(*[re.sub(r"case \(.*?\)", "case", str(said(result))) for result in results])  # the sizes differ
            with_whole, only = map(self.contents, folders)
            self.assertEqual(list(only), [file for file in with_whole if "case/constant/" not in file])
            self.assertEqual([file for file in only if only[file] != with_whole[file]], [])

    # Of a mesh in the pieces that ranks have made.
    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_processors_need_no_whole_mesh(self):
        options = [*COARSE, "--layers", "2", "--block-size", "300", "--openfoam", "case", "--ascii"]
        alone = self.folder("alone")
        self.assertEqual(run(0, "mesh", HOUSE, *options, cwd=alone).returncode, 0)
        for ranks in (2, 5):
            folder = self.folder(f"on{ranks}")
            result = run(ranks, "mesh", HOUSE, *options, "-o", "mesh.pvtu", "--processors-only", cwd=folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            found = run_in(self, folder / "case", "mpirun", "-np", ranks, "checkMesh", "-parallel", "-allTopology", "-allGeometry")
            self.assertIn("Mesh OK.", found)
            self.assertFalse((folder / "case/constant").exists())
            shutil.copytree(alone / "case/constant", folder / "case/constant")
            expect_decompose_par(self, folder / "case", folder / "decomposed", ranks, zones=())

    def test_each_rank_writes_its_piece_and_pieces_are_the_mesh(self):
        self.expect_pieces_of_the_mesh("dealt")

    def test_each_rank_writes_the_piece_that_it_has_made(self):
        self.expect_pieces_of_the_mesh("made", "--block-size", "300", "--threads", "1")

    def expect_pieces_of_the_mesh(self, name, *options):
        options = [*COARSE, *options, "--layers", "2", "--report", "r.json"]
        whole = self.folder(name)
        files = ["--patches", "patches.vtpc"]
        run(0, "mesh", HOUSE, *options, *files, "-o", "mesh.vtu", "--openfoam", "case", cwd=whole)
        wanted = self.contents(whole / "case")
        told = json.loads((whole / "r.json").read_text())
        for ranks in (0, *RANKS):
            folder = self.folder(f"{name}{ranks}")
            result = run(ranks, "mesh", HOUSE, *options, *files, "-o", "mesh.pvtu", cwd=folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(sorted(path.name for path in folder.glob("*.vtu")), [f"mesh_{i}.vtu" for i in range(max(ranks, 1))])
            self.assertEqual([path.name for path in folder.glob(".*")], [])
            self.expect_alike(json.loads((folder / "r.json").read_text()), told)
            for kind, given in (("recorded", []), ("given", files)):
                (folder / kind).mkdir()
                convert = run(0, "convert", "mesh.pvtu", *given, "--openfoam", f"{kind}/case", cwd=folder)
                self.assertEqual(convert.returncode, 0, convert.stderr)
                self.assertEqual(self.contents(folder / kind / "case"), wanted)

    def expect_alike(self, got, wanted):
        """Reports but for what differs from run to run, and for sums, which are rounded in another order."""
        if isinstance(wanted, dict):
            run_by_run = {"seconds", "peak_memory_bytes", "threads", "openfoam"}
            self.assertEqual(list(got), list(wanted))
            for key in wanted.keys() - run_by_run:
                self.expect_alike(got[key], wanted[key])
        elif isinstance(wanted, list):
            self.assertEqual(len(got), len(wanted))
            for one, other in zip(got, wanted):
                self.expect_alike(one, other)
        elif isinstance(wanted, float):
            self.assertAlmostEqual(got, wanted, delta=1e-9 * abs(wanted) + 1e-12)
        else:
            self.assertEqual(got, wanted)

    def test_one_rank_or_a_number_of_processors_leaves_ranks_out(self):
        options = [*COARSE, "-o", "mesh.vtu", "--openfoam", "case"]
        for name, ranks, processors, there in (("one", 1, [], 0), ("whole", 2, ["--processors", "1"], 0),
                                               ("said", 2, ["--processors", "3"], 3)):
            folder = self.folder(name)
            self.assertEqual(run(ranks, "mesh", HOUSE, *options, *processors, cwd=folder).returncode, 0)
            self.assertEqual(len(list((folder / "case").glob("processor*"))), there)

    def test_an_error_ends_all_with_its_status(self):
        for arguments in (["mesh", "missing.wrl"], ["mesh", HOUSE, "--size-mni", "1"], ["mesh", HOUSE, "--site", "Nowhere"],
                          ["mesh", HOUSE, *COARSE, "--seed", "0", "0", "900", "--block-size", "300"]):
            alone = run(0, *arguments, cwd=self.scratch.name)
            together = run(3, *arguments, cwd=self.scratch.name)
            self.assertNotEqual(alone.returncode, 0)
            self.assertEqual((together.returncode, said(together)), (alone.returncode, said(alone)))

    def test_other_commands_run_once(self):
        self.assertEqual(run(3, "inspect", HOUSE).stdout, run(0, "inspect", HOUSE).stdout)

    def signaled(self, send, *options):
        """Status and messages of a run of three ranks that is signaled while it meshes; nothing may be left of it."""
        folder = self.folder("-".join([send.__name__, *options]))
        launcher = subprocess.Popen(launched(3, "mesh", HOUSE, *FINE, *options, "-o", "mesh.vtu", "--openfoam", "case"),
                                    env=ENVIRONMENT, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for _ in range(100):
            time.sleep(0.1)
            processes = processes_of(launcher)
            if len(processes) == 3 and catches(processes[0], signal.SIGINT):
                break
        time.sleep(0.5)
        processes = processes_of(launcher)
        send(launcher, processes)
        _, messages = launcher.communicate(timeout=30)
        self.assertEqual(list(folder.iterdir()), [])
        for _ in range(100):  # mpiexec may be gone a little before what it signaled
            if not any(map(runs, processes.values())):
                break
            time.sleep(0.1)
        self.assertFalse(any(map(runs, processes.values())))
        return launcher.returncode, messages

    def test_control_c_on_the_first_rank_ends_all(self):
        def interrupt_first(launcher, processes):
            os.kill(processes[0], signal.SIGINT)

        for options in ([], ["--block-size", "5000"]):
            status, messages = self.signaled(interrupt_first, *options)
            self.assertEqual(status, 130, messages)
            self.assertEqual(messages.count("atria: error: interrupted"), 1, messages)

    def test_control_c_on_mpiexec_ends_all(self):
        def interrupt_all(launcher, processes):
            launcher.send_signal(signal.SIGINT)

        for options in ([], ["--block-size", "5000"]):
            status, _ = self.signaled(interrupt_all, *options)
            self.assertNotEqual(status, 0)

    def test_a_rank_that_dies_ends_all(self):
        def kill_last(launcher, processes):
            os.kill(processes[2], signal.SIGKILL)

        for options in ([], ["--block-size", "5000"]):
            status, _ = self.signaled(kill_last, *options)
            self.assertNotEqual(status, 0)

    def test_a_rank_that_dies_as_files_are_written_leaves_none_half_written(self):
        whole, folder = self.folder("whole"), self.folder("killed")
        arguments = ["mesh", HOUSE, *MANY, "-o", "mesh.pvtu", "--patches", "patches.vtpc", "--openfoam", "case"]
        self.assertEqual(run(3, *arguments, cwd=whole).returncode, 0)
        wanted = self.contents(whole)
        for victim, begun in ((1, ".mesh.pvtu.unfinished/*.vtu"), (2, "case/.processors.unfinished/*")):
            launcher = subprocess.Popen(launched(3, *arguments), env=ENVIRONMENT, cwd=folder, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
            processes = {}
            while launcher.poll() is None and not any(folder.glob(begun)):
                processes = processes if len(processes) == 3 else processes_of(launcher)
                time.sleep(0.001)
            self.assertIsNone(launcher.returncode, "it ended before it was found writing")
            os.kill(processes[victim], signal.SIGKILL)
            self.assertNotEqual(launcher.wait(timeout=30), 0)
            self.assertFalse(any(folder.glob("case/processor*")))
            for name, data in self.contents(folder).items():
                if ".unfinished/" not in name:
                    self.assertEqual(data, wanted[name], name)
        # What a killed run has begun is in no one's way.
        self.assertEqual(run(3, *arguments, cwd=folder).returncode, 0)
        self.assertEqual(self.contents(folder), wanted)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
