// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Domain/GridFrame.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace atria {

/// Collects places for a grid point that are not too far from where it is.
struct CandidatePlaces
{
  LatticePoint home;
  std::int64_t reach;
  std::vector<LatticePoint> places;

  void add(const Vec3& p)
  {
    const LatticePoint place{std::llround(p[0]), std::llround(p[1]), std::llround(p[2])};
    const bool near = std::abs(place[0] - home[0]) <= reach && std::abs(place[1] - home[1]) <= reach &&
                      std::abs(place[2] - home[2]) <= reach;
    if (near && std::find(places.begin(), places.end(), place) == places.end())
    {
      places.push_back(place);
    }
  }

  /// The point nearest to p in the plane in the middle between a and b.
  void addBetween(const Vec3& p, const std::optional<Vec3>& a, const std::optional<Vec3>& b)
  {
    if (a && b && (*a - *b).squaredNorm() > 1.0)
    {
      const Vec3 along = (*a - *b).normalized();
      add(p - along * along.dot(p - 0.5 * (*a + *b)));
    }
  }
};

} // namespace atria
