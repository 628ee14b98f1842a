// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Constraints/CreaseSheetConstraints.h"

#include "Surface/Search/Distance.h"

#include <algorithm>

namespace atria {

void CreaseSheetConstraints::prepare(std::span<const Index> points, const RunContext& context)
{
  std::vector<Index> older;
  std::ranges::copy_if(points, std::back_inserter(older), [&](Index p) { return isOlder(p); });
  others_.prepare(older, context);
}

bool CreaseSheetConstraints::isMovable(Index point) const
{
  return isOlder(point) ? others_.isMovable(point) : !at(point).onWall || at(point).chart != noIndex;
}

/// Returns p moved to the domain's sides on which the point stays. These are the sides on which the copy of its wall
/// point slides.
Vec3 CreaseSheetConstraints::onSides(Index point, const Vec3& p) const
{
  return at(point).onSide ? others_.place(layer_.copies[at(point).wallPoint], p) : p;
}

Vec3 CreaseSheetConstraints::onChart(Index chart, const Vec3& p) const
{
  const TriangleTree::AnyPlaceOn ofChart([&](Index triangle) { return model_.charts[triangle] == chart; });
  const auto found =
      tree_.nearest((p - frame_.origin) / frame_.latticeUnit(), std::numeric_limits<double>::infinity(), ofChart);
  return found ? frame_.toModel(found->at) : p;
}

Vec3 CreaseSheetConstraints::place(Index point, const Vec3& p) const
{
  if (isOlder(point))
  {
    return others_.place(point, p);
  }
  if (!at(point).onWall)
  {
    return onSides(point, p);
  }
  Vec3 q = p;
  for (int i = 0; i < (at(point).onSide ? projectionTurns : 1); ++i)
  {
    q = onSides(point, onChart(at(point).chart, q));
  }
  return q;
}

Ways CreaseSheetConstraints::waysFrom(Index point, const Vec3& p, double step) const
{
  if (isOlder(point))
  {
    return others_.waysFrom(point, p, step);
  }
  return at(point).onWall || at(point).onSide ? VertexConstraints::waysFrom(point, p, step) : Ways();
}

} // namespace atria
