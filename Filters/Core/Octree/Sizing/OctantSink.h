// SPDX-License-Identifier: GPL-3.0-or-later
/// Interface through which sources of sizes add octants.
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"

namespace atria {

/// Reason to refine an octant. A limit on elements gives up the first of these first.
enum class OctantNeed : std::uint8_t
{
  open,    ///< the size in the open, SizeMax
  region,  ///< a box, a distance or a gap, away from surfaces
  surface, ///< a surface, or a box or distance where a surface is
  feature  ///< a feature curve, a corner or close surfaces
};
inline constexpr std::size_t needCount = 4;

/// Receives octants from sources of sizes, level by level from the root. A source adds an octant only if it has added
/// its parent, and the sink wants it to continue from that.
class OctantSink
{
public:
  virtual ~OctantSink() = default;

  virtual const GridFrame& frame() const = 0;
  /// True if octants of `level` may still be refined for `need`.
  virtual bool takes(int level, OctantNeed need) const = 0;
  /// True if a source must give the needs of octants.
  virtual bool isLimited() const = 0;
  /// Adds octants of `level` to refine: sorted keys, and the need of each. Needs may have any values if the sink is not
  /// limited.
  virtual void add(int level, const std::vector<MortonKey>& keys, const std::vector<OctantNeed>& needs,
                   const RunContext& context) = 0;
  /// True if a source should visit the children of an octant it has added, provided that the level takes its need.
  virtual bool goesOn(int level, MortonKey key) const = 0;
};

/// True if octants of `level` may still be refined for any need.
inline bool takesAny(const OctantSink& sink, int level)
{
  return sink.takes(level, OctantNeed::open) || sink.takes(level, OctantNeed::region) ||
         sink.takes(level, OctantNeed::surface) || sink.takes(level, OctantNeed::feature);
}

} // namespace atria
