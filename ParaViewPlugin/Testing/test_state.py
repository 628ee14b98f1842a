# SPDX-License-Identifier: GPL-3.0-or-later
"""A saved state, loaded again, makes the same mesh with the same properties and shows it in the same way."""

import os
import pathlib

from paraview import simple

from house_pipeline import house

FOLDER = pathlib.Path(os.environ["ATRIA_OUTPUT"])
CHANGED = {
    "SurfaceSizeRules": ["Wall* 2 1", "RoofNorth 1"],
    "RefinementBoxes": [0.0, 10.0, 0.0, 10.0, 0.0, 5.0, 2.0],
    "Seeds": [5.0, 5.0, 30.0],
    "LayerRules": ["Neighbor 2"],
}


def summary(mesher, display):
    information = mesher.GetDataInformation()
    return {
        "cells": information.GetNumberOfCells(),
        "points": information.GetNumberOfPoints(),
        "bounds": information.GetBounds(),
        "changed": {name: list(mesher.GetPropertyValue(name)) for name in CHANGED},
        "shown": (display.GetXMLName(), display.Representation, display.BackfaceRepresentation),
    }


def first(xml_name):
    return next(s for s in simple.GetSources().values() if s.GetXMLName() == xml_name)


def show(mesher):
    view = simple.GetActiveViewOrCreate("RenderView")
    display = simple.Show(mesher, view)
    simple.Render(view)
    return display


def main():
    pipeline = house()
    for name, value in CHANGED.items():
        pipeline.mesher.GetProperty(name).SetData(value)
    before = summary(pipeline.mesher, show(pipeline.mesher))
    assert before["changed"] == CHANGED, before["changed"]
    assert before["shown"] == ("AtriaMeshRepresentation", "Surface With Edges", "Cull Frontface"), before["shown"]
    for ending in ("pvsm", "py"):
        file = FOLDER / f"house_state.{ending}"
        simple.SaveState(str(file))
        simple.ResetSession()
        simple.LoadState(str(file))
        mesher = first("AtriaDualMesher")
        mesher.UpdatePipeline()
        after = summary(mesher, show(mesher))
        assert after == before, f".{ending}: {after}, saved {before}"
    print(f"{before['cells']} elements, as before")


main()
