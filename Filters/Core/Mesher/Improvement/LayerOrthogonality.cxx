// SPDX-License-Identifier: GPL-3.0-or-later
// What is valid is brought within the angles that solvers do well with.
#include "Mesher/Improvement/LayerCells.h"
#include "Mesher/Improvement/PathConstraints.h"
#include "Optimize/Constraints/ChainConstraints.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <functional>

namespace atria {

namespace {

/// Cells below this share of what a stage aims at are looked at.
constexpr float enough = 0.5F;
constexpr float enoughOfDivided = 0.3F;
/// Degrees of non-orthogonality: 60, beyond which vertices leave where the model wants them, to 55.9.
constexpr QualityRange acceptable{0.5, 0.56};
/// 71.9 to 66.4.
constexpr QualityRange acceptableOfDivided{0.31, 0.4};
/// Of divided layers, the share of the way to targets at which measures other than angles are left alone.
constexpr double guardedShare = 0.6;
/// Limit of pyramid cosines, a cell squish of 0.93: well above what is valid, so that cells come below 0.9.
constexpr double leastPyramidCosine = 0.07;
/// How far, in octants, vertices may leave their surfaces where nothing else helps, one after the other.
constexpr std::array reaches{0.4, 0.75};

} // namespace

/// A range of faces' cosines to hold cells to.
struct LayerImprover::OrthogonalityStage
{
  QualityRange faceCosine;
  bool byChains = false; ///< whether chains of divided layers move as a whole
};

QualityTargets LayerImprover::targetsOf(const OrthogonalityStage& stage) const
{
  QualityTargets out = targets();
  out.pyramidCosine.limit = leastPyramidCosine;
  if (divided_)
  {
    out = out.within(guardedShare);
  }
  out.faceCosine = stage.faceCosine;
  out.leastOfFaceCosine = leastOfOthers;
  return out;
}

/// What no later pass asks more than.
QualityTargets LayerImprover::strictest() const
{
  QualityTargets out = curved_.empty() ? targets() : targetsAtCurved(curvedWalls_);
  out.faceCosine.target = std::max(out.faceCosine.target, acceptable.target);
  out.scaledJacobian = targets().scaledJacobian;
  return out;
}

/// Of some cells, those below a share of targets.
std::vector<ShortCell> LayerImprover::findBelow(const QualityTargets& wanted, float share,
                                                const std::vector<Index>& cells) const
{
  std::vector<ShortCell> found = findShortAmong(DualSource(layer_.mesh), cells, wanted, context_);
  std::erase_if(found, [&](const ShortCell& cell) { return cell.worst >= share; });
  return found;
}

/// `candidates` are all cells at the points marked that may be below the share of a stage. Cells farther from the walls
/// that fall short after one are marked, too. The limit rises in stages: held to the last one at once, cells that are
/// far from it find no way there.
void LayerImprover::straighten(std::span<const OrthogonalityStage> stages, float share, std::vector<char>& toEvaluate,
                               std::vector<Index>& candidates)
{
  Constraints constraints(*this);
  ChainConstraints chains(layer_, constraints.layer);
  const DualSource source(layer_.mesh);
  for (const OrthogonalityStage& stage : stages)
  {
    VertexConstraints& allowed = stage.byChains ? static_cast<VertexConstraints&>(chains) : constraints.layer;
    OptimizerOptions options;
    options.targets = targetsOf(stage);
    options.leastWorst = leastOfOthers;
    options.patient = true;
    options.leastPenalty = 0.1; // cells looked at are short by more
    std::vector<Index> changed;
    const std::vector<ShortCell> left =
        optimize(source, layer_.mesh.points, findBelow(options.targets, share, candidates), allowed, options, context_,
                 &changed);
    std::vector<char> fresh(toEvaluate.size(), 0);
    for (const ShortCell& cell : left)
    {
      for (const Index p : layer_.mesh.corners[cell.cell])
      {
        fresh[p] = toEvaluate[p] ? 0 : 1;
      }
    }
    std::ranges::transform(toEvaluate, fresh, toEvaluate.begin(), std::bit_or());
    changed = withNeighbors(source, changed, context_);
    std::erase_if(changed, [&](Index cell) { return !source.hasMarked(cell, toEvaluate); });
    mergeUnique(candidates, changed);
    mergeUnique(candidates, cellsWithMarked(source, fresh, context_));
  }
}

/// Vertices at faces that stay beyond the largest angle leave their curves, and their surfaces by a little.
void LayerImprover::straightenOrDetach(std::span<const OrthogonalityStage> stages, float share,
                                       const QualityRange& largest, std::vector<char>& toEvaluate,
                                       std::vector<Index>& candidates)
{
  straighten(stages, share, toEvaluate, candidates);
  QualityTargets wanted = targets();
  wanted.faceCosine = largest;
  for (const double reach : reaches)
  {
    const std::vector<ShortCell> beyond = findBelow(wanted, 0.0F, candidates);
    if (beyond.empty())
    {
      break;
    }
    detach(beyond, reach);
    straighten(stages, share, toEvaluate, candidates);
  }
  keepThoseAway();
}

void LayerImprover::straighten()
{
  // Degrees of non-orthogonality: 72.5 to 60, 66.4 to 57.3, 59.3 to 55.9.
  constexpr std::array stages{OrthogonalityStage{{0.3, 0.5}}, OrthogonalityStage{{0.4, 0.54}},
                              OrthogonalityStage{{0.51, acceptable.target}},
                              OrthogonalityStage{{0.51, acceptable.target}}};
  std::vector<char> toEvaluate = pointsToEvaluate(layer_, context_.executor);
  const DualSource source(layer_.mesh);
  std::erase_if(unsure_, [&](Index cell) { return !source.hasMarked(cell, toEvaluate); });
  // What is within the last stage is within all others.
  std::vector<Index> candidates = cellsOf(findBelow(targetsOf(stages.back()), enough, unsure_));
  if (!candidates.empty())
  {
    straightenOrDetach(stages, enough, acceptable, toEvaluate, candidates);
  }
}

/// There are many cells, and a limit as high as with one layer would take long.
void LayerImprover::straightenDivided()
{
  constexpr std::array stages{OrthogonalityStage{{0.2, 0.4}, true}, OrthogonalityStage{{0.2, 0.4}},
                              OrthogonalityStage{{0.35, 0.5}, true}, OrthogonalityStage{{0.35, 0.5}}};
  std::vector<char> toEvaluate = pointsToEvaluate(layer_, context_.executor);
  std::vector<Index> candidates;
  for (const ShortCell& cell : findShortCells(DualSource(layer_.mesh), toEvaluate, targetsOf(stages.back()), context_))
  {
    if (cell.worst < enoughOfDivided)
    {
      candidates.push_back(cell.cell);
    }
  }
  straightenOrDetach(stages, enoughOfDivided, acceptableOfDivided, toEvaluate, candidates);
}

} // namespace atria
