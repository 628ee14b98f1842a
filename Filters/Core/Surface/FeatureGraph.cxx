// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/FeatureGraph.h"

#include "Support/UnionFind.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace atria {

namespace {

/// One use of an edge by a triangle; `forward` if the triangle runs from a to b.
struct EdgeUse
{
  Index a;
  Index b;
  Index triangle;
  bool forward;

  bool sameEdge(const EdgeUse& other) const { return a == other.a && b == other.b; }
};

std::vector<EdgeUse> edgeUses(const SurfaceModel& model)
{
  std::vector<EdgeUse> uses;
  uses.reserve(3 * model.triangles.size());
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Index p = model.triangles[t][i];
      const Index q = model.triangles[t][(i + 1) % 3];
      uses.push_back({std::min(p, q), std::max(p, q), t, p < q});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& l, const EdgeUse& r) {
    return std::tie(l.a, l.b, l.triangle) < std::tie(r.a, r.b, r.triangle);
  });
  return uses;
}

Vec3 vectorBetween(const SurfaceModel& model, Index from, Index to)
{
  const LatticePoint& p = model.points[from];
  const LatticePoint& q = model.points[to];
  return {static_cast<double>(q[0] - p[0]), static_cast<double>(q[1] - p[1]), static_cast<double>(q[2] - p[2])};
}

/// Both ends of the edge lie on the same two domain planes.
bool onDomainEdge(const SurfaceModel& model, const GridFrame& frame, const EdgeUse& edge)
{
  int planes = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t p = model.points[edge.a][axis];
    const std::int64_t q = model.points[edge.b][axis];
    planes += p == q && (p == frame.domainLow[axis] || p == frame.domainHigh[axis]) ? 1 : 0;
  }
  return planes >= 2;
}

/// The kind of curve that the uses [first, last) of one edge make; nothing where the surface is smooth there.
std::optional<CurveKind> kindOf(const SurfaceModel& model, const EdgeUse* first, const EdgeUse* last,
                                double minimumCosine)
{
  const auto count = last - first;
  if (count == 1)
  {
    return CurveKind::rim;
  }
  if (count > 2)
  {
    return CurveKind::junction;
  }
  const Index s = first[0].triangle;
  const Index t = first[1].triangle;
  // Triangles wound alike run through their edge in opposite senses.
  const double orientation = first[0].forward != first[1].forward ? 1.0 : -1.0;
  if (orientation * model.normal(s).normalized().dot(model.normal(t).normalized()) < minimumCosine)
  {
    return CurveKind::crease;
  }
  if (model.surfaceIds[s] != model.surfaceIds[t] || model.domainSides[s] != model.domainSides[t])
  {
    return CurveKind::border;
  }
  return std::nullopt;
}

void findCorners(SurfaceModel& model, double minimumCosine)
{
  // Up to two neighbours along curves for each point; a third makes it a corner at once.
  std::vector<std::array<Index, 2>> along(model.points.size(), {noIndex, noIndex});
  std::vector<std::uint32_t> degree(model.points.size(), 0);
  for (const FeatureEdge& edge : model.featureEdges)
  {
    for (const auto& [p, q] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)})
    {
      if (degree[p] < 2)
      {
        along[p][degree[p]] = q;
      }
      ++degree[p];
    }
  }
  for (Index p = 0; p < model.points.size(); ++p)
  {
    if (degree[p] == 0)
    {
      continue;
    }
    const bool turns =
        degree[p] == 2 &&
        vectorBetween(model, along[p][0], p).normalized().dot(vectorBetween(model, p, along[p][1]).normalized()) <
            minimumCosine;
    if (degree[p] != 2 || turns)
    {
      model.corners.push_back(p);
    }
  }
}

void nameCharts(SurfaceModel& model, UnionFind& sets)
{
  model.charts.resize(model.triangles.size());
  Index count = 0;
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    const Index root = sets.find(t); // the smallest of its set, so named before
    model.charts[t] = root == t ? count++ : model.charts[root];
  }
}

} // namespace

void findFeatures(SurfaceModel& model, const GridFrame& frame, const FeatureOptions& options)
{
  const double minimumCosine = std::cos(options.featureAngle * std::numbers::pi / 180.0);
  const std::vector<EdgeUse> uses = edgeUses(model);
  UnionFind sets(model.triangles.size());
  std::vector<std::array<Index, 2>> curveTriangles;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end)
  {
    for (end = begin + 1; end < uses.size() && uses[end].sameEdge(uses[begin]); ++end)
    {
    }
    const EdgeUse& edge = uses[begin];
    const auto kind = kindOf(model, uses.data() + begin, uses.data() + end, minimumCosine);
    if (!kind)
    {
      sets.join(uses[begin].triangle, uses[begin + 1].triangle);
    }
    else if (!onDomainEdge(model, frame, edge))
    {
      model.featureEdges.push_back({edge.a, edge.b, *kind, {}});
      curveTriangles.push_back({edge.triangle, uses[end - 1].triangle});
    }
  }
  nameCharts(model, sets);
  for (std::size_t i = 0; i < curveTriangles.size(); ++i)
  {
    model.featureEdges[i].charts = {model.charts[curveTriangles[i][0]], model.charts[curveTriangles[i][1]]};
  }
  findCorners(model, minimumCosine);
}

} // namespace atria
