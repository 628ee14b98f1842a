// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds what upright lines meet.
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// Bins of boxes by their place as seen from above. O(n) memory.
class PlanBins
{
public:
  /// Empty boxes are in no bin.
  explicit PlanBins(const std::vector<Box3>& boxes);

  /// Calls visit(number) for all boxes that the rectangle may touch, for some more than once unless it is a point.
  template <typename Visit> void eachNear(const Vec3& low, const Vec3& high, Visit&& visit) const
  {
    for (std::size_t i = binOf(low[0], 0); !bounds.empty() && i <= binOf(high[0], 0); ++i)
    {
      for (std::size_t j = binOf(low[1], 1); j <= binOf(high[1], 1); ++j)
      {
        for (std::size_t at = begins[i * bins + j]; at < begins[i * bins + j + 1]; ++at)
        {
          visit(numbers[at]);
        }
      }
    }
  }

private:
  std::size_t binOf(double value, int axis) const;
  std::size_t entriesOf(const std::vector<Box3>& boxes) const;

  Box3 bounds;
  std::size_t bins = 1; ///< number along each side
  std::vector<std::size_t> begins;
  std::vector<Index> numbers;
};

struct PlumbHit
{
  double height;
  Index triangle;
};

/// Finds where upright lines meet triangles of a surface. Keeps a reference to the surface.
class PlumbLines
{
public:
  PlumbLines(const TriangleSurface& surface, std::vector<Index> triangles);

  /// Sets `hits` to the triangles that are not upright and that the line at (x, y) meets, from the lowest up.
  void find(double x, double y, std::vector<PlumbHit>& hits) const;

  /// Calls visit(triangle) for each upright triangle within `reach` of the line from p down to `bottom`.
  template <typename Visit> void eachUprightBelow(const Vec3& p, double bottom, double reach, Visit&& visit) const
  {
    const Vec3 margin(reach, reach, 0.0);
    bins.eachNear(p - margin, p + margin, [&](Index i) {
      if (isUprightBelow(triangles[i], p, bottom, reach))
      {
        visit(triangles[i]);
      }
    });
  }

private:
  bool isUprightBelow(Index triangle, const Vec3& p, double bottom, double reach) const;

  const TriangleSurface& surface;
  std::vector<Index> triangles;
  PlanBins bins;
};

} // namespace atria
