// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/SharedBlocks.h"

#include "Ranks/SharedNumbers.h"
#include "Support/Error.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace atria {

namespace {

Bytes bytesOfChanges(const PointChanges& changes)
{
  return bytesOf(changes.points, changes.places, changes.counts, changes.above, changes.classes, changes.turnedSides,
                 changes.suspect, changes.displacementLimits, changes.detached);
}

PointChanges changesFrom(const Bytes& bytes)
{
  PointChanges changes;
  readBytes(bytes, changes.points, changes.places, changes.counts, changes.above, changes.classes, changes.turnedSides,
            changes.suspect, changes.displacementLimits, changes.detached);
  return changes;
}

/// Returns the changes whose points have a number, with these numbers.
template <typename NumberOf> PointChanges renumbered(const PointChanges& changes, NumberOf&& numberOf)
{
  PointChanges out;
  std::size_t first = 0;
  for (std::size_t i = 0; i < changes.points.size(); ++i)
  {
    const std::size_t end = first + changes.counts[i];
    if (const Index number = numberOf(changes.points[i]); number != noIndex)
    {
      out.points.push_back(number);
      out.places.push_back(changes.places[i]);
      out.counts.push_back(changes.counts[i]);
      out.above.insert(out.above.end(), changes.above.begin() + static_cast<std::ptrdiff_t>(first),
                       changes.above.begin() + static_cast<std::ptrdiff_t>(end));
      out.classes.push_back(changes.classes[i]);
      if (!changes.turnedSides.empty())
      {
        out.turnedSides.push_back(changes.turnedSides[i]);
      }
      out.suspect.push_back(changes.suspect[i]);
    }
    first = end;
  }
  for (const auto& [point, limit] : changes.displacementLimits)
  {
    if (const Index number = numberOf(point); number != noIndex)
    {
      out.displacementLimits.emplace_back(number, limit);
    }
  }
  for (const DetachedVertex& vertex : changes.detached)
  {
    if (const Index number = numberOf(vertex.point); number != noIndex)
    {
      out.detached.push_back({number, vertex.wanted});
    }
  }
  return out;
}

/// A poor element as all ranks know it: the grid point it stands for, or that of the element with the face on which it
/// stands.
struct SharedPoor
{
  PointKey element;
  Index height;
  std::uint8_t direction;
  bool fails;
};

} // namespace

SharedBlocks::SharedBlocks(const SharedWindow& window, const DualMesh& plain, const RankShare& share)
    : window_(window), plain_(plain), exchange_(share.exchange()), theirs_(static_cast<std::size_t>(share.ranks())),
      ours_(theirs_.size())
{
  std::vector<std::vector<Index>> theirs(theirs_.size());
  for (Index p = 0; p < window.points.size(); ++p)
  {
    if (const MortonKey leaf = window.points[p].leaf; !share.isOwn(leaf))
    {
      theirs[static_cast<std::size_t>(share.rankOf(leaf))].push_back(p);
    }
  }
  std::vector<std::vector<Index>> ours = askedOf<SharedPoint>(
      theirs, exchange_, [&](Index p) { return window.points[p]; },
      [&](const SharedPoint& point) {
        const Index found = window.find(point);
        return found != noIndex ? found
                                : throw RanksDisagree("ranks do not have the same points where their shares meet");
      });
  for (std::size_t rank = 0; rank < theirs.size(); ++rank)
  {
    theirs_[rank].points = std::move(theirs[rank]);
    ours_[rank].points = std::move(ours[rank]);
  }
  std::ranges::for_each(theirs_, &SharedList::sortPlaces);
  std::ranges::for_each(ours_, &SharedList::sortPlaces);
}

void SharedBlocks::SharedList::sortPlaces()
{
  places.resize(points.size());
  std::iota(places.begin(), places.end(), Index{0});
  std::ranges::sort(places, {}, [this](Index place) { return points[place]; });
}

Index SharedBlocks::SharedList::placeOf(Index point) const
{
  const auto found = std::ranges::lower_bound(places, point, {}, [this](Index place) { return points[place]; });
  return found != places.end() && points[*found] == point ? *found : noIndex;
}

void SharedBlocks::takePlaces(std::vector<Vec3>& points, std::unordered_map<Index, DisplacementLimit>& limits) const
{
  struct PlaceLimit
  {
    Index place;
    DisplacementLimit limit;
  };
  std::vector<std::vector<Vec3>> positions(ours_.size());
  std::vector<std::vector<PlaceLimit>> limitsOf(ours_.size());
  for (std::size_t rank = 0; rank < ours_.size(); ++rank)
  {
    for (const Index p : ours_[rank].points)
    {
      const auto found = limits.find(p);
      if (found != limits.end())
      {
        limitsOf[rank].push_back({static_cast<Index>(positions[rank].size()), found->second});
      }
      positions[rank].push_back(points[p]);
    }
  }
  const auto received = exchangeLists(exchange_, positions);
  const auto receivedLimits = exchangeLists(exchange_, limitsOf);
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    const std::vector<Index>& theirs = theirs_[rank].points;
    for (std::size_t i = 0; i < theirs.size(); ++i)
    {
      points[theirs[i]] = received[rank][i];
      limits.erase(theirs[i]);
    }
    std::ranges::for_each(receivedLimits[rank],
                          [&](const PlaceLimit& one) { limits.emplace(theirs[one.place], one.limit); });
  }
}

std::vector<std::vector<Index>> SharedBlocks::allTouching(const std::vector<std::vector<Index>>& own)
{
  std::vector<Index> flat;
  for (const std::vector<Index>& blocks : own)
  {
    flat.push_back(static_cast<Index>(blocks.size()));
    flat.insert(flat.end(), blocks.begin(), blocks.end());
  }
  std::vector<std::vector<Index>> all;
  for (const std::vector<Index>& some : gatherAll(exchange_, flat))
  {
    for (auto at = some.begin(); at != some.end();)
    {
      const auto end = at + 1 + static_cast<std::ptrdiff_t>(*at);
      all.emplace_back(at + 1, end);
      at = end;
    }
  }
  return all;
}

/// Sends each rank the changes of points that are in its list, and returns what came from each.
std::vector<PointChanges> SharedBlocks::sendChanges(const PointChanges& changes, const std::vector<SharedList>& to,
                                                    const std::vector<SharedList>& from) const
{
  std::vector<Bytes> messages;
  std::ranges::transform(to, std::back_inserter(messages), [&](const SharedList& list) {
    return bytesOfChanges(renumbered(changes, [&](Index point) { return list.placeOf(point); }));
  });
  std::vector<PointChanges> received;
  const std::vector<Bytes> all = exchange_.exchange(std::move(messages));
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    received.push_back(renumbered(changesFrom(all[rank]), [&](Index place) { return from[rank].points[place]; }));
  }
  return received;
}

PointChanges SharedBlocks::allChanges(const PointChanges& own)
{
  PointChanges all = own;
  std::ranges::for_each(sendChanges(own, theirs_, ours_), [&](const PointChanges& some) { append(some, all); });
  PointChanges out = all;
  std::ranges::for_each(sendChanges(all, ours_, theirs_), [&](const PointChanges& some) { append(some, out); });
  return out;
}

std::vector<PoorElement> SharedBlocks::allPoor(const std::vector<PoorElement>& own)
{
  const DualMesh& mesh = plain_;
  std::vector<SharedPoor> shared;
  for (const PoorElement& one : own)
  {
    const Index element = one.isPlain() ? one.place : mesh.boundaryFaces[one.place].element;
    const std::uint8_t direction = one.isPlain() ? std::uint8_t{0} : mesh.boundaryFaces[one.place].direction;
    shared.push_back({window_.elementKeys[element], one.height, direction, one.fails});
  }
  std::vector<PoorElement> out;
  for (const std::vector<SharedPoor>& some : gatherAll(exchange_, shared))
  {
    for (const SharedPoor& one : some)
    {
      const auto found = std::ranges::lower_bound(window_.elementKeys, one.element);
      if (found == window_.elementKeys.end() || *found != one.element)
      {
        continue;
      }
      const auto element = static_cast<Index>(found - window_.elementKeys.begin());
      const std::int32_t code = mesh.neighbors[element][one.direction];
      if (one.height == noIndex || DualMesh::isBoundary(code))
      {
        out.push_back({one.height == noIndex ? element : DualMesh::boundaryFaceOf(code), one.height, one.fails});
      }
    }
  }
  return out;
}

bool SharedBlocks::isAny(bool own) { return isAnywhere(own, exchange_); }

} // namespace atria
