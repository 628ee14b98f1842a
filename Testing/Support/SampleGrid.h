// SPDX-License-Identifier: GPL-3.0-or-later
/// Sample meshes as VTK data.
#pragma once

#include "Support/SampleMesh.h"

#include <vtkSmartPointer.h>

#include <functional>
#include <string>

class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

namespace atria::testing {

vtkSmartPointer<vtkUnstructuredGrid> toGrid(const SampleMesh& mesh);

/// Names the patch of a face from its center; an empty name leaves it out.
using NameOfFace = std::function<std::string(const Vec3& center)>;

/// The boundary faces as the mesher hands them over: one named vtkPolyData a patch, with OwnerCellId and
/// VolumePointId. Patches come in the order of their names.
vtkSmartPointer<vtkPartitionedDataSetCollection> toPatches(const FaceMesh& mesh, const NameOfFace& boundary);

/// The same with sheets: an internal face that `sheet` names goes with its owner's side to <name>_front and
/// with its neighbor's to <name>_back.
vtkSmartPointer<vtkPartitionedDataSetCollection> toPatches(const FaceMesh& mesh, const NameOfFace& boundary,
                                                           const NameOfFace& sheet);

/// Names the sides of the box [0, n0] x [0, n1] x [0, n2] xMin to zMax.
NameOfFace sidesOfBox(std::array<int, 3> n);

} // namespace atria::testing
