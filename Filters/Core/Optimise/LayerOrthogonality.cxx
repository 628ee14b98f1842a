// SPDX-License-Identifier: GPL-3.0-or-later
// What is valid is brought within the angles that solvers do well with.
#include "Optimise/LayerCells.h"
#include "Optimise/LayerGuide.h"
#include "Optimise/LayerImprover.h"

#include <algorithm>

namespace atria {

namespace {

/// Cells below this share of what a stage aims at are looked at.
constexpr float enough = 0.5F;
constexpr float enoughOfDivided = 0.3F;
/// Degrees of non-orthogonality: 60, beyond which vertices leave where the model wants them, to 55.9.
constexpr QualityRange acceptable{0.5, 0.56};
/// How far, in octants, vertices may leave their surfaces where nothing else helps, one after the other.
constexpr std::array reaches{0.2, 0.4, 0.75};

} // namespace

/// A range of faces' cosines to hold cells to, and the rings of cells that make room.
struct LayerImprover::OrthogonalityStage
{
  QualityRange faceCosine;
  int rings;
};

QualityTargets LayerImprover::targetsOf(const OrthogonalityStage& stage) const
{
  QualityTargets out = targets();
  out.faceCosine = stage.faceCosine;
  out.leastOfFaceCosine = leastOfOthers;
  return out;
}

/// Cells below a share of targets.
std::vector<ShortCell> LayerImprover::findBelow(const LayerMesh& layer, const QualityTargets& wanted, float share,
                                                const std::vector<char>& toJudge) const
{
  std::vector<ShortCell> cells = findShortCells(DualSource(layer.mesh), toJudge, wanted, context_);
  std::erase_if(cells, [&](const ShortCell& cell) { return cell.worst >= share; });
  return cells;
}

/// Marks the points of cells that fall short then, too. The limit rises in stages: held to the last one at once, cells
/// that are far from it find no way there.
void LayerImprover::straighten(LayerMesh& layer, std::span<const OrthogonalityStage> stages, float share,
                               std::vector<char>& toJudge) const
{
  ModelGuide model(octree_, model_, tree_, anchors_, layer.mesh.points, vertexOf_);
  LayerGuide guide(layer, walls_, options_, leaders_, letGo_, model);
  for (const OrthogonalityStage& stage : stages)
  {
    OptimiserOptions options;
    options.targets = targetsOf(stage);
    options.leastWorst = leastOfOthers;
    options.rings = stage.rings;
    options.patient = true;
    const DualSource source(layer.mesh);
    const std::vector<ShortCell> cells = findBelow(layer, options.targets, share, toJudge);
    // Cells farther from the walls may have made room.
    for (const ShortCell& cell : optimise(source, layer.mesh.points, cells, guide, options, context_))
    {
      for (const Index p : layer.mesh.corners[cell.cell])
      {
        toJudge[p] = 1;
      }
    }
  }
}

/// Vertices at faces that stay beyond the largest angle leave their curves, and their surfaces by a little.
void LayerImprover::straighten()
{
  // Degrees of non-orthogonality: 72.5 to 60, 66.4 to 57.3, 59.3 to 55.9.
  constexpr std::array stages{OrthogonalityStage{{0.3, 0.5}, 2}, OrthogonalityStage{{0.4, 0.54}, 2},
                              OrthogonalityStage{{0.51, 0.56}, 2}, OrthogonalityStage{{0.51, 0.56}, 2}};
  std::vector<char> toJudge = pointsToJudge(layer_);
  // What is within the last stage is within all others.
  if (findBelow(layer_, targetsOf(stages.back()), enough, toJudge).empty())
  {
    return;
  }
  straighten(layer_, stages, enough, toJudge);
  QualityTargets largest = targets();
  largest.faceCosine = acceptable;
  for (const double reach : reaches)
  {
    const std::vector<ShortCell> beyond = findBelow(layer_, largest, 0.0F, toJudge);
    if (beyond.empty())
    {
      break;
    }
    release(beyond, reach);
    straighten(layer_, stages, enough, toJudge);
  }
  keepThoseAway();
}

/// There are many cells, and a limit as high as with one layer would take long.
void LayerImprover::straightenDivided(LayerMesh& divided) const
{
  constexpr std::array stages{OrthogonalityStage{{0.2, 0.4}, 1}, OrthogonalityStage{{0.35, 0.5}, 1}};
  std::vector<char> toJudge = pointsToJudge(divided);
  straighten(divided, stages, enoughOfDivided, toJudge);
}

} // namespace atria
