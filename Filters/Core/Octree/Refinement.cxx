// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Refinement.h"

#include "Octree/Balance.h"
#include "Octree/GeometryLists.h"
#include "Support/Error.h"

#include <algorithm>

namespace atria {

namespace {

bool mustRefine(const GeometryLists& lists, std::size_t i, int level, const SurfaceModel& model, const GridFrame& frame)
{
  if (level < frame.startLevel || level < frame.topLevel)
  {
    return true;
  }
  const std::span<const ModelItem> pieces = lists.of(i);
  if (pieces.empty() || level >= frame.depth)
  {
    return false;
  }
  if (level < frame.midLevel)
  {
    return true;
  }
  return featureTypeOf(domainBoxOf(frame, level, lists.keys[i]), pieces, model) > FeatureType::surface;
}

RefinedSets sizeOctants(const SurfaceModel& model, const GridFrame& frame, const RunContext& context)
{
  RefinedSets refined;
  GeometryLists lists = sizingLists(model, frame);
  for (int level = 0; level < frame.depth; ++level)
  {
    context.progress.report(static_cast<double>(level) / frame.depth, "Sizing octants");
    std::vector<char> chosen(lists.size());
    context.executor.forEach(lists.size(), 1024,
                             [&](std::size_t i) { chosen[i] = mustRefine(lists, i, level, model, frame); });
    std::vector<MortonKey> keys;
    for (std::size_t i = 0; i < lists.size(); ++i)
    {
      if (chosen[i])
      {
        keys.push_back(lists.keys[i]);
      }
    }
    if (keys.empty())
    {
      break;
    }
    refined.push_back(std::move(keys));
    const bool onlyOccupied = level + 1 >= std::max(frame.topLevel, frame.startLevel);
    lists = childLists(lists, level, chosen, onlyOccupied, model, frame, context);
  }
  return refined;
}

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

Octree buildOctree(const SurfaceModel& model, const GridFrame& frame, const RunContext& context)
{
  const RunContext sizing = context.part(0.0, 0.5);
  RefinedSets refined = sizeOctants(model, frame, sizing);
  context.progress.report(0.5, "Balancing");
  balance(refined, frame, context);
  context.progress.report(0.6, "Linking octants");
  Octree octree(frame, refined);
  locateModel(octree, model, context.part(0.7, 1.0));
  return octree;
}

} // namespace atria
