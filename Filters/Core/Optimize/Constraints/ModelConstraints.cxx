// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Constraints/ModelConstraints.h"

#include "Dual/Vertices/TurnedDomain.h"
#include "Grid/DomainPlanes.h"
#include "Octree/Tree/GeometryLists.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <span>

namespace atria {

namespace {

/// Number of triangles near a vertex above which the tree is searched instead.
constexpr std::size_t mostPieces = 64;

} // namespace

ModelConstraints::ModelConstraints(const MeshingContext& context, const VertexClassification& classification,
                                   const std::vector<Vec3>& points, const std::vector<Index>& vertexOf)
    : octree_(context.octree), model_(context.model), classification_(classification), points_(points),
      vertexOf_(vertexOf), tree_(context.tree)
{
}

void ModelConstraints::prepare(std::span<const Index> points, const RunContext& /*context*/)
{
  slotOf_.resize(vertexOf_.size(), noIndex);
  for (const Index point : points)
  {
    if (slotOf_[point] == noIndex && hasPieces(point))
    {
      slotOf_[point] = static_cast<Index>(targets_.size());
      targets_.emplace_back().start = points_[point];
    }
  }
}

std::vector<Index> ModelConstraints::wantedPieces(Index vertex) const
{
  const auto pieces = classification_.piecesOf(vertex);
  if (classification_.classes[vertex] != VertexClass::adjacent)
  {
    return {pieces.begin(), pieces.end()};
  }
  std::vector<Index> charts;
  for (const Index curve : pieces)
  {
    charts.insert(charts.end(), model_.curves[curve].charts.begin(), model_.curves[curve].charts.end());
  }
  std::ranges::sort(charts);
  return charts;
}

/// Returns the pieces of `wanted` in the octants around the point's octant, in order.
std::vector<ModelItem> ModelConstraints::findPieces(Index point, const std::vector<Index>& wanted) const
{
  const Index leaf = classification_.leaves[vertexOf_[point]];
  const LatticePoint low = octree_.lowCorner(leaf);
  const LatticePoint high = octree_.highCorner(leaf);
  const LatticeBox box = grown({low, high}, (high[0] - low[0]) / 2);
  const bool isOnCurve = classOf(point) == VertexClass::curve;
  const auto fits = [&](ModelItem item) {
    return std::ranges::binary_search(wanted,
                                      isOnCurve ? model_.featureEdges[item.index].curve : model_.charts[item.index]);
  };
  std::vector<ModelItem> found;
  for (const Index near : wanted.empty() ? std::vector<Index>() : leavesTouching(octree_, box))
  {
    std::ranges::copy_if(octree_.items(near, isOnCurve ? ModelItem::featureEdge : ModelItem::triangle),
                         std::back_inserter(found), fits);
  }
  const auto indexOf = [](ModelItem item) { return item.index; };
  std::ranges::sort(found, {}, indexOf);
  // Clang 14 cannot compile std::ranges::unique of this library.
  const auto isSame = [](ModelItem a, ModelItem b) { return a.index == b.index; };
  found.erase(std::unique(found.begin(), found.end(), isSame), found.end());
  return found;
}

void ModelConstraints::find(Index point, Target& target) const
{
  std::vector<Index> wanted = wantedPieces(vertexOf_[point]);
  const std::vector<ModelItem> found = findPieces(point, wanted);
  const bool isOnCurve = classOf(point) == VertexClass::curve;
  if (found.size() > mostPieces && !isOnCurve)
  {
    target.kind = Kind::charts;
    target.pieces = std::move(wanted);
    return;
  }
  target.kind = isOnCurve ? Kind::featureEdges : Kind::triangles;
  target.pieces.resize(found.size());
  std::ranges::transform(found, target.pieces.begin(), [](ModelItem item) { return item.index; });
}

/// Returns the target of a point that was prepared. Threads must call it for different points.
ModelConstraints::Target& ModelConstraints::targetOf(Index point) const
{
  Target& target = targets_[slotOf_[point]];
  if (target.kind == Kind::unknown)
  {
    find(point, target);
  }
  return target;
}

unsigned ModelConstraints::planesOf(Index point) const
{
  if (!classification_.planes.empty())
  {
    return classification_.planes[vertexOf_[point]];
  }
  const Index leaf = classification_.leaves[vertexOf_[point]];
  return octree_.frame().domainPlanes(octree_.lowCorner(leaf), octree_.highCorner(leaf));
}

SideBits ModelConstraints::turnedSidesOf(Index point) const
{
  return classification_.turnedSides.empty() ? 0 : classification_.turnedSides[vertexOf_[point]];
}

/// Returns p moved into the domain, and to those of its sides on which the point stays.
Vec3 ModelConstraints::onSides(Index point, const Vec3& p) const
{
  const GridFrame& frame = octree_.frame();
  return onTurnedSides(onDomainPlanes(p, planesOf(point), frame), turnedSidesOf(point), frame);
}

Vec3 ModelConstraints::centerOf(Index point) const
{
  return onSides(point, octree_.center(classification_.leaves[vertexOf_[point]]));
}

Vec3 ModelConstraints::place(Index point, const Vec3& p) const
{
  if (classOf(point) == VertexClass::free)
  {
    return onSides(point, p);
  }
  if (classOf(point) == VertexClass::detached)
  {
    const auto& [origin, reach] = classification_.displacementLimits.at(vertexOf_[point]);
    return onSides(point, p.cwiseMax(origin - Vec3::Constant(reach)).cwiseMin(origin + Vec3::Constant(reach)));
  }
  const Index leaf = classification_.leaves[vertexOf_[point]];
  const Vec3 q = nearest(point, p);
  // Vertices on curves must not cut off a corner that has no vertex of its own.
  constexpr double reach = 0.6;
  const bool strays = classOf(point) == VertexClass::curve && (q - octree_.center(leaf)).cwiseAbs().maxCoeff() >
                                                                  reach * octree_.frame().sizeOf(octree_.level(leaf));
  return strays ? targets_[slotOf_[point]].start : q;
}

/// A vertex starts on its pieces, in most cases.
Vec3 ModelConstraints::nearest(Index point, const Vec3& p) const { return nearest(point, p, targetOf(point).start); }

Vec3 ModelConstraints::nearest(Index point, const Vec3& p, const Vec3& known) const
{
  Target& target = targetOf(point);
  if (target.pieces.empty())
  {
    return target.start;
  }
  const bool isOnSide = planesOf(point) != 0 || turnedSidesOf(point) != 0;
  Vec3 q = p;
  for (int i = 0; i < (isOnSide ? projectionTurns : 1); ++i)
  {
    q = onSides(point, nearestOf(target, q, known));
  }
  return q;
}

Vec3 ModelConstraints::nearestOf(Target& target, const Vec3& p, const Vec3& known) const
{
  const GridFrame& frame = octree_.frame();
  if (target.kind == Kind::charts)
  {
    const TriangleTree::AnyPlaceOn onCharts(
        [&](Index t) { return std::ranges::binary_search(target.pieces, model_.charts[t]); });
    const Vec3 wanted = (p - frame.origin) / frame.latticeUnit();
    const double atMost = 1.001 * (known - p).norm() / frame.latticeUnit() + 1.0;
    auto found = tree_.get().nearest(wanted, atMost, onCharts);
    found = found ? found : tree_.get().nearest(wanted, std::numeric_limits<double>::infinity(), onCharts);
    return found ? frame.toModel(found->at) : p;
  }
  return nearestPiece(target, p).place;
}

std::array<Vec3, 3> ModelConstraints::cornersOf(Index triangle) const
{
  const auto& t = model_.triangles[triangle];
  const auto at = [&](Index p) { return octree_.frame().toModel(model_.points[p]); };
  return {at(t[0]), at(t[1]), at(t[2])};
}

Vec3 ModelConstraints::nearestOn(const Target& target, Index piece, const Vec3& p) const
{
  if (target.kind == Kind::featureEdges)
  {
    const FeatureEdge& edge = model_.featureEdges[piece];
    const GridFrame& frame = octree_.frame();
    return nearestOnSegment(p, frame.toModel(model_.points[edge.a]), frame.toModel(model_.points[edge.b]));
  }
  const auto [a, b, c] = cornersOf(piece);
  return nearestOnTriangle(p, a, b, c);
}

/// True if a triangle's box is farther than `reach` from a position, both in lattice units. False for feature edges.
bool ModelConstraints::isBeyond(const Target& target, Index piece, const Vec3& wanted, double reach) const
{
  if (target.kind == Kind::featureEdges)
  {
    return false;
  }
  const Box3 box = model_.bounds(piece);
  const Vec3 apart = (box.min - wanted).cwiseMax(wanted - box.max).cwiseMax(0.0);
  return apart.squaredNorm() > reach * reach;
}

/// Returns the nearest position on a target that lists its pieces, and its piece, the first of those equally near.
/// Starts with the piece that was nearest last time, because it is mostly near again and rules out most others.
ModelConstraints::OnPiece ModelConstraints::nearestPiece(Target& target, const Vec3& p) const
{
  if (target.kind == Kind::charts || target.pieces.empty())
  {
    return {p, noIndex};
  }
  constexpr double rounding = 1.0; // lattice units
  const GridFrame& frame = octree_.frame();
  const Vec3 wanted = (p - frame.origin) / frame.latticeUnit();
  Vec3 best = nearestOn(target, target.pieces[target.last], p);
  double least = (best - p).squaredNorm();
  const auto reachOf = [&] { return std::sqrt(least) / frame.latticeUnit() + rounding; };
  double reach = reachOf();
  for (Index i = 0; i < target.pieces.size(); ++i)
  {
    if (i == target.last || isBeyond(target, target.pieces[i], wanted, reach))
    {
      continue;
    }
    const Vec3 near = nearestOn(target, target.pieces[i], p);
    const double distance = (near - p).squaredNorm();
    if (distance < least || (distance == least && i < target.last))
    {
      best = near;
      least = distance;
      reach = reachOf();
      target.last = i;
    }
  }
  return {best, target.pieces[target.last]};
}

/// Free and detached points may move in all directions, points on a surface in the plane of the nearest triangle. All
/// others, and points at the domain's sides, get their directions from place(): they may be where pieces end or meet,
/// as at boundary edges, and a single piece would allow directions in which they cannot move.
Ways ModelConstraints::waysFrom(Index point, const Vec3& p, double step) const
{
  const bool isAtSide = planesOf(point) != 0 || octree_.frame().turnedDomain;
  if (!isAtSide && !hasPieces(point))
  {
    return {};
  }
  const bool isOnSurface = classOf(point) == VertexClass::surface;
  const Index piece = isAtSide || !isOnSurface ? noIndex : nearestPiece(targetOf(point), p).piece;
  if (piece == noIndex)
  {
    return VertexConstraints::waysFrom(point, p, step);
  }
  const auto [a, b, c] = cornersOf(piece);
  const Vec3 along = (b - a).normalized();
  const Vec3 normal = along.cross(c - a).normalized();
  return {{along, normal.cross(along)}, 2};
}

} // namespace atria
