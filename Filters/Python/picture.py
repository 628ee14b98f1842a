# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of patches, for notebooks, and what pictures without a display take.

VTK ends the process where it finds no display, and a notebook should survive that: the picture is drawn by an
interpreter of its own, which runs this file as `picture.py PATCHES.vtm PICTURE.png`, under xvfb-run if need be.
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

SIZE = (640, 400)
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
        return drawn_apart(__file__, str(file))


def drawn_apart(script, *arguments) -> bytes | None:
    """What a script draws as `script ARGUMENTS PICTURE.png`; None where it cannot, such as without a display."""
    command = [sys.executable, script]
    if not os.environ.get("DISPLAY") and sys.platform.startswith("linux"):
        if not shutil.which("xvfb-run"):
            return None
        command = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", *command]
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder) / "picture.png"
        try:
            subprocess.run([*command, *arguments, str(picture)], check=True, capture_output=True, timeout=SECONDS)
            return picture.read_bytes()
        except (OSError, subprocess.SubprocessError):
            return None


def _surface_of(patch):
    array = patch.GetCellData().GetArray("SurfaceId")
    return int(array.GetTuple1(0)) if array and array.GetNumberOfTuples() else -1


def _actor(patch, color):
    """Seen from outside; of the sides that face the eye, which would hide the rest, nothing is drawn."""
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    mapper = vtkPolyDataMapper()
    mapper.SetInputData(patch)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(color)
    look.SetAmbient(0.35)
    look.SetDiffuse(0.65)
    look.EdgeVisibilityOn()
    look.SetEdgeColor(0.35, 0.38, 0.42)
    look.FrontfaceCullingOn()
    return actor


def _bounds_of(patches):
    """Of what stands up among the model's surfaces; the ground and the domain can be far larger."""
    from vtkmodules.vtkCommonDataModel import vtkBoundingBox

    def added(chosen):
        box = vtkBoundingBox()
        for patch in chosen:
            box.AddBounds(patch.GetBounds())
        return box

    model = [patch for patch in patches if _surface_of(patch) >= 0]
    upright = [patch for patch in model if patch.GetBounds()[5] - patch.GetBounds()[4] > 1e-3 * patch.GetLength()]
    bounds = [0.0] * 6
    added(upright or model or patches).GetBounds(bounds)
    return bounds


def _draw(patches, file):
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers itself)
    from vtkmodules.vtkCommonColor import vtkColorSeries
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

    series = vtkColorSeries()
    series.SetColorScheme(vtkColorSeries.BREWER_QUALITATIVE_SET3)
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    for patch in patches:
        surface = _surface_of(patch)
        color = [part / 255.0 for part in series.GetColorRepeating(surface)] if surface >= 0 else [0.92, 0.93, 0.95]
        renderer.AddActor(_actor(patch, color))
    camera = renderer.GetActiveCamera()
    camera.SetPosition(-0.45, -0.75, 0.45)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    renderer.ResetCamera(_bounds_of(patches))
    camera.Zoom(1.3)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(SIZE)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(file)
    writer.Write()


def _main(file, picture):
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader

    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(file)
    reader.Update()
    blocks = reader.GetOutputDataObject(0)
    patches = [blocks.GetBlock(i) for i in range(blocks.GetNumberOfBlocks())]
    _draw([patch for patch in patches if patch and patch.GetNumberOfCells()], picture)


if __name__ == "__main__":
    _main(*sys.argv[1:])
