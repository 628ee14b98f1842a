// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides the conforming layer into boundary layers, as many as elements are valid with.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

namespace atria {

class LayerDivision
{
public:
  explicit LayerDivision(ImproverState& state) : state_(state) {}

  /// Layers of an asked height stay as they are: nothing can be improved by moving their points.
  void run();

private:
  void flattenTops();
  bool divideAndImprove(const LayerMesh& given);
  std::vector<ShortCell> improve(const std::vector<char>& marked, const std::vector<char>& held);
  void restore(const LayerMesh& given, const std::vector<ShortCell>& bad, const std::vector<Index>& counts,
               LayerMesh& one, std::vector<char>& held, std::vector<char>& changed) const;
  void divideEvenly(const LayerMesh& one);

  ImproverState& state_;
};

} // namespace atria
