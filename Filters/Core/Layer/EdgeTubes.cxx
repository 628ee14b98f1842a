// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/EdgeTubes.h"

#include "Layer/PrismAxes.h"
#include "Support/Numbering.h"
#include "Support/Pieces.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <numeric>
#include <utility>

namespace atria {

namespace {

/// An edge by its points, lower first.
using Edge = std::array<Index, 2>;

Edge edgeOf(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

struct SheetEdges
{
  /// Boundary edges of sheets, and the other edges of boundary faces at their points; sorted.
  std::vector<Edge> atBoundary;
  std::vector<Edge> inside;
  /// One entry per point of the mesh: 1 if it is on a boundary edge.
  std::vector<char> points;
};

SheetEdges findSheetEdges(const DualMesh& mesh, const RunContext& context)
{
  const BoundaryGraph graph = findBoundaryGraph(mesh, context);
  const auto forEdges = [&](auto&& use) {
    for (Index f = 0; f < mesh.boundaryFaces.size(); ++f)
    {
      const Index behind = faceBehind(mesh, mesh.boundaryFaces[f]);
      for (int i = 0; i < 4; ++i)
      {
        const Index code = graph.across[f][i];
        const bool isAtBoundary =
            behind != noIndex && BoundaryGraph::isEdge(code) && BoundaryGraph::faceOf(code) == behind;
        use(isAtBoundary, cornerOf(mesh, mesh.boundaryFaces[f], i), cornerOf(mesh, mesh.boundaryFaces[f], i + 1));
      }
    }
  };
  SheetEdges out;
  out.points.assign(mesh.points.size(), 0);
  forEdges([&](bool isAtBoundary, Index a, Index b) {
    out.points[a] |= isAtBoundary ? 1 : 0;
    out.points[b] |= isAtBoundary ? 1 : 0;
  });
  forEdges([&](bool isAtBoundary, Index a, Index b) {
    if (out.points[a] || out.points[b])
    {
      (isAtBoundary ? out.atBoundary : out.inside).push_back(edgeOf(a, b));
    }
  });
  std::ranges::sort(out.atBoundary);
  std::ranges::sort(out.inside);
  return out;
}

/// True if an element lies in front of a boundary edge: it has one but no wall along it, or a point of one but no other
/// edge of a wall anywhere.
bool isInTube(const DualMesh& mesh, const SheetEdges& sheets, const std::vector<char>& onBoundary, Index e)
{
  const auto isAmong = [](const std::vector<Edge>& edges, Edge edge) {
    return std::ranges::binary_search(edges, edge);
  };
  std::array<int, 8> state{}; // bits of a corner: 1 on a boundary edge, 2 with another edge of a wall
  bool hasEdge = false;
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto& face = hexahedronFace[direction];
    for (int i = 0; i < 4; ++i)
    {
      const std::uint8_t c = face[i];
      const std::uint8_t d = face[(i + 1) & 3];
      const Edge edge = edgeOf(mesh.corners[e][c], mesh.corners[e][d]);
      const bool isBare = !DualMesh::isBoundary(mesh.neighbors[e][direction]) &&
                          !DualMesh::isBoundary(mesh.neighbors[e][besideEdge(direction, i)]);
      hasEdge = hasEdge || (isBare && isAmong(sheets.atBoundary, edge));
      const int other = isAmong(sheets.inside, edge) || !isBare ? 2 : 0;
      state[c] |= (sheets.points[mesh.corners[e][c]] ? 1 : 0) | other;
      state[d] |= (sheets.points[mesh.corners[e][d]] ? 1 : 0) | other;
    }
  }
  bool isOff = true; // walls, but for boundary edges
  for (std::size_t c = 0; c < 8; ++c)
  {
    isOff = isOff && (!onBoundary[mesh.corners[e][c]] || state[c] == 1);
  }
  return hasEdge || (isOff && std::ranges::find(state, 1) != state.end());
}

/// Adds elements to tubes until the walls around each sector of the rest are one fan, as layers need it. Tubes that
/// meet a wall or each other in an edge or a point only would leave two.
class TubeCloser
{
public:
  TubeCloser(const DualMesh& m, const RunContext& c) : mesh(m), context(c), inTube(m.elementCount(), 0)
  {
    elementsOf = fillInOrder(mesh.points.size(), context.executor, [&](auto&& use) {
      context.executor.forEach(mesh.elementCount(), 4096, [&](std::size_t e) {
        for (const Index p : mesh.corners[e])
        {
          use(p, static_cast<Index>(e));
        }
      });
    });
  }

  /// Returns the elements of tubes in order. `onBoundary` marks the points on the boundary.
  std::vector<Index> run(const std::vector<Index>& elements, const std::vector<char>& onBoundary)
  {
    std::vector<Index> points =
        chosenNumbers(onBoundary.size(), context.executor, [&](std::size_t p) { return onBoundary[p] != 0; });
    add(elements, points);
    while (!points.empty())
    {
      context.progress.check();
      sortUnique(points);
      const std::vector<Index> some = std::exchange(points, {});
      const std::vector<Index> pinched = chosenNumbers(some.size(), context.executor, [&](std::size_t i) {
        return std::ranges::any_of(sectorsAt(some[i]), [&](const Part& sector) { return isPinched(sector, some[i]); });
      });
      for (const Index i : pinched)
      {
        close(some[i], points);
      }
    }
    return chosenNumbers(inTube.size(), context.executor, [&](std::size_t e) { return inTube[e] != 0; });
  }

private:
  /// Elements outside of tubes that are connected: a sector through faces at a point, a group through faces at an edge.
  using Part = std::vector<Index>;

  /// Adds elements to tubes, and their points to the list.
  void add(const std::vector<Index>& elements, std::vector<Index>& points)
  {
    for (const Index e : elements)
    {
      inTube[e] = 1;
      points.insert(points.end(), mesh.corners[e].begin(), mesh.corners[e].end());
    }
  }

  /// Adds elements of the pinched sectors at a point to tubes: those at pinched edges, or else all.
  void close(Index point, std::vector<Index>& points)
  {
    for (const Part& sector : sectorsAt(point))
    {
      if (isPinched(sector, point))
      {
        const Part some = atPinchedEdges(sector, point);
        add(some.empty() ? sector : some, points);
      }
    }
  }

  /// Calls use(direction, before, after) for each face of an element at a point, with the points beside it.
  template <typename Use> void forFacesAt(Index e, Index point, Use&& use) const
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      const ReducedFace face = faceOf(mesh.corners[e], direction);
      const auto at = std::ranges::find(face.loop(), point) - face.loop().begin();
      if (face.count >= 3 && at < face.count)
      {
        use(direction, face.points[(at + face.count - 1) % face.count], face.points[(at + 1) % face.count]);
      }
    }
  }

  /// Returns the element across a face if it is outside of tubes; else noIndex.
  Index across(Index e, int direction) const
  {
    const std::int32_t code = mesh.neighbors[e][direction];
    return code < 0 || inTube[code] ? noIndex : static_cast<Index>(code);
  }

  /// Returns the parts of a list of elements that are connected through faces which have all of some points.
  std::vector<Part> partsThrough(std::initializer_list<Index> points, std::vector<Index> left) const
  {
    const auto hasAll = [&](Index e, int direction) {
      const ReducedFace face = faceOf(mesh.corners[e], direction);
      return std::ranges::all_of(points,
                                 [&](Index p) { return std::ranges::find(face.loop(), p) != face.loop().end(); });
    };
    std::vector<Part> parts;
    while (!left.empty())
    {
      Part& part = parts.emplace_back(1, left.front());
      left.erase(left.begin());
      for (std::size_t i = 0; i < part.size(); ++i)
      {
        for (int direction = 0; direction < 6; ++direction)
        {
          const auto found = std::ranges::find(left, across(part[i], direction));
          if (found != left.end() && hasAll(part[i], direction))
          {
            part.push_back(*found);
            left.erase(found);
          }
        }
      }
    }
    return parts;
  }

  std::vector<Part> sectorsAt(Index point) const
  {
    std::vector<Index> star;
    std::ranges::copy_if(elementsOf.of(point), std::back_inserter(star), [&](Index e) { return !inTube[e]; });
    sortUnique(star);
    return partsThrough({point}, std::move(star));
  }

  /// True if a sector has walls or tubes beside it, and these are not one fan: the Euler characteristic of its
  /// elements, faces and edges at the point is not 1.
  bool isPinched(const Part& sector, Index point) const
  {
    bool isOpen = false;
    int halfFaces = 0;
    std::vector<Index> ends; // the edges' other points
    for (const Index e : sector)
    {
      forFacesAt(e, point, [&](int direction, Index before, Index after) {
        const bool isOuter = across(e, direction) == noIndex;
        isOpen = isOpen || isOuter;
        halfFaces += isOuter ? 2 : 1;
        ends.insert(ends.end(), {before, after});
      });
    }
    sortUnique(ends);
    return isOpen && static_cast<int>(ends.size()) - halfFaces / 2 + static_cast<int>(sector.size()) != 1;
  }

  /// Returns the elements to be added to tubes so that the rest around each edge at the point is connected: all groups
  /// but the one with most walls.
  Part atPinchedEdges(const Part& sector, Index point) const
  {
    std::vector<std::pair<Index, Index>> atEdges; // end of the edge, and element
    for (const Index e : sector)
    {
      forFacesAt(e, point, [&](int /*direction*/, Index before, Index after) {
        atEdges.emplace_back(before, e);
        atEdges.emplace_back(after, e);
      });
    }
    sortUnique(atEdges);
    Part out;
    for (auto begin = atEdges.begin(); begin != atEdges.end();)
    {
      const auto end = std::find_if(begin, atEdges.end(), [&](const auto& at) { return at.first != begin->first; });
      std::vector<Index> around;
      std::transform(begin, end, std::back_inserter(around), [](const auto& at) { return at.second; });
      std::vector<Part> groups = partsThrough({point, begin->first}, std::move(around));
      std::ranges::stable_sort(groups, std::greater(), [&](const Part& group) { return countWalls(group); });
      for (std::size_t i = 1; i < groups.size(); ++i)
      {
        out.insert(out.end(), groups[i].begin(), groups[i].end());
      }
      begin = end;
    }
    return out;
  }

  std::ptrdiff_t countWalls(const Part& part) const
  {
    std::ptrdiff_t count = 0;
    for (const Index e : part)
    {
      count += std::ranges::count_if(mesh.neighbors[e], &DualMesh::isBoundary);
    }
    return count;
  }

  const DualMesh& mesh;
  const RunContext& context;
  std::vector<char> inTube;
  Buckets elementsOf;
};

/// Returns the direction in which an element sees the face that another one sees in `direction`.
std::uint8_t directionOfSame(const DualMesh& mesh, Index e, int direction, Index other)
{
  const auto pointsOf = [&](Index of, int to) {
    std::array<Index, 4> points;
    std::ranges::transform(hexahedronFace[to], points.begin(), [&](std::uint8_t c) { return mesh.corners[of][c]; });
    std::ranges::sort(points);
    return points;
  };
  std::uint8_t there = 0;
  while (mesh.neighbors[other][there] != static_cast<std::int32_t>(e) ||
         pointsOf(other, there) != pointsOf(e, direction))
  {
    ++there;
  }
  return there;
}

/// Returns for each point the first of those that become one with it: points of the two sides of the cut that have the
/// same vertex.
std::vector<Index> firstOfSame(const DualMesh& mesh, const EdgeTubes& tubes, const std::vector<Index>& vertexOf)
{
  UnionFind sets(mesh.points.size());
  for (Index f = tubes.firstFace; f < tubes.firstFace + tubes.faceCount; f += 2)
  {
    joinSame(mesh, f, tubes.across(f), vertexOf, sets);
  }
  std::vector<Index> first(mesh.points.size());
  for (Index p = 0; p < first.size(); ++p)
  {
    first[p] = sets.find(p);
  }
  return first;
}

} // namespace

void joinSame(const DualMesh& mesh, Index face, Index other, const std::vector<Index>& vertexOf, UnionFind& points)
{
  for (const Index p : cornersOf(mesh, mesh.boundaryFaces[face]))
  {
    for (const Index q : cornersOf(mesh, mesh.boundaryFaces[other]))
    {
      if (vertexOf[p] == vertexOf[q])
      {
        points.join(p, q);
      }
    }
  }
}

EdgeTubes findEdgeTubes(const DualMesh& mesh, const RunContext& context)
{
  EdgeTubes tubes;
  const SheetEdges sheets = findSheetEdges(mesh, context);
  const std::vector<char> onBoundary = boundaryPoints(mesh, context.executor);
  const std::vector<Index> inFront = chosenNumbers(mesh.elementCount(), context.executor, [&](std::size_t e) {
    return hasMarked(mesh.corners[e], sheets.points) && isInTube(mesh, sheets, onBoundary, static_cast<Index>(e));
  });
  tubes.elements = TubeCloser(mesh, context).run(inFront, onBoundary);
  return tubes;
}

void cutTubes(DualMesh& mesh, Index surfaceCount, EdgeTubes& tubes)
{
  for (BoundaryFace& face : mesh.boundaryFaces)
  {
    face.tag += face.tag < surfaceCount ? 0 : tagsOfTubes;
  }
  tubes.firstFace = static_cast<Index>(mesh.boundaryFaces.size());
  for (const Index e : tubes.elements)
  {
    for (std::uint8_t direction = 0; direction < 6; ++direction)
    {
      const std::int32_t code = mesh.neighbors[e][direction];
      if (code < 0 || std::ranges::binary_search(tubes.elements, static_cast<Index>(code)))
      {
        continue;
      }
      const auto other = static_cast<Index>(code);
      const std::uint8_t there = directionOfSame(mesh, e, direction, other);
      mesh.neighbors[other][there] = ~static_cast<std::int32_t>(mesh.boundaryFaces.size());
      mesh.boundaryFaces.push_back({other, surfaceCount, e, there, SheetSide::front, false});
      mesh.neighbors[e][direction] = ~static_cast<std::int32_t>(mesh.boundaryFaces.size());
      mesh.boundaryFaces.push_back({e, surfaceCount + 1, other, direction, SheetSide::back, false});
    }
  }
  tubes.faceCount = static_cast<Index>(mesh.boundaryFaces.size()) - tubes.firstFace;
  for (ZoneFace& zone : mesh.zoneFaces)
  {
    const std::int32_t code = mesh.neighbors[zone.element][zone.direction];
    if (const Index cut = DualMesh::isBoundary(code) ? DualMesh::boundaryFaceOf(code) : 0;
        tubes.has(cut) && mesh.boundaryFaces[cut].tag == surfaceCount)
    {
      const BoundaryFace& inside = mesh.boundaryFaces[cut + 1];
      zone = {inside.element, zone.tag, inside.direction,
              zone.side == SheetSide::front ? SheetSide::back : SheetSide::front};
    }
  }
}

void addTubes(LayerOptions& options)
{
  const auto at = static_cast<std::ptrdiff_t>(options.surfaceCount());
  const int most = std::ranges::max(options.ofTag, {}, &WallLayers::layers).layers;
  options.ofTag.insert(options.ofTag.begin() + at, {WallLayers{.layers = most}, WallLayers{.layers = 0}});
  if (!options.supporting.empty())
  {
    options.supporting.insert(options.supporting.begin() + at, {SupportingLayer::everywhere, SupportingLayer::none});
  }
}

void keepTubes(const DualMesh& mesh, const EdgeTubes& tubes, LayerWalls& walls)
{
  for (const Index e : tubes.elements)
  {
    for (const Index p : mesh.corners[e])
    {
      walls.counts[p] = 0;
    }
  }
  for (Index f = tubes.firstFace; f < tubes.firstFace + tubes.faceCount; f += 2)
  {
    walls.roles[f + 1] = FaceRole::tube;
  }
}

JoinedTubes joinTubes(DualMesh& mesh, const EdgeTubes& tubes, const std::vector<Index>& vertexOf, Index surfaceCount)
{
  const std::vector<Index> first = firstOfSame(mesh, tubes, vertexOf);
  std::vector<char> stays(mesh.points.size());
  for (Index p = 0; p < stays.size(); ++p)
  {
    stays[p] = first[p] == p ? 1 : 0;
  }
  JoinedTubes out{.points = numbersOfKept(stays), .faces = {}};
  compact(mesh.points, out.points);
  std::ranges::transform(first, out.points.begin(), [&](Index p) { return out.points[p]; });
  stays.assign(mesh.boundaryFaces.size(), 1);
  std::fill_n(stays.begin() + tubes.firstFace, tubes.faceCount, 0);
  out.faces = numbersOfKept(stays);
  compact(mesh.boundaryFaces, out.faces);
  for (BoundaryFace& face : mesh.boundaryFaces)
  {
    face.tag -= face.tag < surfaceCount ? 0 : tagsOfTubes;
  }
  for (std::size_t e = 0; e < mesh.elementCount(); ++e)
  {
    for (Index& p : mesh.corners[e])
    {
      p = out.points[p];
    }
    for (std::int32_t& code : mesh.neighbors[e])
    {
      code = DualMesh::isBoundary(code) ? ~static_cast<std::int32_t>(out.faces[DualMesh::boundaryFaceOf(code)]) : code;
    }
  }
  return out;
}

} // namespace atria
