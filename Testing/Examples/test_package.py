# SPDX-License-Identifier: GPL-3.0-or-later
"""The package `atria` and all of `vtk` live in one interpreter and connect."""

import vtk

import atria
from atria import (
    vtkAtriaDualMesher, vtkAtriaFeatureGraph, vtkAtriaMeshOptimizer, vtkAtriaMeshQuality, vtkAtriaOctreeSource,
    vtkAtriaOpenFOAMWriter, vtkAtriaPreflight, vtkAtriaVRMLReader, vtkAtriaWorstElements,
)

for cls in (
    vtkAtriaDualMesher, vtkAtriaFeatureGraph, vtkAtriaMeshOptimizer, vtkAtriaMeshQuality, vtkAtriaOctreeSource,
    vtkAtriaOpenFOAMWriter, vtkAtriaPreflight, vtkAtriaVRMLReader, vtkAtriaWorstElements,
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
