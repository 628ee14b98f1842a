// SPDX-License-Identifier: GPL-3.0-or-later
/// Visits the edges of triangles with all their uses.
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

/// Calls visit(uses) for each edge, with all its uses. `uses` must be sorted.
template <typename Visit> void eachEdge(std::span<const SoupEdgeUse> uses, Visit&& visit)
{
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end)
  {
    for (end = begin + 1; end < uses.size() && uses[end].edge == uses[begin].edge; ++end)
    {
    }
    visit(uses.subspan(begin, end - begin));
  }
}

} // namespace atria
