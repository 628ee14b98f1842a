// SPDX-License-Identifier: GPL-3.0-or-later
// What is valid is made good at smooth walls.
#include "Optimise/LayerCells.h"
#include "Optimise/LayerImprover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace atria {

namespace {

/// How much thicker a layer of no asked height may be on smooth walls, where nothing beside it needs the room.
constexpr double thicker = 5.0 / 3.0;
/// What hexahedra of a uniform mesh keep of their scaled Jacobian where angles are made better.
constexpr double smoothJacobian = 0.52;
constexpr double leastSmoothJacobian = 0.5;
/// Degrees by which limits lie beyond the targets, stage by stage, and what skewness lies beyond for each.
constexpr std::array stages{10.0, 5.0, 3.0};
constexpr double skewnessPerDegree = 0.03;

double cosineOf(double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); }

} // namespace

/// Whether it is a hexahedron, and all its points on walls are away from creases and rims.
bool LayerImprover::isSmooth(Index cell) const
{
  std::array<Index, 8> corners = layer_.mesh.corners[cell];
  const bool onSmooth = std::ranges::all_of(corners, [&](Index p) {
    const Freedom freedom = anchors_.freedom[vertexOf_[layer_.wallPointOf(p)]];
    return freedom == Freedom::free || freedom == Freedom::surface;
  });
  std::ranges::sort(corners);
  return onSmooth && std::ranges::adjacent_find(corners) == corners.end();
}

/// Points with a copy, of which all cells with it are smooth and good.
std::vector<Index> LayerImprover::smoothPoints(const std::vector<ShortCell>& shortCells) const
{
  std::vector<char> rough(layer_.plainPoints, 0);
  markPoints(layer_, shortCells, rough);
  for (Index e = 0; e < layer_.mesh.elementCount(); ++e)
  {
    const auto& corners = layer_.mesh.corners[e];
    if (std::ranges::any_of(corners, [&](Index p) { return layer_.isNew(p); }) && !isSmooth(e))
    {
      for (const Index p : corners)
      {
        rough[layer_.wallPointOf(p)] = 1;
      }
    }
  }
  std::vector<Index> points;
  for (Index p = 0; p < layer_.plainPoints; ++p)
  {
    if (layer_.copies[p] != noIndex && !rough[p])
    {
      points.push_back(p);
    }
  }
  return points;
}

/// Makes the layer thicker as far as no cell falls short by it. Cells that may fall short of `wanted`, which asks for
/// more angle and less skewness than the targets, are unsure then, too.
void LayerImprover::thicken(const QualityTargets& wanted)
{
  const DualSource source(layer_.mesh);
  const std::vector<char> toJudge = pointsToJudge(layer_);
  std::vector<WantedPlace> thick; // where their copies were
  std::erase_if(unsure_, [&](Index cell) { return !source.hasMarked(cell, toJudge); });
  for (const Index p : smoothPoints(findShortAmong(source, unsure_, targets(), context_)))
  {
    Vec3& copy = layer_.mesh.points[layer_.copies[p]];
    thick.push_back({p, copy});
    copy = layer_.mesh.points[p] + thicker * (copy - layer_.mesh.points[p]);
  }
  QualityTargets both = withAngles(wanted);
  both.scaledJacobian = std::max(both.scaledJacobian, targets().scaledJacobian);
  auto found =
      findShortCells(source, cellsWithMarked(source, toJudge, context_), std::array{both, targets()}, context_);
  const std::vector<Index> suspects = cellsOf(found[0]);
  std::vector<ShortCell> shortCells = std::move(found[1]);
  std::vector<char> moved(layer_.mesh.points.size(), 0);
  constexpr int rounds = 10;
  for (int round = 0; round <= rounds; ++round)
  {
    std::vector<char> back(layer_.plainPoints, round == rounds ? 1 : 0);
    markPoints(layer_, shortCells, back);
    std::vector<char> fresh(moved.size(), 0);
    const std::size_t wentBack = std::erase_if(thick, [&](const WantedPlace& was) {
      if (back[was.point])
      {
        const Index copy = layer_.copies[was.point];
        layer_.mesh.points[copy] = was.place;
        fresh[copy] = moved[copy] = 1;
      }
      return back[was.point] != 0;
    });
    if (wentBack == 0)
    {
      break;
    }
    // Cells at points that stay thick were judged.
    shortCells = findShortCells(source, fresh, targets(), context_);
  }
  std::vector<Index> changed = withNeighbours(source, cellsWithMarked(source, moved, context_));
  std::erase_if(changed, [&](Index cell) { return !source.hasMarked(cell, toJudge); });
  unsure_.clear();
  std::ranges::set_union(suspects, changed, std::back_inserter(unsure_));
}

/// Elsewhere such targets would take long and gain little.
void LayerImprover::smooth(const SmoothWallTargets& wanted)
{
  OptimiserOptions options;
  options.targets = targets();
  options.targets.faceCosine.target = std::max(options.targets.faceCosine.target, cosineOf(wanted.nonOrthogonality));
  options.targets.skewness.target = std::min(options.targets.skewness.target, wanted.skewness);
  options.targets.scaledJacobian = std::min(options.targets.scaledJacobian, smoothJacobian);
  options.sweeps = 8;
  options.leastPenalty = 5e-4;
  options.leastGain = 0.02;
  options.firstReach = 0.3;
  thicken(options.targets);
  std::vector<Index> suspects = unsure_;
  std::erase_if(suspects, [&](Index cell) { return !isSmooth(cell); });
  const auto moveThoseShort = [&] {
    move(findShortAmong(DualSource(layer_.mesh), suspects, options.targets, context_), options);
  };
  moveThoseShort();
  const SmoothWallTargets usual;
  if (wanted.nonOrthogonality >= usual.nonOrthogonality && wanted.skewness >= usual.skewness)
  {
    return;
  }
  // Targets that are hard to come up to; the limits rise as in straighten().
  options.targets.leastOfFaceCosine = leastOfOthers;
  options.leastWorst = leastOfOthers;
  options.targets.jacobianLimit = std::min(leastSmoothJacobian, options.targets.scaledJacobian);
  for (const double degrees : stages)
  {
    QualityRange& cosine = options.targets.faceCosine;
    cosine.limit = std::max(cosine.limit, cosineOf(wanted.nonOrthogonality + degrees));
    QualityRange& skewness = options.targets.skewness;
    skewness.limit = std::min(skewness.limit, wanted.skewness + skewnessPerDegree * degrees);
    moveThoseShort();
  }
}

} // namespace atria
