// SPDX-License-Identifier: GPL-3.0-or-later
/// Volume meshes from VTK to the core.
#pragma once

#include "Quality/FaceMesh.h"

#include <vector>

class vtkPartitionedDataSetCollection;
class vtkPoints;
class vtkUnstructuredGrid;

namespace atria {

/// The points in double precision.
std::vector<Vec3> pointsFromVtk(vtkPoints* points);

/// Copies of a grid's cell arrays where VTK's own cannot be viewed directly.
struct VtkCells
{
  std::vector<unsigned char> types;
  std::vector<std::int64_t> offsets;
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> faceStream;
  std::vector<std::int64_t> faceLocations;

  CellArrays view() const { return {types, offsets, connectivity, faceStream, faceLocations}; }
};
VtkCells cellsFromVtk(vtkUnstructuredGrid* grid);

/// The faces of named patches in terms of the volume mesh they belong to.
struct VtkPatches
{
  struct Patch
  {
    std::string name;
    std::size_t firstFace = 0;
    std::size_t faceCount = 0;
  };
  std::vector<Patch> patches;
  std::vector<Index> owners;            ///< per face
  std::vector<std::int64_t> offsets{0}; ///< per face, into points
  std::vector<std::int64_t> points;     ///< ids of the volume mesh's points

  std::vector<BoundaryFaceKey> keys() const;
};

/// Reads the mesher's patches by their arrays OwnerCellId (cells) and VolumePointId (points). Throws Error naming the
/// patch that lacks them or refers to cells or points that the volume mesh does not have.
VtkPatches patchesFromVtk(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume);

} // namespace atria
