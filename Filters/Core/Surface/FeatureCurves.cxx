// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/FeatureCurves.h"

#include "Support/UnionFind.h"

#include <algorithm>
#include <map>
#include <utility>

namespace atria {

namespace {

void joinEdges(const SurfaceModel& model, UnionFind& sets)
{
  std::vector<char> ends(model.points.size(), 0);
  for (const Index corner : model.corners)
  {
    ends[corner] = 1;
  }
  // The edge seen first at each point, by kind.
  std::map<std::pair<Index, CurveKind>, Index> first;
  for (Index e = 0; e < model.featureEdges.size(); ++e)
  {
    const FeatureEdge& edge = model.featureEdges[e];
    for (const Index p : {edge.a, edge.b})
    {
      if (!ends[p])
      {
        sets.join(e, first.try_emplace({p, edge.kind}, e).first->second);
      }
    }
  }
}

std::vector<std::vector<Index>> surfacesAlong(const SurfaceModel& model)
{
  std::map<std::pair<Index, Index>, Index> edges;
  for (Index e = 0; e < model.featureEdges.size(); ++e)
  {
    edges[std::minmax(model.featureEdges[e].a, model.featureEdges[e].b)] = e;
  }
  std::vector<std::vector<Index>> out(model.featureEdges.size());
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const auto found = edges.find(std::minmax(model.triangles[t][i], model.triangles[t][(i + 1) % 3]));
      if (found != edges.end())
      {
        out[found->second].push_back(model.surfaceIds[t]);
      }
    }
  }
  for (std::vector<Index>& surfaces : out)
  {
    std::sort(surfaces.begin(), surfaces.end());
    surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
  }
  return out;
}

} // namespace

FeatureCurves findFeatureCurves(const SurfaceModel& model)
{
  UnionFind sets(model.featureEdges.size());
  joinEdges(model, sets);
  FeatureCurves out;
  out.curveOf.resize(model.featureEdges.size());
  for (Index e = 0; e < out.curveOf.size(); ++e)
  {
    const Index root = sets.find(e); // the smallest of its set, so numbered before
    out.curveOf[e] = root == e ? static_cast<Index>(out.count++) : out.curveOf[root];
  }
  out.surfaces = surfacesAlong(model);
  return out;
}

} // namespace atria
