// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks whether polygons close a volume.
#pragma once

#include "Support/Types.h"

#include <cstddef>
#include <vector>

namespace atria::model {

/// Polygons that may lack each other's corners: an edge is also closed by several shorter ones along it.
class ClosedShell
{
public:
  std::size_t addPoint(const Vec3& p)
  {
    points.push_back(p);
    return points.size() - 1;
  }
  /// Adds a polygon. Corners beyond the last point are left out.
  void addPolygon(const std::vector<std::size_t>& corners) { polygons.push_back(corners); }

  /// True if an even number of polygons meets along all edges, except gaps of a ten-thousandth of the whole.
  bool isClosed() const;

private:
  std::vector<Vec3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

} // namespace atria::model
