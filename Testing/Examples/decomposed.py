# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of OpenFOAM that are divided among processors, beside what its own decomposePar makes of them."""

import itertools
import os
import re
import shutil
import subprocess

HAVE_OPENFOAM = shutil.which("simpleFoam") is not None
# Of Open MPI, for root, and for more processors than this machine has.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_mpi_yield_when_idle": "1", "WM_PROJECT_DIR": "/usr/share/openfoam"}


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


def run_in(test, folder, *command):
    """What a command prints that has to succeed."""
    run = subprocess.run(list(map(str, command)), cwd=folder, env=os.environ | MPI, capture_output=True, text=True, check=False)
    test.assertEqual(run.returncode, 0, run.stdout[-3000:] + run.stderr)
    return run.stdout


def expect_decompose_par(test, case, other, parts, zones=("faceZones", "cellZones")):
    """The processors of an ascii case hold what decomposePar makes of the same division, in the folder `other`."""
    shutil.copytree(case, other, ignore=shutil.ignore_patterns("processor*"))
    part_of = {}
    for part in range(parts):
        for cell in labels(case / f"processor{part}/constant/polyMesh/cellProcAddressing"):
            part_of[cell] = part
    header = 'FoamFile { version 2.0; format ascii; class %s; location "%s"; object %s; }\n'
    (other / "constant/division").write_text(header % ("labelList", "constant", "division") + f"{len(part_of)}\n(\n" +
                                             "\n".join(str(part_of[c]) for c in range(len(part_of))) + "\n)\n")
    (other / "system/decomposeParDict").write_text(
        header % ("dictionary", "system", "decomposeParDict") +
        f"numberOfSubdomains {parts};\nmethod manual;\nmanualCoeffs {{ dataFile \"division\"; }}\n")
    run_in(test, other, "decomposePar")
    for part in range(parts):
        own, theirs = all_of(part, (case, other))
        for name in ("faces", "owner", "neighbour", "cellProcAddressing", "faceProcAddressing", "pointProcAddressing",
                     "boundaryProcAddressing", *zones):
            test.assertEqual(content(own / name), content(theirs / name), f"{part} {name}")
        for a, b in itertools.zip_longest(content(own / "points"), content(theirs / "points")):
            test.assertAlmostEqual(a, b, delta=1e-9)
        test.assertEqual(patches(own / "boundary"), patches(theirs / "boundary"))
