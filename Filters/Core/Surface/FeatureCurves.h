// SPDX-License-Identifier: GPL-3.0-or-later
/// A model's feature edges as the curves they make, and what meets there.
#pragma once

#include "Surface/SurfaceModel.h"

#include <vector>

namespace atria {

/// A curve runs through points that are no corners, along edges of one kind.
struct FeatureCurves
{
  /// Per feature edge: its curve; numbered in order of their first edges.
  std::vector<Index> curveOf;
  std::size_t count = 0;
  /// Per feature edge: the surfaces of the triangles that use it, sorted, each once.
  std::vector<std::vector<Index>> surfaces;
};

/// O(n log n) in triangles and feature edges.
FeatureCurves findFeatureCurves(const SurfaceModel& model);

} // namespace atria
