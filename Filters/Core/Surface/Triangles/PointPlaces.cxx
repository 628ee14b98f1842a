// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/PointPlaces.h"

#include "Support/IndexTable.h"

#include <bit>
#include <cmath>

namespace atria {

std::vector<Index> placesOf(std::span<const Vec3> points, double step)
{
  // Adding and subtracting 1.5 * 2^52 rounds, many times faster than std::round. Adding zero merges both zeros.
  constexpr double rounder = 6755399441055744.0;
  const double scale = step > 0.0 ? 1.0 / step : 1.0;
  const auto rounded = [&](const Vec3& p) -> Vec3 {
    const Vec3 q = step > 0.0 ? Vec3(((p * scale).array() + rounder) - rounder) : p;
    return q + Vec3::Zero();
  };
  const auto hash = [&](const Vec3& p) {
    std::uint64_t h = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      h = mixed(h ^ std::bit_cast<std::uint64_t>(p[axis]));
    }
    return h;
  };
  IndexTable table(points.size());
  std::vector<Index> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 key = rounded(points[i]);
    places[i] =
        table.findOrAdd(hash(key), static_cast<Index>(i), [&](Index other) { return rounded(points[other]) == key; });
  }
  return places;
}

double placeStep(const Box3& bounds)
{
  if (bounds.empty())
  {
    return 0.0;
  }
  const double reach = std::max(bounds.min.cwiseAbs().maxCoeff(), bounds.max.cwiseAbs().maxCoeff());
  const double extent = bounds.size().maxCoeff() > 0.0 ? bounds.size().maxCoeff() : reach;
  if (!(reach > 0.0))
  {
    return 0.0;
  }
  // Numbers have sixteen digits; transforms may cost one or two.
  const double ofSize = std::pow(10.0, std::floor(std::log10(extent)) - 8.0);
  const double ofNumbers = std::pow(10.0, std::floor(std::log10(reach)) - 14.0);
  const double step = std::max(ofSize, ofNumbers);
  return std::isnormal(step) ? step : 0.0;
}

} // namespace atria
