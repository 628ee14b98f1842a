// SPDX-License-Identifier: GPL-3.0-or-later
/// Areas, volumes and centroids of faces and cells, computed as OpenFOAM's primitiveMesh does.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Quality/Faces/InOrder.h"
#include "Support/Buckets.h"
#include "Support/RunContext.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace atria {

/// A polygon's area vector (right-hand rule) and its centroid.
struct PolygonMeasure
{
  Vec3 area;
  Vec3 centroid;
};

/// Measures a polygon by triangles around the mean of its points: its area vector is the sum of theirs, its centroid
/// the mean of theirs weighted by area.
PolygonMeasure measurePolygon(std::span<const Vec3> points, std::span<const Index> face);

/// A cell's centroid, and its volume, negative if the cell is inverted.
struct CellMeasureInOrder
{
  Vec3 centroid;
  double volume;
};

/// Measures a cell by pyramids from the mean of its face centroids: its volume is the sum of theirs, its centroid the
/// mean of theirs weighted by volume. `faceOf(i)` returns the PolygonMeasure of a face with outward area vector. Sums
/// are taken in OpenFOAM's order.
template <typename FaceOf> CellMeasureInOrder measureCellInOrder(std::size_t faceCount, FaceOf&& faceOf)
{
  Vec3 estimate = Vec3::Zero();
  for (std::size_t i = 0; i < faceCount; ++i)
  {
    estimate += faceOf(i).centroid;
  }
  estimate /= std::max<double>(1.0, static_cast<double>(faceCount));
  Vec3 moment = Vec3::Zero();
  double tripleVolume = 0.0;
  for (std::size_t i = 0; i < faceCount; ++i)
  {
    const PolygonMeasure face = faceOf(i);
    const double pyramid = dotInOrder(face.area, face.centroid - estimate);
    moment += pyramid * (0.75 * face.centroid + 0.25 * estimate);
    tripleVolume += pyramid;
  }
  return {std::abs(tripleVolume) > vSmall ? Vec3(moment / tripleVolume) : estimate, tripleVolume * (1.0 / 3.0)};
}

/// The faces of every cell: first those it owns, then those it is the neighbor of, each in rising order.
using CellFaces = Buckets;

CellFaces makeCellFaces(const FaceMesh& mesh, const Executor& executor = SerialExecutor());

/// Geometry of a mesh, in the units of its points, squared for areas, cubed for volumes.
struct MeshGeometry
{
  Buffer<Vec3> faceAreas; ///< area vectors, out of the owner
  Buffer<Vec3> faceCentroids;
  Buffer<Vec3> cellCentroids;
  Buffer<double> cellVolumes; ///< negative if a cell is inverted
};

/// Measures faces by measurePolygon() and cells by measureCellInOrder(). Throws Aborted when asked to.
MeshGeometry computeGeometry(const FaceMesh& mesh, const CellFaces& cellFaces, const RunContext& context);

/// A mesh with the cell faces and geometry that metrics and checks need. The mesh must outlive it.
struct MeasuredMesh
{
  const FaceMesh& mesh;
  CellFaces cellFaces;
  MeshGeometry geometry;
};

MeasuredMesh measureMesh(const FaceMesh& mesh, const RunContext& context);

} // namespace atria
