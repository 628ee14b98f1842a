// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/LayerImprover.h"

#include "Mesher/Improvement/ConcaveElements.h"
#include "Mesher/Improvement/CurvedWalls.h"
#include "Mesher/Improvement/LayerCreases.h"
#include "Mesher/Improvement/LayerDivision.h"
#include "Mesher/Improvement/Straightening.h"
#include "Mesher/Improvement/SupportingLayer.h"

#include <algorithm>
#include <optional>

namespace atria {

namespace {

/// Elements that fall short of targets, and, where there may be layers, those that are concave at walls, in order.
std::vector<ShortCell> findFailing(ImproverState& state, const QualityTargets& targets)
{
  std::vector<ShortCell> failing = state.findShort(targets, 0.0F);
  if (!state.traits.layered)
  {
    return failing;
  }
  for (const Index cell : findConcaveAtWalls(state.layer.mesh, state.context))
  {
    failing.push_back({cell, 0.0F});
  }
  std::ranges::sort(failing, {}, &ShortCell::cell);
  failing.erase(std::unique(failing.begin(), failing.end(),
                            [](const ShortCell& a, const ShortCell& b) { return a.cell == b.cell; }),
                failing.end());
  return failing;
}

/// Elements that stay beyond the largest angle, or bad, lose layers.
void straightenDivided(LayerDivision division, ImproverState& state, VertexDetachment& detachment)
{
  straighten(state, detachment);
  for (int round = 0; round < mostGivenWay; ++round)
  {
    const std::vector<ShortCell> failing = findFailing(state, targetsOfLargestAngle(state.traits));
    state.focus.assign(state.layer.plainPoints, 0);
    if (failing.empty() || !division.giveWay(failing))
    {
      break;
    }
    straighten(state, detachment);
  }
  state.focus.clear();
}

/// Begins a phase, a part of the whole's progress.
void enter(ImproverState& state, const RunContext& whole, double begin, double end, const char* phase)
{
  state.context.progress = whole.progress.part(begin, end);
  state.context.progress.report(0.0, phase);
}

/// What follows where layers are several.
void finishDivided(ImproverState& state, VertexDetachment& detachment, const RunContext& whole)
{
  enter(state, whole, 0.5, 0.7, "Dividing layers");
  supportMore(state, detachment);
  LayerDivision division(state);
  division.run();
  if (!state.traits.hasHeights)
  {
    enter(state, whole, 0.7, 0.9, "Straightening elements");
    straightenDivided(std::move(division), state, detachment);
  }
}

/// What follows where they are single, or none.
void finishWhole(ImproverState& state, VertexDetachment& detachment, CurvedWalls* curved, const RunContext& whole)
{
  if (curved)
  {
    enter(state, whole, 0.5, 0.7, "Improving elements at curved walls");
    curved->improve();
  }
  enter(state, whole, 0.7, 0.9, "Straightening elements");
  straighten(state, detachment);
  supportMore(state, detachment);
}

} // namespace

ImprovedLayer improveLayer(const MeshingContext& context, const VertexClassification& classification,
                           const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                           const LayerOptions& options, const CurvedWallTargets& curvedWalls)
{
  ImproverState state(context, classification, vertexOf, plain, walls, options);
  const MeshTraits& traits = state.traits;
  VertexDetachment detachment(state);
  std::optional<CurvedWalls> curved;
  enter(state, context, 0.0, 0.1, "Growing layers");
  state.grow();
  enter(state, context, 0.1, 0.4, "Improving elements at walls");
  if (traits.isSingle())
  {
    curved.emplace(state, curvedWalls);
  }
  const bool isCurved = curved && !curved->isEmpty();
  state.measureBy(strictestTargets(traits, isCurved ? &curvedWalls : nullptr));
  if (isCurved)
  {
    curved->thicken();
  }
  if (traits.supported)
  {
    addSupport(state, pointsToSupport(state));
    state.focus.clear();
  }
  detachment.improveAndMend();
  enter(state, context, 0.4, 0.5, "Putting vertices back");
  detachment.putBack();
  if (traits.divided)
  {
    finishDivided(state, detachment, context);
  }
  else
  {
    finishWhole(state, detachment, isCurved ? &*curved : nullptr, context);
  }
  if (traits.isSingle() && traits.uniform)
  {
    enter(state, context, 0.9, 1.0, "Adding crease sheets");
    addCreaseSheets(state);
  }
  ImprovedLayer out;
  for (const ShortCell& cell : findFailing(state, targetsOfChecks(traits)))
  {
    out.failing.push_back(cell.cell);
  }
  out.layer = std::move(state.layer);
  out.detached = detachment.detached();
  return out;
}

} // namespace atria
