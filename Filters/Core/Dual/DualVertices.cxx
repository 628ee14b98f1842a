// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/DualVertices.h"

#include "Octree/BoxTests.h"
#include "Surface/Distance.h"

#include <algorithm>
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
  VertexPlacer(const Octree& tree, const SurfaceModel& surfaces) : octree(tree), frame(tree.frame()), model(surfaces)
  {
  }

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
  Vec3 gatherCuts(std::span<const std::pair<Index, Index>> cuts, const std::vector<CrossedEdge>& edges, const Vec3& center)
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
    // A tip that reaches a grid point or edge only: the other leaves about it have the same cuts, but must not share the vertex.
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
          (cut || onOwnPlane(leaf, model.corners[piece.index])))
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

  /// A point on the border of octants belongs to one of them only: the upper one, like the grid's symbolic shift has it; but
  /// to the lower one on an upper domain plane.
  bool owns(const LatticePoint& p) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool atTop = p[axis] == box.high[axis] && p[axis] == frame.domainHigh[axis];
      if (p[axis] < box.low[axis] || (p[axis] >= box.high[axis] && !atTop))
      {
        return false;
      }
    }
    return true;
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
      p = onPlanes(nearestOnPieces(leaf, p));
    }
    return p;
  }

  Vec3 nearestOnPieces(Index leaf, const Vec3& p) const
  {
    Vec3 best = p;
    double bestDistance = std::numeric_limits<double>::infinity();
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind != ModelItem::triangle || !hasChart(model.charts[piece.index]))
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

std::vector<Vec3> placeVertices(const Octree& octree, const SurfaceModel& model, const Crossings& crossings,
                                const std::vector<Index>& leaves, const RunContext& context)
{
  const auto byLeaf = crossingsByLeaf(crossings);
  std::vector<Vec3> vertices(leaves.size());
  context.executor.forRanges(leaves.size(), 4096, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    VertexPlacer placer(octree, model);
    for (std::size_t i = begin; i < end; ++i)
    {
      const auto [first, last] =
        std::equal_range(byLeaf.begin(), byLeaf.end(), std::pair(leaves[i], Index{0}),
                         [](const auto& l, const auto& r) { return l.first < r.first; });
      vertices[i] = placer.place(leaves[i], {first, last}, crossings.crossedEdges);
    }
  });
  return vertices;
}

} // namespace atria
