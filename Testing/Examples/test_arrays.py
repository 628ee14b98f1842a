# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/arrays.md lists the arrays of every output: no more, no fewer.

Usage: test_arrays.py docs/arrays.md MODEL.wrl
"""

import pathlib
import re
import sys
import tempfile

from vtkmodules.vtkCommonDataModel import vtkPartitionedDataSetCollection, vtkTable

from atria import (
    vtkAtriaDualMesher, vtkAtriaFeatureGraph, vtkAtriaMeshQuality, vtkAtriaOctreeSource, vtkAtriaPreflight,
    vtkAtriaVRMLReader, vtkAtriaWeatherReader, vtkAtriaWorstElements,
)
from weather_year import epw


def documented(file):
    """{beginning of heading: names in the first column of the section's tables}"""
    sections = {}
    for section in file.read_text().split("\n## ")[1:]:
        heading, _, body = section.partition("\n")
        rows = re.findall(r"^\| (`[^|]*`) \|", body, re.MULTILINE)
        sections[heading.split(" (")[0]] = {name for row in rows for name in re.findall(r"`(\w+)`", row)}
    return sections


def names_of(data):
    """Names of all arrays of an output."""
    if isinstance(data, vtkTable):
        return {data.GetColumnName(i) for i in range(data.GetNumberOfColumns())}
    if isinstance(data, vtkPartitionedDataSetCollection):
        return set().union(*(names_of(data.GetPartition(i, 0)) for i in range(data.GetNumberOfPartitionedDataSets())))
    return {
        attributes.GetArrayName(i)
        for attributes in (data.GetCellData(), data.GetPointData(), data.GetFieldData())
        for i in range(attributes.GetNumberOfArrays())
    }


def fields_of(data):
    """Names of all field arrays, also of those of texts."""
    fields = data.GetFieldData()
    return {fields.GetAbstractArray(i).GetName() for i in range(fields.GetNumberOfArrays())}


def climate():
    """All that the reader of weather files makes."""
    with tempfile.TemporaryDirectory() as scratch:
        file = pathlib.Path(scratch) / "year.epw"
        file.write_text(epw(lambda hour: 20.0, lambda hour: 10.0 * (hour % 36), lambda hour: 1.0 + hour % 7))
        reader = vtkAtriaWeatherReader()
        reader.SetFileName(str(file))
        reader.Update()
        return names_of(reader.GetOutput()) | fields_of(reader.GetOutput())


def outputs(model):
    reader = vtkAtriaVRMLReader()
    reader.SetFileName(model)
    octree, mesher, quality = vtkAtriaOctreeSource(), vtkAtriaDualMesher(), vtkAtriaMeshQuality()
    features, preflight = vtkAtriaFeatureGraph(), vtkAtriaPreflight()
    for grid in (features, octree, mesher, preflight):
        grid.SetInputConnection(reader.GetOutputPort())
        grid.SetSizeMax(16.0)
        grid.SetSizeMid(4.0)
        grid.SetSizeMin(2.0)
        grid.SetDomainMode(vtkAtriaDualMesher.Site)
        grid.SetSiteName("Site")
    quality.SetInputConnection(mesher.GetOutputPort())
    quality.CheckMeshOn()
    worst = vtkAtriaWorstElements()
    worst.SetInputConnection(quality.GetOutputPort())
    features.Update()
    octree.Update()
    preflight.Update()
    report = preflight.GetOutput()
    worst.Update()
    mesh = names_of(mesher.GetOutputDataObject(0))
    zoned = vtkAtriaDualMesher()  # with all that is there where openings and zones are asked for only
    zoned.SetInputConnection(reader.GetOutputPort())
    zoned.SetSizeMax(8.0)
    zoned.SetSizeMid(1.0)
    zoned.SetSizeMin(0.5)
    zoned.SetDomainMode(vtkAtriaDualMesher.Site)
    zoned.SetSiteName("Site")
    zoned.SetFindOpenings(True)
    zoned.AddCellZone("Neighbor")
    zoned.Update()
    return {
        "Surfaces": names_of(reader.GetOutput()),
        "Feature curves": names_of(features.GetOutputDataObject(0)),
        "Model": names_of(features.GetOutputDataObject(1)),
        "Octree": names_of(octree.GetOutputDataObject(0)),
        "Mesh": mesh | names_of(zoned.GetOutputDataObject(0)),
        "Patches": names_of(mesher.GetOutputDataObject(1)) | names_of(zoned.GetOutputDataObject(1)),
        "Diagnostics": names_of(mesher.GetOutputDataObject(2)) | names_of(zoned.GetOutputDataObject(2)),
        "Preflight": names_of(report) | fields_of(report),
        "Quality": (names_of(quality.GetOutput()) - mesh) | names_of(quality.GetSummary()) | names_of(quality.GetChecks()),
        "Climate": climate(),
        "Worst elements": names_of(worst.GetOutput()) - names_of(quality.GetOutput()),
    }


def main(file, model):
    sections = documented(file)
    wrong = False
    for heading, names in outputs(model).items():
        for kind, difference in (("not documented", names - sections[heading]), ("not there", sections[heading] - names)):
            if difference:
                print(f"{heading}: {kind}: {', '.join(sorted(difference))}", file=sys.stderr)
                wrong = True
    sys.exit(1 if wrong else 0)


main(pathlib.Path(sys.argv[1]), sys.argv[2])
