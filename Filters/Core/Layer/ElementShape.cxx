// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/ElementShape.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace atria {

namespace {

struct FaceShape
{
  Vec3 area = Vec3::Zero();
  Vec3 centroid = Vec3::Zero();
};

/// Measures a face as triangles around the mean of its points; see computeGeometry.
FaceShape measure(const std::vector<Vec3>& points, const ReducedFace& face)
{
  const auto at = [&](int i) -> const Vec3& { return points[face.points[i]]; };
  if (face.count == 3)
  {
    return {0.5 * (at(1) - at(0)).cross(at(2) - at(0)), (at(0) + at(1) + at(2)) / 3.0};
  }
  const Vec3 mean = 0.25 * (at(0) + at(1) + at(2) + at(3));
  FaceShape out;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    const Vec3& next = at((i + 1) % 4);
    const Vec3 area = 0.5 * (next - at(i)).cross(mean - at(i));
    const double magnitude = area.norm();
    out.area += area;
    out.centroid += magnitude / 3.0 * (at(i) + next + mean);
    sum += magnitude;
  }
  out.centroid = sum > 0.0 ? Vec3(out.centroid / sum) : mean;
  return out;
}

} // namespace

ElementShape shapeOf(const std::vector<Vec3>& points, const std::array<Index, 8>& corners)
{
  std::array<FaceShape, 6> faces;
  int count = 0;
  Vec3 estimate = Vec3::Zero();
  for (int d = 0; d < 6; ++d)
  {
    const ReducedFace face = faceOf(corners, d);
    if (face.count >= 3)
    {
      faces[count] = measure(points, face);
      estimate += faces[count++].centroid;
    }
  }
  estimate /= std::max(1, count);
  Vec3 moment = Vec3::Zero();
  double triple = 0.0;
  for (int i = 0; i < count; ++i)
  {
    const double pyramid = faces[i].area.dot(faces[i].centroid - estimate);
    moment += pyramid * (0.75 * faces[i].centroid + 0.25 * estimate);
    triple += pyramid;
  }
  ElementShape out;
  out.volume = triple / 3.0;
  if (count < 4 || triple == 0.0)
  {
    return out;
  }
  const Vec3 centroid = moment / triple;
  out.pyramid = std::numeric_limits<double>::max();
  out.cosine = 1.0;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 way = faces[i].centroid - centroid;
    const double pyramid = faces[i].area.dot(way);
    const double scale = faces[i].area.norm() * way.norm();
    out.pyramid = std::min(out.pyramid, pyramid / 3.0);
    out.cosine = std::min(out.cosine, scale > 0.0 ? pyramid / scale : -1.0);
  }
  return out;
}

} // namespace atria
