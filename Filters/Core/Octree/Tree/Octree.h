// SPDX-License-Identifier: GPL-3.0-or-later
/// A linear octree in flat arrays.
#pragma once

#include "Grid/GridFrame.h"
#include "Grid/Morton.h"
#include "Support/Buffer.h"
#include "Support/Executor.h"

#include <algorithm>
#include <span>
#include <vector>

namespace atria {

/// The sets of refined octants, by level: `refined[l]` holds the Morton keys, in the grid of level l, of the octants of
/// level l that have children; sorted, without repeats. Every refined octant's parent is refined. An octree is
/// sized, balanced and passed on in this form; leaves follow from it.
using RefinedSets = std::vector<std::vector<MortonKey>>;

/// An octree from elsewhere: its frame and its refined octants.
struct OctreeSets
{
  GridFrame frame;
  RefinedSets refined;
};

/// Kind of the model's pieces in a leaf.
enum class FeatureType : std::uint8_t
{
  none,
  surface,
  curve,
  corner,
  several, ///< surfaces that are not connected inside the leaf
  cluster  ///< more charts than a leaf can show: see isCluster in Octree/Tree/GeometryLists.h
};

/// A piece of the model in an octant: a triangle, feature edge or corner.
struct ModelItem
{
  enum Kind : std::uint32_t
  {
    triangle,
    featureEdge,
    corner
  };
  std::uint32_t kind : 2;
  std::uint32_t index : 30;
};

/// Leaves in Morton order, and above them the refined octants with their children. Takes about 19 bytes a leaf, and 4
/// for each piece of the model in it. The whole root cube is covered. Leaves outside of the domain are only as fine as
/// the refinement of the domain makes them.
class Octree
{
public:
  /// A child: a refined octant, or a leaf if the leaf bit is set.
  using Node = std::uint32_t;
  static constexpr Node leafBit = 0x80000000u;
  static bool isLeaf(Node node) { return (node & leafBit) != 0; }
  static Index leafOf(Node node) { return node & ~leafBit; }

  Octree() = default;
  /// Builds the octree of these sets. O(n). Throws Error if they are not an octree.
  Octree(const GridFrame& frame, const RefinedSets& refined, const Executor& executor = SerialExecutor());

  const GridFrame& frame() const { return frame_; }
  std::size_t leafCount() const { return levels_.size(); }
  int level(Index leaf) const { return levels_[leaf]; }
  /// Returns the Morton key in the grid of the leaf's own level.
  MortonKey key(Index leaf) const { return keys_[leaf] >> (3 * (frame_.depth - levels_[leaf])); }
  /// Returns the Morton key of the leaf's first cell in the finest grid.
  MortonKey finestKey(Index leaf) const { return keys_[leaf]; }
  int maximumLevel() const;
  Node root() const { return root_; }
  /// Returns the children of a refined octant, in Morton order.
  const std::array<Node, 8>& children(Node node) const { return children_[node]; }
  std::size_t refinedCount() const { return children_.size(); }

  /// Returns the octant `key` of the grid of `level`, or the leaf that holds it.
  Node nodeAt(MortonKey key, int level) const;
  /// Returns the leaf that holds a lattice point of the root cube; the upper one on a border.
  Index leafAt(const LatticePoint& p) const;

  /// Returns the lower corner in cells of the finest grid.
  GridCell anchor(Index leaf) const { return gridCell(keys_[leaf]); }
  LatticePoint lowCorner(Index leaf) const { return cornerOf(leaf, 0); }
  LatticePoint highCorner(Index leaf) const { return cornerOf(leaf, 7); }
  /// Returns a corner by the bits of `which`: x 1, y 2, z 4.
  LatticePoint cornerOf(Index leaf, unsigned which) const;
  Vec3 center(Index leaf) const;
  /// True if the leaf and the domain share volume.
  bool inDomain(Index leaf) const;

  /// Returns the pieces of the model that are in a leaf or touch it, by kind and then by number.
  std::span<const ModelItem> items(Index leaf) const
  {
    return itemOffsets_.empty()
               ? std::span<const ModelItem>()
               : std::span(items_).subspan(itemOffsets_[leaf], itemOffsets_[leaf + 1] - itemOffsets_[leaf]);
  }
  std::span<const ModelItem> items(Index leaf, ModelItem::Kind kind) const
  {
    const auto all = items(leaf);
    const auto begin = std::ranges::partition_point(all, [&](ModelItem piece) { return piece.kind < kind; });
    return {begin, std::partition_point(begin, all.end(), [&](ModelItem piece) { return piece.kind == kind; })};
  }
  FeatureType featureType(Index leaf) const { return featureTypes_.empty() ? FeatureType::none : featureTypes_[leaf]; }
  void setItems(std::vector<Index> offsets, std::vector<ModelItem> items, std::vector<FeatureType> types);

  /// Returns the sets that this octree was made from.
  RefinedSets refinedSets() const;

private:
  void numberLeaves(const RefinedSets& refined, const Executor& executor);

  GridFrame frame_;
  Node root_ = leafBit;
  Buffer<std::array<Node, 8>> children_;
  std::vector<Index> levelBegins_; ///< refined octants of level l are [levelBegins_[l], levelBegins_[l + 1])
  Buffer<MortonKey> keys_;
  Buffer<std::uint8_t> levels_;
  std::vector<Index> itemOffsets_;
  std::vector<ModelItem> items_;
  std::vector<FeatureType> featureTypes_;
};

} // namespace atria
