# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the plugin and builds the pipeline the tests look at."""

import os
import types

from paraview import simple


def load_plugin():
    """Adds the plugin's proxies to paraview.simple."""
    simple.LoadPlugin(os.environ["ATRIA_PLUGIN"])


def house():
    """The pipeline of the example house, coarse enough for a test."""
    load_plugin()
    return build_house()


def build_house():
    """Reader, octree, mesher and quality, where the plugin is loaded."""
    reader = simple.OpenDataFile(os.environ["ATRIA_MODEL"])
    grid = {"SizeMax": 16.0, "SizeMid": 4.0, "SizeMin": 1.0, "DomainMode": "Site", "SiteName": "Site"}
    octree = simple.AtriaOctreeSource(Input=reader, **grid)
    mesher = simple.AtriaDualMesher(Input=reader, **grid)
    patches = simple.OutputPort(mesher, 1)
    quality = simple.AtriaMeshQuality(Input=mesher, Patches=patches)
    return types.SimpleNamespace(reader=reader, octree=octree, mesher=mesher, patches=patches, quality=quality)


def render_cut(view, source, colors, with_bar):
    """Renders a cut through the house's mesh, colored by an array: (association, name)."""
    cut = simple.Slice(Input=source, Crinkleslice=1)
    cut.SliceType.Origin = [12.3, 7.1, 5.0]
    cut.SliceType.Normal = [0.0, 1.0, 0.0]
    display = simple.Show(cut, view)
    display.SetRepresentationType("Surface With Edges")
    simple.ColorBy(display, colors)
    display.RescaleTransferFunctionToDataRange()
    display.SetScalarBarVisibility(view, with_bar)
    simple.Render(view)  # the first rendering moves the camera
    view.CameraPosition = [25.0, -75.0, 24.0]
    view.CameraFocalPoint = [25.0, 7.0, 14.0]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    simple.Render(view)
