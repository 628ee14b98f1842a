# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures without a display, and that of patches for notebooks.

VTK ends the process where it finds no display, and a notebook should survive that: `drawing.py` draws in an interpreter
of its own, under xvfb-run if need be.
"""

from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping

from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData

SECONDS = 60


def picture_of(patches: Mapping[str, vtkPolyData]) -> bytes | None:
    """A PNG of the patches, or None where nothing can be drawn."""
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter

    blocks = vtkMultiBlockDataSet()
    for index, patch in enumerate(patches.values()):
        blocks.SetBlock(index, patch)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "patches.vtm"
        writer = vtkXMLMultiBlockDataWriter()
        writer.SetFileName(str(file))
        writer.SetInputData(blocks)
        writer.Write()
        return drawn_apart("patches", str(file))


def drawn_apart(kind, file) -> bytes | None:
    """A PNG of a kind that drawing.py knows; None where it cannot be drawn, such as without a display."""
    command = [sys.executable, str(pathlib.Path(__file__).with_name("drawing.py"))]
    if not os.environ.get("DISPLAY") and sys.platform.startswith("linux"):
        if not shutil.which("xvfb-run"):
            return None
        command = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", *command]
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder) / "picture.png"
        try:
            subprocess.run([*command, kind, file, str(picture)], check=True, capture_output=True, timeout=SECONDS)
            return picture.read_bytes()
        except (OSError, subprocess.SubprocessError):
            return None
