# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the pipeline on the ranks of pvbatch, writes cases, and hashes of what the first rank holds to FOLDER/hashes.json.

Usage: mpiexec -n N pvbatch ranks_pipeline.py FOLDER [fail]; the second has a mesher and a reader fail instead.
"""

import hashlib
import json
import os
import pathlib
import sys

import atria  # noqa: F401: before VTK meets objects of its classes, which it else takes for their base
from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataObject
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from house_pipeline import house

KINDS = (vtkDataObject.POINT, vtkDataObject.CELL, vtkDataObject.ROW, vtkDataObject.FIELD)

# Runs on each rank: a share of the model's triangles in their order, none for the second rank.
SHARE = """
import atria
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
holders = [r for r in range(ranks) if r != 1 or ranks == 1]
reader = atria.vtkAtriaVRMLReader()
reader.SetFileName({model!r})
reader.Update()
whole, output = reader.GetOutput(), self.GetOutput()
output.ShallowCopy(whole)
count = whole.GetNumberOfCells() if rank in holders else 0
at = holders.index(rank) if count else 0
ids = range(count * at // len(holders), count * (at + 1) // len(holders))
cells = vtkCellArray()
for i in ids:
    cells.InsertNextCell(whole.GetCell(i).GetPointIds())
output.SetPolys(cells)
surfaces = whole.GetCellData().GetArray("SurfaceId")
own = surfaces.NewInstance()
own.SetName("SurfaceId")
for i in ids:
    own.InsertNextValue(surfaces.GetValue(i))
output.GetCellData().SetScalars(own)
"""


def bits(array):
    """A hash of the values of an array."""
    if array.IsA("vtkStringArray"):
        values = "\0".join(array.GetValue(i) for i in range(array.GetNumberOfValues())).encode()
    else:
        values = memoryview(array)
    return hashlib.sha256(values).hexdigest()[:16]


def hashes(data):
    """Of all arrays of a data object, by kind and name."""
    if data.IsA("vtkPartitionedDataSetCollection"):
        return {
            data.GetMetaData(i).Get(vtkCompositeDataSet.NAME()):
                [hashes(data.GetPartitionAsDataObject(i, j)) for j in range(data.GetNumberOfPartitions(i))]
            for i in range(data.GetNumberOfPartitionedDataSets())
        }
    found = {}
    if data.IsA("vtkPointSet") and data.GetNumberOfPoints() > 0:
        found["points"] = bits(data.GetPoints().GetData())
    if data.IsA("vtkUnstructuredGrid"):
        found["cells"] = bits(data.GetCells().GetConnectivityArray())
    for kind in KINDS:
        attributes = data.GetAttributesAsFieldData(kind)
        for i in range(attributes.GetNumberOfArrays() if attributes else 0):
            array = attributes.GetAbstractArray(i)
            if array.GetNumberOfValues() > 0:
                found[f"{kind} {array.GetName()}"] = bits(array)
    return found


def tables(source):
    """The columns of the tables of quality, which the first rank has whatever is divided."""
    for port in range(4):
        simple.UpdatePipeline(proxy=simple.OutputPort(source, port))
    columns = {}
    for port in (1, 2, 3):
        table = source.GetClientSideObject().GetOutputDataObject(port)
        for i in range(table.GetNumberOfColumns()):
            column = table.GetColumn(i)
            columns[f"{port} {column.GetName()}"] = [column.GetValue(j) for j in range(column.GetNumberOfValues())]
    return columns


def check_pieces(mesher):
    """The first rank has its share."""
    mesher.UpdatePipeline()
    ranks = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
    piece = mesher.GetClientSideObject().GetOutputDataObject(0)
    own = piece.GetCellGhostArray()
    count = list(memoryview(own)).count(0) if own else piece.GetNumberOfCells()
    whole = mesher.GetDataInformation().GetNumberOfCells() # with ghosts
    assert 0 < count <= whole / ranks, (count, whole)


def outputs(source):
    """Hashes of all outputs that the first rank holds; the others must hold nothing but names."""
    found = []
    for port in range(source.GetNumberOfOutputPorts() if hasattr(source, "GetNumberOfOutputPorts") else 1):
        simple.UpdatePipeline(proxy=simple.OutputPort(source, port))
        data = source.GetClientSideObject().GetOutputDataObject(port)
        everywhere = source.GetDataInformation(port).DataInformation
        if not data.IsA("vtkTable"):
            assert everywhere.GetNumberOfCells() == data.GetNumberOfElements(vtkDataObject.CELL), source.GetXMLName()
        found.append(hashes(data))
    return found


def share():
    """The model, spread over the ranks."""
    source = simple.ProgrammableSource(OutputDataSetType="vtkPolyData")
    source.Script = SHARE.format(model=os.environ["ATRIA_MODEL"])
    return source


def main(folder):
    pipeline = house()
    pipeline.mesher.DistributeOutput = 0
    pipeline.quality.CheckMesh = 1
    features = simple.AtriaFeatureGraph(Input=pipeline.reader)
    worst = simple.AtriaWorstElements(Input=pipeline.quality, MetricName="NonOrthogonality")
    improved = simple.AtriaMeshOptimizer(Input=pipeline.mesher, Patches=pipeline.patches, NumberOfSweeps=1)
    pipeline.octree.SMProxy.InvokeCommand("Estimate")
    pipeline.octree.UpdatePropertyInformation()
    found = {"estimate": pipeline.octree.GetPropertyValue("EstimatedElements")}
    for name, source in [("reader", pipeline.reader), ("octree", pipeline.octree), ("mesher", pipeline.mesher),
                         ("quality", pipeline.quality), ("features", features), ("worst", worst),
                         ("improved", improved)]:
        found[name] = outputs(source)
    pipeline.mesher.Input = share()
    found["mesher of pieces"] = outputs(pipeline.mesher)
    pipeline.mesher.DistributeOutput = 1
    check_pieces(pipeline.mesher)
    found["quality of dealt mesh"] = tables(pipeline.quality)
    found["worst of dealt mesh"] = outputs(worst)
    for name in ("case.openfoam", "wind.windcase", "mesh.msh"):
        simple.SaveData(str(folder / name), proxy=pipeline.mesher)
    if vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses() > 1:
        simple.SaveData(str(folder / "divided.openfoam"), proxy=pipeline.mesher, UseRanksAsProcessors=1)
    (folder / "hashes.json").write_text(json.dumps(found, indent=1))


def fail(folder):
    pipeline = house()
    pipeline.mesher.SiteName = "Nowhere"
    pipeline.quality.UpdatePipeline()
    pipeline.mesher.SiteName = "Site"
    empty = folder / "empty.wrl"
    empty.write_text("#VRML V2.0 utf8\n")
    pipeline.mesher.Input = simple.OpenDataFile(str(empty))
    pipeline.quality.UpdatePipeline()
    # All ranks go on.
    pipeline.mesher.Input = pipeline.reader
    pipeline.quality.UpdatePipeline()
    assert pipeline.mesher.GetDataInformation().GetNumberOfCells() > 1000


(fail if sys.argv[2:] == ["fail"] else main)(pathlib.Path(sys.argv[1]))
