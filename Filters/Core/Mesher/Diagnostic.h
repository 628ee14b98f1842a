// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <vector>

namespace atria {

/// Something the mesh could not follow, or that a user should know of it.
struct Diagnostic
{
  enum Kind : std::uint8_t
  {
    mergedSheets,      ///< an octree edge is cut more than once: the sheets there became one
    unresolvedFeature, ///< pieces that do not meet share a vertex, which is not on all of them
    leakPath,          ///< a way from a sealed seed to the outside
    closedCrack,       ///< a gap beside a boundary edge, narrower than an octant, that no octree edge passes
    openCrack,         ///< one that octree edges pass
    detachedVertex,    ///< a vertex that is not where the model wants it, as no valid element could be there
    cluster,           ///< an octant with more pieces of the model than it can show; of its merged sheets and features
                       ///< nothing else is told
    leftOutElement     ///< an element at a wall that is not in the mesh, as it could not be made valid: its middle
  };
  Kind kind;
  Vec3 begin;
  Vec3 end;
  /// An element beside it; noIndex for a leak of a zone that is not meshed.
  Index element;
  /// How wide a gap is: a leak at its narrowest place, a crack at its widest. Of an element left out, the edge of a
  /// cube of its volume. 0 for the other kinds.
  double width = 0.0;
  /// The points of a line between its begin and end, in order.
  std::vector<Vec3> between = {};
  /// Its place among those that are found by one stage, if several processes find them; equal ones by element.
  std::uint64_t order = 0;
};
inline constexpr std::array<const char*, 8> diagnosticNames{"MergedSheets", "UnresolvedFeature", "LeakPath",
                                                            "ClosedCrack",  "OpenCrack",         "DetachedVertex",
                                                            "Cluster",      "LeftOutElement"};

} // namespace atria
