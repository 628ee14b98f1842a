// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Leaf/LeafGeometry.h"

#include "Grid/DomainPlanes.h"
#include "Surface/Search/Distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atria {

namespace {

LatticePoint pointAlong(const LatticePoint& a, const LatticePoint& b, double t)
{
  LatticePoint p = a;
  for (int axis = 0; axis < 3; ++axis)
  {
    p[axis] += std::llround(t * static_cast<double>(b[axis] - a[axis]));
  }
  return p;
}

} // namespace

std::optional<Vec3> LeafGeometry::centerOffSides(Index leaf) const
{
  const LatticePoint low = octree.lowCorner(leaf);
  const std::int64_t size = frame.latticeSize(octree.level(leaf));
  if (frame.domainPlanes(low, {low[0] + size, low[1] + size, low[2] + size}) != 0)
  {
    return std::nullopt;
  }
  const double half = 0.5 * frame.sizeOf(octree.level(leaf));
  return (frame.toModel(low) + Vec3::Constant(half)).cwiseMax(frame.domain.min).cwiseMin(frame.domain.max);
}

void LeafGeometry::enter(Index leaf)
{
  leaf_ = leaf;
  box = {octree.lowCorner(leaf), octree.highCorner(leaf)};
  planes = frame.domainPlanes(box.low, box.high);
  leaves = {leaf};
  isDisplaced = false;
  diverted = false;
  center_ = onPlanes(octree.center(leaf));
  sum = Vec3::Zero();
  extent = Box3();
  count = 0.0;
  charts_.clear();
}

void LeafGeometry::addCut(const EdgeSegment& edge, std::span<const SurfaceCrossing> cuts)
{
  for (const SurfaceCrossing* cut : {&cuts.front(), &cuts.back()})
  {
    const Vec3 p = frame.toModel(pointOn(edge, cut->parameter));
    sum += p;
    extent.extend(p);
    count += 1.0;
  }
  isDisplaced = isDisplaced || edge.axis < 0;
  for (const Index leaf : edge.about)
  {
    if (std::find(leaves.begin(), leaves.end(), leaf) == leaves.end())
    {
      leaves.push_back(leaf);
    }
  }
}

/// Curves beside the leaf may lead out of the domain.
Vec3 LeafGeometry::onPlanes(const Vec3& p) const { return onDomainPlanes(p, planes, frame); }

Vec3 LeafGeometry::meanOfCuts() const { return count > 0.0 ? Vec3(sum / count) : center_; }

/// Returns the mean of the cuts. If a tip reaches only a grid point or edge, returns the middle between that and the
/// center: other leaves there have the same cuts, but must not share the vertex.
Vec3 LeafGeometry::tipOrMean() const
{
  const double edgeLength = frame.latticeUnit() * static_cast<double>(box.high[0] - box.low[0]);
  const bool isTip = count > 0.0 && extent.size().maxCoeff() < coincidentRatio * edgeLength;
  return isTip ? Vec3(0.5 * (meanOfCuts() + center_)) : meanOfCuts();
}

bool LeafGeometry::hasChart(Index chart) const { return std::binary_search(charts_.begin(), charts_.end(), chart); }

/// True if the leaf has a point. One on the border of octants belongs to the lower one, by the grid's symbolic shift.
bool LeafGeometry::owns(const LatticePoint& p) const
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

bool LeafGeometry::onOwnPlane(Index triangle) const
{
  const std::int8_t side = model.domainSides[triangle];
  return side != SurfaceModel::noSide && (planes >> side & 1);
}

/// True if all that meets at the edge in this leaf lies on a domain side.
bool LeafGeometry::onOwnPlane(const FeatureEdge& edge) const
{
  const std::vector<Index>& wanted = model.curves[edge.curve].charts;
  std::size_t onPlane = 0;
  for (const ModelItem piece : octree.items(leaf_))
  {
    if (piece.kind == ModelItem::triangle && onOwnPlane(piece.index))
    {
      const auto& t = model.triangles[piece.index];
      onPlane += std::find(t.begin(), t.end(), edge.a) != t.end() && std::find(t.begin(), t.end(), edge.b) != t.end();
    }
  }
  return onPlane == wanted.size();
}

std::optional<Vec3> LeafGeometry::sidePosition()
{
  if (planes == 0)
  {
    return std::nullopt;
  }
  if (const auto corner = sideCorner())
  {
    return onPlanes(*corner);
  }
  const auto middle = middleOfPieces([&](const FeatureEdge& edge) { return onOwnPlane(edge); });
  return middle ? std::optional(onPlanes(*middle)) : std::nullopt;
}

/// Returns the corner, nearest to the center, of what lies on the domain sides through the leaf.
std::optional<Vec3> LeafGeometry::sideCorner() const
{
  NearestPlace best{center_};
  for (const ModelItem corner : octree.items(leaf_))
  {
    if (corner.kind != ModelItem::corner || !owns(model.points[model.corners[corner.index]]))
    {
      continue;
    }
    const Index point = model.corners[corner.index];
    const bool onSide = std::ranges::any_of(octree.items(leaf_), [&](const ModelItem piece) {
      return piece.kind == ModelItem::triangle && onOwnPlane(piece.index) &&
             std::ranges::find(model.triangles[piece.index], point) != model.triangles[piece.index].end();
    });
    if (onSide)
    {
      best.offer(modelPoint(point));
    }
  }
  return best.place();
}

Vec3 LeafGeometry::surfacePosition()
{
  const auto fold = middleOfPieces([&](const FeatureEdge& edge) {
    const FeatureCurve& curve = model.curves[edge.curve];
    return curve.ending.empty() && std::ranges::all_of(curve.charts, [&](Index chart) { return hasChart(chart); });
  });
  if (fold)
  {
    return onPlanes(*fold);
  }
  Vec3 p = onPlanes(tipOrMean());
  for (int i = 0; i < (planes != 0 ? projectionTurns : 1); ++i)
  {
    p = onPlanes(nearestOnPieces(p, [&](Index chart) { return hasChart(chart); }).value_or(p));
  }
  return p;
}

std::optional<Vec3> LeafGeometry::curvePosition(const std::vector<std::vector<Index>>& endings)
{
  if (planes == 0)
  {
    if (auto found = middleOfPieces([&](const FeatureEdge& edge) { return isOneOf(edge, endings); }))
    {
      return found;
    }
  }
  diverted = true;
  return nearestCurvePosition(endings, meanOfCuts());
}

bool LeafGeometry::isOneOf(const FeatureEdge& edge, const std::vector<std::vector<Index>>& endings) const
{
  const FeatureCurve& curve = model.curves[edge.curve];
  return std::ranges::find(endings, curve.ending) != endings.end() &&
         (!curve.ending.empty() || std::ranges::all_of(curve.charts, [&](Index chart) { return hasChart(chart); }));
}

std::optional<Vec3> LeafGeometry::nearestCurvePosition(const std::vector<std::vector<Index>>& endings, const Vec3& p)
{
  const auto wanted = [&](const FeatureEdge& edge) { return isOneOf(edge, endings); };
  std::optional<Vec3> found = nearestOnCurves(p, wanted);
  if (!found)
  {
    addNeighbors();
    found = nearestOnCurves(p, wanted);
  }
  if (!found)
  {
    found = nearestOnCurves(p, [&](const FeatureEdge& edge) {
      const std::vector<Index>& ending = model.curves[edge.curve].ending;
      return std::ranges::any_of(endings, [&](const std::vector<Index>& e) {
        return std::ranges::any_of(e, [&](Index chart) { return std::ranges::binary_search(ending, chart); });
      });
    });
  }
  return found ? std::optional(onPlanes(*found)) : std::nullopt;
}

/// Adds the leaves at the 26 places beside the leaf.
void LeafGeometry::addNeighbors()
{
  const std::int64_t size = box.high[0] - box.low[0];
  const std::int64_t end = frame.latticeSize(0);
  for (int i = 0; i < 27; ++i)
  {
    const LatticePoint p{box.low[0] + size / 2 + (i % 3 - 1) * size, box.low[1] + size / 2 + (i / 3 % 3 - 1) * size,
                         box.low[2] + size / 2 + (i / 9 - 1) * size};
    if (std::ranges::all_of(p, [&](std::int64_t c) { return c >= 0 && c < end; }))
    {
      const Index leaf = octree.leafAt(p);
      if (std::ranges::find(leaves, leaf) == leaves.end())
      {
        leaves.push_back(leaf);
      }
    }
  }
}

bool LeafGeometry::misses(const Vec3& p) const
{
  const double allowed = coincidentRatio * frame.finestSize;
  return charts_.size() > 1 && std::ranges::any_of(charts_, [&](Index chart) {
           const auto nearest = nearestOnPieces(p, [&](Index c) { return c == chart; });
           return nearest && (*nearest - p).norm() > allowed;
         });
}

/// Returns the middle of those parts of wanted curves that the leaf owns, moved to the nearest place on them.
template <typename Wanted> std::optional<Vec3> LeafGeometry::middleOfPieces(Wanted&& wanted)
{
  segments.clear();
  Vec3 weighted = Vec3::Zero();
  double length = 0.0;
  for (const ModelItem piece : octree.items(leaf_))
  {
    if (piece.kind != ModelItem::featureEdge)
    {
      continue;
    }
    const FeatureEdge& edge = model.featureEdges[piece.index];
    const LatticePoint& p = model.points[edge.a];
    const LatticePoint& q = model.points[edge.b];
    const SegmentRange range = clipSegment(box, p, q);
    if (range.begin >= range.end || !owns(pointAlong(p, q, 0.5 * (range.begin + range.end))) || !wanted(edge))
    {
      continue;
    }
    const Vec3 a = modelPoint(edge.a);
    const Vec3 along = modelPoint(edge.b) - a;
    segments.emplace_back(a + range.begin * along, a + range.end * along);
    const double part = (range.end - range.begin) * along.norm();
    weighted += part * 0.5 * (segments.back().first + segments.back().second);
    length += part;
  }
  return length > 0.0 ? nearestOfSegments(weighted / length) : std::nullopt;
}

/// Returns the point nearest to p of wanted curves in `leaves`; on domain planes, of the places where curves meet them.
template <typename Wanted> std::optional<Vec3> LeafGeometry::nearestOnCurves(const Vec3& p, Wanted&& wanted)
{
  segments.clear();
  for (const Index leaf : leaves)
  {
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind == ModelItem::featureEdge && wanted(model.featureEdges[piece.index]))
      {
        const FeatureEdge& edge = model.featureEdges[piece.index];
        segments.emplace_back(modelPoint(edge.a), modelPoint(edge.b));
      }
    }
  }
  if (planes != 0)
  {
    if (auto meeting = whereSegmentsMeetPlanes(p))
    {
      return meeting;
    }
  }
  return nearestOfSegments(p);
}

std::optional<Vec3> LeafGeometry::nearestOfSegments(const Vec3& p) const
{
  NearestPlace best{p};
  for (const auto& [a, b] : segments)
  {
    best.offer(nearestOnSegment(p, a, b));
  }
  return best.place();
}

std::optional<Vec3> LeafGeometry::whereSegmentsMeetPlanes(const Vec3& p) const
{
  NearestPlace best{p};
  for (const auto& [a, b] : segments)
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      const int axis = axisOf(direction);
      const double plane = frame.planeOf(direction);
      if ((planes >> direction & 1) == 0 || a[axis] == b[axis])
      {
        continue;
      }
      const double t = (plane - a[axis]) / (b[axis] - a[axis]);
      if (t >= -1e-6 && t <= 1.0 + 1e-6)
      {
        best.offer(a + std::clamp(t, 0.0, 1.0) * (b - a));
      }
    }
  }
  return best.place();
}

/// Returns the nearest point of triangles of wanted charts: those in the leaf and, if there are none or the grid was
/// moved, those in the leaves beside it.
template <typename Wanted> std::optional<Vec3> LeafGeometry::nearestOnPieces(const Vec3& p, Wanted&& wanted) const
{
  NearestPlace best{p};
  for (const Index leaf : leaves)
  {
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind == ModelItem::triangle && wanted(model.charts[piece.index]))
      {
        const auto& t = model.triangles[piece.index];
        best.offer(nearestOnTriangle(p, modelPoint(t[0]), modelPoint(t[1]), modelPoint(t[2])));
      }
    }
    if (best.found() && !isDisplaced)
    {
      break;
    }
  }
  return best.place();
}

} // namespace atria
