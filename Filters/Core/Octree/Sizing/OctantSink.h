// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"

namespace atria {

/// What sources of sizes add octants to, level by level from the root. A source adds an octant only if it has added its
/// parent, and the sink goes on from that.
class OctantSink
{
public:
  virtual ~OctantSink() = default;

  virtual const GridFrame& frame() const = 0;
  /// Whether octants of `level` may still be refined, at least for features.
  virtual bool takes(int level) const = 0;
  /// Whether a source must say which octants it refines for features.
  virtual bool wantsFeatures() const = 0;
  /// Octants of `level` to refine: `keys`, sorted; `forFeatures` by key, or empty if none is.
  virtual void add(int level, const std::vector<MortonKey>& keys, const std::vector<char>& forFeatures,
                   const RunContext& context) = 0;
  /// Whether a source is to look at the children of an octant it has added.
  virtual bool goesOn(int level, MortonKey key) const = 0;
};

} // namespace atria
