// SPDX-License-Identifier: GPL-3.0-or-later
// Computes LeastMetrics of the cells and faces that a QualityEvaluator keeps.
#include "Optimize/Kernel/QualityEvaluator.h"

#include "Quality/Faces/CellShapes.h"

#include <algorithm>
#include <cmath>

namespace atria {

LeastMetrics QualityEvaluator::metricsOf(const VertexStar& star) const
{
  LeastMetrics least;
  for (const Index cell : star.cells)
  {
    least.take(metricsOfCell(cell));
  }
  for (const Index face : star.faces)
  {
    least.take(metricsOfFace(face));
  }
  return least;
}

LeastMetrics QualityEvaluator::metricsOfCell(Index cell) const
{
  LeastMetrics least;
  const CellMeasure& measure = cells[cell];
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  const auto measureDistance = [&](const Vec3& to) {
    const double distance = (to - measure.centroid).norm();
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  };
  for (const Index f : region_.facesOf(cell))
  {
    const Vec3 toFace = faces[f].centroid - measure.centroid;
    const double side = sign(cell, f);
    least.take(LeastMetrics::pyramidCosine, side * faces[f].normal.dot(toFace) / (toFace.norm() + rootVSmall));
    least.take(LeastMetrics::facePyramid, side * faces[f].area.dot(toFace) / 3.0);
    measureDistance(faces[f].centroid);
    for (const Index point : region_.face(f))
    {
      measureDistance(region_.points[point]);
    }
  }
  least.take(LeastMetrics::inverseAspectRatio, farthest > 0.0 ? nearest / farthest : 0.0);
  least.take(LeastMetrics::volume, measure.volume);
  least.take(LeastMetrics::determinant, determinantOf(cell));
  const JacobianTerms terms = jacobiansOf(cell);
  for (std::size_t i = 0; i < terms.count; ++i)
  {
    least.take(LeastMetrics::scaledJacobian, terms.values[i]);
  }
  return least;
}

LeastMetrics QualityEvaluator::metricsOfFace(Index face) const
{
  LeastMetrics least;
  const FaceMeasure& f = faces[face];
  const CellMeasure& own = cells[region_.owner[face]];
  const Index across = region_.neighbor[face];
  if (across == noIndex)
  {
    least.take(LeastMetrics::skewness, -skewnessOf(face, f.normal.dot(f.centroid - own.centroid) * f.normal, 0.0));
    return least;
  }
  const CellMeasure& other = cells[across];
  const Vec3 d = other.centroid - own.centroid;
  least.take(LeastMetrics::faceCosine, f.normal.dot(d) / (d.norm() + rootVSmall));
  least.take(LeastMetrics::skewness, -skewnessOf(face, d, 0.0));
  least.take(LeastMetrics::weight, weightOf(f, own, other));
  least.take(LeastMetrics::volumeRatio, volumeRatioOf(own, other));
  return least;
}

double QualityEvaluator::determinantOf(Index cell) const
{
  std::array<double, 6> sum{};
  double mean = 0.0;
  int count = 0;
  for (const Index f : region_.facesOf(cell))
  {
    if (region_.neighbor[f] != noIndex)
    {
      const Vec3& a = faces[f].area;
      sum[0] += a[0] * a[0];
      sum[1] += a[1] * a[1];
      sum[2] += a[2] * a[2];
      sum[3] += a[1] * a[2];
      sum[4] += a[0] * a[2];
      sum[5] += a[0] * a[1];
      mean += faces[f].length;
      ++count;
    }
  }
  if (mean <= rootVSmall)
  {
    return 0.0;
  }
  mean /= count;
  const double square = mean * mean;
  const auto& [xx, yy, zz, yz, xz, xy] = sum;
  const double determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  return std::abs(determinant) / (8.0 * square * square * square);
}

JacobianTerms QualityEvaluator::jacobiansOf(Index cell) const
{
  if (region_.natives.empty())
  {
    return {};
  }
  const NativeCell& native = region_.natives[cell];
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < shapeOf(native.type).corners; ++i)
  {
    corners[i] = region_.points[native.corners[i]];
  }
  return jacobianTerms(native.type, corners);
}

} // namespace atria
