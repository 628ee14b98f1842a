// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts points, cells and patches of volume meshes from VTK to the core.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Support/Buffer.h"
#include "Support/Executor.h"

#include <vtkSmartPointer.h>

#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPartitionedDataSetCollection;
class vtkPoints;
class vtkUnstructuredGrid;

namespace atria {

/// Returns the points in double precision.
std::vector<Vec3> pointsFromVtk(vtkPoints* points, const Executor& executor = SerialExecutor());

/// Returns VTK points in double precision.
vtkSmartPointer<vtkPoints> pointsToVtk(std::span<const Vec3> points, const Executor& executor = SerialExecutor());

/// View of points in double precision; copies them only if VTK stores them differently. VTK's points must outlive it,
/// unchanged.
class VtkPoints
{
public:
  VtkPoints(vtkPoints* points, const Executor& executor);
  VtkPoints(const VtkPoints&) = delete;
  VtkPoints& operator=(const VtkPoints&) = delete;

  std::span<const Vec3> view() const { return points_; }

private:
  std::vector<Vec3> copy_;
  std::span<const Vec3> points_;
};

/// View of a grid's cell arrays; copies them only if they cannot be viewed directly. The grid must outlive it,
/// unchanged.
class VtkCells
{
public:
  explicit VtkCells(vtkUnstructuredGrid* grid);
  VtkCells() = default;
  VtkCells(VtkCells&&) = default;
  VtkCells& operator=(VtkCells&&) = default;

  const CellArrays& view() const { return arrays; }

private:
  IdView viewOrCopy(vtkDataArray* array);
  std::span<const unsigned char> viewOrCopyTypes(vtkDataArray* array);

  CellArrays arrays;
  std::vector<unsigned char> typeCopy;
  std::vector<Buffer<std::int64_t>> copies;
};

/// Faces of named patches or face zones, with the numbers of their volume mesh.
struct VtkPatches
{
  struct Patch
  {
    std::string name;
    std::size_t firstFace = 0;
    std::size_t faceCount = 0;
  };
  std::vector<Patch> patches;
  std::vector<Index> owners;            ///< one entry per face
  std::vector<Index> neighbors;         ///< one entry per face of a zone: the cell across; empty for patches
  std::vector<std::int64_t> offsets{0}; ///< one entry per face, into points
  std::vector<std::int64_t> points;     ///< ids of the volume mesh's points

  std::span<const std::int64_t> face(std::size_t f) const;
  std::vector<BoundaryFaceKey> keys() const;

  /// Appends a face with the point ids `corners`; faces of zones have a neighbor.
  template <typename Corners> void append(Index owner, std::optional<Index> neighbor, const Corners& corners)
  {
    owners.push_back(owner);
    if (neighbor)
    {
      neighbors.push_back(*neighbor);
    }
    points.insert(points.end(), std::begin(corners), std::end(corners));
    offsets.push_back(static_cast<std::int64_t>(points.size()));
  }
  /// Makes a named patch of the faces from `firstFace` on.
  void close(std::string name, std::size_t firstFace);
};

/// Returns the name of a patch; one made from its index if it has none.
std::string patchNameOf(vtkPartitionedDataSetCollection* patches, unsigned int i);

/// Reads the mesher's patches by their arrays OwnerCellId (cells) and VolumePointId (points), without its face zones.
/// Throws Error that names a patch without these arrays, or with cells or points that the volume mesh does not have.
VtkPatches patchesFromVtk(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume);

/// The same for its face zones, which have the cell array NeighborCellId.
VtkPatches faceZonesFromVtk(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume);

} // namespace atria
