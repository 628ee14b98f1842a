# SPDX-License-Identifier: GPL-3.0-or-later
"""The client of a pvserver of two ranks, each of which holds a part of the mesh; pictures of it.

Usage: pvpython ranks_client.py PORT
"""

import os
import pathlib
import sys

import numpy
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from house_pipeline import build_house, render_cut

FOLDER = pathlib.Path(os.environ["ATRIA_OUTPUT"])


def connect(port):
    connection = simple.Connect("localhost", port)
    simple.LoadPlugin(os.environ["ATRIA_PLUGIN"], remote=True)
    simple.LoadPlugin(os.environ["ATRIA_PLUGIN"], remote=False)
    assert connection.GetNumberOfDataPartitions() == 2


def check_quality(pipeline):
    pipeline.quality.UpdatePipeline()
    pipeline.quality.UpdatePropertyInformation()
    assert pipeline.quality.GetPropertyValue("NumberOfInvalidCells") == 0
    names = pipeline.patches.GetDataInformation().DataInformation
    assert names.GetNumberOfCells() > 1000


def picture(source, colors, name, remote):
    """What the server, or the client, draws of a cut through the mesh."""
    simple.GetSettingsProxy("RenderViewSettings").RemoteRenderThreshold = 0 if remote else 1e6
    view = simple.CreateRenderView(ViewSize=[900, 600], OrientationAxesVisibility=0)
    render_cut(view, source, colors, False)
    file = FOLDER / f"{name}.png"
    file.unlink(missing_ok=True)
    simple.SaveScreenshot(str(file), view)
    simple.Delete(view)
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)


def check_pictures(pipeline):
    """Both draw the same, and both ranks' parts are in it."""
    drawn = [picture(pipeline.quality, ("CELLS", "CellSquish"), f"ranks_{where}", where == "server")
             for where in ("server", "client")]
    colors = len(numpy.unique(drawn[0], axis=0))
    assert colors > 100, colors
    differing = (abs(drawn[0] - drawn[1]).max(axis=1) > 30).mean()
    assert differing < 0.01, differing
    parts = picture(simple.ProcessIdScalars(Input=pipeline.mesher), ("POINTS", "ProcessId"), "ranks_parts", True)
    for tint in (0, 2):  # the first rank's is blue, the second's red
        share = (parts[:, tint] - parts[:, 2 - tint] > 60).mean()
        assert share > 0.05, (tint, share)


def main(port):
    connect(port)
    pipeline = build_house()
    check_quality(pipeline)
    check_pictures(pipeline)
    print("two ranks of a server show the mesh")
    sys.stdout.flush()
    os._exit(0)  # the client's objects would write to the server as they go


main(int(sys.argv[1]))
