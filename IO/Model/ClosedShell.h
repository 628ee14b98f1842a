// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether polygons close a volume.
#pragma once

#include "Support/Types.h"

#include <cstddef>
#include <vector>

namespace atria::model {

/// Polygons that may leave each other's corners out: an edge is also closed by several shorter ones along it.
class ClosedShell
{
public:
  std::size_t addPoint(const Vec3& p)
  {
    points.push_back(p);
    return points.size() - 1;
  }
  /// Corners beyond the last point are left out.
  void addPolygon(const std::vector<std::size_t>& corners) { polygons.push_back(corners); }

  /// Whether an even number of polygons meets along all edges, but for gaps of a ten-thousandth of the whole.
  bool isClosed() const;

private:
  std::vector<Vec3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

} // namespace atria::model
