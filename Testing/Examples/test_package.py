# SPDX-License-Identifier: GPL-3.0-or-later
"""The package `atria` and all of `vtk` live in one interpreter and connect."""

import subprocess
import sys

import vtk

import atria
from atria import (
    vtkAtriaDualMesher, vtkAtriaFeatureGraph, vtkAtriaMeshOptimizer, vtkAtriaMeshQuality, vtkAtriaOctreeSource,
    vtkAtriaOpenFOAMWriter, vtkAtriaPreflight, vtkAtriaVRMLReader, vtkAtriaWeatherReader,
    vtkAtriaWorstElements,
)

for cls in (
    vtkAtriaDualMesher, vtkAtriaFeatureGraph, vtkAtriaMeshOptimizer, vtkAtriaMeshQuality, vtkAtriaOctreeSource,
    vtkAtriaOpenFOAMWriter, vtkAtriaPreflight, vtkAtriaVRMLReader, vtkAtriaWeatherReader,
    vtkAtriaWorstElements,
):
    instance = cls()
    assert isinstance(instance, vtk.vtkAlgorithm), cls
    assert cls.__name__ in atria.__all__, cls
    assert cls.__name__ in str(instance), cls

sphere = vtk.vtkSphereSource()
sphere.SetRadius(2.0)
mesher = vtkAtriaDualMesher()
mesher.SetInputConnection(sphere.GetOutputPort())
mesher.SetSizeMax(0.5)
mesher.SetSizeMid(0.5)
mesher.SetSizeMin(0.5)
mesher.SetDomainMode(vtkAtriaDualMesher.Explicit)
mesher.SetDomainBounds(-5, 5, -5, 5, -5, 5)
mesher.Update()
assert mesher.GetOutputDataObject(0).GetNumberOfCells() > 1000

# With another VTK it says so instead of crashing.
OTHER = """
import vtkmodules.vtkCommonCore as core

class Version:
    GetVTKMajorVersion = staticmethod(lambda: 9)
    GetVTKMinorVersion = staticmethod(lambda: 99)

core.vtkVersion = Version
import atria
"""
run = subprocess.run([sys.executable, "-c", OTHER], capture_output=True, text=True)
assert run.returncode == 1 and "ImportError: this atria is built for VTK 9." in run.stderr, run
assert "found VTK 9.99 in " in run.stderr, run.stderr
