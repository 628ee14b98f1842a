// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces and cells measured as in Quality/Geometry.h, one at a time.
#pragma once

#include "Optimize/Kernel/CellSource.h"

namespace atria {

struct FaceMeasure
{
  Vec3 centroid;
  Vec3 area;     ///< out of the owner
  Vec3 normal;   ///< of length 1; nothing for a face without area
  double length; ///< the area vector's
};

struct CellMeasure
{
  Vec3 centroid;
  double volume;
  /// The mean of the faces' centroids, which says more than the centroid where a cell is nearly flat.
  Vec3 mean;
};

/// Eigen's is not inlined everywhere.
inline Vec3 crossOf(const Vec3& u, const Vec3& v)
{
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// `pointOf(i)` is the face's i-th corner. Where `size` is a constant this is faster.
template <typename PointOf> FaceMeasure measureFace(std::size_t size, PointOf&& pointOf)
{
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < size; ++i)
  {
    mean += pointOf(i);
  }
  mean /= static_cast<double>(size);
  Vec3 area = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  double magnitude = 0.0;
  const auto addTriangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 twice = crossOf(b - a, c - a);
    const double size2 = twice.norm();
    area += twice;
    magnitude += size2;
    moment += size2 * (a + b + c);
  };
  if (size == 3)
  {
    addTriangle(pointOf(0), pointOf(1), pointOf(2));
  }
  else
  {
    for (std::size_t i = 0; i < size; ++i)
    {
      addTriangle(pointOf(i), pointOf(i + 1 < size ? i + 1 : 0), mean);
    }
  }
  const double length = area.norm();
  return {magnitude > rootVSmall ? Vec3(moment / (3.0 * magnitude)) : mean, 0.5 * area,
          length > rootVSmall ? Vec3(area / length) : Vec3(Vec3::Zero()), 0.5 * length};
}

template <typename PointOf> FaceMeasure measureAnyFace(std::size_t size, PointOf&& pointOf)
{
  return size == 4 ? measureFace(4, pointOf) : measureFace(size, pointOf);
}

/// `eachFace(visit)` calls visit(centroid, outward area) for every face, each time in the same order.
template <typename EachFace> CellMeasure measureCell(EachFace&& eachFace)
{
  Vec3 estimate = Vec3::Zero();
  int count = 0;
  eachFace([&](const Vec3& centroid, const Vec3&) {
    estimate += centroid;
    ++count;
  });
  estimate /= static_cast<double>(std::max(count, 1));
  Vec3 moment = Vec3::Zero();
  double triple = 0.0;
  eachFace([&](const Vec3& centroid, const Vec3& area) {
    const double pyramid = area.dot(centroid - estimate);
    moment += pyramid * (0.75 * centroid + 0.25 * estimate);
    triple += pyramid;
  });
  return {std::abs(triple) > vSmall ? Vec3(moment / triple) : estimate, triple / 3.0, estimate};
}

/// OpenFOAM's interpolation weight.
double weightOf(const FaceMeasure& face, const CellMeasure& own, const CellMeasure& other);
/// The smaller over the larger; negative where one of them is.
double volumeRatioOf(const CellMeasure& own, const CellMeasure& other);

/// Of some points, one after the other and back to the first: `pointOf(i)` is the i-th.
template <typename PointOf> double perimeterOf(std::size_t size, PointOf&& pointOf)
{
  double length = (pointOf(0) - pointOf(size - 1)).norm();
  for (std::size_t i = 1; i < size; ++i)
  {
    length += (pointOf(i) - pointOf(i - 1)).norm();
  }
  return length;
}

struct SizedCell
{
  CellMeasure measure;
  double size; ///< mean edge of its faces
};

/// Measures a cell of a source; `faces` is room for its faces.
SizedCell measureCell(const CellSource& source, Index cell, CellSource::Scratch& scratch,
                      std::vector<FaceMeasure>& faces);

} // namespace atria
