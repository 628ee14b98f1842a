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
