# SPDX-License-Identifier: GPL-3.0-or-later
"""The pipeline on a pvserver: reader, mesher, quality and writer run there, and names and numbers come to the client.

Usage: pvpython test_server.py PVSERVER
"""

import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys

from paraview import simple
from paraview.modules.vtkRemotingServerManager import vtkSMProxyManager

from house_pipeline import build_house

FOLDER = pathlib.Path(os.environ["ATRIA_OUTPUT"]) / "server.openfoam"


def free_port():
    with socket.socket() as listener:
        listener.bind(("localhost", 0))
        return listener.getsockname()[1]


def start(pvserver, port):
    """The server, once it listens."""
    command = [pvserver, f"--server-port={port}"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    for line in server.stdout:
        if line.startswith("Accepting connection"):
            return server
    raise AssertionError("pvserver does not listen")


def check(pipeline):
    assert pipeline.mesher.GetClientSideObject() is None, "the mesher is in the client"
    pipeline.quality.UpdatePipeline()
    pipeline.quality.UpdatePropertyInformation()
    cells = pipeline.mesher.GetDataInformation().GetNumberOfCells()
    assert cells > 1000, cells
    assert pipeline.quality.GetPropertyValue("NumberOfInvalidCells") == 0
    assert "CellSquish" in pipeline.quality.CellData.keys()
    # What the panel's button does.
    sm = pipeline.octree.SMProxy
    sm.InvokeCommand("Estimate")
    sm.UpdatePropertyInformation()
    estimated = pipeline.octree.GetPropertyValue("EstimatedElements")
    assert 0.5 * cells < estimated < 2 * cells, (estimated, cells)


def check_case(mesher):
    shutil.rmtree(FOLDER, ignore_errors=True)
    simple.SaveData(str(FOLDER), proxy=mesher)
    boundary = (FOLDER / "constant" / "polyMesh" / "boundary").read_text()
    assert re.search(r"^    WallSouth_front\n", boundary, re.MULTILINE), boundary


def main(pvserver):
    port = free_port()
    server = start(pvserver, port)
    try:
        assert simple.Connect("localhost", port) is not None
        simple.LoadPlugin(os.environ["ATRIA_PLUGIN"], remote=True)
        simple.LoadPlugin(os.environ["ATRIA_PLUGIN"], remote=False)
        assert vtkSMProxyManager.GetProxyManager().GetActiveSession().IsA("vtkSMSessionClient")
        pipeline = build_house()
        check(pipeline)
        check_case(pipeline.mesher)
        print("the server's pipeline gives what it promises")
        # The client's objects would write to the server as they go.
        sys.stdout.flush()
        server.kill()
        os._exit(0)
    finally:
        server.kill()


main(sys.argv[1])
