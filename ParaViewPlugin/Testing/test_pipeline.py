# SPDX-License-Identifier: GPL-3.0-or-later
"""The pipeline of the plugin gives the arrays, patches and tables it promises. Needs no display."""

import os
import pathlib
import shutil

from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet

from house_pipeline import house

METRICS = [
    "CellSquish", "FaceSquish", "AspectRatio", "InverseAspectRatio", "OrthogonalQuality", "NonOrthogonality",
    "Skewness", "Volume", "FacePyramids", "ScaledJacobian",
]


# What the tables have of faces alone.
OF_FACES = ["FaceNonOrthogonality", "FaceSkewness"]


def fetch(source, port=0):
    """The data itself. (servermanager.Fetch would turn collections into multi-blocks.)"""
    simple.UpdatePipeline(proxy=simple.OutputPort(source, port))
    return source.GetClientSideObject().GetOutputDataObject(port)


def names(attributes):
    return {attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())}


def check_surfaces(reader):
    assert "AtriaVRMLReader" in reader.GetXMLName(), f"the model was opened by {reader.GetXMLName()}"
    surfaces = fetch(reader)
    assert surfaces.GetNumberOfCells() > 50
    assert "SurfaceId" in names(surfaces.GetCellData())
    found = surfaces.GetFieldData().GetAbstractArray("SurfaceName")
    found = {found.GetValue(i) for i in range(found.GetNumberOfValues())}
    assert {"Site", "WallSouth", "RoofNorth", "PartitionA", "Neighbor"} <= found, found


def check_octree(octree):
    leaves = fetch(octree)
    assert leaves.GetClassName() == "vtkUnstructuredGrid"
    assert {"Level", "FeatureType"} <= names(leaves.GetCellData())
    octree.OutputType = "Hyper Tree Grid"
    assert fetch(octree).GetClassName() == "vtkHyperTreeGrid"
    octree.OutputType = "Unstructured Grid"


def check_sizes(reader):
    """Without sizes they follow from the model, as a preflight tells them; entered, they hold."""
    preflight = simple.AtriaPreflight(Input=reader)
    preflight.UpdatePipeline()
    preflight.UpdatePropertyInformation()
    high, mid, low = preflight.SizesTaken
    assert 0.0 < 2 * low == mid <= high / 4, (low, mid, high)
    octree = simple.AtriaOctreeSource(Input=reader)
    assert [octree.SizeMax, octree.SizeMid, octree.SizeMin] == [0.0] * 3
    leaves = fetch(octree).GetNumberOfCells()
    octree.SizeMax, octree.SizeMid, octree.SizeMin = high, mid, low
    assert fetch(octree).GetNumberOfCells() == leaves
    octree.SizeMid = octree.SizeMin = 4 * low
    assert fetch(octree).GetNumberOfCells() < leaves


def check_mesh(mesher):
    mesh = fetch(mesher)
    assert mesh.GetNumberOfCells() > 1000
    assert {"ZoneId", "Level"} <= names(mesh.GetCellData())
    patches = fetch(mesher, 1)
    blocks = {
        patches.GetMetaData(i).Get(vtkCompositeDataSet.NAME())
        for i in range(patches.GetNumberOfPartitionedDataSets())
    }
    assert {"WallSouth_front", "WallSouth_back", "Neighbor", "xMin", "zMax"} <= blocks, blocks
    diagnostics = fetch(mesher, 2)
    assert diagnostics.GetFieldData().GetAbstractArray("DiagnosticName") is not None


def check_quality(quality):
    measured = fetch(quality)
    assert set(METRICS) | {"Valid"} <= names(measured.GetCellData())
    assert fetch(quality, 1).GetNumberOfRows() == len(METRICS) + len(OF_FACES)
    histogram = fetch(quality, 2)
    assert {"CellSquish", "CellSquish_PDF", "CellSquish_CDF"} <= names(histogram.GetRowData())
    assert histogram.GetNumberOfRows() == quality.NumberOfBins
    valid = measured.GetCellData().GetArray("Valid")
    invalid = sum(1 for i in range(valid.GetNumberOfTuples()) if not valid.GetTuple1(i))
    quality.UpdatePropertyInformation()
    assert quality.GetPropertyValue("NumberOfInvalidCells") == invalid


def check_checks(quality):
    quality.CheckMesh = 1
    checks = fetch(quality, 3)
    assert checks.GetNumberOfRows() > 10
    quality.UpdatePropertyInformation()
    rows = range(checks.GetNumberOfRows())
    failed = sum(1 for i in rows if checks.GetValueByName(i, "Failing").ToInt() and checks.GetValueByName(i, "IsError").ToInt())
    # With the layer of the default there is nothing to object to.
    assert quality.GetPropertyValue("NumberOfFailedChecks") == failed == 0
    assert "FailedChecks" in names(fetch(quality).GetCellData())
    quality.CheckMesh = 0


def check_worst(quality):
    worst = simple.AtriaWorstElements(Input=quality, MetricName="NonOrthogonality", NumberOfElements=5)
    elements = fetch(worst)
    ranks = [elements.GetCellData().GetArray("WorstRank").GetTuple1(i) for i in range(5)]
    assert ranks == [1, 2, 3, 4, 5], ranks
    greatest = fetch(quality).GetCellData().GetArray("NonOrthogonality").GetRange()[1]
    assert elements.GetCellData().GetArray("NonOrthogonality").GetTuple1(0) == greatest


def check_writer(mesher, patches):
    folder = pathlib.Path(os.environ["ATRIA_OUTPUT"]) / "house.openfoam"
    shutil.rmtree(folder, ignore_errors=True)
    simple.SaveData(str(folder), proxy=mesher, Patches=patches)
    boundary = (folder / "constant" / "polyMesh" / "boundary").read_text()
    assert "WallSouth_front" in boundary


def main():
    pipeline = house()
    check_surfaces(pipeline.reader)
    check_octree(pipeline.octree)
    check_sizes(pipeline.reader)
    check_mesh(pipeline.mesher)
    check_quality(pipeline.quality)
    check_checks(pipeline.quality)
    check_worst(pipeline.quality)
    check_writer(pipeline.mesher, pipeline.patches)
    print("the pipeline gives what it promises")


main()
