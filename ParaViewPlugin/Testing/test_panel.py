# SPDX-License-Identifier: GPL-3.0-or-later
"""What panels and views show without being told: groups in the order of work, labels, edges, colors.

Usage: pvbatch test_panel.py
"""

import pathlib
import xml.etree.ElementTree as ElementTree

from paraview import simple

from house_pipeline import house

# What is not advanced comes in this order.
WORK = ["Sizes [m]", "Domain [m, degrees]", "Fluid", "Seeds [m]", "Layers on Walls [m]"]


def check_groups(proxy):
    sm = proxy.SMProxy
    groups = [sm.GetPropertyGroup(i) for i in range(sm.GetNumberOfPropertyGroups())]
    assert [g.GetXMLLabel() for g in groups if g.GetPanelVisibility() == "default"] == WORK
    grouped = [g.GetProperty(i).GetXMLName() for g in groups for i in range(g.GetNumberOfProperties())]
    assert len(grouped) == len(set(grouped))
    shown = {name for name in proxy.ListProperties() if name not in ("Input", "Octree")}
    assert shown == set(grouped), shown ^ set(grouped)
    # A list has no label of its own in the panel: its group says what it is.
    for group in groups:
        for i in range(group.GetNumberOfProperties()):
            if group.GetProperty(i).GetRepeatable():
                assert group.GetNumberOfProperties() == 1, group.GetXMLLabel()


def check_tooltips():
    """ParaView takes text between two asterisks for italics, and drops them."""
    for file in pathlib.Path(__file__).parent.parent.glob("*.xml"):
        for element in ElementTree.parse(file).iter("Documentation"):
            assert (element.text or "").count("*") < 2, f"{file.name}: {element.text}"


def check_labels_are_names_in_scripts(proxy):
    for name in ("SizeMax", "DomainBounds", "SurfaceSizeRules", "NumberOfLayers"):
        assert name in proxy.ListProperties(), name


def check_views(pipeline):
    shown = simple.Show(pipeline.reader)
    assert list(shown.ColorArrayName) == ["CELLS", "SurfaceId"], shown.ColorArrayName
    assert simple.Show(pipeline.mesher).Representation == "Surface With Edges"
    diagnostics = simple.Show(simple.OutputPort(pipeline.mesher, 2))
    assert diagnostics.Representation != "Surface With Edges"


def check_metrics(pipeline):
    pipeline.quality.UpdatePipeline()
    worst = simple.AtriaWorstElements(Input=pipeline.quality)
    assert worst.MetricName == "CellSquish"
    assert {"CellSquish", "NonOrthogonality", "Skewness"} <= set(worst.GetProperty("MetricName").Available)
    worst.MetricName = "Skewness"
    worst.UpdatePipeline()
    assert worst.GetDataInformation().GetNumberOfCells() > 0


pipeline = house()
check_groups(pipeline.mesher)
check_tooltips()
check_labels_are_names_in_scripts(pipeline.mesher)
check_views(pipeline)
check_metrics(pipeline)
