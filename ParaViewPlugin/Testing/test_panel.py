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


def occurring(mesher):
    """The kinds of diagnostics that are there."""
    data = mesher.GetClientSideObject().GetOutputDataObject(2)
    kinds, names = data.GetCellData().GetArray("Diagnostic"), data.GetFieldData().GetAbstractArray("DiagnosticName")
    return {names.GetValue(int(kinds.GetValue(i))) for i in range(kinds.GetNumberOfValues())} if kinds else set()


def check_diagnostics(pipeline):
    """A sealed seed in a house with a door gives a leak at least. The legend has what occurs, whatever changes."""
    mesher = simple.AtriaDualMesher(Input=pipeline.reader, SizeMax=16.0, SizeMid=4.0, SizeMin=1.0, DomainMode="Site")
    mesher.SealedSeeds = [5.0, 4.0, 1.5]
    output = simple.OutputPort(mesher, 2)
    output.UpdatePipeline()
    shown = simple.Show(output)
    assert list(shown.ColorArrayName) == ["CELLS", "Diagnostic"], shown.ColorArrayName
    sealed = occurring(mesher)
    assert "LeakPath" in sealed and set(names_of(shown)) == sealed, (names_of(shown), sealed)
    mine = [0.1, 0.2, 0.3]
    colors = list(shown.LookupTable.IndexedColors)
    place = 3 * names_of(shown).index("OpenCrack")
    shown.LookupTable.IndexedColors = colors[:place] + mine + colors[place + 3:]
    mesher.SealedSeeds, mesher.CrackTolerance = [], 0.0
    output.UpdatePipeline()
    others = occurring(mesher)
    assert "LeakPath" not in others and set(names_of(shown)) == others, (names_of(shown), others)
    place = 3 * names_of(shown).index("OpenCrack")
    assert list(shown.LookupTable.IndexedColors)[place:place + 3] == mine, "colors of one's own stay"


def check_first_diagnostics(pipeline):
    """What comes only after a change is colored and named as well, but not against a user's choice."""
    box = simple.Box(XLength=4, YLength=4, ZLength=4)
    mesher = simple.AtriaDualMesher(Input=box, SizeMax=1.0, SizeMid=1.0, SizeMin=1.0, DomainMode="Explicit",
                                    DomainBounds=[-5, 5, -5, 5, -5, 5])
    output = simple.OutputPort(mesher, 2)
    output.UpdatePipeline()
    assert not occurring(mesher)
    shown = simple.Show(output)
    assert not shown.ColorArrayName[1], shown.ColorArrayName
    mesher.Input, mesher.DomainMode = pipeline.reader, "Site"
    output.UpdatePipeline()
    assert occurring(mesher) and occurring(mesher) <= set(names_of(shown)), (occurring(mesher), names_of(shown))
    simple.ColorBy(shown, None)
    mesher.SizeMin = 0.5
    output.UpdatePipeline()
    assert not shown.ColorArrayName[1], shown.ColorArrayName


def check_legend(pipeline):
    """Dark letters on a light ground; and the names of a model that is read otherwise are its new ones."""
    view = simple.GetActiveViewOrCreate("RenderView")
    shown = simple.Show(pipeline.reader, view)
    shown.SetScalarBarVisibility(view, True)
    legend = simple.GetScalarBar(shown.LookupTable, view)
    assert legend.DrawBackground == 1 and min(legend.BackgroundColor[:3]) > 0.9, list(legend.BackgroundColor)
    assert max(legend.LabelColor) < 0.2 and max(legend.TitleColor) < 0.2, list(legend.LabelColor)
    simple.LoadPalette("WhiteBackground")
    assert max(legend.LabelColor) < 0.2 and min(legend.BackgroundColor[:3]) > 0.9
    pipeline.reader.ExcludedSurfaces = ["Neighbor"]
    pipeline.reader.UpdatePipeline()
    assert "WallSouth" in names_of(shown) and "Neighbor" not in names_of(shown), names_of(shown)


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
check_first_diagnostics(pipeline)
check_legend(pipeline)
