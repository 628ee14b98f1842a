# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs docs/tutorial.md as it is written, in an empty folder, and looks at what each step promises.

Usage: test_tutorial.py TUTORIAL.md ATRIA [PVPYTHON]

Blocks of sh are run one after the other; a block of Python is put into the file that its first line names. Fewer
iterations are run than the tutorial asks for, unless ATRIA_TEST_FULL is set. What needs OpenFOAM, or ParaView and
xvfb-run, is left out with a word where these are missing; status 77 then.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

TUTORIAL, ATRIA = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
PVPYTHON = sys.argv[3] if len(sys.argv) > 3 and os.access(sys.argv[3], os.X_OK) else shutil.which("pvpython")
FULL = "ATRIA_TEST_FULL" in os.environ
FEW = 5
missing = []


def run(block, folder):
    path = os.pathsep.join([str(ATRIA.parent), str(folder / ".bin"), os.environ["PATH"]])
    done = subprocess.run(["bash", "-e", "-c", block], cwd=folder, env={**os.environ, "PATH": path}, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, f"{block}\nends with status {done.returncode}:\n{done.stdout}"
    return done.stdout


def can_run(block):
    """Whether what the block needs is there."""
    for word, program in (("Allrun", shutil.which("simpleFoam")), ("pvpython", PVPYTHON and shutil.which("xvfb-run"))):
        if word in block and not program:
            missing.append(block.strip())
            return False
    return not ("pvpython" in block and missing)  # without a flow there is nothing to draw


def prepare(folder):
    """The files that the tutorial links to, and a pvpython that has a display."""
    for link in re.findall(r"\]\(([^)]+\.(?:wrl|py))\)", TUTORIAL.read_text()):
        shutil.copy(TUTORIAL.parent / link, folder)
    (folder / ".bin").mkdir()
    if PVPYTHON:
        script = folder / ".bin" / "pvpython"
        script.write_text(f"#!/bin/sh\nexec xvfb-run -a -s '-screen 0 1280x900x24 -noreset' '{PVPYTHON}' \"$@\"\n")
        script.chmod(0o755)


def check(folder, said):
    """What the text says of the results."""
    everything = "\n".join(said)
    for option in ("--unit", "--up", "--surfaces-by group"):
        assert re.search(rf"warning: sketchup_house.wrl: .*{option}\b", said[0]), said[0]
    assert "warning" not in said[1] and "WallSouth" in said[1], said[1]
    assert re.search(r"warning: .*narrowest opening, 1 wide, between 'PartitionB'.* 2 octants", said[2]), said[2]
    for line in (r"^not valid +none$", r"^left out +insides of solids 1$", r"^patches .*WallSouth_front, WallSouth_back"):
        assert re.search(line, everything, re.MULTILINE), f"no {line} in\n{everything}"
    quality = {row[0]: float(row[2]) for row in map(str.split, said[5].splitlines()) if len(row) == 5 and row[0] != "metric"}
    assert quality["NonOrthogonality"] < 70 and quality["Skewness"] < 4, quality
    roles = json.loads((folder / "case" / "case.json").read_text())["directions"][0]["patches"]
    assert set(roles.values()) == {"inlet", "outlet", "ground", "wall", "slip"}, roles
    assert "fails" not in said[6], said[6]
    assert all((folder / name).stat().st_size > 0 for name in ("house.vtu", "patches.vtpc", "worst.vtu"))
    if (folder / "flow.png").exists():
        assert (folder / "flow.png").stat().st_size > 20000, "the picture of the flow is empty"


def main():
    said = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        prepare(folder)
        for language, block in re.findall(r"^```(\w+)\n(.*?)^```", TUTORIAL.read_text(), re.DOTALL | re.MULTILINE):
            if language == "python":
                (folder / re.match(r"# (\S+\.py)\n", block)[1]).write_text(block)
                continue
            if not FULL:
                block = re.sub(r"--iterations \d+", f"--iterations {FEW}", block)
            if can_run(block):
                said.append(run(block, folder))
        check(folder, said)
        print(f"{len(said)} blocks of the tutorial were run")
    for block in missing:
        print(f"SKIP: not run, as the program is missing: {block}")
    sys.exit(77 if missing else 0)


main()
