// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Grid/EdgeProbe.h"

#include "Grid/Predicates.h"
#include "Support/Sorting.h"
#include "Surface/Search/Distance.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Number of pieces in a leaf above which a tree finds those near an edge sooner.
constexpr std::size_t longList = 64;

} // namespace

LatticeBox boundsOf(const EdgeSegment& edge) { return boundsOf(edge.start, edge.end); }

bool touchesBounds(const LatticeBox& box, const SurfaceModel& model, Index triangle)
{
  return overlap(box, boundsOf(model.corner(triangle, 0), model.corner(triangle, 1), model.corner(triangle, 2)));
}

Vec3 pointOn(const EdgeSegment& edge, double parameter)
{
  return toVector(edge.start) + parameter * (toVector(edge.end) - toVector(edge.start));
}

std::optional<SurfaceCrossing> crossingOf(const EdgeSegment& edge, const LatticePoint& a, const LatticePoint& b,
                                          const LatticePoint& c, Index triangle)
{
  if (!overlap(boundsOf(edge), boundsOf(a, b, c)))
  {
    return std::nullopt;
  }
  const bool meets = edge.axis >= 0 ? lineMeetsTriangle(a, b, c, edge.start, edge.axis)
                                    : lineMeetsTriangle(a, b, c, edge.start, edge.end);
  if (!meets)
  {
    return std::nullopt;
  }
  const LatticeNormal normal(a, b, c);
  const int side = normal.sideOf(a, edge.start);
  if (side == normal.sideOf(a, edge.end))
  {
    return std::nullopt;
  }
  const Vec3 n(static_cast<double>(normal.n[0]), static_cast<double>(normal.n[1]), static_cast<double>(normal.n[2]));
  const double along = n.dot(toVector(edge.end) - toVector(edge.start));
  const double parameter = n.dot(toVector(a) - toVector(edge.start)) / along;
  // From the back to the front the edge runs along the normal.
  return SurfaceCrossing{triangle, -side, std::isfinite(parameter) ? std::clamp(parameter, 0.0, 1.0) : 0.5};
}

std::span<const SurfaceCrossing> EdgeProbe::cut(const EdgeSegment& edge, std::span<const Index> leaves)
{
  gather(boundsOf(edge), leaves, candidates);
  return cutAmong(edge, candidates);
}

std::span<const SurfaceCrossing> EdgeProbe::cutAmong(const EdgeSegment& edge, std::span<const Index> triangles)
{
  found.clear();
  for (const Index t : triangles)
  {
    if (const auto cut = crossingOf(edge, model.corner(t, 0), model.corner(t, 1), model.corner(t, 2), t))
    {
      found.push_back(*cut);
    }
  }
  const auto isBefore = [](const SurfaceCrossing& l, const SurfaceCrossing& r) {
    return std::tie(l.parameter, l.triangle) < std::tie(r.parameter, r.triangle);
  };
  std::sort(found.begin(), found.end(), isBefore);
  if (model.kinds.empty())
  {
    dropBulges(edge, 0, found.size());
    return found;
  }
  const auto permeable = std::stable_partition(
      found.begin(), found.end(), [&](const SurfaceCrossing& cut) { return !model.isPermeable(cut.triangle); });
  const auto walls = static_cast<std::size_t>(permeable - found.begin());
  dropBulges(edge, walls, found.size());
  dropBulges(edge, 0, walls);
  std::sort(found.begin(), found.end(), isBefore);
  return found;
}

Index EdgeProbe::sideTriangle(Index leaf, const LatticePoint& p, int direction) const
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

void EdgeProbe::gather(const LatticeBox& box, std::span<const Index> leaves, std::vector<Index>& triangles) const
{
  const auto isObstacle = [&](Index triangle) { return model.domainSides[triangle] == SurfaceModel::noSide; };
  triangles.clear();
  if (triangleTree && std::ranges::any_of(leaves, [&](Index leaf) { return octree.items(leaf).size() > longList; }))
  {
    std::ranges::copy_if(triangleTree->get().touching(box), std::back_inserter(triangles), isObstacle);
    return;
  }
  for (const Index leaf : leaves)
  {
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind == ModelItem::triangle && isObstacle(piece.index) && touchesBounds(box, model, piece.index))
      {
        triangles.push_back(piece.index);
      }
    }
  }
  if (leaves.size() > 1)
  {
    sortUnique(triangles);
  }
}

/// True if two neighboring crossings are a surface that reaches through the edge and back, with both ends of the edge
/// on the same side. It is the tip of a crease or a bulge of a smooth piece. A bulge faces the same way twice, the two
/// sides of a thin wall opposite ways.
bool EdgeProbe::isBulge(const EdgeSegment& edge, const SurfaceCrossing& l, const SurfaceCrossing& r) const
{
  if (model.charts[l.triangle] == model.charts[r.triangle])
  {
    return l.orientation != r.orientation && model.normal(l.triangle).dot(model.normal(r.triangle)) > 0.0;
  }
  return isNick(edge, l, r);
}

/// True if the two pieces meet in a crease close beyond the edge. False where three pieces meet, as the ends may lie in
/// different zones there.
bool EdgeProbe::isNick(const EdgeSegment& edge, const SurfaceCrossing& l, const SurfaceCrossing& r) const
{
  const auto [low, high] = std::minmax(model.charts[l.triangle], model.charts[r.triangle]);
  const Vec3 middle = pointOn(edge, 0.5 * (l.parameter + r.parameter));
  const double reach = nickDepth * static_cast<double>(edge.size);
  for (const Index leaf : edge.about)
  {
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind != ModelItem::featureEdge)
      {
        continue;
      }
      const FeatureEdge& feature = model.featureEdges[piece.index];
      const std::vector<Index>& charts = model.curves[feature.curve].charts;
      if (charts.size() != 2 || charts[0] != low || charts[1] != high)
      {
        continue;
      }
      const Vec3 nearest =
          nearestOnSegment(middle, toVector(model.points[feature.a]), toVector(model.points[feature.b]));
      if ((nearest - middle).squaredNorm() <= reach * reach)
      {
        return true;
      }
    }
  }
  return false;
}

/// Drops bulges, in pairs. The parity of crossings along every closed path stays, so that closed surfaces stay closed.
void EdgeProbe::dropBulges(const EdgeSegment& edge, std::size_t begin, std::size_t end)
{
  for (std::size_t i = begin; i + 1 < end;)
  {
    if (isBulge(edge, found[i], found[i + 1]))
    {
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(i), found.begin() + static_cast<std::ptrdiff_t>(i) + 2);
      end -= 2;
      i = i > begin ? i - 1 : begin;
    }
    else
    {
      ++i;
    }
  }
}

} // namespace atria
