// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/LostModel.h"

#include <algorithm>
#include <sstream>

namespace atria {

std::vector<std::string> warningsOfLostModel(const std::vector<char>& isGround, double sizeMin,
                                             const std::vector<MetSides>& met)
{
  bool isAnyMet = false;
  for (std::size_t i = 0; i < isGround.size(); ++i)
  {
    isAnyMet = isAnyMet || (!isGround[i] && (met[i].hasBoundary() || met[i].within));
  }
  if (isAnyMet || std::ranges::find(isGround, 0) == isGround.end())
  {
    return {};
  }
  std::ostringstream text;
  text << "no surface of the model has a face in the mesh, but for ground: all are finer than its elements; lower "
          "SizeMin, which is "
       << sizeMin;
  return {text.str()};
}

} // namespace atria
