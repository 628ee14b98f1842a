// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/DualVertices.h"

#include "Octree/BoxTests.h"
#include "Surface/Distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace atria {

namespace {

/// Cuts closer together than this part of a leaf's edge are one point.
constexpr double tipRatio = 1e-3;

/// Which crossed edges each leaf has, sorted by leaf.
std::vector<std::pair<Index, Index>> crossingsByLeaf(const Crossings& crossings)
{
  std::vector<std::pair<Index, Index>> pairs;
  pairs.reserve(4 * crossings.crossedEdges.size());
  for (Index e = 0; e < crossings.crossedEdges.size(); ++e)
  {
    for (const Index leaf : crossings.crossedEdges[e].leaves)
    {
      pairs.emplace_back(leaf, e);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Places one vertex at a time.
class VertexPlacer
{
public:
  VertexPlacer(const Octree& tree, const SurfaceModel& surfaces) : octree(tree), frame(tree.frame()), model(surfaces) {}

  Vec3 place(Index leaf, std::span<const std::pair<Index, Index>> cuts, const std::vector<CrossedEdge>& edges)
  {
    box = {octree.lowCorner(leaf), octree.highCorner(leaf)};
    planes = frame.domainPlanes(box.low, box.high);
    const Vec3 center = onPlanes(octree.center(leaf));
    if (cuts.empty() && planes == 0)
    {
      return center;
    }
    charts.clear();
    const Vec3 mean = gatherCuts(cuts, edges, center);
    const bool cut = !cuts.empty();
    if (!cut)
    {
      gatherSides(leaf);
    }
    std::optional<Vec3> found = nearestCorner(leaf, mean, cut);
    if (!found)
    {
      found = middleOfCurve(leaf, cut);
    }
    if (!found && cut)
    {
      found = onSurface(leaf, mean);
    }
    return onPlanes(found.value_or(center));
  }

  /// Whether some piece that cuts the leaf placed last is farther from p than rounding explains.
  bool missesPiece(Index leaf, const Vec3& p)
  {
    constexpr double ratio = 1e-4;
    const double allowed = ratio * frame.finestSize;
    return charts.size() > 1 && std::any_of(charts.begin(), charts.end(), [&](Index chart) {
             const Vec3 nearest = nearestOnPieces(leaf, p, [&](Index c) { return c == chart; });
             return (nearest - p).norm() > allowed;
           });
  }

private:
  Vec3 modelPoint(Index i) const { return frame.toModel(model.points[i]); }

  Vec3 onPlanes(Vec3 p) const
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      if (planes >> direction & 1)
      {
        p[axisOf(direction)] = frame.planeOf(direction);
      }
    }
    return p;
  }

  /// Mean of the points where the leaf's edges are cut; notes the smooth pieces that cut them.
  Vec3 gatherCuts(std::span<const std::pair<Index, Index>> cuts, const std::vector<CrossedEdge>& edges,
                  const Vec3& center)
  {
    Vec3 sum = Vec3::Zero();
    Box3 extent;
    double count = 0.0;
    for (const auto& [leaf, e] : cuts)
    {
      const CrossedEdge& edge = edges[e];
      for (const SurfaceCrossing* crossing : {&edge.nearest, &edge.farthest})
      {
        charts.push_back(model.charts[crossing->triangle]);
        const Vec3 p = crossingPoint(edge, *crossing);
        sum += p;
        extent.extend(p);
        count += 1.0;
      }
    }
    std::sort(charts.begin(), charts.end());
    charts.erase(std::unique(charts.begin(), charts.end()), charts.end());
    if (count == 0.0)
    {
      return center;
    }
    // A tip that reaches a grid point or edge only: the other leaves about it have the same cuts, but must not share
    // the vertex.
    const double edgeLength = frame.latticeUnit() * static_cast<double>(box.high[0] - box.low[0]);
    const bool isTip = extent.size().maxCoeff() < tipRatio * edgeLength;
    return isTip ? Vec3(0.5 * (sum / count + center)) : Vec3(sum / count);
  }

  Vec3 crossingPoint(const CrossedEdge& edge, const SurfaceCrossing& crossing) const
  {
    Vec3 p = frame.toModel(edge.start);
    p[axisOf(edge.direction)] = frame.toModel(axisOf(edge.direction), crossing.coordinate);
    return p;
  }

  void gatherSides(Index leaf)
  {
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind == ModelItem::triangle && onOwnPlane(piece.index))
      {
        charts.push_back(model.charts[piece.index]);
      }
    }
    std::sort(charts.begin(), charts.end());
  }

  bool onOwnPlane(Index triangle) const
  {
    const int side = model.domainSides[triangle];
    return side != SurfaceModel::noSide && (planes >> side & 1);
  }

  bool onOwnPlane(Index leaf, Index point) const
  {
    const auto pieces = octree.items(leaf);
    return std::any_of(pieces.begin(), pieces.end(), [&](const ModelItem piece) {
      return piece.kind == ModelItem::triangle && onOwnPlane(piece.index) &&
             std::ranges::find(model.triangles[piece.index], point) != model.triangles[piece.index].end();
    });
  }

  bool hasChart(Index chart) const { return std::binary_search(charts.begin(), charts.end(), chart); }

  /// In a leaf that is not cut, corners of what lies on its domain sides only.
  std::optional<Vec3> nearestCorner(Index leaf, const Vec3& mean, bool cut) const
  {
    std::optional<Vec3> best;
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind == ModelItem::corner && owns(model.points[model.corners[piece.index]]) &&
          (cut ? endsOwnCurve(leaf, model.corners[piece.index]) : onOwnPlane(leaf, model.corners[piece.index])))
      {
        const Vec3 p = modelPoint(model.corners[piece.index]);
        if (!best || (p - mean).squaredNorm() < (*best - mean).squaredNorm())
        {
          best = p;
        }
      }
    }
    return best;
  }

  /// Whether a curve of a piece that cuts the leaf ends or turns at the point.
  bool endsOwnCurve(Index leaf, Index point) const
  {
    const auto items = octree.items(leaf);
    return std::any_of(items.begin(), items.end(), [&](ModelItem piece) {
      if (piece.kind != ModelItem::featureEdge)
      {
        return false;
      }
      const FeatureEdge& edge = model.featureEdges[piece.index];
      return (edge.a == point || edge.b == point) && (hasChart(edge.charts[0]) || hasChart(edge.charts[1]));
    });
  }

  /// A point on the border of octants belongs to one of them only: the lower one, as the grid's symbolic shift has it.
  bool owns(const LatticePoint& p) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (p[axis] > box.high[axis] || p[axis] <= box.low[axis])
      {
        return false;
      }
    }
    return true;
  }

  LatticePoint pointAlong(const FeatureEdge& edge, double t) const
  {
    LatticePoint p = model.points[edge.a];
    const LatticePoint& end = model.points[edge.b];
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] += std::llround(t * static_cast<double>(end[axis] - p[axis]));
    }
    return p;
  }

  /// The middle of the feature curves in the leaf, on the one that is nearest to it.
  std::optional<Vec3> middleOfCurve(Index leaf, bool cut)
  {
    segments.clear();
    Vec3 sum = Vec3::Zero();
    double length = 0.0;
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind != ModelItem::featureEdge)
      {
        continue;
      }
      const FeatureEdge& edge = model.featureEdges[piece.index];
      const bool first = hasChart(edge.charts[0]);
      const bool second = hasChart(edge.charts[1]);
      const SegmentRange range = clipSegment(box, model.points[edge.a], model.points[edge.b]);
      if (range.begin >= range.end || !(cut ? first || second : first && second))
      {
        continue;
      }
      if (!owns(pointAlong(edge, 0.5 * (range.begin + range.end))))
      {
        continue;
      }
      const Vec3 a = modelPoint(edge.a);
      const Vec3 along = modelPoint(edge.b) - a;
      segments.emplace_back(a + range.begin * along, a + range.end * along);
      const double part = (range.end - range.begin) * along.norm();
      sum += part * 0.5 * (segments.back().first + segments.back().second);
      length += part;
    }
    if (segments.empty() || length <= 0.0)
    {
      return std::nullopt;
    }
    return nearestOfSegments(sum / length);
  }

  Vec3 nearestOfSegments(const Vec3& p) const
  {
    Vec3 best = p;
    double bestDistance = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : segments)
    {
      const Vec3 q = nearestOnSegment(p, a, b);
      const double distance = (q - p).squaredNorm();
      if (distance < bestDistance)
      {
        bestDistance = distance;
        best = q;
      }
    }
    return best;
  }

  /// Nearest point of the pieces that cut the leaf; on domain planes, found by projecting to surface and plane in turn.
  Vec3 onSurface(Index leaf, Vec3 p) const
  {
    constexpr int turns = 8;
    for (int i = 0; i < (planes != 0 ? turns : 1); ++i)
    {
      p = onPlanes(nearestOnPieces(leaf, p, [&](Index chart) { return hasChart(chart); }));
    }
    return p;
  }

  /// The nearest point of the triangles in the leaf whose chart is `wanted`.
  template <typename Wanted> Vec3 nearestOnPieces(Index leaf, const Vec3& p, Wanted&& wanted) const
  {
    Vec3 best = p;
    double bestDistance = std::numeric_limits<double>::infinity();
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind != ModelItem::triangle || !wanted(model.charts[piece.index]))
      {
        continue;
      }
      const auto& t = model.triangles[piece.index];
      const Vec3 q = nearestOnTriangle(p, modelPoint(t[0]), modelPoint(t[1]), modelPoint(t[2]));
      const double distance = (q - p).squaredNorm();
      if (distance < bestDistance)
      {
        bestDistance = distance;
        best = q;
      }
    }
    return best;
  }

  const Octree& octree;
  const GridFrame& frame;
  const SurfaceModel& model;
  LatticeBox box{};
  unsigned planes = 0;
  std::vector<Index> charts;
  std::vector<std::pair<Vec3, Vec3>> segments;
};

} // namespace

DualVertices placeVertices(const Octree& octree, const SurfaceModel& model, const Crossings& crossings,
                           const std::vector<Index>& leaves, const RunContext& context)
{
  const auto byLeaf = crossingsByLeaf(crossings);
  DualVertices vertices;
  vertices.positions.resize(leaves.size());
  vertices.compromised.resize(leaves.size());
  context.executor.forRanges(leaves.size(), 4096, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    VertexPlacer placer(octree, model);
    // Both lists are in order of leaves: they are walked side by side.
    auto last = std::lower_bound(byLeaf.begin(), byLeaf.end(), std::pair(leaves[begin], Index{0}));
    for (std::size_t i = begin; i < end; ++i)
    {
      const auto first = std::find_if(last, byLeaf.end(), [&](const auto& pair) { return pair.first >= leaves[i]; });
      last = std::find_if(first, byLeaf.end(), [&](const auto& pair) { return pair.first > leaves[i]; });
      vertices.positions[i] = placer.place(leaves[i], {first, last}, crossings.crossedEdges);
      vertices.compromised[i] = first != last && placer.missesPiece(leaves[i], vertices.positions[i]) ? 1 : 0;
    }
  });
  return vertices;
}

} // namespace atria
