// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures single faces and cells, as Quality/Faces/Geometry.h does for meshes.
#pragma once

#include "Optimize/Kernel/CellSource.h"

namespace atria {

struct FaceMeasure
{
  Vec3 centroid;
  Vec3 area;     ///< area vector by the right-hand rule
  Vec3 normal;   ///< unit vector; zero for a face without area
  double length; ///< length of the area vector
};

struct CellMeasure
{
  Vec3 centroid;
  /// Negative if the cell is inverted.
  double volume;
  /// Mean of the face centroids, which is of more use than the centroid if a cell is nearly flat.
  Vec3 mean;
};

/// Returns the cross product. Eigen's is not inlined everywhere.
inline Vec3 crossOf(const Vec3& u, const Vec3& v)
{
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Measures a face of `size` points by triangles around their mean; `pointOf(i)` returns the i-th. It is faster if
/// `size` is a constant.
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

/// The same; faster for quadrilaterals.
template <typename PointOf> FaceMeasure measureAnyFace(std::size_t size, PointOf&& pointOf)
{
  return size == 4 ? measureFace(4, pointOf) : measureFace(size, pointOf);
}

/// Measures a cell by pyramids from the mean of its face centroids. `eachFace(visit)` calls visit(centroid, outward
/// area vector) for every face, in the same order each time.
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

/// Returns OpenFOAM's interpolation weight of a face between two cells, 0 to 0.5.
double weightOf(const FaceMeasure& face, const CellMeasure& own, const CellMeasure& other);
/// Returns the smaller volume over the larger absolute volume; negative if a volume is.
double volumeRatioOf(const CellMeasure& own, const CellMeasure& other);

/// Returns the length of a closed polygon of `size` points; `pointOf(i)` returns the i-th.
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
  double size; ///< mean edge of its faces, in model units
};

/// Measures a cell of a source. `scratch` and `faces` are buffers that it overwrites.
SizedCell measureCell(const CellSource& source, Index cell, CellSource::Scratch& scratch,
                      std::vector<FaceMeasure>& faces);

} // namespace atria
