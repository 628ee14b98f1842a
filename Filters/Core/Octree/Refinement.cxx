// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Refinement.h"

#include "Octree/GeometryLists.h"
#include "Support/Error.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

namespace atria {

namespace {

/// Leaves that lie one behind the other, and what they hold.
struct LeafLists
{
  std::vector<Index> leaves;
  std::vector<std::size_t> ends; ///< of each leaf's items
  std::vector<FeatureType> types;
  std::vector<ModelItem> items;
};

/// An octant, or a leaf, and what it holds.
struct Branch
{
  Octree::Node node;
  int level;
  MortonKey key;
  std::vector<ModelItem> pieces;
};

/// Hands pieces of the model down to the leaves.
class Descent
{
public:
  Descent(const Octree& tree, const SurfaceModel& surfaces) : octree(tree), model(surfaces) {}

  /// The children that hold something, in order.
  template <typename Use>
  void forChildren(Octree::Node node, int level, MortonKey key, std::span<const ModelItem> pieces, Use&& use)
  {
    Room& room = roomOf(level);
    const std::array<LatticeBox, 8> boxes = childBoxes(octree.frame(), level, key);
    room.touched.resize(pieces.size());
    std::ranges::transform(pieces, room.touched.begin(), [&](ModelItem piece) {
      return static_cast<std::uint8_t>(childrenTouched(boxes, piece, model));
    });
    for (unsigned k = 0; k < 8; ++k)
    {
      room.pieces.clear();
      for (std::size_t i = 0; i < pieces.size(); ++i)
      {
        if ((room.touched[i] >> k & 1) != 0)
        {
          room.pieces.push_back(pieces[i]);
        }
      }
      if (!room.pieces.empty())
      {
        use(octree.children(node)[k], level + 1, key << 3 | k, room.pieces);
      }
    }
  }

  void descend(Octree::Node node, int level, MortonKey key, std::span<const ModelItem> pieces, LeafLists& out)
  {
    if (!Octree::isLeaf(node))
    {
      forChildren(node, level, key, pieces,
                  [&](Octree::Node child, int below, MortonKey childKey, const std::vector<ModelItem>& some) {
                    descend(child, below, childKey, some, out);
                  });
      return;
    }
    out.leaves.push_back(Octree::leafOf(node));
    out.types.push_back(featureTypeOf(domainBoxOf(octree.frame(), level, key), pieces, model));
    out.items.insert(out.items.end(), pieces.begin(), pieces.end());
    out.ends.push_back(out.items.size());
  }

private:
  /// For the children of one octant of a level at a time.
  struct Room
  {
    std::vector<std::uint8_t> touched;
    std::vector<ModelItem> pieces;
  };

  Room& roomOf(int level) { return rooms[static_cast<std::size_t>(level)]; }

  const Octree& octree;
  const SurfaceModel& model;
  std::array<Room, GridFrame::maximumDepth + 1> rooms;
};

/// Some hundred parts of the octree that hold something, in order.
std::vector<Branch> branchesOf(const Octree& octree, const SurfaceModel& model, const RunContext& context)
{
  constexpr std::size_t enough = 256;
  std::vector<Branch> branches{{octree.root(), 0, 0, rootLists(model, octree.frame()).items}};
  for (int level = 0; level < octree.frame().depth && branches.size() < enough; ++level)
  {
    std::vector<std::vector<Branch>> below(branches.size());
    context.executor.forEach(branches.size(), 1, [&](std::size_t i) {
      Branch& branch = branches[i];
      if (Octree::isLeaf(branch.node))
      {
        below[i].push_back(std::move(branch));
        return;
      }
      Descent(octree, model)
          .forChildren(branch.node, branch.level, branch.key, branch.pieces,
                       [&](Octree::Node child, int childLevel, MortonKey key, const std::vector<ModelItem>& pieces) {
                         below[i].push_back({child, childLevel, key, pieces});
                       });
    });
    branches.clear();
    for (std::vector<Branch>& some : below)
    {
      std::ranges::move(some, std::back_inserter(branches));
    }
  }
  return branches;
}

} // namespace

void locateModel(Octree& octree, const SurfaceModel& model, const RunContext& context)
{
  constexpr std::size_t largest = std::size_t{1} << 30;
  if (model.triangles.size() >= largest || model.featureEdges.size() >= largest)
  {
    throw Error("the model has more than 2^30 triangles");
  }
  context.progress.report(0.0, "Locating surfaces");
  std::vector<Branch> branches = branchesOf(octree, model, context);
  context.progress.report(0.2, "Locating surfaces");
  std::vector<LeafLists> parts(branches.size());
  context.executor.forEach(branches.size(), 1, [&](std::size_t i) {
    Branch& branch = branches[i];
    Descent(octree, model).descend(branch.node, branch.level, branch.key, branch.pieces, parts[i]);
    branch.pieces = {};
  });
  context.progress.report(0.9, "Locating surfaces");
  std::vector<std::size_t> begins{0};
  for (const LeafLists& part : parts)
  {
    begins.push_back(begins.back() + part.items.size());
  }
  std::vector<Index> offsets(octree.leafCount() + 1, 0);
  std::vector<FeatureType> types(octree.leafCount(), FeatureType::none);
  std::vector<ModelItem> items(begins.back());
  context.executor.forEach(parts.size(), 1, [&](std::size_t i) {
    LeafLists& part = parts[i];
    for (std::size_t k = 0; k < part.leaves.size(); ++k)
    {
      const std::size_t before = k == 0 ? 0 : part.ends[k - 1];
      offsets[part.leaves[k] + 1] = static_cast<Index>(part.ends[k] - before);
      types[part.leaves[k]] = part.types[k];
    }
    std::ranges::copy(part.items, items.begin() + static_cast<std::ptrdiff_t>(begins[i]));
    part = {};
  });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  octree.setItems(std::move(offsets), std::move(items), std::move(types));
}

Octree buildOctree(const SurfaceModel& model, const GridFrame& frame, const SizedOctants& sized,
                   const RunContext& context)
{
  context.progress.report(0.0, "Linking octants");
  Octree octree(frame, sized.refined, context.executor);
  locateModel(octree, model, context.part(0.2, 1.0));
  return octree;
}

Octree buildOctree(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& sizing,
                   const RunContext& context)
{
  const SizedOctants sized = sizeOctants(model, frame, sizing, context.part(0.0, 0.6));
  return buildOctree(model, frame, sized, context.part(0.6, 1.0));
}

} // namespace atria
