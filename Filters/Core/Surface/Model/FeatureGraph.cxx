// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Model/FeatureGraph.h"

#include "Support/Angles.h"
#include "Support/Pieces.h"
#include "Support/UnionFind.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace atria {

namespace {

Vec3 vectorBetween(const SurfaceModel& model, Index from, Index to)
{
  const LatticePoint& p = model.points[from];
  const LatticePoint& q = model.points[to];
  return {static_cast<double>(q[0] - p[0]), static_cast<double>(q[1] - p[1]), static_cast<double>(q[2] - p[2])};
}

/// True if both ends of the edge lie on the same two domain planes.
bool onDomainEdge(const SurfaceModel& model, const GridFrame& frame, const SoupEdgeUse& use)
{
  int planes = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t p = model.points[use.edge.first][axis];
    const std::int64_t q = model.points[use.edge.second][axis];
    planes += p == q && (p == frame.domainLow[axis] || p == frame.domainHigh[axis]) ? 1 : 0;
  }
  return planes >= 2;
}

/// Returns the kind of curve that the uses [first, last) of one edge make; nullopt if the surface is smooth there.
std::optional<CurveKind> kindOf(const SurfaceModel& model, const SoupEdgeUse* first, const SoupEdgeUse* last,
                                double minimumCosine)
{
  const auto count = last - first;
  if (count == 1)
  {
    return CurveKind::boundary;
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

/// Kind of an edge and the charts of its triangles, before curves are named.
using EdgeProfile = std::pair<CurveKind, std::vector<Index>>;

/// The feature edges at each point, up to two; more than two make it a corner at once.
struct PointCurves
{
  std::array<Index, 2> edges{noIndex, noIndex};
  std::uint32_t degree = 0;
};

std::vector<PointCurves> curvesAtPoints(const SurfaceModel& model)
{
  std::vector<PointCurves> at(model.points.size());
  for (Index e = 0; e < model.featureEdges.size(); ++e)
  {
    for (const Index p : {model.featureEdges[e].a, model.featureEdges[e].b})
    {
      if (at[p].degree < 2)
      {
        at[p].edges[at[p].degree] = e;
      }
      ++at[p].degree;
    }
  }
  return at;
}

/// True if the two edges at a point continue each other as one curve.
bool runsThrough(const SurfaceModel& model, Index p, const PointCurves& at, const std::vector<EdgeProfile>& profiles,
                 double minimumCosine)
{
  if (at.degree != 2 || profiles[at.edges[0]] != profiles[at.edges[1]])
  {
    return false;
  }
  const auto otherEnd = [&](Index e) {
    const FeatureEdge& edge = model.featureEdges[e];
    return edge.a == p ? edge.b : edge.a;
  };
  const Vec3 before = vectorBetween(model, otherEnd(at.edges[0]), p).normalized();
  const Vec3 after = vectorBetween(model, p, otherEnd(at.edges[1])).normalized();
  return before.dot(after) >= minimumCosine;
}

std::vector<Index> endingCharts(const std::vector<Index>& charts)
{
  std::vector<Index> ending;
  for (const Index chart : charts)
  {
    if (!ending.empty() && ending.back() == chart)
    {
      ending.pop_back();
    }
    else
    {
      ending.push_back(chart);
    }
  }
  return ending;
}

/// Finds corners, and the curves between them.
void findCurves(SurfaceModel& model, const std::vector<EdgeProfile>& profiles, double minimumCosine)
{
  const std::vector<PointCurves> at = curvesAtPoints(model);
  UnionFind sets(model.featureEdges.size());
  for (Index p = 0; p < model.points.size(); ++p)
  {
    if (at[p].degree == 0)
    {
      continue;
    }
    if (runsThrough(model, p, at[p], profiles, minimumCosine))
    {
      sets.join(at[p].edges[0], at[p].edges[1]);
    }
    else
    {
      model.corners.push_back(p);
    }
  }
  for (Index e = 0; e < model.featureEdges.size(); ++e)
  {
    const Index root = sets.find(e); // the smallest of its set, so named before
    if (root == e)
    {
      model.curves.push_back({profiles[e].first, profiles[e].second, endingCharts(profiles[e].second)});
    }
    model.featureEdges[e].curve =
        root == e ? static_cast<Index>(model.curves.size() - 1) : model.featureEdges[root].curve;
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

std::vector<std::vector<Index>> surfacesOfCurves(const SurfaceModel& model)
{
  // Borders separate charts, so a chart belongs to one surface.
  std::vector<Index> surfaceOf(model.triangles.size(), noIndex);
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    surfaceOf[model.charts[t]] = model.surfaceIds[t];
  }
  std::vector<std::vector<Index>> surfaces;
  for (const FeatureCurve& curve : model.curves)
  {
    std::vector<Index>& found = surfaces.emplace_back();
    std::transform(curve.charts.begin(), curve.charts.end(), std::back_inserter(found),
                   [&](Index chart) { return surfaceOf[chart]; });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }
  return surfaces;
}

BoundaryEdges boundaryOf(const SurfaceModel& model, const Executor& executor)
{
  return {model.triangles, model.points.size(), executor, [&](Index t) {
            return model.domainSides[t] == SurfaceModel::noSide && !model.isTurnedSide(t) && !model.isPermeable(t);
          }};
}

void findFeatures(SurfaceModel& model, const GridFrame& frame, const Executor& executor)
{
  const double minimumCosine = cosOfDegrees(model.featureAngle);
  const std::vector<SoupEdgeUse> uses = sortedEdgeUses(model.triangles, model.points.size(), executor);
  std::vector<Index> begins =
      chosenNumbers(uses.size(), executor, [&](std::size_t i) { return i == 0 || uses[i].edge != uses[i - 1].edge; });
  const std::size_t edges = begins.size();
  begins.push_back(static_cast<Index>(uses.size()));
  std::vector<std::optional<CurveKind>> kinds(edges);
  executor.forEach(edges, 2048, [&](std::size_t e) {
    kinds[e] = kindOf(model, uses.data() + begins[e], uses.data() + begins[e + 1], minimumCosine);
  });
  UnionFind sets(model.triangles.size());
  struct Range
  {
    std::size_t begin;
    std::size_t end;
    CurveKind kind;
  };
  std::vector<Range> featureUses;
  for (std::size_t e = 0; e < edges; ++e)
  {
    const Index begin = begins[e];
    if (!kinds[e])
    {
      sets.join(uses[begin].triangle, uses[begin + 1].triangle);
    }
    else if (!onDomainEdge(model, frame, uses[begin]))
    {
      featureUses.push_back({begin, begins[e + 1], *kinds[e]});
    }
  }
  nameCharts(model, sets);
  std::vector<EdgeProfile> profiles;
  for (const Range& range : featureUses)
  {
    model.featureEdges.push_back({uses[range.begin].edge.first, uses[range.begin].edge.second, noIndex});
    std::vector<Index> charts;
    for (std::size_t u = range.begin; u < range.end; ++u)
    {
      charts.push_back(model.charts[uses[u].triangle]);
    }
    std::sort(charts.begin(), charts.end());
    profiles.emplace_back(range.kind, std::move(charts));
  }
  findCurves(model, profiles, minimumCosine);
}

} // namespace atria
