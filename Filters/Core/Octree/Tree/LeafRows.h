// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds leaves around others, without numbers of leaves or grid points.
#pragma once

#include "Octree/Tree/OctreeBlocks.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// A set of leaves. One entry per refined octant, in the order of levels and keys: the bits of its children in the set.
using LeafMasks = std::vector<std::uint8_t>;

/// Rows of the leaves of a balanced octree whose root is refined. Takes 10 bytes a refined octant, and one more for
/// each mask. Throws Error for 2^28 refined octants or more.
class LeafRows
{
public:
  /// `refined` must outlive this; so must `frame`.
  LeafRows(const RefinedSets& refined, const GridFrame& frame);

  /// Returns the leaves that share volume with the domain.
  const LeafMasks& inDomain() const { return inDomain_; }
  /// Returns the leaves of a range, also those outside of the domain.
  LeafMasks in(const MortonRange& range) const;
  /// Returns the leaves with these keys in the finest grid.
  LeafMasks of(const std::vector<MortonKey>& leaves) const;
  /// Returns the leaves with pieces of the model.
  LeafMasks withModel(const SurfaceModel& model, const RunContext& context) const
  {
    return marked(model, false, context);
  }
  /// Returns the leaves with pieces of the model or sides of the domain.
  LeafMasks withSurfaces(const SurfaceModel& model, const RunContext& context) const
  {
    return marked(model, true, context);
  }
  /// Returns the number of `leaves` from each of these keys of the finest grid to the next one; the last is the end.
  std::vector<std::size_t> countBetween(const std::vector<MortonKey>& begins, const LeafMasks& leaves) const;
  /// Returns a set with `rows` rows of leaves around it; only leaves of `within` are added.
  LeafMasks grow(LeafMasks leaves, int rows, const LeafMasks& within) const;
  /// Returns the sets of an octree that has these leaves; it is not balanced yet. Octants above the start level are all
  /// refined.
  RefinedSets setsOf(const LeafMasks& leaves) const;

private:
  class SurfaceDescent;
  class NeighborFinder;

  /// A refined octant by its number; a leaf, with the leaf bit, by the number of its parent and its place among that
  /// one's children; noIndex outside of the root.
  using Node = Index;
  /// The octants of one level around one, itself in the middle, or leaves that hold them.
  using Neighbors = std::array<Node, 27>;
  struct Octant
  {
    Index place;        ///< eight times its parent, plus its place among that one's children
    Index firstRefined; ///< first of its refined children, which are consecutive
  };

  void link();
  LeafMasks marked(const SurfaceModel& model, bool sides, const RunContext& context) const;
  template <typename Visit> void eachChild(Visit&& visit) const;
  Node childOf(Index octant, unsigned child) const;
  template <typename Visit> void eachTouching(unsigned children, const Neighbors& neighbors, Visit&& visit) const;
  template <typename Visit>
  void eachFiner(unsigned children, int direction, Index octant, unsigned touched, Visit&& visit) const;

  const RefinedSets& refined_;
  const GridFrame& frame_;
  std::vector<Octant> octants_;
  std::vector<Index> levels_; ///< first octant of each level
  LeafMasks all_;
  LeafMasks inDomain_;
};

} // namespace atria
