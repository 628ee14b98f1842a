// SPDX-License-Identifier: GPL-3.0-or-later
/// What tests ask of the meshing filters' outputs.
#pragma once

#include "Support/Types.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

class vtkAtriaGridAlgorithm;
class vtkDataObject;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria::testing {

/// Geometry, topology and every array are the same, bit for bit; but for the wall times of the stages.
::testing::AssertionResult identical(vtkDataObject* a, vtkDataObject* b);

/// An explicit domain, and the three sizes.
void setGrid(vtkAtriaGridAlgorithm* filter, const Box3& domain, double sizeMin, double sizeMid, double sizeMax);

/// The error a filter gave, which comes before the one VTK's executive adds; empty without.
/// What stands in the filters' warnings of surfaces that go on beyond the domain, and of those that end on its sides.
inline constexpr const char* cutAtSides = "cuts through surfaces at ";
inline constexpr const char* endAtSides = "end on the domain's sides";

std::string firstOf(const std::vector<std::string>& errors);

/// The patches in alphabetical order.
std::map<std::string, vtkPolyData*> patchesByName(vtkPartitionedDataSetCollection* patches);
std::vector<std::string> namesOf(const std::map<std::string, vtkPolyData*>& patches);

/// Faces as triangles about the mean of their points, as the volumes take them.
double areaOf(vtkPolyData* patch);
/// The volume that patches enclose, by the divergence theorem.
double enclosedVolume(vtkPartitionedDataSetCollection* patches);

/// Volume of each cell. Fails where the mesh is not conformal.
std::vector<double> volumesOf(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches);
double totalVolume(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches);
double volumeOf(const Box3& box);

/// Every face of the mesh has two elements, or one and a place in exactly one patch, as a face of its owner seen
/// counter-clockwise from outside.
::testing::AssertionResult patchesAreTheBoundary(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches);

/// The strings of a field array; empty where it is missing.
std::vector<std::string> fieldStrings(vtkDataObject* data, const char* array);

} // namespace atria::testing
