// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/SharedWindow.h"

#include "Ranks/OwnPart.h"
#include "Ranks/SharedNear.h"
#include "Ranks/WindowSearch.h"
#include "Support/FreedMemory.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace atria {

namespace {

/// Returns, for each rank, the own elements that are in its window, counted from the first own one.
std::vector<std::vector<Index>> elementsFor(const PlainShare& own, const NearBoundary& near, const RankShare& share)
{
  std::vector<std::vector<PointKey>> wanted(static_cast<std::size_t>(share.ranks()));
  for (const PointKey key : WindowSearch(own, near, share).run())
  {
    wanted[static_cast<std::size_t>(share.rankOf(key >> 3))].push_back(key);
  }
  std::vector<std::vector<Index>> out;
  for (const std::vector<PointKey>& some : exchangeLists(share.exchange(), wanted))
  {
    std::ranges::transform(some, std::back_inserter(out.emplace_back()),
                           [&](PointKey key) { return own.find(key) - own.firstOwn; });
  }
  return out;
}

std::vector<WindowPart> partsOfWindow(PlainShare own, Index cutTag, const RankShare& share)
{
  NearBoundary near = findNearBoundary(own.plain.mesh, own.plain.vertexOf, own.plain.classification.classes.size(),
                                       SharedNear(own, share));
  const std::vector<std::vector<Index>> elements = elementsFor(own, near, share);
  WindowPart part = ownPart(std::move(own), std::move(near), cutTag);
  giveBackFreedMemory();
  return exchangeParts(std::move(part), elements, cutTag, share.exchange());
}

} // namespace

Index SharedWindow::find(const SharedPoint& point) const
{
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(vertexCount);
  const auto begin = point.copy == 0 ? points.begin() : middle;
  const auto end = point.copy == 0 ? middle : points.end();
  const auto found = std::lower_bound(begin, end, point);
  return found != end && *found == point ? static_cast<Index>(found - points.begin()) : noIndex;
}

SharedWindow makeWindow(PlainShare own, Index cutTag, const RankShare& share, const SurfaceModel& model, Octree& octree,
                        const RunContext& context)
{
  context.progress.check();
  octree = {};
  expectSameElements(own, share);
  SharedWindow out = joinParts(partsOfWindow(std::move(own), cutTag, share), cutTag);
  giveBackFreedMemory();
  std::tie(out.firstOwn, out.endOwn) = ownRange(out.elementKeys, share);
  std::vector<MortonKey> leaves(out.vertexCount);
  std::transform(out.points.begin(), out.points.begin() + out.vertexCount, leaves.begin(),
                 [](const SharedPoint& point) { return point.leaf; });
  octree = share.makeOctree(leaves, model, context);
  out.plain.classification.leaves.resize(leaves.size());
  std::ranges::transform(leaves, out.plain.classification.leaves.begin(),
                         [&](MortonKey leaf) { return Octree::leafOf(octree.nodeAt(leaf, octree.frame().depth)); });
  return out;
}

} // namespace atria
