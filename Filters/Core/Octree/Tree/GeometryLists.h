// SPDX-License-Identifier: GPL-3.0-or-later
/// Hands the pieces of the model that octants hold down from parents to children.
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"
#include "Surface/Search/BoxTests.h"

namespace atria {

/// Octants of one level, sorted by key, each with its pieces of the model.
struct GeometryLists
{
  std::vector<MortonKey> keys;
  std::vector<std::size_t> offsets{0};
  std::vector<ModelItem> items;

  std::size_t size() const { return keys.size(); }
  std::span<const ModelItem> of(std::size_t i) const
  {
    return std::span(items).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
  void append(MortonKey key, std::span<const ModelItem> pieces);
  void append(const GeometryLists& other);
};

/// Returns the octant `key` of `level`, cut to the domain; empty if they share no volume.
LatticeBox domainBoxOf(const GridFrame& frame, int level, MortonKey key);

/// Hands the pieces of octants to their children, one octant at a time.
class PieceDivider
{
public:
  PieceDivider(const SurfaceModel& model, const GridFrame& frame) : model_(model), frame_(frame) {}

  /// Calls use(k, box, pieces) for each child, in the domain, of an octant of `level` that has `pieces`. These must not
  /// be pieces that the same divider has passed to `use`, which are valid until the next child.
  template <typename Use> void divide(int level, MortonKey key, std::span<const ModelItem> pieces, Use&& use)
  {
    find(level, key, pieces);
    for (unsigned k = 0; k < 8; ++k)
    {
      if (!boxes_[k].empty())
      {
        use(k, boxes_[k], take(k, pieces));
      }
    }
  }

private:
  void find(int level, MortonKey key, std::span<const ModelItem> pieces);
  std::span<const ModelItem> take(unsigned k, std::span<const ModelItem> pieces);

  const SurfaceModel& model_;
  const GridFrame& frame_;
  std::array<LatticeBox, 8> boxes_{};
  /// One entry per piece: bits of the boxes that it touches.
  std::vector<std::uint8_t> touched_;
  std::vector<ModelItem> taken_;
};

/// Returns the root, with all pieces of the model that touch the domain.
GeometryLists rootLists(const SurfaceModel& model, const GridFrame& frame);

/// The same, without the sides of a turned domain and the features on them, as sides of a domain request no small
/// octants.
GeometryLists sizingLists(const SurfaceModel& model, const GridFrame& frame);

/// Returns the children, of level + 1, of the octants of `parents` marked in `chosen`; each inherits the pieces that
/// touch it. Children outside the domain are left out, and if `onlyOccupied`, children without pieces, too.
GeometryLists childLists(const GeometryLists& parents, int level, const std::vector<char>& chosen, bool onlyOccupied,
                         const SurfaceModel& model, const GridFrame& frame, const RunContext& context);

/// Return the leaves that touch a box, in Morton order, and the triangles in these leaves, sorted.
std::vector<Index> leavesTouching(const Octree& octree, const LatticeBox& box);
std::vector<Index> trianglesNear(const Octree& octree, const LatticeBox& box);

/// True if the triangles among `pieces` form more than one surface inside the box: sets connected through edges and
/// points that lie in it.
bool severalSurfaces(const LatticeBox& box, std::span<const ModelItem> pieces, const SurfaceModel& model);

/// True if a leaf holds a piece of a side of a turned domain.
bool hasTurnedSide(const Octree& octree, Index leaf, const SurfaceModel& model);

/// A leaf of more charts than this is a cluster. Three planes that cross, such as a slab and two walls, are twelve
/// charts once they are cut, and a leaf's eight corners distinguish all eight regions between them.
inline constexpr std::size_t mostChartsOfLeaf = 12;

/// True if the triangles among `pieces` are of more charts than mostChartsOfLeaf.
bool isCluster(std::span<const ModelItem> pieces, const SurfaceModel& model);

/// Returns the first type that fits an octant's pieces: `cluster`, `corner`, `curve`, `several`, `surface`, `none`.
FeatureType featureTypeOf(const LatticeBox& box, std::span<const ModelItem> pieces, const SurfaceModel& model);

} // namespace atria
