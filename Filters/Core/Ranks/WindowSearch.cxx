// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/WindowSearch.h"

#include "Support/Sorting.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace atria {

WindowSearch::WindowSearch(const PlainShare& own, const NearBoundary& near, const RankShare& share)
    : own_(own), ofOwn_(near), share_(share)
{
  addOwn();
}

std::vector<PointKey> WindowSearch::run()
{
  const std::vector<PointKey> about = keysAbout();
  fetch(about);
  std::vector<Index> near;
  for (Index e = 0; e < keys_.size(); ++e)
  {
    if (near_.isNear(e))
    {
      near.push_back(e);
    }
  }
  for (;;)
  {
    const std::vector<Index> grown = WindowRows(graph_, near_).grow(near);
    const std::vector<PointKey> missing = missingBeside(grown);
    if (!isAnywhere(!missing.empty(), share_.exchange()))
    {
      return wantedOf(grown, about);
    }
    fetch(missing);
  }
}

/// Returns the keys of elements beside own ones, and of those beside these near the boundary, for layers that grow
/// there.
std::vector<PointKey> WindowSearch::keysAbout() const
{
  std::vector<Index> near = own_.beside;
  std::erase_if(near, [&](Index e) { return !ofOwn_.isNear(e); });
  std::vector<Index> elements = own_.besideThese(near);
  elements.insert(elements.end(), own_.beside.begin(), own_.beside.end());
  std::vector<PointKey> keys;
  std::ranges::transform(elements, std::back_inserter(keys), [&](Index e) { return own_.keys[e]; });
  sortUnique(keys);
  return keys;
}

/// Returns the keys of other ranks' elements in `grown` and in a row around it, and `about`.
std::vector<PointKey> WindowSearch::wantedOf(const std::vector<Index>& grown, const std::vector<PointKey>& about) const
{
  std::vector<PointKey> keys;
  for (const Index e : ElementRows(graph_).grow(grown, 1))
  {
    if (e >= own_.ownCount())
    {
      keys.push_back(keys_[e]);
    }
  }
  sortUnique(keys);
  mergeUnique(keys, about);
  return keys;
}

WindowSearch::Connections WindowSearch::connectionsOf(Index own) const
{
  Connections out{{}, ofOwn_.rows[own], 0};
  const DualMesh& mesh = own_.plain.mesh;
  for (std::size_t direction = 0; direction < out.beyond.size(); ++direction)
  {
    const std::int32_t code = mesh.neighbors[own][direction];
    const Index other = beyond(mesh, code);
    out.beyond[direction] = other == noIndex ? noKey : own_.keys[other];
    out.sheets |= other != noIndex && code < 0 ? 1u << direction : 0u;
  }
  return out;
}

/// Adds own elements. Their neighbors of other ranks are linked when these are fetched.
void WindowSearch::addOwn()
{
  keys_.assign(own_.keys.begin() + own_.firstOwn, own_.keys.begin() + own_.endOwn);
  near_.rows.assign(ofOwn_.rows.begin() + own_.firstOwn, ofOwn_.rows.begin() + own_.endOwn);
  for (Index e = own_.firstOwn; e < own_.endOwn; ++e)
  {
    addFaces(connectionsOf(e));
    for (std::size_t direction = 0; direction < 6; ++direction)
    {
      const Index other = beyond(own_.plain.mesh, own_.plain.mesh.neighbors[e][direction]);
      if (other != noIndex && own_.isOwn(other))
      {
        link(e - own_.firstOwn, direction, other - own_.firstOwn);
      }
    }
  }
}

void WindowSearch::addFaces(const Connections& connections)
{
  const auto element = static_cast<Index>(graph_.neighbors.size());
  std::array<std::int32_t, 6> codes;
  codes.fill(DualMesh::noFace);
  for (std::uint8_t direction = 0; direction < 6; ++direction)
  {
    if ((connections.sheets >> direction & 1) != 0)
    {
      codes[direction] = ~static_cast<std::int32_t>(graph_.boundaryFaces.size());
      graph_.boundaryFaces.push_back({element, 0, noIndex, direction, SheetSide::front, false});
    }
  }
  graph_.neighbors.push_back(codes);
}

void WindowSearch::link(Index element, std::size_t direction, Index other)
{
  std::int32_t& code = graph_.neighbors[element][direction];
  if (DualMesh::isBoundary(code))
  {
    graph_.boundaryFaces[DualMesh::boundaryFaceOf(code)].opposite = other;
  }
  else
  {
    code = static_cast<std::int32_t>(other);
  }
}

/// Returns noIndex for elements that were not fetched.
Index WindowSearch::numberOf(PointKey key) const
{
  if (share_.isOwn(key >> 3))
  {
    return own_.find(key) - own_.firstOwn;
  }
  const auto found = numbers_.find(key);
  return found == numbers_.end() ? noIndex : found->second;
}

void WindowSearch::fetch(const std::vector<PointKey>& keys)
{
  const std::vector<Connections> fetched = askRanks<PointKey, Connections>(
      share_.exchange(), keys, [&](PointKey key) { return share_.rankOf(key >> 3); },
      [&](PointKey key) { return connectionsOf(own_.find(key)); });
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const auto element = static_cast<Index>(keys_.size());
    addFaces(fetched[i]);
    keys_.push_back(keys[i]);
    near_.rows.push_back(fetched[i].row);
    fetched_.push_back(fetched[i]);
    numbers_.emplace(keys[i], element);
    for (std::size_t direction = 0; direction < 6; ++direction)
    {
      const PointKey key = fetched[i].beyond[direction];
      const Index other = key == noKey ? noIndex : numberOf(key);
      if (other != noIndex)
      {
        link(element, direction, other);
        linkBack(other, keys[i], element);
      }
    }
  }
}

void WindowSearch::linkBack(Index element, PointKey key, Index other)
{
  const Connections connections =
      element < own_.ownCount() ? connectionsOf(own_.firstOwn + element) : fetched_[element - own_.ownCount()];
  for (std::size_t direction = 0; direction < 6; ++direction)
  {
    if (connections.beyond[direction] == key)
    {
      link(element, direction, other);
    }
  }
}

/// Returns the keys of elements across faces of `elements` that were not fetched.
std::vector<PointKey> WindowSearch::missingBeside(const std::vector<Index>& elements) const
{
  std::vector<PointKey> missing;
  for (const Index e : elements)
  {
    for (std::size_t direction = 0; e >= own_.ownCount() && direction < 6; ++direction)
    {
      const PointKey key = fetched_[e - own_.ownCount()].beyond[direction];
      if (key != noKey && beyond(graph_, graph_.neighbors[e][direction]) == noIndex)
      {
        if (numberOf(key) != noIndex)
        {
          throw RanksDisagree("ranks do not have the same elements beside each other");
        }
        missing.push_back(key);
      }
    }
  }
  sortUnique(missing);
  return missing;
}

} // namespace atria
