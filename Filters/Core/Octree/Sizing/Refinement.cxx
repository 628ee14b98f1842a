// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/Refinement.h"

#include "Octree/Tree/GeometryLists.h"
#include "Support/Error.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace atria {

namespace {

/// Consecutive leaves, and what they hold.
struct LeafLists
{
  std::vector<Index> leaves;
  std::vector<std::size_t> ends; ///< end of each leaf's items
  std::vector<FeatureType> types;
  std::vector<ModelItem> items;
};

/// An octant, or a leaf, and what it holds.
struct Branch
{
  Octree::Node node;
  int level;
  MortonKey key;
  LatticeBox box;
  std::vector<ModelItem> pieces;
};

/// Hands the pieces of a branch down to its leaves.
class Descent
{
public:
  Descent(const Octree& tree, const SurfaceModel& surfaces, LeafLists& leaves)
      : octree(tree), model(surfaces), out(leaves), dividers(tree.frame().depth, PieceDivider(model, tree.frame()))
  {
  }

  void descend(Octree::Node node, int level, MortonKey key, const LatticeBox& box, std::span<const ModelItem> pieces)
  {
    if (Octree::isLeaf(node))
    {
      out.leaves.push_back(Octree::leafOf(node));
      out.types.push_back(featureTypeOf(box, pieces, model));
      out.items.insert(out.items.end(), pieces.begin(), pieces.end());
      out.ends.push_back(out.items.size());
      return;
    }
    dividers[level].divide(level, key, pieces,
                           [&](unsigned k, const LatticeBox& childBox, std::span<const ModelItem> some) {
                             if (!some.empty())
                             {
                               descend(octree.children(node)[k], level + 1, key << 3 | k, childBox, some);
                             }
                           });
  }

private:
  const Octree& octree;
  const SurfaceModel& model;
  LeafLists& out;
  /// One divider per level.
  std::vector<PieceDivider> dividers;
};

/// Returns the children of a branch that hold something, or the branch itself if it is a leaf.
std::vector<Branch> childrenOf(Branch branch, const Octree& octree, const SurfaceModel& model)
{
  std::vector<Branch> children;
  if (Octree::isLeaf(branch.node))
  {
    children.push_back(std::move(branch));
    return children;
  }
  PieceDivider(model, octree.frame())
      .divide(branch.level, branch.key, branch.pieces,
              [&](unsigned k, const LatticeBox& box, std::span<const ModelItem> pieces) {
                if (!pieces.empty())
                {
                  children.push_back({octree.children(branch.node)[k],
                                      branch.level + 1,
                                      branch.key << 3 | k,
                                      box,
                                      {pieces.begin(), pieces.end()}});
                }
              });
  return children;
}

/// Returns some hundred parts of the octree that hold something, in order.
std::vector<Branch> branchesOf(const Octree& octree, const SurfaceModel& model, const RunContext& context)
{
  constexpr std::size_t enough = 256;
  const GridFrame& frame = octree.frame();
  std::vector<Branch> branches{{octree.root(), 0, 0, domainBoxOf(frame, 0, 0), rootLists(model, frame).items}};
  for (int level = 0; level < frame.depth && branches.size() < enough; ++level)
  {
    std::vector<std::vector<Branch>> below(branches.size());
    context.executor.forEach(branches.size(), 1,
                             [&](std::size_t i) { below[i] = childrenOf(std::move(branches[i]), octree, model); });
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
    Descent(octree, model, parts[i]).descend(branch.node, branch.level, branch.key, branch.box, branch.pieces);
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
