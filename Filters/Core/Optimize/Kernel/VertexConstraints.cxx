// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

Ways VertexConstraints::waysFrom(Index point, const Vec3& p, double step) const
{
  // Shorter components, as shares of a step, are rounding or the bend of a surface.
  constexpr double least = 0.05;
  const Vec3 origin = place(point, p);
  std::array<Vec3, 3> rest;
  for (int axis = 0; axis < 3; ++axis)
  {
    rest[axis] = (place(point, origin + step * Vec3::Unit(axis)) - origin) / step;
  }
  Ways ways{{}, 0};
  for (int i = 0; i < 3; ++i)
  {
    const Vec3* longest = &rest[0];
    for (const Vec3& one : rest)
    {
      longest = one.squaredNorm() > longest->squaredNorm() ? &one : longest;
    }
    if (longest->norm() < least)
    {
      break;
    }
    const Vec3 way = longest->normalized();
    ways.along[ways.count++] = way;
    for (Vec3& one : rest)
    {
      one -= way.dot(one) * way;
    }
  }
  return ways;
}

} // namespace atria
