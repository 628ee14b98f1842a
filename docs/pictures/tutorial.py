# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of docs/tutorial.md from what the tutorial has made.

Usage: xvfb-run pvpython tutorial.py PLUGIN FOLDER OUTPUT    PLUGIN is Atria.so; FOLDER is where the tutorial was run
"""

import json
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from paraview import simple

from draw import behind, color_by, legend, look, new_view, patches_in, save, show, shrink

PLUGIN, FOLDER, OUTPUT = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
HOUSE = (-14.0, -34.0, 23.0), (15.0, 7.0, 4.0)
ROLES = {"inlet": [0.25, 0.45, 0.80], "outlet": [0.80, 0.40, 0.30], "ground": [0.72, 0.80, 0.62],
         "wall": [0.93, 0.86, 0.74], "slip": [0.88, 0.88, 0.92]}


def model():
    reader = simple.AtriaVRMLReader(FileName=str(FOLDER / "sketchup_house.wrl"), LengthUnit="Inches", UpAxis="Y",
                                    SurfaceBy="Group")
    view = new_view((-30.0, -60.0, 42.0), (28.0, 7.0, 0.0))
    shown = simple.Show(reader, view)
    table = shown.LookupTable
    legend(table, view, "surfaces")
    bar = simple.GetScalarBar(table, view)
    bar.Position, bar.ScalarBarLength = [0.86, 0.08], 0.85
    shown.SetScalarBarVisibility(view, True)
    save(view, OUTPUT / "tutorial-model.png")
    return reader


def preflight(reader):
    """The domain that is found, as a box about the model."""
    found = simple.AtriaPreflight(Input=reader, SizeMin=0.3, SizeMid=1.0, SizeMax=8.0)
    found.UpdatePipeline()
    table = simple.servermanager.Fetch(found)
    values = {table.GetValue(row, 0).ToString(): table.GetValue(row, 1).ToDouble() for row in range(table.GetNumberOfRows())}
    low, high = ([values[f"Domain{axis}{end}"] for axis in "XYZ"] for end in ("Min", "Max"))
    box = simple.Box(Center=[(a + b) / 2 for a, b in zip(low, high)], XLength=high[0] - low[0], YLength=high[1] - low[1],
                     ZLength=high[2] - low[2])
    view = new_view((-30.0, -330.0, 190.0), (85.0, 7.0, 10.0))
    show(box, view, [0.25, 0.45, 0.80]).SetRepresentationType("Outline")
    simple.GetDisplayProperties(box, view).LineWidth = 3
    simple.Show(reader, view).SetScalarBarVisibility(view, False)
    save(view, OUTPUT / "tutorial-domain.png")


def mesh():
    reader = simple.XMLUnstructuredGridReader(FileName=[str(FOLDER / "house.vtu")])
    view = new_view((-12.0, -42.0, 26.0), (16.0, 9.0, 3.0))
    show(behind(reader, (0.0, 10.5, 0.0), (0.0, -1.0, 0.0)), view, [0.90, 0.93, 0.96], edges=True)
    colors = {"Floor": [0.87, 0.72, 0.53], "Site": [0.80, 0.86, 0.72], "Wall": [0.95, 0.92, 0.87], "Part": [0.69, 0.77, 0.87]}
    for name, patch in patches_in(FOLDER / "patches.vtpc"):
        if name[:4] in ("Floo", "Site", "Part") or name.startswith(("WallEast", "WallWest")):
            show(patch, view, colors.get(name) or colors[name[:4]], edges=True)
    save(view, OUTPUT / "tutorial-mesh.png")


def quality():
    worst = simple.XMLUnstructuredGridReader(FileName=[str(FOLDER / "worst.vtu")])
    view = new_view(*HOUSE)
    surfaces = simple.AtriaVRMLReader(FileName=str(FOLDER / "sketchup_house.wrl"), LengthUnit="Inches", UpAxis="Y",
                                      SurfaceBy="Group", ExcludedSurfaces=["Site"])
    show(surfaces, view, [0.75, 0.75, 0.78], opacity=0.25)
    color_by(show(worst, view, edges=True), view, "CELLS", "NonOrthogonality", "degrees", preset="Inferno (matplotlib)")
    save(view, OUTPUT / "tutorial-worst.png")


def roles():
    case = json.loads((FOLDER / "case" / "case.json").read_text())
    role_of = case["directions"][0]["patches"]
    view = new_view((-330.0, -330.0, 250.0), (85.0, 7.0, 0.0))
    for name, patch in patches_in(FOLDER / "patches.vtpc"):
        if name not in ("zMax", "yMin"):
            show(patch, view, ROLES[role_of[name]])
    look(view, (60.0, -270.0, 125.0), (87.0, 7.0, 22.0))
    save(view, OUTPUT / "tutorial-roles.png")


def main():
    simple.LoadPlugin(PLUGIN, ns=vars(simple))
    OUTPUT.mkdir(parents=True, exist_ok=True)
    preflight(model())
    mesh()
    quality()
    roles()
    shutil.copy(FOLDER / "flow.png", OUTPUT / "tutorial-flow.png")
    shrink(OUTPUT / "tutorial-flow.png")


main()
