// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Optimise/Judge.h"
#include "Optimise/VertexGuide.h"

namespace atria {

/// Looks for a better place for one point at a time.
class PointSearch
{
public:
  PointSearch(Judge& qualities, const VertexGuide& vertexGuide) : judge(qualities), guide(vertexGuide) {}

  /// Moves the point if there is a place near it where the penalty of the cells about it is less and their worst no
  /// worse. `trust` is how far to go, as a part of the cells' size, and is adapted.
  bool improve(Index movable, double& trust);
  /// Moves the point towards `place` as far as the worst of the cells about it is not below `least`, or not below what
  /// it is.
  void approach(Index movable, const Vec3& place, double least);

private:
  Vec3 newtonStep(const Score& here, double reach);
  Vec3 bestProbe(const Score& here, double reach);
  Score scoreAt(const Vec3& p, double enough = std::numeric_limits<double>::infinity());
  bool isBetter(const Score& there, const Score& here) const;

  Judge& judge;
  const VertexGuide& guide;
  Star star;
  Index pointId = noIndex;
  Vec3 origin;
};

} // namespace atria
