// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/AnyMesh/BoundaryConstraints.h"

#include "Support/Sorting.h"
#include "Surface/Search/Distance.h"

#include <algorithm>

namespace atria {

BoundaryConstraints::BoundaryConstraints(const FaceMesh& mesh, const BoundaryFeatures& features, bool fixed)
    : mesh_(mesh), features_(features), fixed_(fixed), slotOf_(mesh.points.size(), noIndex)
{
}

bool BoundaryConstraints::isMovable(Index point) const
{
  const BoundaryKind kind = kindOf(point);
  return kind == BoundaryKind::inside || (!fixed_ && kind != BoundaryKind::corner);
}

void BoundaryConstraints::prepare(std::span<const Index> points, const RunContext& context)
{
  std::vector<Index> fresh;
  for (const Index point : points)
  {
    if (slotOf_[point] == noIndex && kindOf(point) != BoundaryKind::inside)
    {
      slotOf_[point] = static_cast<Index>(reaches_.size() + fresh.size());
      fresh.push_back(point);
    }
  }
  const std::size_t before = reaches_.size();
  reaches_.resize(before + fresh.size());
  context.executor.forEach(fresh.size(), 256, [&](std::size_t i) { reaches_[before + i] = findReach(fresh[i]); });
}

BoundaryConstraints::Reach BoundaryConstraints::findReach(Index point) const
{
  Reach reach;
  const bool isOnCurve = kindOf(point) == BoundaryKind::curve;
  reach.pieces = isOnCurve ? edgesNear(point) : facesNear(point);
  const Vec3& start = mesh_.points[point];
  reach.fixedAxes.fill(true);
  for (const Index piece : reach.pieces)
  {
    const std::span<const Index> points =
        isOnCurve ? std::span<const Index>(features_.edges[piece]) : mesh_.face(features_.faces[piece]);
    for (const Index p : points)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        reach.fixedAxes[axis] = reach.fixedAxes[axis] && mesh_.points[p][axis] == start[axis];
      }
    }
  }
  return reach;
}

/// Returns the kept edges at a point and at their other ends; not beyond corners.
std::vector<Index> BoundaryConstraints::edgesNear(Index point) const
{
  std::vector<Index> edges;
  for (const Index edge : features_.edgesAbout.of(point))
  {
    edges.push_back(edge);
    const auto& [a, b] = features_.edges[edge];
    const Index end = a == point ? b : a;
    if (features_.kinds[end] == BoundaryKind::curve)
    {
      const auto beyond = features_.edgesAbout.of(end);
      edges.insert(edges.end(), beyond.begin(), beyond.end());
    }
  }
  sortUnique(edges);
  return edges;
}

/// Returns the faces at a point, and those of the same chart at their corners.
std::vector<Index> BoundaryConstraints::facesNear(Index point) const
{
  std::vector<Index> faces;
  for (const Index face : features_.facesAbout.of(point))
  {
    for (const Index p : mesh_.face(features_.faces[face]))
    {
      for (const Index near : features_.facesAbout.of(features_.leaders[p]))
      {
        if (features_.charts[near] == features_.charts[face])
        {
          faces.push_back(near);
        }
      }
    }
  }
  sortUnique(faces);
  return faces;
}

/// Returns the point of a face that is nearest to p. A face consists of triangles around the mean of its corners, as in
/// its measures.
Vec3 BoundaryConstraints::nearestOnFace(Index face, const Vec3& p) const
{
  const auto points = mesh_.face(features_.faces[face]);
  const auto at = [&](std::size_t i) -> const Vec3& { return mesh_.points[points[i]]; };
  if (points.size() == 3)
  {
    return nearestOnTriangle(p, at(0), at(1), at(2));
  }
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mean += at(i);
  }
  mean /= static_cast<double>(points.size());
  Vec3 best = mean;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 near = nearestOnTriangle(p, at(i), at(i + 1 < points.size() ? i + 1 : 0), mean);
    best = (near - p).squaredNorm() < (best - p).squaredNorm() ? near : best;
  }
  return best;
}

Vec3 BoundaryConstraints::place(Index point, const Vec3& p) const
{
  const BoundaryKind kind = kindOf(point);
  if (kind == BoundaryKind::inside)
  {
    return p;
  }
  const Vec3& start = mesh_.points[point];
  const Reach& reach = reaches_[slotOf_[point]];
  Vec3 best = start;
  double least = std::numeric_limits<double>::infinity();
  for (const Index piece : reach.pieces)
  {
    const Vec3 near = kind == BoundaryKind::curve ? nearestOnSegment(p, mesh_.points[features_.edges[piece][0]],
                                                                     mesh_.points[features_.edges[piece][1]])
                                                  : nearestOnFace(piece, p);
    const double distance = (near - p).squaredNorm();
    if (distance < least)
    {
      least = distance;
      best = near;
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    best[axis] = reach.fixedAxes[axis] ? start[axis] : best[axis];
  }
  return best;
}

} // namespace atria
