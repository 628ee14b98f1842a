// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/ModelGuide.h"

#include "Dual/TurnedDomain.h"
#include "Octree/GeometryLists.h"
#include "Surface/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace atria {

namespace {

/// More triangles near a vertex are looked for in a tree.
constexpr std::size_t mostPieces = 64;

} // namespace

ModelGuide::ModelGuide(const Octree& octree, const SurfaceModel& model, TriangleTreeOnDemand& tree,
                       const VertexAnchors& anchors, const std::vector<Vec3>& points,
                       const std::vector<Index>& vertexOf)
    : octree_(octree), model_(model), anchors_(anchors), points_(points), vertexOf_(vertexOf), tree_(tree)
{
}

void ModelGuide::prepare(std::span<const Index> points, const RunContext& /*context*/)
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

std::vector<Index> ModelGuide::wantedPieces(Index vertex) const
{
  const auto pieces = anchors_.piecesOf(vertex);
  if (anchors_.freedom[vertex] != Freedom::beside)
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

/// The pieces that are wanted in the octants about the point's, in order.
std::vector<ModelItem> ModelGuide::findPieces(Index point, const std::vector<Index>& wanted) const
{
  const Index leaf = anchors_.leaves[vertexOf_[point]];
  LatticeBox box{octree_.lowCorner(leaf), octree_.highCorner(leaf)};
  const std::int64_t reach = (box.high[0] - box.low[0]) / 2;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] -= reach;
    box.high[axis] += reach;
  }
  const bool isOnCurve = freedomOf(point) == Freedom::curve;
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

void ModelGuide::find(Index point, Target& target) const
{
  target.isFound = true;
  std::vector<Index> wanted = wantedPieces(vertexOf_[point]);
  const std::vector<ModelItem> found = findPieces(point, wanted);
  if (found.size() > mostPieces && found.front().kind == ModelItem::triangle)
  {
    target.charts = std::move(wanted);
    return;
  }
  const auto at = [&](Index p) { return octree_.frame().toModel(model_.points[p]); };
  target.pieces.reserve(found.size());
  for (const ModelItem item : found)
  {
    if (item.kind == ModelItem::triangle)
    {
      const auto& t = model_.triangles[item.index];
      target.pieces.push_back({at(t[0]), at(t[1]), at(t[2])});
    }
    else
    {
      const FeatureEdge& edge = model_.featureEdges[item.index];
      target.pieces.push_back({at(edge.a), at(edge.b), at(edge.b)});
    }
  }
}

/// Of a point that was prepared. Threads ask for different points.
const ModelGuide::Target& ModelGuide::targetOf(Index point) const
{
  Target& target = targets_[slotOf_[point]];
  if (!target.isFound)
  {
    find(point, target);
  }
  return target;
}

unsigned ModelGuide::planesOf(Index leaf) const
{
  return octree_.frame().domainPlanes(octree_.lowCorner(leaf), octree_.highCorner(leaf));
}

Vec3 ModelGuide::onPlanes(Vec3 p, unsigned planes) const
{
  const GridFrame& frame = octree_.frame();
  for (int direction = 0; direction < 6; ++direction)
  {
    if (planes >> direction & 1)
    {
      p[axisOf(direction)] = frame.planeOf(direction);
    }
  }
  p = p.cwiseMax(frame.domain.min).cwiseMin(frame.domain.max);
  keepWithinSides({&p, 1}, frame);
  return p;
}

Vec3 ModelGuide::centreOf(Index point) const
{
  const Index leaf = anchors_.leaves[vertexOf_[point]];
  return onPlanes(octree_.center(leaf), planesOf(leaf));
}

Vec3 ModelGuide::place(Index point, const Vec3& p) const
{
  const Index leaf = anchors_.leaves[vertexOf_[point]];
  const unsigned planes = planesOf(leaf);
  if (freedomOf(point) == Freedom::free)
  {
    return onPlanes(p, planes);
  }
  if (freedomOf(point) == Freedom::released)
  {
    const auto& [home, reach] = anchors_.leashes.at(vertexOf_[point]);
    return onPlanes(p.cwiseMax(home - Vec3::Constant(reach)).cwiseMin(home + Vec3::Constant(reach)), planes);
  }
  const Vec3 q = nearest(point, p);
  // Where a corner has no vertex of its own, those beside it must not cut it off.
  constexpr double reach = 0.6;
  const bool strays = freedomOf(point) == Freedom::curve && (q - octree_.center(leaf)).cwiseAbs().maxCoeff() >
                                                                reach * octree_.frame().sizeOf(octree_.level(leaf));
  return strays ? targets_[slotOf_[point]].start : q;
}

Vec3 ModelGuide::nearest(Index point, const Vec3& p) const
{
  const Target& target = targetOf(point);
  if (target.pieces.empty() && target.charts.empty())
  {
    return target.start;
  }
  const unsigned planes = planesOf(anchors_.leaves[vertexOf_[point]]);
  // On a domain side, surface and plane in turn.
  constexpr int turns = 8;
  Vec3 q = p;
  for (int i = 0; i < (planes != 0 ? turns : 1); ++i)
  {
    q = onPlanes(nearestOf(target, q), planes);
  }
  return q;
}

Vec3 ModelGuide::nearestOf(const Target& target, const Vec3& p) const
{
  const GridFrame& frame = octree_.frame();
  if (!target.charts.empty())
  {
    const auto isWanted = [&](Index t) { return std::ranges::binary_search(target.charts, model_.charts[t]); };
    const Vec3 wanted = (p - frame.origin) / frame.latticeUnit();
    // Where it starts a vertex is on its charts, mostly: what is farther away than that is not nearest.
    const double atMost = 1.001 * (target.start - p).norm() / frame.latticeUnit() + 1.0;
    std::optional<Vec3> found = tree_.get().nearest(wanted, atMost, isWanted);
    found = found ? found : tree_.get().nearest(wanted, std::numeric_limits<double>::infinity(), isWanted);
    return found ? frame.toModel(*found) : p;
  }
  return nearestPiece(target, p).place;
}

/// Of a target that lists its pieces.
ModelGuide::OnPiece ModelGuide::nearestPiece(const Target& target, const Vec3& p)
{
  OnPiece best{p, nullptr};
  double least = std::numeric_limits<double>::infinity();
  for (const Piece& piece : target.pieces)
  {
    const auto& [a, b, c] = piece;
    const Vec3 near = b == c ? nearestOnSegment(p, a, b) : nearestOnTriangle(p, a, b, c);
    const double distance = (near - p).squaredNorm();
    if (distance < least)
    {
      least = distance;
      best = {near, &piece};
    }
  }
  return best;
}

/// Of points on surfaces the triangle they are on says it. Others may be where pieces end or meet, as at rims, and one
/// piece would promise ways there are not.
Ways ModelGuide::waysFrom(Index point, const Vec3& p, double step) const
{
  const bool isAtSide = planesOf(anchors_.leaves[vertexOf_[point]]) != 0 || octree_.frame().turnedDomain;
  if (!isAtSide && !hasPieces(point))
  {
    return {};
  }
  const bool isOnSurface = freedomOf(point) == Freedom::surface;
  const Piece* piece = isAtSide || !isOnSurface ? nullptr : nearestPiece(targetOf(point), p).piece;
  if (!piece)
  {
    return VertexGuide::waysFrom(point, p, step);
  }
  const auto& [a, b, c] = *piece;
  const Vec3 along = (b - a).normalized();
  const Vec3 normal = along.cross(c - a).normalized();
  return {{along, normal.cross(along)}, 2};
}

} // namespace atria
