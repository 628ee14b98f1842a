// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Tree/GeometryLists.h"

#include "Support/FewNumbers.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <bit>

namespace atria {

namespace {

bool touchesPiece(const LatticeBox& box, ModelItem piece, const SurfaceModel& model)
{
  switch (piece.kind)
  {
    case ModelItem::triangle:
      return touches(box, model.corner(piece.index, 0), model.corner(piece.index, 1), model.corner(piece.index, 2));
    case ModelItem::featureEdge:
      return touches(box, model.points[model.featureEdges[piece.index].a],
                     model.points[model.featureEdges[piece.index].b]);
    default:
      return box.contains(model.points[model.corners[piece.index]]);
  }
}

/// Returns the child of an octant whose box holds the triangle off its faces, as it does for most small ones; 8 if
/// there is none.
unsigned childThatHolds(const std::array<LatticeBox, 8>& boxes, const LatticePoint& a, const LatticePoint& b,
                        const LatticePoint& c)
{
  unsigned k = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    k |= a[axis] > boxes[0].high[axis] ? 1u << axis : 0u;
  }
  bool holds = !boxes[0].empty();
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t low = boxes[k].low[axis];
    const std::int64_t high = boxes[k].high[axis];
    holds =
        holds && a[axis] > low && a[axis] < high && b[axis] > low && b[axis] < high && c[axis] > low && c[axis] < high;
  }
  return holds ? k : 8;
}

/// Returns the bits of the boxes of an octant's children that a piece touches. Nothing touches empty boxes.
unsigned childrenTouched(const std::array<LatticeBox, 8>& boxes, ModelItem piece, const SurfaceModel& model)
{
  unsigned bits = 0;
  const auto test = [&](auto&& touchesBox) {
    for (unsigned k = 0; k < 8; ++k)
    {
      bits |= !boxes[k].empty() && touchesBox(boxes[k]) ? 1u << k : 0u;
    }
  };
  if (piece.kind == ModelItem::triangle)
  {
    const auto corner = [&](int i) -> const LatticePoint& { return model.corner(piece.index, i); };
    if (const unsigned k = childThatHolds(boxes, corner(0), corner(1), corner(2)); k < 8)
    {
      return 1u << k;
    }
    TriangleBoxTest triangle(corner(0), corner(1), corner(2));
    test([&](const LatticeBox& box) { return triangle.touches(box); });
  }
  else
  {
    test([&](const LatticeBox& box) { return touchesPiece(box, piece, model); });
  }
  return bits;
}

/// An edge with both ends outside of an octant, to find which of the octant's triangles meet there.
struct OuterEdge
{
  EdgeKey edge;
  Index triangle; ///< position among the octant's triangles
  friend auto operator<=>(const OuterEdge&, const OuterEdge&) = default;
};

/// First triangle that was seen at each point.
class FirstAtPoints
{
public:
  explicit FirstAtPoints(std::size_t most) : slots(std::bit_ceil(2 * most), {noIndex, 0}) {}

  /// Returns the first triangle at the point: the given one if there was none before.
  Index insert(Index point, Index triangle)
  {
    // Separates neighboring numbers (Fibonacci hashing).
    constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;
    std::size_t at = (point * golden) >> 32 & (slots.size() - 1);
    while (slots[at].first != noIndex && slots[at].first != point)
    {
      at = (at + 1) & (slots.size() - 1);
    }
    if (slots[at].first == noIndex)
    {
      slots[at] = {point, triangle};
    }
    return slots[at].second;
  }

private:
  std::vector<std::pair<Index, Index>> slots;
};

/// True if two triangles share an edge or a point within the box.
bool meetIn(const LatticeBox& box, const std::array<Index, 3>& first, const std::array<Index, 3>& second,
            const SurfaceModel& model)
{
  std::array<Index, 3> shared;
  int count = 0;
  for (const Index p : first)
  {
    if (p == second[0] || p == second[1] || p == second[2])
    {
      if (box.contains(model.points[p]))
      {
        return true;
      }
      shared[count++] = p;
    }
  }
  for (int i = 1; i < count; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      if (touches(box, model.points[shared[i]], model.points[shared[j]]))
      {
        return true;
      }
    }
  }
  return false;
}

/// True if `triangles` form several surfaces. Changes their order, and compares pairs, so it is for few of them.
bool areSeveral(const LatticeBox& box, std::span<Index> triangles, const SurfaceModel& model)
{
  // Triangles before `reached` are connected with the first.
  auto reached = triangles.begin() + 1;
  for (auto at = triangles.begin(); at != reached && reached != triangles.end(); ++at)
  {
    reached = std::partition(reached, triangles.end(),
                             [&](Index t) { return meetIn(box, model.triangles[*at], model.triangles[t], model); });
  }
  return reached != triangles.end();
}

/// The same for many triangles. Connects them at points in the box, and at the few edges that may pass through it
/// without a point in it, which it sorts.
bool areSeveralOfMany(const LatticeBox& box, std::span<const Index> triangles, const SurfaceModel& model)
{
  UnionFind sets(triangles.size());
  FirstAtPoints firstAt(3 * triangles.size());
  std::vector<OuterEdge> edges;
  for (Index i = 0; i < triangles.size(); ++i)
  {
    const auto& t = model.triangles[triangles[i]];
    const auto isIn = [&](int k) { return box.contains(model.points[t[k]]); };
    const std::array<bool, 3> inside{isIn(0), isIn(1), isIn(2)};
    for (int e = 0; e < 3; ++e)
    {
      if (inside[e])
      {
        sets.join(firstAt.insert(t[e], i), i);
      }
      else if (!inside[(e + 1) % 3])
      {
        edges.push_back({edgeKey(t, e), i});
      }
    }
  }
  std::ranges::sort(edges);
  for (std::size_t i = 1; i < edges.size(); ++i)
  {
    const auto& [edge, triangle] = edges[i];
    if (edges[i - 1].edge == edge && touches(box, model.points[edge.first], model.points[edge.second]))
    {
      sets.join(edges[i - 1].triangle, triangle);
    }
  }
  for (Index i = 1; i < triangles.size(); ++i)
  {
    if (sets.find(i) != 0)
    {
      return true;
    }
  }
  return false;
}

std::vector<ModelItem> allPieces(const SurfaceModel& model, const GridFrame& frame)
{
  const LatticeBox box = domainBoxOf(frame, 0, 0);
  std::vector<ModelItem> pieces;
  const auto add = [&](ModelItem::Kind kind, std::size_t count) {
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const ModelItem piece{kind, i};
      if (touchesPiece(box, piece, model))
      {
        pieces.push_back(piece);
      }
    }
  };
  add(ModelItem::triangle, model.triangles.size());
  add(ModelItem::featureEdge, model.featureEdges.size());
  add(ModelItem::corner, model.corners.size());
  return pieces;
}

void appendLeaves(const Octree& octree, const LatticeBox& box, Octree::Node node, int level, MortonKey key,
                  std::vector<Index>& out)
{
  const GridCell cell = gridCell(key);
  const std::int64_t size = octree.frame().latticeSize(level);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (cell[axis] * size > box.high[axis] || (cell[axis] + 1) * size < box.low[axis])
    {
      return;
    }
  }
  if (Octree::isLeaf(node))
  {
    out.push_back(Octree::leafOf(node));
    return;
  }
  for (unsigned k = 0; k < 8; ++k)
  {
    appendLeaves(octree, box, octree.children(node)[k], level + 1, key << 3 | k, out);
  }
}

} // namespace

void GeometryLists::append(MortonKey key, std::span<const ModelItem> pieces)
{
  keys.push_back(key);
  items.insert(items.end(), pieces.begin(), pieces.end());
  offsets.push_back(items.size());
}

void GeometryLists::append(const GeometryLists& other)
{
  const std::size_t shift = items.size();
  keys.insert(keys.end(), other.keys.begin(), other.keys.end());
  items.insert(items.end(), other.items.begin(), other.items.end());
  for (std::size_t i = 1; i < other.offsets.size(); ++i)
  {
    offsets.push_back(other.offsets[i] + shift);
  }
}

LatticeBox domainBoxOf(const GridFrame& frame, int level, MortonKey key)
{
  const GridCell cell = gridCell(key);
  const std::int64_t size = frame.latticeSize(level);
  LatticeBox box;
  bool apart = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = std::max(cell[axis] * size, frame.domainLow[axis]);
    box.high[axis] = std::min((cell[axis] + 1) * size, frame.domainHigh[axis]);
    apart = apart || box.low[axis] >= box.high[axis];
  }
  return apart ? LatticeBox{{1, 1, 1}, {0, 0, 0}} : box;
}

void PieceDivider::find(int level, MortonKey key, std::span<const ModelItem> pieces)
{
  for (unsigned k = 0; k < 8; ++k)
  {
    boxes_[k] = domainBoxOf(frame_, level + 1, key << 3 | k);
  }
  touched_.resize(pieces.size());
  std::ranges::transform(pieces, touched_.begin(), [&](ModelItem piece) {
    return static_cast<std::uint8_t>(childrenTouched(boxes_, piece, model_));
  });
}

std::span<const ModelItem> PieceDivider::take(unsigned k, std::span<const ModelItem> pieces)
{
  taken_.clear();
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if ((touched_[i] >> k & 1) != 0)
    {
      taken_.push_back(pieces[i]);
    }
  }
  return taken_;
}

GeometryLists rootLists(const SurfaceModel& model, const GridFrame& frame)
{
  GeometryLists lists;
  lists.append(0, allPieces(model, frame));
  return lists;
}

GeometryLists sizingLists(const SurfaceModel& model, const GridFrame& frame)
{
  std::vector<ModelItem> pieces = allPieces(model, frame);
  std::vector<char> sideCharts(model.triangles.size(), 0);
  std::vector<char> sidePoints(model.points.size(), 0);
  bool anySide = false;
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    if (model.isTurnedSide(t))
    {
      anySide = true;
      sideCharts[model.charts[t]] = 1;
      std::ranges::for_each(model.triangles[t], [&](Index p) { sidePoints[p] = 1; });
    }
  }
  const auto onSide = [&](ModelItem piece) {
    switch (piece.kind)
    {
      case ModelItem::triangle:
        return model.isTurnedSide(piece.index);
      case ModelItem::featureEdge: {
        const FeatureEdge& edge = model.featureEdges[piece.index];
        return std::ranges::any_of(model.curves[edge.curve].charts,
                                   [&](Index chart) { return sideCharts[chart] != 0; });
      }
      default:
        return sidePoints[model.corners[piece.index]] != 0;
    }
  };
  if (anySide)
  {
    std::erase_if(pieces, onSide);
  }
  GeometryLists lists;
  lists.append(0, pieces);
  return lists;
}

GeometryLists childLists(const GeometryLists& parents, int level, const std::vector<char>& chosen, bool onlyOccupied,
                         const SurfaceModel& model, const GridFrame& frame, const RunContext& context)
{
  // Pieces have a fixed length and are joined in order, so that lists do not depend on threads.
  constexpr std::size_t grain = 16;
  std::vector<GeometryLists> parts((parents.size() + grain - 1) / grain);
  context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
    context.progress.check();
    PieceDivider divider(model, frame);
    for (std::size_t i = part * grain; i < std::min((part + 1) * grain, parents.size()); ++i)
    {
      if (chosen[i])
      {
        divider.divide(level, parents.keys[i], parents.of(i),
                       [&](unsigned k, const LatticeBox&, std::span<const ModelItem> pieces) {
                         if (!pieces.empty() || !onlyOccupied)
                         {
                           parts[part].append(parents.keys[i] << 3 | k, pieces);
                         }
                       });
      }
    }
  });
  GeometryLists children;
  for (GeometryLists& part : parts)
  {
    children.append(part);
    part = {};
  }
  return children;
}

std::vector<Index> leavesTouching(const Octree& octree, const LatticeBox& box)
{
  std::vector<Index> leaves;
  appendLeaves(octree, box, octree.root(), 0, 0, leaves);
  return leaves;
}

std::vector<Index> trianglesNear(const Octree& octree, const LatticeBox& box)
{
  std::vector<Index> triangles;
  for (const Index leaf : leavesTouching(octree, box))
  {
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind == ModelItem::triangle)
      {
        triangles.push_back(piece.index);
      }
    }
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

bool severalSurfaces(const LatticeBox& box, std::span<const ModelItem> pieces, const SurfaceModel& model)
{
  constexpr std::ptrdiff_t mostInPairs = 16;
  const auto isTriangle = [](ModelItem piece) { return piece.kind == ModelItem::triangle; };
  const auto count = std::ranges::count_if(pieces, isTriangle);
  if (count < 2)
  {
    return false;
  }
  std::array<Index, mostInPairs> few;
  std::vector<Index> many(count <= mostInPairs ? 0 : static_cast<std::size_t>(count));
  Index* next = many.empty() ? few.data() : many.data();
  for (const ModelItem piece : pieces)
  {
    if (isTriangle(piece))
    {
      *next++ = piece.index;
    }
  }
  return many.empty() ? areSeveral(box, {few.data(), static_cast<std::size_t>(count)}, model)
                      : areSeveralOfMany(box, many, model);
}

bool hasTurnedSide(const Octree& octree, Index leaf, const SurfaceModel& model)
{
  return octree.frame().turnedDomain &&
         std::ranges::any_of(octree.items(leaf, ModelItem::triangle),
                             [&](ModelItem piece) { return model.isTurnedSide(piece.index); });
}

bool isCluster(std::span<const ModelItem> pieces, const SurfaceModel& model)
{
  FewNumbers<mostChartsOfLeaf> charts;
  return !std::ranges::all_of(pieces, [&](ModelItem piece) {
    return piece.kind != ModelItem::triangle || charts.add(model.charts[piece.index]);
  });
}

FeatureType featureTypeOf(const LatticeBox& box, std::span<const ModelItem> pieces, const SurfaceModel& model)
{
  FeatureType type = FeatureType::none;
  for (const ModelItem piece : pieces)
  {
    const auto found = static_cast<FeatureType>(piece.kind + 1);
    type = std::max(type, found);
  }
  if (isCluster(pieces, model))
  {
    return FeatureType::cluster;
  }
  return type == FeatureType::surface && severalSurfaces(box, pieces, model) ? FeatureType::several : type;
}

} // namespace atria
