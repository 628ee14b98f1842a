// SPDX-License-Identifier: GPL-3.0-or-later
/// Areas, volumes and centroids of faces and cells, computed as OpenFOAM's primitiveMesh does.
#pragma once

#include "Quality/FaceMesh.h"
#include "Support/Buffer.h"
#include "Support/RunContext.h"

#include <span>

namespace atria {

/// A polygon's area vector (right-hand rule) and its centroid.
struct PolygonMeasure
{
  Vec3 area;
  Vec3 centroid;
};

/// Cuts the polygon into triangles about the mean of its points: its area vector is their sum, its centroid the mean of
/// theirs weighted by area.
PolygonMeasure measurePolygon(std::span<const Vec3> points, std::span<const Index> face);

/// The faces of every cell: first those it owns, then those it is the neighbour of, each in rising order.
struct CellFaces
{
  Buffer<Index> offsets{0};
  Buffer<Index> faces;

  std::span<const Index> of(std::size_t cell) const
  {
    return {faces.data() + offsets[cell], faces.data() + offsets[cell + 1]};
  }
};

CellFaces makeCellFaces(const FaceMesh& mesh, const Executor& executor = SerialExecutor());

/// Units: those of the points, squared for areas, cubed for volumes.
struct MeshGeometry
{
  Buffer<Vec3> faceAreas; ///< area vectors, out of the owner
  Buffer<Vec3> faceCentroids;
  Buffer<Vec3> cellCentroids;
  Buffer<double> cellVolumes; ///< negative where a cell is inside out
};

/// Faces are measured by measurePolygon(). A cell is cut into pyramids from the mean of its face centroids: its
/// volume is their sum, its centroid the mean of theirs weighted by volume. Throws Aborted when asked to.
MeshGeometry computeGeometry(const FaceMesh& mesh, const CellFaces& cellFaces, const RunContext& context);

/// A mesh with all that metrics and checks start from. The mesh must outlive it.
struct MeasuredMesh
{
  const FaceMesh& mesh;
  CellFaces cellFaces;
  MeshGeometry geometry;
};

MeasuredMesh measureMesh(const FaceMesh& mesh, const RunContext& context);

} // namespace atria
