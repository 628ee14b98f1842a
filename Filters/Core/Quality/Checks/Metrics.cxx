// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/Metrics.h"

#include "Quality/Checks/ScaledJacobian.h"
#include "Quality/Faces/InOrder.h"
#include "Support/Angles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace atria {

namespace {

constexpr double maxOpenness = 1e-6;
constexpr std::size_t grain = 4096;

double cosine(const Vec3& a, const Vec3& b)
{
  return dotInOrder(a, b) / (lengthInOrder(a) * lengthInOrder(b) + rootVSmall);
}

/// Returns the component of v along an area vector.
Vec3 normalPart(const Vec3& v, const Vec3& area)
{
  const double size = lengthInOrder(area);
  const Vec3 normal = size < rootVSmall ? Vec3(Vec3::Zero()) : Vec3(area / size);
  return dotInOrder(normal, v) * normal;
}

/// Fills the metrics of faces, then those of cells, which take the worst over their faces.
class Measurement
{
public:
  Measurement(const MeasuredMesh& source, QualityMetrics& target)
      : measured(source), mesh(source.mesh), cellFaces(source.cellFaces), geometry(source.geometry), out(target)
  {
    const std::size_t cells = mesh.cellCount;
    for (auto* metric : {&out.cellSquish, &out.faceSquish, &out.aspectRatio, &out.inverseAspectRatio,
                         &out.orthogonalQuality, &out.nonOrthogonality, &out.skewness, &out.facePyramids})
    {
      metric->resize(cells);
    }
    out.valid.resize(cells);
    out.squishOfFaces.resize(mesh.internalFaceCount());
    out.nonOrthogonalityOfFaces.resize(mesh.internalFaceCount());
    out.skewnessOfFaces.resize(mesh.faceCount());
  }

  void measureFace(std::size_t f)
  {
    if (f < mesh.internalFaceCount())
    {
      const double c = std::clamp(faceCosine(measured, f), -1.0, 1.0);
      out.squishOfFaces[f] = 1.0 - c;
      out.nonOrthogonalityOfFaces[f] = degreesOfCosine(c);
    }
    out.skewnessOfFaces[f] = faceSkewness(measured, f);
  }

  void measureCell(std::size_t cell)
  {
    const Vec3& center = geometry.cellCentroids[cell];
    double worstCosine = 1.0;
    double worstSquish = 0.0;
    double worstAngle = 0.0;
    double worstSkewness = 0.0;
    double leastPyramid = std::numeric_limits<double>::infinity();
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0.0;
    const auto measureDistance = [&](const Vec3& to) {
      const double distance = (to - center).norm();
      nearest = std::min(nearest, distance);
      farthest = std::max(farthest, distance);
    };
    for (const Index f : cellFaces.of(cell))
    {
      const Vec3 area = mesh.owner[f] == cell ? geometry.faceAreas[f] : Vec3(-geometry.faceAreas[f]);
      const Vec3 r = geometry.faceCentroids[f] - center;
      worstCosine = std::min(worstCosine, std::clamp(cosine(area, r), -1.0, 1.0));
      leastPyramid = std::min(leastPyramid, dotInOrder(area, r) / 3.0);
      worstSkewness = std::max(worstSkewness, out.skewnessOfFaces[f]);
      if (f < mesh.internalFaceCount())
      {
        worstSquish = std::max(worstSquish, out.squishOfFaces[f]);
        worstAngle = std::max(worstAngle, out.nonOrthogonalityOfFaces[f]);
      }
      measureDistance(geometry.faceCentroids[f]);
      for (const Index point : mesh.face(f))
      {
        measureDistance(mesh.points[point]);
      }
    }
    out.cellSquish[cell] = 1.0 - worstCosine;
    out.faceSquish[cell] = worstSquish;
    out.orthogonalQuality[cell] = std::min(worstCosine, 1.0 - worstSquish);
    out.nonOrthogonality[cell] = worstAngle;
    out.skewness[cell] = worstSkewness;
    out.facePyramids[cell] = leastPyramid;
    out.aspectRatio[cell] = farthest / nearest;
    out.inverseAspectRatio[cell] = nearest / farthest;
    out.valid[cell] = geometry.cellVolumes[cell] > 0.0 && leastPyramid > 0.0 && closed(cell) ? 1 : 0;
  }

private:
  bool closed(std::size_t cell) const
  {
    Vec3 sum = Vec3::Zero();
    Vec3 absolute = Vec3::Zero();
    for (const Index f : cellFaces.of(cell))
    {
      sum += mesh.owner[f] == cell ? geometry.faceAreas[f] : Vec3(-geometry.faceAreas[f]);
      absolute += geometry.faceAreas[f].cwiseAbs();
    }
    return (sum.array().abs() <= maxOpenness * absolute.array()).all();
  }

  const MeasuredMesh& measured;
  const FaceMesh& mesh;
  const CellFaces& cellFaces;
  const MeshGeometry& geometry;
  QualityMetrics& out;
};

} // namespace

double faceSkewness(const MeasuredMesh& measured, std::size_t f)
{
  const FaceMesh& mesh = measured.mesh;
  const MeshGeometry& geometry = measured.geometry;
  const Vec3& area = geometry.faceAreas[f];
  const Vec3& center = geometry.cellCentroids[mesh.owner[f]];
  const bool internal = f < mesh.internalFaceCount();
  const Vec3 toFace = geometry.faceCentroids[f] - center;
  const Vec3 d = internal ? Vec3(geometry.cellCentroids[mesh.neighbor[f]] - center) : normalPart(toFace, area);
  const Vec3 offset = toFace - (dotInOrder(area, toFace) / (dotInOrder(area, d) + rootVSmall)) * d;
  const double distance = lengthInOrder(offset);
  const Vec3 direction = offset / (distance + rootVSmall);
  double extent = (internal ? 0.2 : 0.4) * lengthInOrder(d) + rootVSmall;
  for (const Index point : mesh.face(f))
  {
    extent = std::max(extent, std::abs(dotInOrder(direction, mesh.points[point] - geometry.faceCentroids[f])));
  }
  return distance / extent;
}

double faceCosine(const MeasuredMesh& measured, std::size_t f)
{
  const Buffer<Vec3>& centroids = measured.geometry.cellCentroids;
  return cosine(measured.geometry.faceAreas[f],
                centroids[measured.mesh.neighbor[f]] - centroids[measured.mesh.owner[f]]);
}

QualityMetrics computeQuality(const MeasuredMesh& measured, const CellArrays& cells, const RunContext& context)
{
  QualityMetrics out;
  const FaceMesh& mesh = measured.mesh;
  Measurement measurement(measured, out);
  context.progress.report(0.0, "Judging faces");
  context.executor.forEach(mesh.faceCount(), grain, [&](std::size_t f) { measurement.measureFace(f); });
  context.progress.report(0.4, "Judging cells");
  context.executor.forEach(mesh.cellCount, grain, [&](std::size_t c) { measurement.measureCell(c); });
  context.progress.report(0.8, "Judging corners");
  out.scaledJacobian = scaledJacobians(mesh.points, cells, context.part(0.8, 1.0));
  out.volume.resize(mesh.cellCount);
  context.executor.forEach(mesh.cellCount, grain,
                           [&](std::size_t c) { out.volume[c] = measured.geometry.cellVolumes[c]; });
  out.invalidCells = static_cast<std::size_t>(std::count(out.valid.begin(), out.valid.end(), 0));
  context.progress.report(1.0, "Quality known");
  return out;
}

QualityMetrics computeQuality(const FaceMesh& mesh, const CellArrays& cells, const RunContext& context)
{
  return computeQuality(measureMesh(mesh, context.part(0.0, 0.4)), cells, context.part(0.4, 1.0));
}

} // namespace atria
