// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/TriangleCuts.h"

#include "Support/Sorting.h"
#include "Surface/Triangulation/FaceTriangulation.h"
#include "Surface/Triangulation/LatticeSegments.h"

#include <Eigen/Geometry>

#include <map>
#include <span>

namespace atria {

namespace {

/// Collects the points and segments on triangles, and cuts the triangles.
class Cutter
{
public:
  Cutter(TriangleSoup& soup_, const Contacts& contacts_, double reach_)
      : soup(soup_), contacts(contacts_), reach(reach_), begins(beginsOfEdges(contacts.edges, soup.points.size())),
        hasInside(soup.triangles.size(), 0)
  {
    sortAlongEdges();
    for (const auto& [a, b] : contacts.pairs)
    {
      joinPair(a, b);
    }
    sortUnique(segments);
    for (const Segment& segment : segments)
    {
      hasInside[segment.triangle] = 1;
    }
    for (const FaceContact& contact : contacts.faces)
    {
      hasInside[contact.triangle] = 1;
    }
  }

  /// Replaces the triangles by those after the cuts. `changes` marks the pieces of triangles that were cut.
  void apply(std::vector<Change>& changes, std::vector<char>& sourceIsSplit, const RunContext& context)
  {
    TriangleSoup next;
    next.points = std::move(soup.points);
    changes.clear();
    const auto add = [&](Index t, const std::array<Index, 3>& triangle, Change change) {
      next.add(triangle, soup.surfaceIds[t], soup.sources[t]);
      changes.push_back(change);
    };
    std::vector<std::array<Index, 3>> pieces;
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      if (t % 1024 == 0)
      {
        context.progress.check();
      }
      if (!isCut(t))
      {
        add(t, soup.triangles[t], Change::none);
        continue;
      }
      DividedFace face = dividedFace(t);
      pieces.clear();
      triangulateFace(next.points, face, reach, pieces);
      sourceIsSplit[soup.sources[t]] = 1;
      for (const auto& piece : pieces)
      {
        add(t, piece, Change::cut);
      }
    }
    soup = std::move(next);
  }

  /// Replaces edges of `edges` that were cut by their pieces, and adds the new ones.
  void updateEdges(std::set<EdgeKey>& edges) const
  {
    std::vector<EdgeKey> cut;
    for (const EdgeContact& contact : alongEdges)
    {
      if ((cut.empty() || cut.back() != contact.edge) && edges.contains(contact.edge))
      {
        cut.push_back(contact.edge);
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
    for (const Segment& segment : segments)
    {
      edges.insert(segment.edge);
    }
  }

private:
  /// A point on a triangle; bit i of `edges` is set if it lies on edge i.
  struct PlacedPoint
  {
    Index point;
    unsigned edges;
  };
  using Placed = std::vector<PlacedPoint>;

  /// A segment that must become an edge of a triangle.
  struct Segment
  {
    Index triangle;
    EdgeKey edge;
    friend auto operator<=>(const Segment&, const Segment&) = default;
  };

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

  std::span<const Segment> segmentsOf(Index triangle) const
  {
    // Clang 14 cannot compile std::ranges::equal_range of this library.
    return {std::ranges::lower_bound(segments, triangle, {}, &Segment::triangle),
            std::ranges::upper_bound(segments, triangle, {}, &Segment::triangle)};
  }

  /// True if there is a point or a segment on a triangle.
  bool isCut(Index t) const
  {
    const auto& corners = soup.triangles[t];
    const auto hasPoints = [&](int i) {
      const EdgeKey edge = edgeKey(corners, i);
      return begins[edge.first] && !pointsOn(edge).empty();
    };
    return hasPoints(0) || hasPoints(1) || hasPoints(2) || hasInside[t];
  }

  /// Returns all points of a triangle, by index.
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

  /// Makes the segments that two triangles have in common edges of both.
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
        segments.push_back({a, segment});
      }
      if ((row[i].onB & row[i + 1].onB) == 0)
      {
        segments.push_back({b, segment});
      }
    }
  }

  /// Sorts points along the line through the first and the one farthest from it. Returns false if they are not on it.
  bool sortOnLine(std::vector<CommonPoint>& row) const
  {
    const auto at = [&](const CommonPoint& p) { return between(soup.points[row[0].point], soup.points[p.point]); };
    Vec3 along = Vec3::Zero();
    for (const CommonPoint& p : row)
    {
      along = at(p).squaredNorm() > along.squaredNorm() ? at(p) : along;
    }
    const double length = along.norm();
    // Points on edges and faces are within the reach of them, and welding may have moved them.
    const double width = static_cast<double>(2 + 2 * weldReaches) * reach;
    const bool straight = std::all_of(
        row.begin(), row.end(), [&](const CommonPoint& p) { return at(p).cross(along).norm() <= width * length; });
    std::vector<std::pair<double, CommonPoint>> keyed;
    keyed.reserve(row.size());
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
    std::ranges::transform(segmentsOf(t), std::back_inserter(face.segments), &Segment::edge);
    return face;
  }

  TriangleSoup& soup;
  const Contacts& contacts;
  double reach;
  std::vector<EdgeContact> alongEdges;
  std::vector<char> begins;
  /// One flag per triangle: nonzero if there are points or segments off its edges.
  std::vector<char> hasInside;
  std::vector<Segment> segments;
  std::map<Index, Placed> placed;
};

} // namespace

void cutTriangles(TriangleSoup& soup, const Contacts& contacts, double reach, std::vector<Change>& changes,
                  std::vector<char>& sourceIsSplit, std::set<EdgeKey>& meetings, const RunContext& context)
{
  Cutter cutter(soup, contacts, reach);
  cutter.updateEdges(meetings);
  cutter.apply(changes, sourceIsSplit, context);
}

} // namespace atria
