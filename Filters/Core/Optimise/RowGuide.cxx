// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/RowGuide.h"

#include <algorithm>

namespace atria {

void RowGuide::prepare(std::span<const Index> points, const RunContext& context)
{
  std::vector<Index> older;
  std::ranges::copy_if(points, std::back_inserter(older), [&](Index p) { return isOlder(p); });
  others_.prepare(older, context);
}

bool RowGuide::isMovable(Index point) const
{
  return isOlder(point) ? others_.isMovable(point)
                        : !at(point).isFixed && (!at(point).onWall || at(point).chart != noIndex);
}

Vec3 RowGuide::place(Index point, const Vec3& p) const
{
  if (isOlder(point))
  {
    return others_.place(point, p);
  }
  if (!at(point).onWall)
  {
    return p;
  }
  const auto isWanted = [&](Index triangle) { return model_.charts[triangle] == at(point).chart; };
  const auto found =
      tree_.nearest((p - frame_.origin) / frame_.latticeUnit(), std::numeric_limits<double>::infinity(), isWanted);
  return found ? frame_.toModel(*found) : p;
}

Ways RowGuide::waysFrom(Index point, const Vec3& p, double step) const
{
  if (isOlder(point))
  {
    return others_.waysFrom(point, p, step);
  }
  return at(point).onWall ? VertexGuide::waysFrom(point, p, step) : Ways();
}

} // namespace atria
