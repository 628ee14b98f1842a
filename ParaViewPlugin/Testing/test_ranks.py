# SPDX-License-Identifier: GPL-3.0-or-later
"""Any number of MPI ranks gives the outputs and files of one, bit for bit, and says nothing.

Usage: python3 test_ranks.py MPIEXEC PVBATCH
"""

import hashlib
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys

FOLDER = pathlib.Path(os.environ["ATRIA_OUTPUT"]) / "ranks"
SCRIPT = pathlib.Path(__file__).parent / "ranks_pipeline.py"


def start(mpiexec, pvbatch, ranks, *arguments):
    """Runs the pipeline; its exit status and what it said."""
    allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    command = [mpiexec, "--oversubscribe", "-n", str(ranks), pvbatch, str(SCRIPT), *arguments]
    result = subprocess.run(command, env=os.environ | allowed, capture_output=True, text=True, timeout=300)
    return result.returncode, result.stdout + result.stderr


def check_division(folder, ranks):
    """Each rank has written the folder of its processor, of the case that is written undivided; OpenFOAM takes them."""
    case, divided = folder / "case.openfoam", folder / "divided.openfoam"
    for name in ("points", "faces", "owner", "boundary"):
        mesh = pathlib.Path("constant") / "polyMesh" / name
        assert (case / mesh).read_bytes() == (divided / mesh).read_bytes(), name
    assert sorted(path.name for path in divided.glob("processor*")) == [f"processor{i}" for i in range(ranks)]
    if shutil.which("checkMesh"):
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), "checkMesh", "-parallel", "-allTopology"]
        allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "WM_PROJECT_DIR": "/usr/share/openfoam"}
        said = subprocess.run(command, cwd=divided, env=os.environ | allowed, capture_output=True, text=True, timeout=300)
        assert "Mesh OK." in said.stdout, said.stdout + said.stderr
    shutil.rmtree(divided)


def run(mpiexec, pvbatch, ranks):
    """The hashes of outputs and files."""
    folder = FOLDER / str(ranks)
    folder.mkdir(parents=True)
    status, said = start(mpiexec, pvbatch, ranks, str(folder))
    assert (status, said) == (0, ""), (ranks, status, said)
    if ranks > 1:
        check_division(folder, ranks)
    found = json.loads((folder / "hashes.json").read_text())
    for path in sorted(folder.rglob("*")):
        if path.is_file() and path.name != "hashes.json":
            found[str(path.relative_to(folder))] = hashlib.sha256(path.read_bytes()).hexdigest()[:16]
    return found


def is_near(value, other):
    """Whether they are the same, numbers up to rounding: sums over ranks are in another order."""
    if isinstance(value, float) and isinstance(other, float):
        return value == other or math.isclose(value, other, rel_tol=1e-9, abs_tol=1e-9) or (math.isnan(value) and math.isnan(other))
    if isinstance(value, list) and isinstance(other, list):
        return len(value) == len(other) and all(map(is_near, value, other))
    return value == other


def differ(found, other, name):
    """Whether two runs have something else. Tables of quality where pieces are have figures."""
    if name == "quality of dealt mesh":
        figures, others = found[name], other[name]
        return figures.keys() != others.keys() or not all(is_near(figures[column], others[column]) for column in figures)
    return found.get(name) != other.get(name)


def check_failures(mpiexec, pvbatch):
    """A reader and a mesher that fail do so on all ranks, and say so once."""
    status, said = start(mpiexec, pvbatch, 3, str(FOLDER), "fail")
    assert status == 0, said
    assert said.count("no surface 'Nowhere'") == 1, said
    assert said.count("holds no surfaces") == 1, said


def main(mpiexec, pvbatch):
    shutil.rmtree(FOLDER, ignore_errors=True)
    alone = run(mpiexec, pvbatch, 1)
    assert alone["mesher of pieces"] == alone["mesher"]
    assert "case.openfoam/constant/polyMesh/owner" in alone and "mesh.msh" in alone, alone.keys()
    for ranks in (2, 3, 5, 8):
        together = run(mpiexec, pvbatch, ranks)
        differing = [name for name in alone.keys() | together.keys() if differ(alone, together, name)]
        assert not differing, (ranks, differing)
    check_failures(mpiexec, pvbatch)
    print("ranks give what one gives")


main(*sys.argv[1:])
