# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of docs/gallery.md again, and that of the README: each shows what the one in the documents does.

Usage: test_gallery.py SOURCE ATRIA [PVPYTHON]; status 77 without ParaView or xvfb-run
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

SOURCE, ATRIA = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
PVPYTHON = sys.argv[3] if len(sys.argv) > 3 and os.access(sys.argv[3], os.X_OK) else shutil.which("pvpython")
XVFB = shutil.which("xvfb-run")
# Blocks of so many pixels are compared; by how much of the whole range they may differ on average: elements that moved
# a little and other drivers do less, another view or a surface that is missing more.
BLOCK = 20
MOST_DIFFERENT = 0.03


def blocks_of(file):
    """Mean colors of blocks, 0 to 1."""
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3] / 255.0
    rows, columns = height // BLOCK, width // BLOCK
    return pixels[:rows * BLOCK, :columns * BLOCK].reshape(rows, BLOCK, columns, BLOCK, 3).mean(axis=(1, 3))


def drawn(*command):
    subprocess.run([XVFB, "-a", "-s", "-screen 0 1280x900x24 -noreset", *command], check=True)


def compare(new, old):
    new, old = blocks_of(new), blocks_of(old)
    assert new.shape == old.shape, (new.shape, old.shape)
    difference = float(numpy.abs(new - old).mean())
    assert new.std() > 0.05, "it is empty"
    assert difference < MOST_DIFFERENT, f"it differs by {difference:.3f}"
    return difference


def check_readme(folder):
    """The picture that Examples/run.sh draws, with its options."""
    script = (SOURCE / "Examples/run.sh").read_text(encoding="utf-8")
    options = re.search(r"(--site Site .*?) \|\|", script)[1].split()
    mesh, patches, picture = (folder / name for name in ("mesh.vtu", "patches.vtpc", "house.png"))
    subprocess.run([ATRIA, "mesh", SOURCE / "Examples/Data/house.wrl", "-o", mesh, "--patches", patches, *options], check=True,
                   stdout=subprocess.DEVNULL)
    drawn("/usr/bin/python3", SOURCE / "Examples/Python/picture.py", mesh, patches, picture)
    print(f"{picture.name}: differs by {compare(picture, SOURCE / 'docs/house.png'):.4f}")


def main():
    shown = re.findall(r"\]\(pictures/(gallery-\w+\.png)\)", (SOURCE / "docs/gallery.md").read_text(encoding="utf-8"))
    assert len(shown) == len(set(shown)) > 5, shown
    if not PVPYTHON or not XVFB:
        print("SKIP: pvpython or xvfb-run is missing")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scratch:
        drawn(PVPYTHON, SOURCE / "docs/pictures/gallery.py", ATRIA, SOURCE, scratch)
        made = sorted(file.name for file in pathlib.Path(scratch).iterdir())
        assert made == sorted(shown), (made, shown)
        for name in made:
            print(f"{name}: differs by {compare(pathlib.Path(scratch) / name, SOURCE / 'docs/pictures' / name):.4f}")
        check_readme(pathlib.Path(scratch))


main()
