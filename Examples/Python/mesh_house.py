#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes a model from Python: reader, mesher, quality and writers.

Usage: mesh_house.py MODEL.wrl FOLDER    (PYTHONPATH must hold the package `atria`)
"""

import pathlib
import sys

from vtkmodules.vtkIOParallelXML import vtkXMLPartitionedDataSetCollectionWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import atria
from atria import vtkAtriaDualMesher, vtkAtriaMeshQuality, vtkAtriaVRMLReader


def write(writer, connection, file):
    writer.SetInputConnection(connection)
    writer.SetFileName(str(file))
    with atria.raising(writer):  # makes errors exceptions, as Atria's own classes do
        writer.Write()


def main(model, folder):
    folder.mkdir(parents=True, exist_ok=True)

    reader = vtkAtriaVRMLReader()
    reader.SetFileName(model)

    mesher = vtkAtriaDualMesher()
    mesher.SetInputConnection(0, reader.GetOutputPort())
    mesher.SetSizeMax(8.0)  # meters, as all sizes
    mesher.SetSizeMid(2.0)
    mesher.SetSizeMin(1.0)
    mesher.SetDomainMode(vtkAtriaDualMesher.Site)
    mesher.SetSiteName("Site")

    quality = vtkAtriaMeshQuality()
    quality.SetInputConnection(0, mesher.GetOutputPort(0))
    quality.SetInputConnection(1, mesher.GetOutputPort(1))

    write(vtkXMLUnstructuredGridWriter(), quality.GetOutputPort(0), folder / "mesh.vtu")
    write(vtkXMLPartitionedDataSetCollectionWriter(), mesher.GetOutputPort(1), folder / "patches.vtpc")

    mesh = quality.GetOutput()
    print(f"{mesh.GetNumberOfCells()} elements, {quality.GetNumberOfInvalidCells()} of them not valid")
    summary = quality.GetOutputDataObject(1)
    for row in range(summary.GetNumberOfRows()):
        value = lambda column: summary.GetValueByName(row, column)
        print(f"{value('Metric').ToString():20} {value('Minimum').ToDouble():12.5g} {value('Maximum').ToDouble():12.5g}")
    if mesh.GetNumberOfCells() == 0:
        sys.exit("the mesh is empty")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
