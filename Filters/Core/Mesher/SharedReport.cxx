// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/SharedReport.h"

#include "Mesher/Shares/SharedNumbers.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace atria {

namespace {

constexpr std::size_t root = 0;

/// What each rank has, on the first one; nothing on others.
template <typename T> std::vector<std::vector<T>> gatherOnRoot(const std::vector<T>& own, RankExchange& exchange)
{
  std::vector<std::vector<T>> toRanks(static_cast<std::size_t>(exchange.ranks()));
  toRanks[root] = own;
  return exchangeLists(exchange, toRanks);
}

struct SharedStep
{
  CrackStep step;
  PointKey point;
};

/// By point, the element with the lowest number of all in the mesh that have it, where that is an own one: all elements
/// at a point of an own one are in the piece. Otherwise one of another rank.
std::vector<Index> firstElementsOf(const SharedPiece& piece)
{
  std::vector<Index> first(piece.pointsBefore.size(), noIndex);
  for (Index e = 0; e < piece.mesh.elementCount(); ++e)
  {
    for (const Index p : piece.mesh.corners[e])
    {
      const bool isFirst = first[p] == noIndex || piece.elementNumbers[e] < piece.elementNumbers[first[p]];
      first[p] = isFirst ? e : first[p];
    }
  }
  return first;
}

} // namespace

ZoneFacts SharedReport::findFacts(const Zones& zones, const GridPlaces& places, const Crossings& crossings,
                                  const SharedPoints& points, std::size_t surfaceCount,
                                  const std::vector<char>& isGround, const MeshingContext& context) const
{
  const auto firstFrom = [&](MortonKey key) {
    const auto leaves = context.octree.leafCount();
    Index first = 0;
    for (auto end = static_cast<Index>(leaves); first < end;)
    {
      const Index middle = first + (end - first) / 2;
      const bool isBefore = context.octree.finestKey(middle) < key;
      first = isBefore ? middle + 1 : first;
      end = isBefore ? end : middle;
    }
    return first;
  };
  const MortonRange own = share_.own();
  const GridPart part{points.firstOwn(), points.endOwn(), firstFrom(own.begin), firstFrom(own.end)};
  const ZoneFacts facts = findZoneFacts(zones, crossings, places, surfaceCount, part, context, isGround);
  ZoneFacts all;
  for (const Bytes& bytes : share_.exchange().gather(bytesOf(facts.zones, facts.faces, facts.corners)))
  {
    ZoneFacts some;
    readBytes(bytes, some.zones, some.faces, some.corners);
    append(some, all);
  }
  return all;
}

void SharedReport::addCracks(const CrossedGrid& grid, const Zones& zones, const std::vector<char>& kept,
                             const SharedPoints& points, const MeshingContext& context)
{
  const auto isOwnLeaf = [&](Index leaf) { return share_.isOwn(context.octree.finestKey(leaf)); };
  std::vector<SharedStep> own;
  for (const CrackStep& step :
       findCrackSteps(grid.gaps, zones, kept, grid.displaced.crossings, grid.displaced.places, isOwnLeaf, context))
  {
    own.push_back({step, points.key(step.point)});
  }
  std::vector<CrackStep> steps;
  std::vector<PointKey> keys;
  for (const std::vector<SharedStep>& some : gatherOnRoot(own, share_.exchange()))
  {
    for (const SharedStep& shared : some)
    {
      steps.push_back(shared.step);
      steps.back().point = static_cast<Index>(keys.size());
      keys.push_back(shared.point);
    }
  }
  for (const Crack& crack : joinCracks(grid.gaps.boundary, steps))
  {
    entries_.push_back({Group::cracks,
                        crack.open ? Diagnostic::openCrack : Diagnostic::closedCrack,
                        crack.path.front(),
                        crack.path.back(),
                        crack.width,
                        paths_.size(),
                        0,
                        {keys[crack.point], noIndex, 0}});
    paths_.push_back(crack.path);
  }
}

void SharedReport::addPlain(const std::vector<Diagnostic>& found, const std::vector<PointKey>& keys)
{
  for (const Diagnostic& diagnostic : found)
  {
    if (isOwn(keys[diagnostic.element], share_))
    {
      const Group group = diagnostic.kind == Diagnostic::mergedSheets ? Group::merged : Group::unresolved;
      entries_.push_back({group,
                          diagnostic.kind,
                          diagnostic.begin,
                          diagnostic.end,
                          diagnostic.width,
                          0,
                          0,
                          {keys[diagnostic.element], noIndex, 0}});
    }
  }
}

void SharedReport::addLeftOut(const ImprovedMesh& improved, const SharedLayers& layers)
{
  for (const LeftOutElement& element : improved.leftOut)
  {
    if (layers.isOwn(element.number))
    {
      const SharedElement beside = element.beside == noIndex ? noElement : layers.elementOf(element.besideBefore);
      // Those on walls come after all others.
      entries_.push_back({Group::leftOut, Diagnostic::leftOutElement, element.middle, element.middle, element.size,
                          layers.elementOf(element.number).isPlain() ? 0U : 1U, 0, beside});
    }
  }
}

void SharedReport::addDetached(const ImprovedMesh& improved, const SharedPiece& piece)
{
  const std::vector<Index> firstElements = firstElementsOf(piece);
  for (const DetachedVertex& vertex : improved.detached)
  {
    const auto found = std::ranges::lower_bound(piece.pointsBefore, vertex.point);
    if (found == piece.pointsBefore.end() || *found != vertex.point)
    {
      continue;
    }
    const auto p = static_cast<std::size_t>(found - piece.pointsBefore.begin());
    const Index e = firstElements[p];
    // The rank that has the point may have none of its elements.
    if (piece.elementRanks[e] == share_.rank())
    {
      entries_.push_back({Group::detached, Diagnostic::detachedVertex, piece.mesh.points[p], vertex.wanted, 0.0,
                          piece.pointNumbers[p], piece.elementNumbers[e], noElement});
    }
  }
}

std::vector<SharedElement> SharedReport::elements() const
{
  std::vector<SharedElement> elements;
  for (const Entry& entry : entries_)
  {
    if (entry.beside != noElement)
    {
      elements.push_back(entry.beside);
    }
  }
  return elements;
}

Diagnostic SharedReport::diagnosticOf(const Entry& entry)
{
  const Index element = entry.element < noIndex ? static_cast<Index>(entry.element) : noIndex;
  return {entry.kind, entry.begin, entry.end, element, entry.width};
}

std::vector<Diagnostic> SharedReport::finish(const std::vector<std::uint64_t>& numbers) const
{
  std::vector<Entry> own = entries_;
  std::size_t next = 0;
  for (Entry& entry : own)
  {
    if (entry.beside != noElement)
    {
      entry.element = numbers[next++];
    }
    else if (entry.group == Group::leftOut)
    {
      entry.element = noNumber;
    }
  }
  std::vector<Entry> all;
  for (const std::vector<Entry>& some : gatherOnRoot(own, share_.exchange()))
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  std::stable_sort(all.begin(), all.end(), [](const Entry& l, const Entry& r) {
    return std::tuple(l.group, l.place) < std::tuple(r.group, r.place);
  });
  std::vector<Diagnostic> out;
  for (const Entry& entry : all)
  {
    Diagnostic& diagnostic = out.emplace_back(diagnosticOf(entry));
    if (entry.group == Group::cracks)
    {
      const std::vector<Vec3>& path = paths_[entry.place];
      diagnostic.between.assign(path.begin() + 1, path.end() - 1);
    }
  }
  return out;
}

} // namespace atria
