// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/UnreachedParts.h"

#include "Octree/Sizing/Refinement.h"
#include "Surface/Model/FeatureGraph.h"
#include "Surface/Triangles/EachEdge.h"

#include <algorithm>

namespace atria {

namespace {

bool isHidden(const TriangleViews& views)
{
  return std::ranges::all_of(views, [](View view) { return view == View::solid || view == View::ground; });
}

/// Takes back pieces that leave an edge with one triangle where there were several.
void keepEdgesClosed(const SurfaceModel& model, std::vector<char>& isUnreached, const Executor& executor)
{
  Index count = 0;
  const std::vector<Index> pieceOf = piecesBetweenEdges(model, count, executor);
  std::vector<char> isLeft(count, 0);
  for (Index t = 0; t < isUnreached.size(); ++t)
  {
    isLeft[pieceOf[t]] |= isUnreached[t];
  }
  const std::vector<SoupEdgeUse> uses = sortedEdgeUses(model.triangles, model.points.size(), executor);
  for (bool changed = true; changed;)
  {
    changed = false;
    eachEdge(uses, [&](std::span<const SoupEdgeUse> edge) {
      const auto left =
          std::ranges::count_if(edge, [&](const auto& use) { return isLeft[pieceOf[use.triangle]] != 0; });
      if (left > 0 && left + 1 == static_cast<std::ptrdiff_t>(edge.size()))
      {
        std::ranges::for_each(edge, [&](const auto& use) { isLeft[pieceOf[use.triangle]] = 0; });
        changed = true;
      }
    });
  }
  std::ranges::transform(pieceOf, isUnreached.begin(), [&](Index piece) { return isLeft[piece]; });
}

SurfaceModel withoutParts(const SurfaceModel& model, const std::vector<char>& isUnreached, const GridFrame& frame,
                          const Executor& executor)
{
  SurfaceModel out;
  out.names = model.names;
  out.kinds = model.kinds;
  out.walls = model.walls;
  out.repair = model.repair;
  out.featureAngle = model.featureAngle;
  std::vector<Index> numbers(model.points.size(), noIndex);
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    if (!isUnreached[t])
    {
      std::ranges::for_each(model.triangles[t], [&](Index p) { numbers[p] = 0; });
    }
  }
  for (Index p = 0; p < numbers.size(); ++p)
  {
    if (numbers[p] != noIndex)
    {
      numbers[p] = static_cast<Index>(out.points.size());
      out.points.push_back(model.points[p]);
    }
  }
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    if (!isUnreached[t])
    {
      const auto [a, b, c] = model.triangles[t];
      out.triangles.push_back({numbers[a], numbers[b], numbers[c]});
      out.surfaceIds.push_back(model.surfaceIds[t]);
      out.domainSides.push_back(model.domainSides[t]);
    }
  }
  findFeatures(out, frame, executor);
  return out;
}

} // namespace

UnreachedParts findUnreachedParts(const Crossings& crossings, const GridPlaces& grid, const Zones& zones,
                                  const std::vector<View>& ofZone, const SurfaceModel& model, const ViewShare& share,
                                  const RunContext& context)
{
  UnreachedParts out;
  if (std::ranges::none_of(ofZone, [](View view) { return view == View::solid || view == View::ground; }))
  {
    return out;
  }
  out.views = findModelViews(crossings, grid, zones, ofZone, model, share, context);
  out.isUnreached.resize(model.triangles.size());
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    const bool canBe = model.domainSides[t] == SurfaceModel::noSide && !model.isPermeable(t) && !model.isTurnedSide(t);
    out.isUnreached[t] = canBe && isHidden(out.views[t]) ? 1 : 0;
  }
  const auto any = [&] { return std::ranges::find(out.isUnreached, 1) != out.isUnreached.end(); };
  if (any())
  {
    keepEdgesClosed(model, out.isUnreached, context.executor);
  }
  return any() ? out : UnreachedParts{};
}

ReachedModel::ReachedModel(const UnreachedParts& parts, const MeshingContext& context)
    : model_(withoutParts(context.model, parts.isUnreached, context.octree.frame(), context.executor)),
      octree_(context.octree.frame(), context.octree.refinedSets(), context.executor), tree_(model_)
{
  locateModel(octree_, model_, context);
}

} // namespace atria
