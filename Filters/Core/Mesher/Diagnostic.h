// SPDX-License-Identifier: GPL-3.0-or-later
/// Places where a mesh does not follow its model.
#pragma once

#include "Support/Types.h"

#include <vector>

namespace atria {

/// Place that the mesh could not follow, or that a user should know of.
struct Diagnostic
{
  enum Kind : std::uint8_t
  {
    mergedSheets,      ///< an octree edge is cut more than once: the sheets there became one
    unresolvedFeature, ///< pieces that do not meet share a vertex, which is not on all of them
    leakPath,          ///< a way from a sealed seed to the outside
    closedCrack,       ///< a gap beside a boundary edge, narrower than an octant, that no octree edge passes
    openCrack,         ///< the same gap if octree edges pass it
    detachedVertex,    ///< a vertex that is not where the model wants it, as no valid element could be there
    cluster,           ///< an octant with more pieces of the model than it can show; its merged sheets and features
                       ///< are not reported
    leftOutElement     ///< the middle of an element at a wall that was left out as it could not be made valid
  };
  Kind kind;
  Vec3 begin;
  Vec3 end;
  /// An element beside it; noIndex for a leak of a zone that is not meshed.
  Index element;
  /// Width of a gap: of a leak at its narrowest place, of a crack at its widest. For an element left out, the edge of a
  /// cube with its volume. 0 for the other kinds.
  double width = 0.0;
  /// Points of a line between `begin` and `end`, in order.
  std::vector<Vec3> between = {};
  /// Place among the diagnostics of one stage, if several processes find them; equal ones are sorted by element.
  std::uint64_t order = 0;
};
inline constexpr std::array<const char*, 8> diagnosticNames{"MergedSheets", "UnresolvedFeature", "LeakPath",
                                                            "ClosedCrack",  "OpenCrack",         "DetachedVertex",
                                                            "Cluster",      "LeftOutElement"};

} // namespace atria
