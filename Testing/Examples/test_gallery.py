# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of docs/gallery.md again: each shows what the one in the documents does.

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


def main():
    shown = re.findall(r"\]\(pictures/(gallery-\w+\.png)\)", (SOURCE / "docs/gallery.md").read_text(encoding="utf-8"))
    assert len(shown) == len(set(shown)) > 5, shown
    if not PVPYTHON or not XVFB:
        print("SKIP: pvpython or xvfb-run is missing")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([XVFB, "-a", "-s", "-screen 0 1280x900x24 -noreset", PVPYTHON, SOURCE / "docs/pictures/gallery.py", ATRIA,
                        SOURCE, scratch], check=True)
        made = sorted(file.name for file in pathlib.Path(scratch).iterdir())
        assert made == sorted(shown), (made, shown)
        for name in made:
            new, old = blocks_of(pathlib.Path(scratch) / name), blocks_of(SOURCE / "docs/pictures" / name)
            assert new.shape == old.shape, name
            difference = float(numpy.abs(new - old).mean())
            print(f"{name}: differs by {difference:.4f}")
            assert new.std() > 0.05, f"{name} is empty"
            assert difference < MOST_DIFFERENT, f"{name} is not what the documents show: make it again"


main()
