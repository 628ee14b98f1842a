// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/Contacts.h"

#include "Support/Pieces.h"
#include "Support/Sorting.h"
#include "Surface/Repair/Clusters.h"
#include "Surface/Repair/ContactFinder.h"
#include "Surface/Search/BoxRaster.h"
#include "Surface/Search/BoxTree.h"

#include <atomic>
#include <numeric>

namespace atria {

namespace {

/// A search among some of the triangles.
struct Search
{
  ContactFinder finder;
  /// Pairs to test once it is known that there are not too many.
  std::vector<std::pair<Index, Index>> later;
};

/// Tests pairs of boxes in the tree, and pairs of the others with these, as they are met. Pairs are counted first where
/// boxes cluster, as testing them takes far longer.
std::vector<Search> searchContacts(const TriangleSoup& soup, const BoxTree& tree,
                                   const std::vector<NumberedBox>& others, const AskedPairs& asked, double reach,
                                   const ClusterCells& clusters, const RunContext& context)
{
  const std::size_t count = tree.size() + others.size();
  // If there are few triangles, many are near each other. Pieces are small then, so that all threads get some.
  const std::size_t grain = std::clamp<std::size_t>(count / 128, 8, 1024);
  constexpr std::size_t manyEach = 200;
  std::vector<Search> searches((count + grain - 1) / grain, Search{ContactFinder(soup, reach), {}});
  std::atomic<std::size_t> seen{0};
  context.executor.forEach(searches.size(), 1, [&](std::size_t piece) {
    context.progress.check();
    auto& [finder, later] = searches[piece];
    std::vector<std::pair<Index, Index>> pairs;
    for (std::size_t i = piece * grain; i < std::min((piece + 1) * grain, count); ++i)
    {
      const bool isInTree = i < tree.size();
      const NumberedBox& box = isInTree ? tree.box(i) : others[i - tree.size()];
      const Index a = box.id;
      if (isInTree)
      {
        finder.look(a);
      }
      std::size_t touching = 0;
      tree.eachTouching(box, isInTree ? i + 1 : 0, [&](std::size_t j) {
        const Index b = tree.box(j).id;
        if (asked.contains(soup, a, b) && !clusters.hold(common(box, tree.box(j))))
        {
          touching += isInTree ? 2 : 1; // seen from both sides
          pairs.emplace_back(std::min(a, b), std::max(a, b));
        }
      });
      checkPairs(seen += touching);
      if (touching > manyEach)
      {
        later.insert(later.end(), pairs.begin(), pairs.end());
      }
      else
      {
        for (const auto& [first, second] : pairs)
        {
          finder.look(first, second);
        }
      }
      pairs.clear();
    }
  });
  context.executor.forEach(searches.size(), 1, [&](std::size_t piece) {
    auto& [finder, later] = searches[piece];
    for (std::size_t i = 0; i < later.size(); ++i)
    {
      if (i % 4096 == 0)
      {
        context.progress.check();
      }
      finder.look(later[i].first, later[i].second);
    }
    later = {};
  });
  return searches;
}

/// Returns the boxes of those triangles that may touch the boxes of a raster.
std::vector<NumberedBox> boxesAt(const BoxRaster& raster, const TriangleSoup& soup, const std::vector<Index>& triangles,
                                 std::int64_t reach, const RunContext& context)
{
  std::vector<Index> near = chosenNumbers(triangles.size(), context.executor, [&](std::size_t i) {
    return raster.mayTouch(boxOf(soup, triangles[i], reach));
  });
  std::ranges::transform(near, near.begin(), [&](Index i) { return triangles[i]; });
  return boxesOf(soup, near, reach, context);
}

bool areLeft(const TriangleSoup& soup, const FoundContacts::Pair& pair, const std::vector<char>& isLeft)
{
  return !isLeft.empty() && isLeft[soup.sources[pair.first]] && isLeft[soup.sources[pair.second]];
}

/// Merges equal points and numbers them by their coordinates: the order in which they were found does not matter.
void numberNewPoints(Contacts& contacts, const std::vector<LatticePoint>& found, Index base)
{
  std::vector<LatticePoint>& points = contacts.newPoints;
  const auto collect = [&](const auto& contact) {
    if (contact.point >= base)
    {
      points.push_back(found[contact.point - base]);
    }
  };
  std::ranges::for_each(contacts.edges, collect);
  std::ranges::for_each(contacts.faces, collect);
  sortUnique(points);
  const auto renumber = [&](auto& contact) {
    if (contact.point >= base)
    {
      const auto at = std::ranges::lower_bound(points, found[contact.point - base]);
      contact.point = base + static_cast<Index>(at - points.begin());
    }
  };
  std::ranges::for_each(contacts.edges, renumber);
  std::ranges::for_each(contacts.faces, renumber);
}

} // namespace

std::vector<char> beginsOfEdges(std::span<const EdgeContact> contacts, std::size_t pointCount)
{
  std::vector<char> begins(pointCount, 0);
  for (const EdgeContact& c : contacts)
  {
    begins[c.edge.first] = 1;
  }
  return begins;
}

Contacts FoundContacts::sorted(const TriangleSoup& soup, const std::vector<char>& isLeft) const
{
  Contacts contacts;
  std::size_t edge = 0;
  std::size_t face = 0;
  for (const Pair& pair : pairs)
  {
    if (areLeft(soup, pair, isLeft))
    {
      add(contacts, edge, pair.edgesBegin, face, pair.facesBegin);
      edge = pair.edgesEnd;
      face = pair.facesEnd;
    }
    else
    {
      contacts.pairs.emplace_back(pair.first, pair.second);
    }
  }
  add(contacts, edge, edges.size(), face, faces.size());
  sort(contacts, static_cast<Index>(soup.points.size()));
  return contacts;
}

std::size_t FoundContacts::countLeft(const TriangleSoup& soup, const std::vector<char>& isLeft) const
{
  Contacts contacts;
  for (const Pair& pair : pairs)
  {
    if (areLeft(soup, pair, isLeft))
    {
      add(contacts, pair.edgesBegin, pair.edgesEnd, pair.facesBegin, pair.facesEnd);
    }
  }
  sort(contacts, static_cast<Index>(soup.points.size()));
  return contacts.edges.size() + contacts.faces.size();
}

void FoundContacts::add(Contacts& to, std::size_t edgesBegin, std::size_t edgesEnd, std::size_t facesBegin,
                        std::size_t facesEnd) const
{
  to.edges.insert(to.edges.end(), edges.begin() + static_cast<std::ptrdiff_t>(edgesBegin),
                  edges.begin() + static_cast<std::ptrdiff_t>(edgesEnd));
  to.faces.insert(to.faces.end(), faces.begin() + static_cast<std::ptrdiff_t>(facesBegin),
                  faces.begin() + static_cast<std::ptrdiff_t>(facesEnd));
}

void FoundContacts::sort(Contacts& contacts, Index base) const
{
  numberNewPoints(contacts, newPoints, base);
  sortUnique(contacts.edges);
  sortUnique(contacts.faces);
  sortUnique(contacts.pairs);
}

void MetSources::add(const TriangleSoup& soup, const std::vector<FoundContacts::Pair>& pairs)
{
  for (const FoundContacts::Pair& pair : pairs)
  {
    const auto [low, high] = std::minmax(soup.sources[pair.first], soup.sources[pair.second]);
    pairs_.emplace_back(low, high);
  }
  sortUnique(pairs_);
  begins_.assign(pairs_.empty() ? 1 : pairs_.back().first + 2, 0);
  for (const auto& [low, high] : pairs_)
  {
    ++begins_[low + 1];
  }
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
}

bool MetSources::contains(Index a, Index b) const
{
  const auto [low, high] = std::minmax(a, b);
  return low + 1 < begins_.size() &&
         std::binary_search(pairs_.begin() + begins_[low], pairs_.begin() + begins_[low + 1], std::pair(low, high));
}

FoundContacts findContacts(const TriangleSoup& soup, const AskedPairs& asked, std::int64_t reach,
                           const ClusterCells& clusters, const RunContext& context)
{
  std::vector<Index> inTree = seenTriangles(soup, clusters, context);
  // Clang 14 cannot compile std::ranges::stable_partition of this library.
  const auto others =
      std::stable_partition(inTree.begin(), inTree.end(), [&](Index t) { return asked.changes[t] != Change::none; });
  const std::vector<Index> rest(others, inTree.end());
  inTree.erase(others, inTree.end());
  std::vector<NumberedBox> treeBoxes = boxesOf(soup, inTree, reach, context);
  if (treeBoxes.empty())
  {
    return {};
  }
  const std::vector<NumberedBox> otherBoxes = boxesAt(BoxRaster(treeBoxes), soup, rest, reach, context);
  const BoxTree tree(std::move(treeBoxes), context);
  ContactFinder finder(soup, static_cast<double>(reach));
  for (const Search& search :
       searchContacts(soup, tree, otherBoxes, asked, static_cast<double>(reach), clusters, context))
  {
    finder.append(search.finder);
  }
  return finder.take();
}

} // namespace atria
