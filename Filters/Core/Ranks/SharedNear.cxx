// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/SharedNear.h"

#include "Support/Sorting.h"

#include <algorithm>

namespace atria {

SharedNear::SharedNear(const PlainShare& own, const RankShare& share)
    : own_(own), exchange_(share.exchange()), theirElements_(static_cast<std::size_t>(share.ranks())),
      theirVertices_(theirElements_.size())
{
  for (const Index e : own.beside)
  {
    theirElements_[static_cast<std::size_t>(share.rankOf(own.keys[e] >> 3))].push_back(e);
  }
  std::vector<Index> vertices;
  for (Index e = own.firstOwn; e < own.endOwn; ++e)
  {
    for (const Index p : own.plain.mesh.corners[e])
    {
      if (!share.isOwn(own.points[p].leaf))
      {
        vertices.push_back(own.plain.vertexOf[p]);
      }
    }
  }
  sortUnique(vertices);
  for (const Index vertex : vertices)
  {
    theirVertices_[static_cast<std::size_t>(share.rankOf(own.points[vertex].leaf))].push_back(vertex);
  }
  ourElements_ = askedOf<PointKey>(
      theirElements_, exchange_, [&](Index e) { return own.keys[e]; }, [&](PointKey key) { return own.find(key); });
  ourVertices_ = askedOf<MortonKey>(
      theirVertices_, exchange_, [&](Index vertex) { return own.points[vertex].leaf; },
      [&](MortonKey leaf) { return own.vertexOf(leaf); });
}

template <typename T>
std::vector<Index> SharedNear::take(const Lists& ours, const Lists& theirs, std::vector<T>& values) const
{
  std::vector<std::vector<T>> sent;
  for (const std::vector<Index>& some : ours)
  {
    std::ranges::transform(some, std::back_inserter(sent.emplace_back()), [&](Index i) { return values[i]; });
  }
  const std::vector<std::vector<T>> received = exchangeLists(exchange_, sent);
  std::vector<Index> changed;
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    for (std::size_t i = 0; i < theirs[rank].size(); ++i)
    {
      T& value = values[theirs[rank][i]];
      if (value != received[rank][i])
      {
        value = received[rank][i];
        changed.push_back(theirs[rank][i]);
      }
    }
  }
  return changed;
}

std::vector<Index> SharedNear::takeElements(std::vector<std::uint8_t>& values) const
{
  return take(ourElements_, theirElements_, values);
}

void SharedNear::takeVertices(std::vector<char>& values) const { take(ourVertices_, theirVertices_, values); }

} // namespace atria
