# SPDX-License-Identifier: GPL-3.0-or-later
"""From File > Open to an OpenFOAM case in ParaView's own window, with nothing but the first Apply of each step.

Usage: paraview --script=test_gui.py, with the plugin in PV_PLUGIN_PATH
"""

import os
import pathlib
import re
import shutil
import sys

# The client runs the script as text, so that it has no folder of its own.
sys.path.insert(0, os.environ["ATRIA_SCRIPTS"])

from PyQt5 import QtCore, QtWidgets

from paraview import simple

from gui_window import OUTPUT, Window, accept, choose_file, choose_reader, run

MODEL = pathlib.Path(os.environ["ATRIA_MODEL"])
# The middle of the buildings, from where, and how far.
VIEW = [12, 7, 3], (-0.45, -0.75, 0.45), 55
# The whole site.
FAR_VIEW = [23, 7, 5], VIEW[1], 480
# What holds others is no surface.
SURFACES = set(re.findall(r"DEF\s+(\w+)\s+Transform", MODEL.read_text())) - {"Buildings"}


def rows_of(table):
    return [[table.item(row, column).text() for column in range(table.columnCount())] for row in range(table.rowCount())]


def open_model(window):
    # ParaView has a reader of VRML itself, and asks.
    window.answer({"FileOpenDialog": choose_file(MODEL), "pqSelectReaderDialog": choose_reader("Atria")})
    window.step("AtriaOpen")
    reader = simple.GetActiveSource()
    assert reader is not None and reader.GetXMLName() == "AtriaVRMLReader", reader
    window.apply()
    display = simple.GetDisplayProperties(reader)
    assert display.ColorArrayName[1] == "SurfaceId", list(display.ColorArrayName)
    legend = list(display.LookupTable.Annotations)
    assert set(legend[1::2]) == SURFACES, legend
    window.look_at(*VIEW)
    window.picture("reader")
    check_left_out(window, reader)
    return reader


def check_toolbar(window):
    """The five steps from model to case, in their order."""
    bar = next(bar for bar in window.main.findChildren(QtWidgets.QToolBar) if any(a.objectName() == "AtriaOpen" for a in bar.actions()))
    assert [action.text() for action in bar.actions()] == ["1 Model", "2 Preflight", "3 Mesh", "4 Quality", "5 Case"]


def check_left_out(window, reader):
    """A surface that is ticked in the list of the model's is left out."""
    window.show_advanced(True)
    table = window.find(QtWidgets.QWidget, "ExcludedSurfaces", window.dock()).findChild(QtWidgets.QTableWidget, "Rules")
    names = [table.item(row, 0).text() for row in range(table.rowCount())]
    assert set(names) == SURFACES, names
    for state, left in ((QtCore.Qt.Checked, SURFACES - {"Neighbor"}), (QtCore.Qt.Unchecked, SURFACES)):
        table.item(names.index("Neighbor"), 0).setCheckState(state)
        window.apply()
        legend = simple.servermanager.Fetch(reader).GetFieldData().GetAbstractArray("SurfaceName")
        found = {legend.GetValue(i) for i in range(legend.GetNumberOfValues())}
        assert found == left, found
    window.show_advanced(False)


def preflight(window, reader):
    window.select(reader)
    window.step("AtriaPreflight")
    simple.GetActiveSource().WindAngle = 20.0
    window.apply()
    window.picture("preflight")
    return simple.GetActiveSource()


def check_hand_over(preflight, reader):
    """The mesher stands behind the model, with the sizes of the preflight, which the model has led to."""
    mesher = simple.GetActiveSource()
    assert mesher.Input.SMProxy == reader.SMProxy, mesher.Input
    sizes = [mesher.SizeMax, mesher.SizeMid, mesher.SizeMin]
    assert sizes == list(preflight.SizesTaken) and min(sizes) > 0.0, (sizes, list(preflight.SizesTaken))
    assert mesher.WindAngle == preflight.WindAngle == 20.0, mesher.WindAngle


def check_panel(window):
    """The number of elements before Apply, and the model's names where names are asked for."""
    window.find(QtWidgets.QPushButton, "Estimate").click()
    window.settle()
    text = window.find(QtWidgets.QLabel, "Result").text()
    assert re.match(r"[\d,]+ elements", text), text
    names = window.find(QtWidgets.QComboBox, "Names", window.dock())
    assert {names.itemText(i) for i in range(names.count())} == SURFACES
    window.picture("mesher-panel")
    window.show_advanced(True)
    tables = [t for t in window.dock().findChildren(QtWidgets.QTableWidget, "Rules") if t.isVisible()]
    assert len(tables) == 3, f"{len(tables)} tables: sizes at surfaces and near them, layers"
    for table in tables:
        assert {row[0] for row in rows_of(table)} == SURFACES, rows_of(table)
    check_rules(window, tables[0])
    check_lists(window)
    window.show_advanced(False)
    check_box(window)
    return int(re.sub(r"\D", "", text.split(" elements")[0]))


def check_rules(window, table):
    """A number in a row is a rule; without it there is none."""
    mesher = simple.GetActiveSource()
    row = [cells[0] for cells in rows_of(table)].index("RoofNorth")
    table.item(row, 1).setText("0.5")
    assert mesher.SMProxy.GetProperty("SurfaceSizeRules").GetUncheckedElement(0) == "RoofNorth 0.5"
    window.dock().findChild(QtWidgets.QScrollArea, "scrollArea").ensureWidgetVisible(table, 0, 150)
    table.scrollToItem(table.item(row, 0))
    window.picture("tables")
    table.item(row, 1).setText("")
    assert mesher.SMProxy.GetProperty("SurfaceSizeRules").GetNumberOfUncheckedElements() == 0


def unchecked(name):
    """What the panel has of a property before Apply."""
    values = simple.GetActiveSource().SMProxy.GetProperty(name)
    return [values.GetUncheckedElement(i) for i in range(values.GetNumberOfUncheckedElements())]


def check_lists(window):
    """Boxes and points are added one by one, each with a widget in the view and its numbers in the panel."""
    zones = window.find(QtWidgets.QComboBox, "ComboBox", window.find(QtWidgets.QWidget, "ZoneRule", window.dock()))
    zones.setCurrentText("Seeds")
    window.settle()
    lists = [w for w in window.dock().findChildren(QtWidgets.QWidget)
             if w.metaObject().className() == "pqPropertyCollectionWidget" and w.isVisible()]
    for name, widget, edit, count in (("RefinementBoxes", "AtriaBox", "bound1", 7), ("Seeds", "InteractiveHandle", "worldPositionY", 3),
                                      ("SealedSeeds", "InteractiveHandle", "worldPositionY", 3)):
        shown = lists.pop(0)
        assert unchecked(name) == []
        shown.findChild(QtWidgets.QToolButton, "addItemButton").click()
        window.settle()
        assert shown.findChild(QtWidgets.QCheckBox, "show3DWidget").isChecked()
        assert shown.findChild(QtWidgets.QWidget, widget) is not None
        number = shown.findChild(QtWidgets.QLineEdit, edit)
        number.setText("4.5")
        number.textEdited.emit("4.5")  # as by a key
        number.editingFinished.emit()
        window.settle()
        assert len(unchecked(name)) == count and unchecked(name)[1] == 4.5, unchecked(name)
        if name == "Seeds":
            window.dock().findChild(QtWidgets.QScrollArea, "scrollArea").ensureWidgetVisible(shown)
            window.picture("points")
        shown.findChild(QtWidgets.QToolButton, "removeAllButton").click()
        window.settle()
        assert unchecked(name) == []
    assert not lists
    zones.setCurrentText("Outside")
    octree = window.find(QtWidgets.QWidget, "Octree", window.dock())
    assert octree.findChild(QtWidgets.QComboBox) is not None, "an octree is chosen from a list"
    corners = window.find(QtWidgets.QWidget, "DomainPolygon", window.dock()).findChild(QtWidgets.QTableView, "Table")
    assert corners.model().columnCount() == 2, "x and y of each corner"


def check_box(window):
    """The explicit domain is a box in the view, which begins at the model."""
    mode = window.find(QtWidgets.QComboBox, "ComboBox", window.find(QtWidgets.QWidget, "DomainMode", window.dock()))
    mode.setCurrentText("Explicit")
    window.settle()
    window.find(QtWidgets.QPushButton, "fitToModel", window.dock()).click()
    box = window.find(QtWidgets.QWidget, "AtriaBox", window.dock())
    window.dock().findChild(QtWidgets.QScrollArea, "scrollArea").ensureWidgetVisible(box)
    shown = [float(box.findChild(QtWidgets.QLineEdit, f"bound{i}").text()) for i in range(6)]
    model = simple.GetActiveSource().Input.GetDataInformation().GetBounds()
    assert all(abs(a - b) < 1e-3 for a, b in zip(shown, model)), (shown, model)
    window.look_at(*FAR_VIEW)
    window.picture("domain-box")
    window.look_at(*VIEW)
    mode.setCurrentText("Automatic")
    window.settle()


def mesh(window, reader, preflight):
    """The table of the preflight is selected; the step finds the model upstream."""
    window.select(preflight)
    window.step("AtriaDualMesher")
    check_hand_over(preflight, reader)
    simple.GetActiveSource().WindAngle = 0.0
    expected = check_panel(window)
    window.apply()
    mesher = simple.GetActiveSource()
    count = mesher.GetDataInformation().GetNumberOfCells()
    assert 0.8 * expected < count < 3 * expected, f"{expected} elements were told, there are {count}"
    view = simple.GetActiveView()
    assert view.GetXMLName() == "RenderView", f"the mesh is in a {view.GetXMLName()}"
    assert simple.GetDisplayProperties(mesher).Representation == "Surface With Edges"
    close("SpreadSheetView")
    window.look_at(*VIEW)
    window.picture("mesh")
    patches = simple.OutputPort(mesher, 1)
    simple.Hide(mesher)
    simple.Hide(simple.OutputPort(mesher, 2))
    shown = simple.Show(patches)
    shown.SetScalarBarVisibility(view, True)
    assert shown.ColorArrayName[1] == "SurfaceId"
    simple.Render(view)
    window.picture("patches")
    simple.Hide(patches)
    simple.Show(mesher)
    simple.Render(view)
    return mesher


def close(kind):
    """Leaves the room of views to the render view."""
    layout = simple.GetLayout()
    for view in simple.GetViews():
        if view.GetXMLName() == kind:
            location = layout.GetViewLocation(view)
            simple.Delete(view)
            layout.Collapse(location)


def quality(window, mesher):
    before = set(simple.GetViews())
    window.select(mesher)
    window.step("AtriaMeshQuality")
    window.apply()
    found = simple.GetActiveSource()
    opened = [view.GetXMLName() for view in set(simple.GetViews()) - before]
    assert opened == ["XYBarChartView"], opened
    window.dock().findChild(QtWidgets.QScrollArea, "scrollArea").verticalScrollBar().setValue(0)
    window.picture("quality")
    invalid = window.find(QtWidgets.QWidget, "NumberOfInvalidCells", window.dock())
    shown = [edit.text() for edit in invalid.findChildren(QtWidgets.QLineEdit)]
    assert shown == [str(found.GetPropertyValue("NumberOfInvalidCells"))], shown
    return found


def check_help(window):
    """The question mark opens the page of the filter."""
    window.find(QtWidgets.QPushButton, "Help", window.dock()).click()
    window.settle(1.0)
    help_window = next(w for w in window.app.topLevelWidgets() if "HelpWindow" in w.metaObject().className())
    pages = [browser.toPlainText() for browser in help_window.findChildren(QtWidgets.QTextBrowser)]
    assert any("HistogramMetric" in page or "Histogram Metric" in page for page in pages), pages
    help_window.close()


def save(window, mesher):
    """With the file dialog and the options of the writer as they come."""
    folder = OUTPUT / "gui" / "house.openfoam"
    shutil.rmtree(folder, ignore_errors=True)
    window.select(mesher)
    window.answer({"FileSaveDialog": choose_file(folder, "OpenFOAM"), "WriterSettingsDialog": accept})
    window.step("AtriaSave")
    boundary = (folder / "constant" / "polyMesh" / "boundary").read_text()
    patches = set(re.findall(r"^    (\w+)\n    \{", boundary, re.MULTILINE))
    kept = {name for name in SURFACES if any(p == name or p.startswith(name + "_") for p in patches)}
    assert kept == SURFACES, f"the case lacks {SURFACES - kept}"
    assert "defaultFaces" not in patches
    return patches


def diagnostics(window, reader):
    """A room that should be closed, and the way out of it."""
    sealed = simple.AtriaDualMesher(Input=reader, SealedSeeds=[3.0, 4.0, 1.5])
    output = simple.OutputPort(sealed, 2)
    output.UpdatePipeline()
    view = next(v for v in simple.GetViews() if v.GetXMLName() == "RenderView")
    close("XYBarChartView")
    simple.SetActiveView(view)
    simple.HideAll(view)
    surfaces = simple.Show(reader, view)
    surfaces.Opacity = 0.15
    surfaces.SetScalarBarVisibility(view, False)
    shown = simple.Show(output, view)
    shown.LineWidth = 6
    shown.SetScalarBarVisibility(view, True)
    assert shown.ColorArrayName[1] == "Diagnostic"
    assert "LeakPath" in list(shown.LookupTable.Annotations)
    window.look_at([6, 4, 3], VIEW[1], 34)
    window.picture("diagnostics")


def session():
    window = Window("gui")
    check_toolbar(window)
    reader = open_model(window)
    mesher = mesh(window, reader, preflight(window, reader))
    quality(window, mesher)
    check_help(window)
    patches = save(window, mesher)
    diagnostics(window, reader)
    print(f"{len(SURFACES)} surfaces of the model, {len(patches)} patches of the case")


run(session)
