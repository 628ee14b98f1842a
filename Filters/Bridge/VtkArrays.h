// SPDX-License-Identifier: GPL-3.0-or-later
/// Volume meshes from VTK to the core.
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

/// The points in double precision.
std::vector<Vec3> pointsFromVtk(vtkPoints* points, const Executor& executor = SerialExecutor());

/// In double precision.
vtkSmartPointer<vtkPoints> pointsToVtk(std::span<const Vec3> points, const Executor& executor = SerialExecutor());

/// The points in double precision without a copy, where they are so. VTK's must outlive it, unchanged.
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

/// A grid's cell arrays: VTK's own where they can be viewed directly, else copies. The grid must outlive it, unchanged.
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

/// The faces of named patches, or of face zones, in terms of the volume mesh they belong to.
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
  std::vector<Index> neighbors;         ///< per face of a zone, the cell across; empty for patches
  std::vector<std::int64_t> offsets{0}; ///< per face, into points
  std::vector<std::int64_t> points;     ///< ids of the volume mesh's points

  std::span<const std::int64_t> face(std::size_t f) const;
  std::vector<BoundaryFaceKey> keys() const;

  /// Appends a face of `corners`, ids of points; with a neighbor if it is one of a zone.
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
  /// Appends the faces from that one on under a name.
  void close(std::string name, std::size_t firstFace);
};

/// The name of a patch, by its place if it has none.
std::string patchNameOf(vtkPartitionedDataSetCollection* patches, unsigned int i);

/// Reads the mesher's patches by their arrays OwnerCellId (cells) and VolumePointId (points), and leaves out its face
/// zones. Throws Error naming the patch that lacks them or refers to cells or points that the volume mesh does not
/// have.
VtkPatches patchesFromVtk(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume);

/// The same of the face zones among them, which have the cell array NeighborCellId.
VtkPatches faceZonesFromVtk(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume);

} // namespace atria
