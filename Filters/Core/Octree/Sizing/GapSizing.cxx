// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/GapSizing.h"

#include "Surface/Search/Distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atria {

namespace {

/// Largest angle between a ray and the normal of a triangle that is the other side of a gap.
constexpr double facingAngle = std::numbers::pi / 6.0;

/// Returns the part of a triangle in a box (Sutherland and Hodgman 1974).
std::vector<Vec3> clipTriangle(const LatticeBox& box, const SurfaceModel& model, Index triangle)
{
  std::vector<Vec3> polygon{toVector(model.corner(triangle, 0)), toVector(model.corner(triangle, 1)),
                            toVector(model.corner(triangle, 2))};
  for (int side = 0; side < 6; ++side)
  {
    const int axis = axisOf(side);
    const auto plane = static_cast<double>(isUpper(side) ? box.high[axis] : box.low[axis]);
    const double sense = isUpper(side) ? -1.0 : 1.0;
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Vec3& p = polygon[i];
      const Vec3& q = polygon[(i + 1) % polygon.size()];
      const double fromP = sense * (p[axis] - plane);
      const double fromQ = sense * (q[axis] - plane);
      if (fromP >= 0.0)
      {
        kept.push_back(p);
      }
      if ((fromP < 0.0) != (fromQ < 0.0))
      {
        kept.push_back(p + (fromP / (fromP - fromQ)) * (q - p));
      }
    }
    polygon = std::move(kept);
  }
  return polygon;
}

} // namespace

GapSizer::GapSizer(const SurfaceModel& model, const GridFrame& frame, const ModelLevels& levels, int cellsAcross)
    : model_(model), frame_(frame), levels_(levels), cellsAcross_(cellsAcross), tree_(model)
{
  least_ = coincidentRatio * static_cast<double>(frame.latticeSize(frame.featureLevel));
  most_ = cellsAcross * static_cast<double>(frame.latticeSize(std::max(frame.topLevel, frame.startLevel)));
}

int GapSizer::levelFor(double width, Index triangle, Index other) const
{
  const int finest = std::max(levels_.featureOfSurface[model_.surfaceIds[triangle]],
                              levels_.featureOfSurface[model_.surfaceIds[other]]);
  return std::min(levelNotAbove(width * frame_.latticeUnit() / cellsAcross_, frame_), finest);
}

void GapSizer::findFrom(const LatticeBox& box, Index triangle, double sense, std::vector<GapLine>& lines) const
{
  const std::vector<Vec3> polygon = clipTriangle(box, model_, triangle);
  if (polygon.size() < 3)
  {
    return;
  }
  Box3 bounds;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : polygon)
  {
    bounds.extend(p);
    middle += p / static_cast<double>(polygon.size());
  }
  const Vec3 direction = sense * model_.normal(triangle).normalized();
  TriangleTree::Hit narrowest;
  const auto probe = [&](const Vec3& origin) {
    const TriangleTree::Hit hit = tree_.firstHit(origin, direction, least_, std::min(most_, narrowest.distance));
    if (hit.triangle != noIndex &&
        std::abs(model_.normal(hit.triangle).normalized().dot(direction)) >= std::cos(facingAngle))
    {
      narrowest = hit;
    }
  };
  probe(middle);
  std::ranges::for_each(polygon, probe);
  if (narrowest.triangle != noIndex)
  {
    // The box is a little short on all sides, so that octants that only touch the gap do not count.
    const Vec3 along = narrowest.distance * direction;
    lines.push_back({bounds.center() + coincidentRatio * along, bounds.center() + (1.0 - coincidentRatio) * along,
                     0.5 * (1.0 - coincidentRatio) * bounds.size(),
                     levelFor(narrowest.distance, triangle, narrowest.triangle)});
  }
}

int GapSizer::find(const LatticeBox& box, std::span<const ModelItem> pieces, std::vector<GapLine>& lines) const
{
  const std::size_t begin = lines.size();
  for (const ModelItem piece : pieces)
  {
    if (piece.kind == ModelItem::triangle)
    {
      findFrom(box, piece.index, 1.0, lines);
      findFrom(box, piece.index, -1.0, lines);
    }
  }
  int level = 0;
  for (std::size_t i = begin; i < lines.size(); ++i)
  {
    level = std::max(level, lines[i].level);
  }
  return level;
}

} // namespace atria
