// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Refinement.h"

#include "Octree/GeometryLists.h"
#include "Support/Error.h"

#include <algorithm>

namespace atria {

namespace {

/// What the leaves hold, as found level by level.
struct LeafLists
{
  struct Entry
  {
    Index leaf;
    std::size_t begin;
    std::size_t end;
  };
  std::vector<Entry> entries;
  std::vector<ModelItem> items;
};

LeafLists descend(const Octree& octree, const SurfaceModel& model, const RunContext& context)
{
  LeafLists found;
  const GridFrame& frame = octree.frame();
  GeometryLists lists = rootLists(model, frame);
  for (int level = 0; lists.size() > 0; ++level)
  {
    context.progress.report(static_cast<double>(level) / (frame.depth + 1), "Locating surfaces");
    std::vector<char> refined(lists.size());
    for (std::size_t i = 0; i < lists.size(); ++i)
    {
      const Octree::Node node = octree.nodeAt(lists.keys[i], level);
      refined[i] = !Octree::isLeaf(node);
      if (!refined[i])
      {
        const auto pieces = lists.of(i);
        const std::size_t begin = found.items.size();
        found.items.insert(found.items.end(), pieces.begin(), pieces.end());
        found.entries.push_back({Octree::leafOf(node), begin, found.items.size()});
      }
    }
    lists = childLists(lists, level, refined, true, model, frame, context);
  }
  return found;
}

} // namespace

void locateModel(Octree& octree, const SurfaceModel& model, const RunContext& context)
{
  constexpr std::size_t largest = std::size_t{1} << 30;
  if (model.triangles.size() >= largest || model.featureEdges.size() >= largest)
  {
    throw Error("the model has more than 2^30 triangles");
  }
  LeafLists found = descend(octree, model, context);
  std::sort(found.entries.begin(), found.entries.end(),
            [](const LeafLists::Entry& l, const LeafLists::Entry& r) { return l.leaf < r.leaf; });
  std::vector<Index> offsets(octree.leafCount() + 1, 0);
  std::vector<ModelItem> items;
  items.reserve(found.items.size());
  std::vector<FeatureType> types(octree.leafCount(), FeatureType::none);
  for (const LeafLists::Entry& entry : found.entries)
  {
    items.insert(items.end(), found.items.begin() + entry.begin, found.items.begin() + entry.end);
    offsets[entry.leaf + 1] = static_cast<Index>(entry.end - entry.begin);
  }
  for (std::size_t i = 1; i < offsets.size(); ++i)
  {
    offsets[i] += offsets[i - 1];
  }
  context.executor.forEach(found.entries.size(), 256, [&](std::size_t i) {
    const LeafLists::Entry& entry = found.entries[i];
    const LatticeBox box = domainBoxOf(octree.frame(), octree.level(entry.leaf), octree.key(entry.leaf));
    types[entry.leaf] = featureTypeOf(box, std::span(found.items).subspan(entry.begin, entry.end - entry.begin), model);
  });
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
