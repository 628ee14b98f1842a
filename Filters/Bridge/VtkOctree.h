// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts octrees between the core and VTK.
#pragma once

#include "Octree/Tree/Octree.h"

class vtkDataObject;
class vtkHyperTreeGrid;
class vtkUnstructuredGrid;

namespace atria {

/// Converts leaves in the domain to voxels, or to hexahedra if the grid is turned, with cell arrays Level and
/// FeatureType. The field array OctreeFrame (23 values) keeps the data that octreeFromVtk needs.
void octreeToVtk(const Octree& octree, vtkUnstructuredGrid* out);

/// Converts the whole root cube to one hyper tree; leaves outside the domain are masked. Throws Error if the grid is
/// turned.
void octreeToVtk(const Octree& octree, vtkHyperTreeGrid* out);

/// Returns frame and refined octants of data that octreeToVtk made. Removed cells are restored as coarse as the others
/// allow. Throws Error for other data.
OctreeSets octreeFromVtk(vtkDataObject* data);

} // namespace atria
