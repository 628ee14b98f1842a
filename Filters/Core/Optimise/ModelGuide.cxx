// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/ModelGuide.h"

#include "Dual/TurnedDomain.h"
#include "Octree/GeometryLists.h"
#include "Surface/Distance.h"

#include <algorithm>

namespace atria {

ModelGuide::ModelGuide(const Octree& octree, const SurfaceModel& model, const VertexAnchors& anchors,
                       const std::vector<Vec3>& points, std::vector<Index> vertexOf)
    : octree_(octree), model_(model), anchors_(anchors), points_(points), vertexOf_(std::move(vertexOf))
{
}

void ModelGuide::prepare(std::span<const Index> points, const RunContext& context)
{
  slotOf_.resize(vertexOf_.size(), noIndex);
  std::vector<Index> fresh;
  for (const Index point : points)
  {
    if (slotOf_[point] == noIndex && hasPieces(point))
    {
      slotOf_[point] = static_cast<Index>(targets_.size() + fresh.size());
      fresh.push_back(point);
    }
  }
  const std::size_t before = targets_.size();
  targets_.resize(before + fresh.size());
  context.executor.forEach(fresh.size(), 256, [&](std::size_t i) { targets_[before + i] = findTarget(fresh[i]); });
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

ModelGuide::Target ModelGuide::findTarget(Index point) const
{
  Target target{points_[point], {}};
  const Index vertex = vertexOf_[point];
  const Index leaf = anchors_.leaves[vertex];
  const std::vector<Index> wanted = wantedPieces(vertex);
  LatticeBox box{octree_.lowCorner(leaf), octree_.highCorner(leaf)};
  const std::int64_t reach = (box.high[0] - box.low[0]) / 2;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] -= reach;
    box.high[axis] += reach;
  }
  const auto at = [&](Index p) { return octree_.frame().toModel(model_.points[p]); };
  std::vector<ModelItem> found;
  for (const Index near : wanted.empty() ? std::vector<Index>() : leavesTouching(octree_, box))
  {
    for (const ModelItem item : octree_.items(near))
    {
      const bool isOnCurve = freedomOf(point) == Freedom::curve;
      const bool fits =
          isOnCurve ? item.kind == ModelItem::featureEdge &&
                          std::ranges::binary_search(wanted, model_.featureEdges[item.index].curve)
                    : item.kind == ModelItem::triangle && std::ranges::binary_search(wanted, model_.charts[item.index]);
      if (fits)
      {
        found.push_back(item);
      }
    }
  }
  std::ranges::sort(found, {}, [](ModelItem item) { return item.index; });
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    if (i > 0 && found[i].index == found[i - 1].index)
    {
      continue;
    }
    if (found[i].kind == ModelItem::triangle)
    {
      const auto& t = model_.triangles[found[i].index];
      target.pieces.push_back({at(t[0]), at(t[1]), at(t[2])});
    }
    else
    {
      const FeatureEdge& edge = model_.featureEdges[found[i].index];
      target.pieces.push_back({at(edge.a), at(edge.b), at(edge.b)});
    }
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
  const Target& target = targets_[slotOf_[point]];
  if (target.pieces.empty())
  {
    return target.start;
  }
  const unsigned planes = planesOf(anchors_.leaves[vertexOf_[point]]);
  // On a domain side, surface and plane in turn.
  constexpr int turns = 8;
  Vec3 q = p;
  for (int i = 0; i < (planes != 0 ? turns : 1); ++i)
  {
    Vec3 best = q;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : target.pieces)
    {
      const Vec3 near = b == c ? nearestOnSegment(q, a, b) : nearestOnTriangle(q, a, b, c);
      const double distance = (near - q).squaredNorm();
      if (distance < least)
      {
        least = distance;
        best = near;
      }
    }
    q = onPlanes(best, planes);
  }
  return q;
}

} // namespace atria
