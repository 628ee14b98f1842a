// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Autorefine.h"

#include "Surface/Contacts.h"
#include "Surface/Crowds.h"
#include "Surface/FaceTriangulation.h"
#include "Surface/LatticeSegments.h"
#include "Surface/Predicates.h"
#include "Surface/Weld.h"

#include <Eigen/Geometry>

#include <map>
#include <set>
#include <span>

namespace atria {

namespace {

/// What a round puts on the triangles.
class Round
{
public:
  Round(TriangleSoup& soup_, const Contacts& contacts_, double reach_)
      : soup(soup_), contacts(contacts_), reach(reach_), segments(soup.triangles.size())
  {
    sortAlongEdges();
    for (const auto& [a, b] : contacts.pairs)
    {
      joinPair(a, b);
    }
  }

  /// The triangles after the round; `changed` marks the pieces of those that were cut.
  void apply(std::vector<char>& changed, std::vector<char>& sourceIsSplit, const RunContext& context)
  {
    TriangleSoup next;
    next.points = std::move(soup.points);
    changed.clear();
    std::vector<std::array<Index, 3>> pieces;
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      if (t % 1024 == 0)
      {
        context.progress.check();
      }
      DividedFace face = dividedFace(t);
      const bool whole = face.inside.empty() && face.segments.empty() && face.alongEdges[0].empty() &&
                         face.alongEdges[1].empty() && face.alongEdges[2].empty();
      pieces.assign(1, face.corners);
      if (!whole)
      {
        pieces.clear();
        triangulateFace(next.points, face, reach, pieces);
        sourceIsSplit[soup.sources[t]] = 1;
      }
      for (const auto& piece : pieces)
      {
        next.add(piece, soup.surfaceIds[t], soup.sources[t]);
        changed.push_back(whole ? 0 : 1);
      }
    }
    soup = std::move(next);
  }

  /// Replaces edges of `edges` that were cut by their pieces, and adds the new ones.
  void updateEdges(std::set<EdgeKey>& edges) const
  {
    std::vector<EdgeKey> cut;
    for (const EdgeKey& edge : edges)
    {
      if (!pointsOn(edge).empty())
      {
        cut.push_back(edge);
      }
    }
    for (const EdgeKey& edge : cut)
    {
      edges.erase(edge);
      Index from = edge.first;
      for (const EdgeContact& contact : pointsOn(edge))
      {
        edges.insert(edgeKey(from, contact.point));
        from = contact.point;
      }
      edges.insert(edgeKey(from, edge.second));
    }
    for (const auto& list : segments)
    {
      edges.insert(list.begin(), list.end());
    }
  }

private:
  /// A point on a triangle; bit i of `edges` where it lies on its edge i.
  struct PlacedPoint
  {
    Index point;
    unsigned edges;
  };
  using Placed = std::vector<PlacedPoint>;

  double along(const EdgeKey& edge, Index p) const
  {
    return between(soup.points[edge.first], soup.points[edge.second])
        .dot(between(soup.points[edge.first], soup.points[p]));
  }

  void sortAlongEdges()
  {
    alongEdges = contacts.edges;
    std::stable_sort(alongEdges.begin(), alongEdges.end(), [&](const EdgeContact& l, const EdgeContact& r) {
      return l.edge != r.edge ? l.edge < r.edge : along(l.edge, l.point) < along(r.edge, r.point);
    });
  }

  std::span<const EdgeContact> pointsOn(const EdgeKey& edge) const
  {
    const auto range = std::equal_range(alongEdges.begin(), alongEdges.end(), EdgeContact{edge, 0},
                                        [](const EdgeContact& l, const EdgeContact& r) { return l.edge < r.edge; });
    return {range.first, range.second};
  }

  std::span<const FaceContact> pointsIn(Index triangle) const
  {
    const auto range =
        std::equal_range(contacts.faces.begin(), contacts.faces.end(), FaceContact{triangle, 0},
                         [](const FaceContact& l, const FaceContact& r) { return l.triangle < r.triangle; });
    return {range.first, range.second};
  }

  /// All points of a triangle, by index.
  const Placed& placedOn(Index t)
  {
    const auto [known, isNew] = placed.try_emplace(t);
    Placed& list = known->second;
    if (!isNew)
    {
      return list;
    }
    const auto& corners = soup.triangles[t];
    for (unsigned i = 0; i < 3; ++i)
    {
      list.push_back({corners[i], 1u << i | 1u << (i + 2) % 3});
      for (const EdgeContact& contact : pointsOn(edgeKey(corners, static_cast<int>(i))))
      {
        list.push_back({contact.point, 1u << i});
      }
    }
    for (const FaceContact& contact : pointsIn(t))
    {
      list.push_back({contact.point, 0});
    }
    std::sort(list.begin(), list.end(), [](const PlacedPoint& l, const PlacedPoint& r) { return l.point < r.point; });
    std::size_t size = 0;
    for (const PlacedPoint& p : list)
    {
      if (size > 0 && list[size - 1].point == p.point)
      {
        list[size - 1].edges |= p.edges;
      }
      else
      {
        list[size++] = p;
      }
    }
    list.resize(size);
    return list;
  }

  struct CommonPoint
  {
    Index point;
    unsigned onA;
    unsigned onB;
  };

  std::vector<CommonPoint> commonPoints(Index a, Index b)
  {
    placedOn(a);
    placedOn(b);
    const Placed& first = placed.at(a);
    const Placed& second = placed.at(b);
    const bool swapped = first.size() > second.size();
    const Placed& small = swapped ? second : first;
    const Placed& large = swapped ? first : second;
    std::vector<CommonPoint> common;
    for (const PlacedPoint& p : small)
    {
      const auto at = std::lower_bound(large.begin(), large.end(), p,
                                       [](const PlacedPoint& l, const PlacedPoint& r) { return l.point < r.point; });
      if (at != large.end() && at->point == p.point)
      {
        common.push_back({p.point, swapped ? at->edges : p.edges, swapped ? p.edges : at->edges});
      }
    }
    return common;
  }

  /// The segments that two triangles have in common become edges of both.
  void joinPair(Index a, Index b)
  {
    std::vector<CommonPoint> common = commonPoints(a, b);
    if (common.size() < 2)
    {
      return;
    }
    if (sortOnLine(common))
    {
      joinRow(common, a, b);
      return;
    }
    for (unsigned edge = 1; edge < 8; edge <<= 1)
    {
      joinAlong(common, a, b, [&](const CommonPoint& p) { return (p.onA & edge) != 0; });
      joinAlong(common, a, b, [&](const CommonPoint& p) { return (p.onB & edge) != 0; });
    }
  }

  template <typename Predicate>
  void joinAlong(const std::vector<CommonPoint>& common, Index a, Index b, const Predicate& lies)
  {
    std::vector<CommonPoint> row;
    std::copy_if(common.begin(), common.end(), std::back_inserter(row), lies);
    if (row.size() > 1)
    {
      sortOnLine(row);
      joinRow(row, a, b);
    }
  }

  void joinRow(const std::vector<CommonPoint>& row, Index a, Index b)
  {
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
    {
      const EdgeKey segment = edgeKey(row[i].point, row[i + 1].point);
      if ((row[i].onA & row[i + 1].onA) == 0) // else it is a piece of the outline
      {
        segments[a].push_back(segment);
      }
      if ((row[i].onB & row[i + 1].onB) == 0)
      {
        segments[b].push_back(segment);
      }
    }
  }

  /// Sorts points along the line through the first and the one farthest from it; false where they are not on it.
  bool sortOnLine(std::vector<CommonPoint>& row) const
  {
    const auto at = [&](const CommonPoint& p) { return between(soup.points[row[0].point], soup.points[p.point]); };
    Vec3 along = Vec3::Zero();
    for (const CommonPoint& p : row)
    {
      along = at(p).squaredNorm() > along.squaredNorm() ? at(p) : along;
    }
    const double length = along.norm();
    // Points on edges and faces are within the reach of them, and moved by welding.
    const double width = static_cast<double>(2 + 2 * weldReaches) * reach;
    const bool straight = std::all_of(
        row.begin(), row.end(), [&](const CommonPoint& p) { return at(p).cross(along).norm() <= width * length; });
    std::vector<std::pair<double, CommonPoint>> keyed;
    for (const CommonPoint& p : row)
    {
      keyed.emplace_back(at(p).dot(along), p);
    }
    std::stable_sort(keyed.begin(), keyed.end(), [](const auto& l, const auto& r) { return l.first < r.first; });
    std::transform(keyed.begin(), keyed.end(), row.begin(), [](const auto& p) { return p.second; });
    return straight;
  }

  DividedFace dividedFace(Index t)
  {
    DividedFace face;
    face.corners = soup.triangles[t];
    for (int i = 0; i < 3; ++i)
    {
      for (const EdgeContact& contact : pointsOn(edgeKey(face.corners, i)))
      {
        face.alongEdges[i].push_back(contact.point);
      }
      if (face.corners[i] > face.corners[(i + 1) % 3])
      {
        std::reverse(face.alongEdges[i].begin(), face.alongEdges[i].end());
      }
    }
    for (const FaceContact& contact : pointsIn(t))
    {
      face.inside.push_back(contact.point);
    }
    face.segments = std::move(segments[t]);
    std::sort(face.segments.begin(), face.segments.end());
    face.segments.erase(std::unique(face.segments.begin(), face.segments.end()), face.segments.end());
    return face;
  }

  TriangleSoup& soup;
  const Contacts& contacts;
  double reach;
  std::vector<EdgeContact> alongEdges;
  std::vector<std::vector<EdgeKey>> segments;
  std::map<Index, Placed> placed;
};

/// Keeps the triangles that `keep` accepts, and what goes with them.
template <typename Predicate> void filter(TriangleSoup& soup, std::vector<char>* changed, const Predicate& keep)
{
  std::size_t size = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
  {
    if (keep(soup.triangles[t]))
    {
      soup.triangles[size] = soup.triangles[t];
      soup.surfaceIds[size] = soup.surfaceIds[t];
      soup.sources[size] = soup.sources[t];
      if (changed)
      {
        (*changed)[size] = (*changed)[t];
      }
      ++size;
    }
  }
  soup.triangles.resize(size);
  soup.surfaceIds.resize(size);
  soup.sources.resize(size);
  if (changed)
  {
    changed->resize(size);
  }
}

std::size_t dropRepeated(TriangleSoup& soup, std::vector<char>* changed)
{
  filter(soup, changed, [](const auto& t) { return !hasRepeatedPoint(t); });
  const std::size_t before = soup.triangles.size();
  std::vector<std::pair<std::array<Index, 3>, Index>> sorted(before);
  for (Index t = 0; t < before; ++t)
  {
    sorted[t] = {soup.triangles[t], t};
    std::sort(sorted[t].first.begin(), sorted[t].first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<char> repeated(before, 0);
  for (std::size_t i = 1; i < before; ++i)
  {
    repeated[sorted[i].second] = sorted[i].first == sorted[i - 1].first ? 1 : 0;
  }
  filter(soup, changed, [&](const auto& t) { return !repeated[&t - soup.triangles.data()]; });
  return before - soup.triangles.size();
}

/// Points closer than the distance become one. Returns for each point what it became.
std::vector<Index> mergePoints(TriangleSoup& soup, std::int64_t distance, std::vector<char>& changed)
{
  std::vector<Index> became = weldPoints(soup.points, distance);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
  {
    for (Index& p : soup.triangles[t])
    {
      changed[t] = became[p] != p ? 1 : changed[t];
      p = became[p];
    }
  }
  return became;
}

void renumber(std::set<EdgeKey>& edges, const std::vector<Index>& became)
{
  std::set<EdgeKey> next;
  for (const auto& [a, b] : edges)
  {
    if (became[a] != became[b])
    {
      next.insert(edgeKey(became[a], became[b]));
    }
  }
  edges = std::move(next);
}

/// Appends the new points, except those that fall together with one there is; contacts that say nothing new then are
/// dropped.
void addNewPoints(TriangleSoup& soup, Contacts& contacts, std::int64_t distance)
{
  soup.points.insert(soup.points.end(), contacts.newPoints.begin(), contacts.newPoints.end());
  const std::vector<Index> became = weldPoints(soup.points, distance);
  for (EdgeContact& c : contacts.edges)
  {
    c.point = became[c.point];
  }
  for (FaceContact& c : contacts.faces)
  {
    c.point = became[c.point];
  }
  std::erase_if(contacts.edges,
                [](const EdgeContact& c) { return c.point == c.edge.first || c.point == c.edge.second; });
  std::sort(contacts.edges.begin(), contacts.edges.end());
  contacts.edges.erase(std::unique(contacts.edges.begin(), contacts.edges.end()), contacts.edges.end());
  std::erase_if(contacts.faces, [&](const FaceContact& c) {
    const auto& corners = soup.triangles[c.triangle];
    const auto onEdge = [&](int i) {
      return std::binary_search(contacts.edges.begin(), contacts.edges.end(),
                                EdgeContact{edgeKey(corners, i), c.point});
    };
    return contains(corners, c.point) || onEdge(0) || onEdge(1) || onEdge(2);
  });
  std::sort(contacts.faces.begin(), contacts.faces.end());
  contacts.faces.erase(std::unique(contacts.faces.begin(), contacts.faces.end()), contacts.faces.end());
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

/// Rounds in a row that may find more than the one before. The first does; where a second does too, many triangles lie
/// closer together than the reach can tell apart, and cutting them only makes more of them.
constexpr int patience = 1;
/// Where rounds do not end, the reach is made this many times as wide, and they begin anew.
constexpr std::int64_t widening = 64;

/// One after the other, until nothing is found or ever more. What then is left is in the report.
void runRounds(TriangleSoup& soup, std::vector<char> changed, const AutorefineOptions& options,
               AutorefineReport& report, const RunContext& context)
{
  const std::int64_t weldDistance = weldReaches * options.reach;
  std::size_t foundBefore = 0;
  int growing = 0;
  for (int round = 0;; ++round)
  {
    const std::size_t usedBefore = round == 0 ? countUsed(soup) : 0;
    const std::vector<Index> became = mergePoints(soup, weldDistance, changed);
    if (round == 0)
    {
      report.mergedPoints += usedBefore - countUsed(soup);
      report.degenerateTriangles += static_cast<std::size_t>(std::count_if(
          soup.triangles.begin(), soup.triangles.end(), [](const auto& t) { return hasRepeatedPoint(t); }));
    }
    renumber(report.meetings, became);
    report.overlappingTriangles += dropRepeated(soup, &changed);
    Contacts contacts = findContacts(soup, changed, options.reach, context);
    const std::size_t found = contacts.edges.size() + contacts.faces.size();
    growing = found > foundBefore ? growing + 1 : 0;
    foundBefore = found;
    if (found == 0 || round == options.maximumRounds || growing > patience)
    {
      report.unresolvedContacts = found;
      return;
    }
    refuseTangles(soup.triangles.size(), contacts.pairs);
    addNewPoints(soup, contacts, weldDistance);
    Round work(soup, contacts, static_cast<double>(options.reach));
    work.updateEdges(report.meetings);
    work.apply(changed, report.isSplit, context);
  }
}

} // namespace

std::size_t dropRepeated(TriangleSoup& soup) { return dropRepeated(soup, nullptr); }

AutorefineReport autorefine(TriangleSoup& soup, const AutorefineOptions& options, const RunContext& context)
{
  AutorefineReport report;
  report.isSplit.resize(soup.sources.empty() ? 0 : soup.sources.back() + 1, 0);
  refineAgain(soup, options, std::vector<char>(soup.triangles.size(), 1), report, context);
  return report;
}

void refineAgain(TriangleSoup& soup, const AutorefineOptions& options, std::vector<char> changed,
                 AutorefineReport& report, const RunContext& context)
{
  const TriangleSoup soupBefore = soup;
  const AutorefineReport reportBefore = report;
  AutorefineOptions wider = options;
  wider.reach = std::max(options.reach, report.reach);
  runRounds(soup, std::move(changed), wider, report, context);
  while (report.unresolvedContacts > 0 && wider.reach < options.largestReach)
  {
    wider.reach = std::min(wider.reach * widening, options.largestReach);
    soup = soupBefore;
    report = reportBefore;
    runRounds(soup, std::vector<char>(soup.triangles.size(), 1), wider, report, context);
  }
  report.reach = wider.reach;
  const std::size_t before = soup.triangles.size();
  filter(soup, nullptr, [&](const auto& t) { return hasArea(soup, t); });
  report.degenerateTriangles += before - soup.triangles.size();
  report.splitTriangles = static_cast<std::size_t>(std::count(report.isSplit.begin(), report.isSplit.end(), 1));
  report.intersectionEdges = countEdges(soup, report.meetings);
}

} // namespace atria
