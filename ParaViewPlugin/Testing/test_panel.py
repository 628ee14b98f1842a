# SPDX-License-Identifier: GPL-3.0-or-later
"""What panels and views show without being told: groups in the order of work, labels, edges, colors.

Usage: pvbatch test_panel.py
"""

import pathlib
import xml.etree.ElementTree as ElementTree

from paraview import simple

from house_pipeline import house

# What is not advanced comes in this order.
WORK = ["Sizes [m]", "Domain [m, degrees]", "Domain Box [m]", "Fluid", "Seeds [m]", "Layers on Walls [m]"]
# Widgets of the panel, by group or property.
WIDGETS = {
    "Sizes in Boxes [m]": "PropertyCollection", "Domain Box [m]": "AtriaBox", "Seeds [m]": "PropertyCollection",
    "Sealed Seeds [m]": "PropertyCollection",
    "SurfaceSizeRules": "atria_surface_rules", "DistanceSizeRules": "atria_surface_rules",
    "LayerRules": "atria_surface_rules", "SiteName": "atria_surface_name", "TerrainName": "atria_surface_name",
    "EstimateElements": "atria_estimate",
}


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


def check_widgets(proxy):
    sm = proxy.SMProxy
    groups = [sm.GetPropertyGroup(i) for i in range(sm.GetNumberOfPropertyGroups())]
    found = {g.GetXMLLabel(): g.GetPanelWidget() for g in groups if g.GetPanelWidget()}
    found.update({n: sm.GetProperty(n).GetPanelWidget() for n in WIDGETS if sm.GetProperty(n)})
    assert found == WIDGETS, found


def check_tooltips():
    """ParaView takes text between two asterisks for italics, and drops them."""
    for file in pathlib.Path(__file__).parent.parent.glob("*.xml"):
        for element in ElementTree.parse(file).iter("Documentation"):
            assert (element.text or "").count("*") < 2, f"{file.name}: {element.text}"


def check_labels_are_names_in_scripts(proxy):
    for name in ("SizeMax", "DomainBounds", "SurfaceSizeRules", "NumberOfLayers"):
        assert name in proxy.ListProperties(), name


def names_of(display):
    """What the legend says."""
    colors = display.LookupTable
    assert colors.InterpretValuesAsCategories == 1
    assert len(colors.IndexedColors) == 3 * len(colors.Annotations) // 2
    return list(colors.Annotations)[1::2]


def check_views(pipeline):
    shown = simple.Show(pipeline.reader)
    assert list(shown.ColorArrayName) == ["CELLS", "SurfaceId"], shown.ColorArrayName
    assert {"Site", "WallSouth", "RoofNorth", "PartitionA", "Neighbor"} <= set(names_of(shown)), names_of(shown)
    mesh = simple.Show(pipeline.mesher)
    assert (mesh.Representation, mesh.BackfaceRepresentation) == ("Surface With Edges", "Cull Frontface")
    patches = simple.Show(pipeline.patches)
    assert (patches.Representation, patches.BackfaceRepresentation) == ("Surface With Edges", "Cull Frontface")
    diagnostics = simple.Show(simple.OutputPort(pipeline.mesher, 2))
    assert diagnostics.Representation != "Surface With Edges"


def check_diagnostics(pipeline):
    """A sealed seed in a house with a door gives a leak at least."""
    mesher = simple.AtriaDualMesher(Input=pipeline.reader, SizeMax=16.0, SizeMid=4.0, SizeMin=1.0, DomainMode="Site")
    mesher.SealedSeeds = [5.0, 4.0, 1.5]
    output = simple.OutputPort(mesher, 2)
    output.UpdatePipeline()
    assert output.GetDataInformation().GetNumberOfCells() > 0
    shown = simple.Show(output)
    assert list(shown.ColorArrayName) == ["CELLS", "Diagnostic"], shown.ColorArrayName
    assert {"MergedSheets", "LeakPath", "OpenCrack"} <= set(names_of(shown)), names_of(shown)


def check_first_views(quality):
    """Of the outputs of the quality, the mesh and the chart show themselves; tables do not."""
    hints = quality.GetHints()
    types = {h.GetAttribute("port"): h.GetAttribute("type")
             for h in (hints.GetNestedElement(i) for i in range(hints.GetNumberOfNestedElements()))
             if h.GetName() == "View"}
    assert types == {"1": "None", "2": "XYBarChartView", "3": "None"}, types


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
check_widgets(pipeline.mesher)
check_tooltips()
check_labels_are_names_in_scripts(pipeline.mesher)
check_views(pipeline)
check_diagnostics(pipeline)
check_first_views(pipeline.quality)
check_metrics(pipeline)
