// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/Autorefine.h"

#include "Grid/Predicates.h"
#include "Support/Buckets.h"
#include "Support/Sorting.h"
#include "Surface/Repair/Clusters.h"
#include "Surface/Repair/Contacts.h"
#include "Surface/Repair/Overlaps.h"
#include "Surface/Repair/Slivers.h"
#include "Surface/Repair/TriangleCuts.h"
#include "Surface/Triangles/Weld.h"
#include "Surface/Triangulation/LatticeSegments.h"

#include <limits>
#include <numeric>

namespace atria {

namespace {

/// Keeps the triangles that `keep` accepts, and their entries in all lists.
template <typename Predicate> void filter(TriangleSoup& soup, std::vector<Change>* changes, const Predicate& keep)
{
  std::size_t size = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
  {
    if (keep(soup.triangles[t]))
    {
      soup.triangles[size] = soup.triangles[t];
      soup.surfaceIds[size] = soup.surfaceIds[t];
      soup.sources[size] = soup.sources[t];
      if (changes)
      {
        (*changes)[size] = (*changes)[t];
      }
      ++size;
    }
  }
  soup.triangles.resize(size);
  soup.surfaceIds.resize(size);
  soup.sources.resize(size);
  if (changes)
  {
    changes->resize(size);
  }
}

/// Marks all but one of the triangles with the same corners; `sorted` has the sorted corners of each.
void markRepeated(const TriangleSoup& soup, std::span<const std::pair<std::array<Index, 3>, Index>> sorted,
                  Overlaps* overlaps, std::vector<char>& repeated)
{
  std::vector<Index> equal;
  for (std::size_t i = 0, next = 0; i < sorted.size(); i = next)
  {
    equal.clear();
    for (next = i; next < sorted.size() && sorted[next].first == sorted[i].first; ++next)
    {
      equal.push_back(sorted[next].second);
    }
    const std::size_t kept = equal.size() > 1 && overlaps ? overlaps->settle(soup, equal) : 0;
    for (std::size_t k = 0; k < equal.size(); ++k)
    {
      repeated[equal[k]] = k != kept ? 1 : 0;
    }
  }
}

/// Returns the number of dropped triangles. If changes are known, only changed triangles can repeat others.
std::size_t dropRepeated(TriangleSoup& soup, std::vector<Change>* changes, Overlaps* overlaps)
{
  filter(soup, changes, [](const auto& t) { return !hasRepeatedPoint(t); });
  const std::size_t before = soup.triangles.size();
  std::vector<char> isAsked(soup.points.size(), changes ? 0 : 1);
  for (Index t = 0; changes && t < before; ++t)
  {
    isAsked[std::ranges::min(soup.triangles[t])] |= (*changes)[t] != Change::none ? 1 : 0;
  }
  const Buckets byLeast = fillBuckets(soup.points.size(), SerialExecutor(), [&](auto&& use) {
    for (Index t = 0; t < before; ++t)
    {
      if (const Index least = std::ranges::min(soup.triangles[t]); isAsked[least])
      {
        use(least, t);
      }
    }
  });
  std::vector<char> repeated(before, 0);
  std::vector<std::pair<std::array<Index, 3>, Index>> sorted;
  for (std::size_t p = 0; p < soup.points.size(); ++p)
  {
    if (byLeast.of(p).size() < 2)
    {
      continue;
    }
    sorted.clear();
    for (const Index t : byLeast.of(p))
    {
      sorted.emplace_back(soup.triangles[t], t);
      std::ranges::sort(sorted.back().first);
    }
    std::ranges::sort(sorted);
    markRepeated(soup, sorted, overlaps, repeated);
  }
  filter(soup, changes, [&](const auto& t) { return !repeated[&t - soup.triangles.data()]; });
  return before - soup.triangles.size();
}

/// Replaces every point as the list says. Triangles with a replaced point count as moved.
void replacePoints(TriangleSoup& soup, const std::vector<Index>& became, std::vector<Change>& changes)
{
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
  {
    for (Index& p : soup.triangles[t])
    {
      changes[t] = became[p] != p ? Change::moved : changes[t];
      p = became[p];
    }
  }
}

/// Returns, for each point, the point that replaces it if those of the given points that are closer than the distance
/// are merged.
std::vector<Index> weldSome(const TriangleSoup& soup, std::vector<Index> some, std::int64_t distance)
{
  sortUnique(some);
  std::vector<LatticePoint> places;
  places.reserve(some.size());
  for (const Index p : some)
  {
    places.push_back(soup.points[p]);
  }
  const std::vector<Index> first = weldPoints(places, distance);
  std::vector<Index> became(soup.points.size());
  std::iota(became.begin(), became.end(), Index{0});
  for (std::size_t i = 0; i < some.size(); ++i)
  {
    became[some[i]] = some[first[i]];
  }
  return became;
}

void renumber(std::set<EdgeKey>& edges, const std::vector<Index>& became)
{
  std::vector<EdgeKey> moved;
  std::erase_if(edges, [&](const EdgeKey& edge) {
    const bool isMoved = became[edge.first] != edge.first || became[edge.second] != edge.second;
    if (isMoved && became[edge.first] != became[edge.second])
    {
      moved.push_back(edgeKey(became[edge.first], became[edge.second]));
    }
    return isMoved;
  });
  edges.insert(moved.begin(), moved.end());
}

/// Appends the new points, except those that merge with an existing one. Contacts that say nothing new then are
/// dropped.
void addNewPoints(TriangleSoup& soup, Contacts& contacts, PointWelder& welder)
{
  const std::size_t base = soup.points.size();
  soup.points.insert(soup.points.end(), contacts.newPoints.begin(), contacts.newPoints.end());
  const std::vector<Index> became = welder.addRest();
  const auto replace = [&](auto& contact) {
    contact.point = contact.point < base ? contact.point : became[contact.point - base];
  };
  std::ranges::for_each(contacts.edges, replace);
  std::ranges::for_each(contacts.faces, replace);
  std::erase_if(contacts.edges,
                [](const EdgeContact& c) { return c.point == c.edge.first || c.point == c.edge.second; });
  sortUnique(contacts.edges);
  std::erase_if(contacts.faces, [&](const FaceContact& c) {
    const auto& corners = soup.triangles[c.triangle];
    const auto onEdge = [&](int i) {
      return std::binary_search(contacts.edges.begin(), contacts.edges.end(),
                                EdgeContact{edgeKey(corners, i), c.point});
    };
    return contains(corners, c.point) || onEdge(0) || onEdge(1) || onEdge(2);
  });
  sortUnique(contacts.faces);
}

bool hasArea(const TriangleSoup& soup, const std::array<Index, 3>& t)
{
  const LatticeNormal normal(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
  return normal.n[0] != 0 || normal.n[1] != 0 || normal.n[2] != 0;
}

std::size_t countUsed(const TriangleSoup& soup)
{
  std::vector<char> used(soup.points.size(), 0);
  for (const auto& t : soup.triangles)
  {
    used[t[0]] = used[t[1]] = used[t[2]] = 1;
  }
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
}

std::size_t countEdges(const TriangleSoup& soup, const std::set<EdgeKey>& edges)
{
  std::set<EdgeKey> found;
  for (std::size_t t = 0; t < soup.triangles.size() && !edges.empty(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const EdgeKey edge = edgeKey(soup.triangles[t], i);
      if (edges.count(edge) != 0)
      {
        found.insert(edge);
      }
    }
  }
  return found.size();
}

/// Returns all points that contacts name.
std::vector<Index> pointsOf(const TriangleSoup& soup, const Contacts& contacts)
{
  std::vector<Index> points;
  for (const EdgeContact& c : contacts.edges)
  {
    points.insert(points.end(), {c.point, c.edge.first, c.edge.second});
  }
  for (const FaceContact& c : contacts.faces)
  {
    points.push_back(c.point);
    points.insert(points.end(), soup.triangles[c.triangle].begin(), soup.triangles[c.triangle].end());
  }
  return points;
}

/// Factor by which the distance grows within which points at contacts are merged, from the second round on. Contacts
/// that rounding makes anew in every round lie a few lattice units apart, and those left after three rounds are folded.
constexpr std::int64_t loosening = 16;
/// Growth of a triangle's contacts in two rounds from which on it is left, while that distance still grows: further
/// rounds do not mend it. With a larger factor, places where all triangles touch all others take as long as the whole
/// rest.
constexpr std::int64_t hopelessGrowth = 4;

/// Cuts in rounds until no contacts are found but those of triangles that are left.
class Rounds
{
public:
  Rounds(TriangleSoup& soup_, const AutorefineOptions& options_, ClusterCells& clusters_, AutorefineReport& report_,
         const RunContext& context_)
      : soup(soup_), options(options_), clusters(clusters_), width(weldReaches * options.reach),
        welder(soup.points, width), report(report_), context(context_)
  {
  }

  void run(std::vector<Change> changes)
  {
    std::size_t foundBefore = std::numeric_limits<std::size_t>::max();
    for (int round = 0;; ++round)
    {
      tidy(changes, round == 0);
      const bool isLast = round == options.maximumRounds;
      Contacts contacts = isLast ? find(changes).sorted(soup) : findHopeful(changes);
      const std::size_t found = contacts.edges.size() + contacts.faces.size();
      // Slivers with a corner on their own edge may stay slivers.
      if (isLast || found == 0 || (contacts.pairs.empty() && found >= foundBefore))
      {
        report.unresolvedContacts = found;
        return;
      }
      foundBefore = found;
      addNewPoints(soup, contacts, welder);
      if (round > 0)
      {
        width = std::max(width, std::min(loosening * width, options.widestWeld));
        knots = pointsOf(soup, contacts);
      }
      alignSlivers(soup, contacts.edges);
      cutTriangles(soup, contacts, static_cast<double>(options.reach), changes, report.isSplit, report.meetings,
                   context);
    }
  }

private:
  FoundContacts find(const std::vector<Change>& changes) const
  {
    return searchSeen(soup, options.reach, clusters, context, [&] {
      return findContacts(soup, {changes, met, report.isLeft}, options.reach, clusters, context);
    });
  }

  /// Returns the contacts after hopeless triangles were left and tangled ones hidden.
  Contacts findHopeful(const std::vector<Change>& changes)
  {
    const FoundContacts found = find(changes);
    met.add(soup, found.pairs);
    leaveHopeless(found.pairs);
    report.leftContacts += found.countLeft(soup, report.isLeft);
    Contacts contacts = found.sorted(soup, report.isLeft);
    return hideTangles(soup, contacts.pairs, clusters) ? find(changes).sorted(soup) : contacts;
  }

  /// Leaves triangles whose contacts grew much in two rounds, or did not become fewer after the merging distance
  /// stopped growing.
  void leaveHopeless(const std::vector<FoundContacts::Pair>& pairs)
  {
    std::vector<Index> counts(report.isLeft.size(), 0);
    for (const FoundContacts::Pair& pair : pairs)
    {
      ++counts[soup.sources[pair.first]];
      ++counts[soup.sources[pair.second]];
    }
    const std::int64_t growth = width < options.widestWeld ? hopelessGrowth : 1;
    for (std::size_t s = 0; s < countsBefore[0].size(); ++s)
    {
      const Index before = countsBefore[0][s];
      report.isLeft[s] |= before > 0 && counts[s] >= growth * before ? 1 : 0;
    }
    countsBefore = {std::move(countsBefore[1]), std::move(counts)};
  }

  /// Merges points close to each other, and drops triangles that vanished or are repeated.
  void tidy(std::vector<Change>& changes, bool isFirst)
  {
    const std::size_t usedBefore = isFirst ? countUsed(soup) : 0;
    if (const std::vector<Index> became = weldRest(); !became.empty())
    {
      merge(became, changes);
    }
    if (isFirst)
    {
      report.mergedPoints += usedBefore - countUsed(soup);
      report.degenerateTriangles += static_cast<std::size_t>(std::count_if(
          soup.triangles.begin(), soup.triangles.end(), [](const auto& t) { return hasRepeatedPoint(t); }));
    }
    if (!knots.empty())
    {
      merge(weldSome(soup, std::move(knots), width), changes);
      knots.clear();
    }
    report.overlappingTriangles += dropRepeated(soup, &changes, options.overlaps);
  }

  /// Returns, for each point, the point that replaces it; empty if no point was added since the last call.
  std::vector<Index> weldRest()
  {
    const std::vector<Index> rest = welder.addRest();
    std::vector<Index> became;
    if (!rest.empty())
    {
      became.resize(soup.points.size() - rest.size());
      std::iota(became.begin(), became.end(), Index{0});
      became.insert(became.end(), rest.begin(), rest.end());
    }
    return became;
  }

  void merge(const std::vector<Index>& became, std::vector<Change>& changes)
  {
    replacePoints(soup, became, changes);
    renumber(report.meetings, became);
    std::transform(knots.begin(), knots.end(), knots.begin(), [&](Index p) { return became[p]; });
  }

  TriangleSoup& soup;
  const AutorefineOptions& options;
  ClusterCells& clusters;
  /// Distance within which points at contacts that cuts do not remove are merged.
  std::int64_t width;
  /// Merges points within `width` as it was at first.
  PointWelder welder;
  std::vector<Index> knots;
  MetSources met; ///< pairs of sources that met in all rounds so far
  /// One list for each of the two rounds before, with one entry per source: the pairs of touching triangles that its
  /// pieces are in.
  std::array<std::vector<Index>, 2> countsBefore;
  AutorefineReport& report;
  const RunContext& context;
};

} // namespace

std::size_t dropRepeated(TriangleSoup& soup, Overlaps* overlaps) { return dropRepeated(soup, nullptr, overlaps); }

AutorefineReport autorefine(TriangleSoup& soup, const AutorefineOptions& options, ClusterCells& clusters,
                            const RunContext& context, std::span<const char> isLone)
{
  AutorefineReport report;
  report.isSplit.resize(soup.sources.empty() ? 0 : soup.sources.back() + 1, 0);
  report.isLeft.resize(report.isSplit.size(), 0);
  std::vector<Change> asked(soup.triangles.size(), Change::moved);
  std::ranges::transform(isLone, asked.begin(), [](char lone) { return lone ? Change::none : Change::moved; });
  refineAgain(soup, options, clusters, std::move(asked), report, context);
  return report;
}

void refineAgain(TriangleSoup& soup, const AutorefineOptions& options, ClusterCells& clusters,
                 std::vector<Change> changes, AutorefineReport& report, const RunContext& context)
{
  Rounds(soup, options, clusters, report, context).run(std::move(changes));
  const std::size_t before = soup.triangles.size();
  filter(soup, nullptr, [&](const auto& t) { return hasArea(soup, t); });
  report.degenerateTriangles += before - soup.triangles.size();
  report.splitTriangles = static_cast<std::size_t>(std::count(report.isSplit.begin(), report.isSplit.end(), 1));
  report.intersectionEdges = countEdges(soup, report.meetings);
}

} // namespace atria
