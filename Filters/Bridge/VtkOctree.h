// SPDX-License-Identifier: GPL-3.0-or-later
/// Octrees between the core and VTK.
#pragma once

#include "Octree/Tree/Octree.h"

class vtkDataObject;
class vtkHyperTreeGrid;
class vtkUnstructuredGrid;

namespace atria {

/// Leaves in the domain as voxels, or as hexahedra where the grid is turned, with cell arrays Level and FeatureType.
/// The field array OctreeFrame (23 values) keeps what octreeFromVtk needs.
void octreeToVtk(const Octree& octree, vtkUnstructuredGrid* out);

/// The whole root cube as one hyper tree; leaves outside the domain are masked. Throws Error where the grid is turned.
void octreeToVtk(const Octree& octree, vtkHyperTreeGrid* out);

/// Frame and refined octants of what octreeToVtk made, possibly with cells removed since: they come back as coarse as
/// the others allow. Throws Error for data from elsewhere.
OctreeSets octreeFromVtk(vtkDataObject* data);

} // namespace atria
