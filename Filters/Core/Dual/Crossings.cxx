// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Crossings.h"

#include "Surface/Predicates.h"

#include <algorithm>

namespace atria {

namespace {

bool boundsMiss(const SurfaceModel& model, Index triangle, const LatticePoint& p, int axis)
{
  for (int other = 1; other < 3; ++other)
  {
    const int a = (axis + other) % 3;
    const std::int64_t x = model.corner(triangle, 0)[a];
    const std::int64_t y = model.corner(triangle, 1)[a];
    const std::int64_t z = model.corner(triangle, 2)[a];
    if (p[a] < std::min({x, y, z}) || p[a] > std::max({x, y, z}))
    {
      return true;
    }
  }
  return false;
}

/// Looks for crossings of one edge with the triangles of a leaf beside it.
class EdgeProbe
{
public:
  EdgeProbe(const Octree& tree, const SurfaceModel& surfaces) : octree(tree), model(surfaces) {}

  /// Crossings of the edge from p to q along `axis` with the triangles of `leaf`, the finest of the leaves `about` it,
  /// sorted from p to q. Triangles on domain sides are not asked.
  const std::vector<SurfaceCrossing>& cut(Index leaf, const std::array<Index, 4>& about, const LatticePoint& p,
                                          const LatticePoint& q, int axis)
  {
    found.clear();
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind == ModelItem::triangle && model.domainSides[piece.index] == SurfaceModel::noSide)
      {
        test(piece.index, p, q, axis);
      }
    }
    const bool up = p[axis] < q[axis];
    std::sort(found.begin(), found.end(), [&](const SurfaceCrossing& l, const SurfaceCrossing& r) {
      const double along = up ? l.coordinate - r.coordinate : r.coordinate - l.coordinate;
      return along < 0.0 || (along == 0.0 && l.triangle < r.triangle);
    });
    dropBulges(about);
    return found;
  }

  /// The triangle of a domain side that covers the point where the edge through p leaves the domain; noIndex if none.
  Index sideTriangle(Index leaf, const LatticePoint& p, int direction) const
  {
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind == ModelItem::triangle && model.domainSides[piece.index] == direction &&
          lineMeetsTriangle(model.corner(piece.index, 0), model.corner(piece.index, 1), model.corner(piece.index, 2), p,
                            axisOf(direction)))
      {
        return piece.index;
      }
    }
    return noIndex;
  }

private:
  void test(Index triangle, const LatticePoint& p, const LatticePoint& q, int axis)
  {
    const LatticePoint& a = model.corner(triangle, 0);
    const LatticePoint& b = model.corner(triangle, 1);
    const LatticePoint& c = model.corner(triangle, 2);
    if (boundsMiss(model, triangle, p, axis) || !lineMeetsTriangle(a, b, c, p, axis))
    {
      return;
    }
    const LatticeNormal normal(a, b, c);
    if (normal.sideOf(a, p) == normal.sideOf(a, q))
    {
      return;
    }
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto n = [&](int i) { return static_cast<double>(normal.n[i]); };
    const double offset = (n(u) * static_cast<double>(p[u] - a[u]) + n(v) * static_cast<double>(p[v] - a[v])) / n(axis);
    const auto low = static_cast<double>(std::min(p[axis], q[axis]));
    const auto high = static_cast<double>(std::max(p[axis], q[axis]));
    found.push_back({triangle, std::clamp(static_cast<double>(a[axis]) - offset, low, high), signOf(normal.n[axis])});
  }

  /// Whether two neighbouring crossings are a surface that reaches through the edge and back, with both ends of the
  /// edge on the same side: a bulge of a smooth piece, which faces the same way twice while the two sides of a thin
  /// wall face opposite ways; or the crease between two pieces, seen in a leaf beside the edge. Not where three pieces
  /// meet: there the ends may lie in different zones.
  bool isBulge(const SurfaceCrossing& l, const SurfaceCrossing& r, const std::array<Index, 4>& about) const
  {
    const Index a = model.charts[l.triangle];
    const Index b = model.charts[r.triangle];
    if (a == b)
    {
      return l.orientation != r.orientation && model.normal(l.triangle).dot(model.normal(r.triangle)) > 0.0;
    }
    return std::any_of(about.begin(), about.end(), [&](Index leaf) { return hasCrease(leaf, a, b); });
  }

  bool hasCrease(Index leaf, Index a, Index b) const
  {
    const auto items = octree.items(leaf);
    return std::any_of(items.begin(), items.end(), [&](ModelItem piece) {
      if (piece.kind != ModelItem::featureEdge)
      {
        return false;
      }
      const FeatureEdge& edge = model.featureEdges[piece.index];
      return (edge.kind == CurveKind::crease || edge.kind == CurveKind::border) &&
             ((edge.charts[0] == a && edge.charts[1] == b) || (edge.charts[0] == b && edge.charts[1] == a));
    });
  }

  /// Taking out pairs keeps the parity of crossings along every closed path, so that closed surfaces stay closed.
  void dropBulges(const std::array<Index, 4>& about)
  {
    for (std::size_t i = 0; i + 1 < found.size();)
    {
      if (isBulge(found[i], found[i + 1], about))
      {
        found.erase(found.begin() + static_cast<std::ptrdiff_t>(i), found.begin() + static_cast<std::ptrdiff_t>(i) + 2);
        i = i > 0 ? i - 1 : 0;
      }
      else
      {
        ++i;
      }
    }
  }

  const Octree& octree;
  const SurfaceModel& model;
  std::vector<SurfaceCrossing> found;
};

/// The faces found for a range of grid points, joined to the others' afterwards.
struct Part
{
  std::vector<BoundaryFace> faces;
  std::vector<CrossedEdge> edges;
};

SheetSide sideSeen(int direction, int orientation)
{
  // The front is seen from where the normal points to: looking along the axis, against an opposed normal.
  return (isUpper(direction) ? orientation < 0 : orientation > 0) ? SheetSide::front : SheetSide::back;
}

class CrossingFinder
{
public:
  CrossingFinder(const Octree& tree, const SurfaceModel& surfaces, const GridPoints& grid, Crossings& target)
      : octree(tree), model(surfaces), points(grid), out(target), probe(tree, surfaces)
  {
  }

  /// Sets the neighbours of one point. Edges between two points are cut from their lower end; the codes of boundary
  /// faces are positions in `part` until the parts are joined.
  void process(Index point, Part& part)
  {
    const std::array<Index, 8>& leaves = points.leaves[point];
    for (int direction = 0; direction < 6; ++direction)
    {
      const GridEdge edge = edgeFrom(octree, leaves, direction);
      std::int32_t& neighbour = out.neighbours[point][direction];
      if (edge.leaf == noIndex)
      {
        neighbour = DualMesh::noFace;
        continue;
      }
      const Index other = points.atCorner[edge.leaf][edge.corner ^ (1u << axisOf(direction))];
      neighbour = static_cast<std::int32_t>(other);
      const bool occupied = !octree.items(edge.leaf).empty();
      if (other == noIndex)
      {
        leave(point, direction, edge, part);
      }
      else if (occupied && isUpper(direction))
      {
        cutBetween(point, other, direction, edge, part);
      }
    }
  }

private:
  /// The edge leads out of the domain.
  void leave(Index point, int direction, const GridEdge& edge, Part& part)
  {
    const LatticePoint p = octree.cornerOf(edge.leaf, edge.corner);
    const int axis = axisOf(direction);
    LatticePoint end = p;
    end[axis] = isUpper(direction) ? octree.frame().domainHigh[axis] : octree.frame().domainLow[axis];
    const auto& found = probe.cut(edge.leaf, leavesAbout(point, direction), p, end, axis);
    if (!found.empty())
    {
      record(point, noIndex, direction, p, found, part);
      addFace(point, noIndex, direction, model.surfaceIds[found.front().triangle],
              sideSeen(direction, found.front().orientation), part);
      return;
    }
    const Index triangle = probe.sideTriangle(edge.leaf, p, direction);
    const Index tag =
        triangle == noIndex ? static_cast<Index>(model.names.size()) + direction : model.surfaceIds[triangle];
    part.faces.push_back({point, tag, noIndex, static_cast<std::uint8_t>(direction), SheetSide::front, true});
  }

  void cutBetween(Index point, Index other, int direction, const GridEdge& edge, Part& part)
  {
    const int axis = axisOf(direction);
    const LatticePoint p = octree.cornerOf(edge.leaf, edge.corner);
    const LatticePoint q = octree.cornerOf(edge.leaf, edge.corner ^ (1u << axis));
    const auto& found = probe.cut(edge.leaf, leavesAbout(point, direction), p, q, axis);
    if (found.empty())
    {
      return;
    }
    record(point, other, direction, p, found, part);
    addFace(point, other, direction, model.surfaceIds[found.front().triangle],
            sideSeen(direction, found.front().orientation), part);
    addFace(other, point, opposite(direction), model.surfaceIds[found.back().triangle],
            sideSeen(opposite(direction), found.back().orientation), part);
  }

  std::array<Index, 4> leavesAbout(Index point, int direction) const
  {
    std::array<Index, 4> leaves;
    const unsigned bit = 1u << axisOf(direction);
    for (unsigned slot = 0, i = 0; slot < 8; ++slot)
    {
      if (((slot & bit) != 0) == isUpper(direction))
      {
        leaves[i++] = points.leaves[point][slot];
      }
    }
    return leaves;
  }

  void record(Index point, Index other, int direction, const LatticePoint& start,
              const std::vector<SurfaceCrossing>& found, Part& part)
  {
    part.edges.push_back({point, other, static_cast<std::uint8_t>(direction), start, found.front(), found.back(),
                          static_cast<std::uint32_t>(found.size()), leavesAbout(point, direction)});
  }

  static void addFace(Index element, Index other, int direction, Index tag, SheetSide side, Part& part)
  {
    part.faces.push_back({element, tag, other, static_cast<std::uint8_t>(direction), side, false});
  }

  const Octree& octree;
  const SurfaceModel& model;
  const GridPoints& points;
  Crossings& out;
  EdgeProbe probe;
};

} // namespace

Crossings findCrossings(const Octree& octree, const SurfaceModel& model, const GridPoints& points,
                        const RunContext& context)
{
  Crossings out;
  out.neighbours.resize(points.size());
  constexpr std::size_t grain = 8192;
  std::vector<Part> parts((points.size() + grain - 1) / grain);
  context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
    context.progress.check();
    CrossingFinder finder(octree, model, points, out);
    for (std::size_t i = part * grain; i < std::min((part + 1) * grain, points.size()); ++i)
    {
      finder.process(static_cast<Index>(i), parts[part]);
    }
  });
  for (const Part& part : parts)
  {
    out.boundaryFaces.insert(out.boundaryFaces.end(), part.faces.begin(), part.faces.end());
    out.crossedEdges.insert(out.crossedEdges.end(), part.edges.begin(), part.edges.end());
  }
  for (std::size_t f = 0; f < out.boundaryFaces.size(); ++f)
  {
    const BoundaryFace& face = out.boundaryFaces[f];
    out.neighbours[face.element][face.direction] = ~static_cast<std::int32_t>(f);
  }
  return out;
}

} // namespace atria
