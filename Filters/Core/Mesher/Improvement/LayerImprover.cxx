// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/LayerImprover.h"

#include "Mesher/Improvement/ConcaveElements.h"
#include "Mesher/Improvement/LayerCreases.h"
#include "Mesher/Improvement/LayerDivision.h"
#include "Mesher/Improvement/Straightening.h"
#include "Mesher/Improvement/SupportingLayer.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

/// Returns elements that fall short of targets and, where there may be layers, those concave at walls, sorted.
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

/// Straightens elements, and takes layers away from those that stay bad or beyond the largest angle.
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

/// Begins a phase, which is a part of the whole progress.
void enter(ImproverState& state, const RunContext& whole, double begin, double end, const char* phase)
{
  state.context.progress = whole.progress.part(begin, end);
  state.context.progress.report(0.0, phase);
}

/// Runs the last stages of several layers.
void finishDivided(ImproverState& state, VertexDetachment& detachment, const RunContext& whole)
{
  enter(state, whole, 0.5, 0.7, "Dividing layers");
  if (!state.walls.settled.areDivided)
  {
    flattenTops(state);
  }
  supportMore(state, detachment); // flattening may leave elements concave at walls
  LayerDivision division(state);
  division.run();
  enter(state, whole, 0.7, 0.9, "Straightening elements");
  straightenDivided(std::move(division), state, detachment);
}

/// Runs the last stages of single layers, or none.
void finishWhole(ImproverState& state, VertexDetachment& detachment, CurvedWalls* curved, const RunContext& whole)
{
  if (curved)
  {
    enter(state, whole, 0.5, 0.7, "Improving elements at curved walls");
    curved->improve();
  }
  enter(state, whole, 0.7, 0.9, "Straightening elements");
  straighten(state, detachment);
  for (int round = 0; state.traits.wraps && round < roundsOfHexahedra; ++round)
  {
    state.run(hexahedraStage(state.traits), state.findShort(targetsOfHexahedra()));
  }
  supportMore(state, detachment);
}

} // namespace

std::vector<Index> findFailing(ImproverState& state)
{
  std::vector<Index> cells;
  std::ranges::transform(findFailing(state, targetsOfChecks(state.traits)), std::back_inserter(cells),
                         &ShortCell::cell);
  return cells;
}

LayerImprover::LayerImprover(ImproverState& state, const CurvedWallTargets& curvedWalls,
                             const std::vector<DetachedVertex>& away)
    : state_(state), whole_(state.context), wanted_(curvedWalls), detachment_(state, away)
{
  enter(state_, whole_, 0.0, 0.1, "Growing layers");
  state_.grow();
  if (state_.traits.isSingle())
  {
    curved_.emplace(state_, wanted_);
  }
  if (curved_ && curved_->isEmpty())
  {
    curved_.reset();
  }
  state_.measureBy(strictestTargets(state_.traits, curved_ ? &wanted_ : nullptr));
}

void LayerImprover::improveWhole()
{
  enter(state_, whole_, 0.1, 0.4, "Improving elements at walls");
  if (curved_)
  {
    curved_->thicken();
  }
  if (state_.traits.supported)
  {
    addSupport(state_, pointsToSupport(state_));
    state_.focus.clear();
  }
  detachment_.improveAndMend();
  enter(state_, whole_, 0.4, 0.5, "Putting vertices back");
  detachment_.putBack();
}

void LayerImprover::finish()
{
  if (state_.traits.divided)
  {
    finishDivided(state_, detachment_, whole_);
  }
  else
  {
    finishWhole(state_, detachment_, curved_ ? &*curved_ : nullptr, whole_);
  }
  restoreHeights(state_);
}

ImprovedLayer improveLayer(const MeshingContext& context, const VertexClassification& classification,
                           const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                           const LayerOptions& options, const CurvedWallTargets& curvedWalls)
{
  ImproverState state(context, classification, vertexOf, plain, walls, options,
                      traitsOf(plain, options, flatLayers(plain, options)));
  LayerImprover improver(state, curvedWalls);
  improver.improveWhole();
  improver.finish();
  if (state.traits.isSingle() && state.traits.hexahedral)
  {
    enter(state, MeshingContext(state.context), 0.9, 1.0, "Adding crease sheets");
    addCreaseSheets(state);
  }
  std::vector<Index> failing = findFailing(state);
  std::vector<double> wallSizes = sizesBesideWalls(plain, walls, context);
  return {std::move(state.layer), improver.detached(), std::move(failing), std::move(wallSizes)};
}

} // namespace atria
