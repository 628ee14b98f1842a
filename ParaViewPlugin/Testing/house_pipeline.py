# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the plugin and builds the pipeline the tests look at."""

import os
import types

from paraview import simple


def load_plugin():
    """Adds the plugin's proxies to paraview.simple."""
    simple.LoadPlugin(os.environ["ATRIA_PLUGIN"])


def house():
    """Reader, octree, mesher and quality for the example house, coarse enough for a test."""
    load_plugin()
    reader = simple.OpenDataFile(os.environ["ATRIA_MODEL"])
    grid = {"SizeMax": 16.0, "SizeMid": 4.0, "SizeMin": 1.0, "DomainMode": "Site", "SiteName": "Site"}
    octree = simple.AtriaOctreeSource(Input=reader, **grid)
    mesher = simple.AtriaDualMesher(Input=reader, **grid)
    patches = simple.OutputPort(mesher, 1)
    quality = simple.AtriaMeshQuality(Input=mesher, Patches=patches)
    return types.SimpleNamespace(reader=reader, octree=octree, mesher=mesher, patches=patches, quality=quality)
