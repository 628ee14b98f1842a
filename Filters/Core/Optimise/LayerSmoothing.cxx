// SPDX-License-Identifier: GPL-3.0-or-later
// What is valid is made good at smooth walls.
#include "Optimise/LayerCells.h"
#include "Optimise/LayerImprover.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atria {

namespace {

/// How much thicker a layer of no asked height may be on smooth walls, where nothing beside it needs the room.
constexpr double thicker = 5.0 / 3.0;
/// What hexahedra of a uniform mesh keep of their scaled Jacobian where angles are made better.
constexpr double smoothJacobian = 0.52;

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

/// Makes the layer thicker as far as no cell falls short by it.
void LayerImprover::thicken()
{
  std::vector<char> toJudge = pointsToJudge(layer_);
  const std::vector<Index> points = smoothPoints(findShortCells(DualSource(layer_.mesh), toJudge, targets(), context_));
  std::vector<WantedPlace> thick; // where their copies were
  for (const Index p : points)
  {
    Vec3& copy = layer_.mesh.points[layer_.copies[p]];
    thick.push_back({p, copy});
    copy = layer_.mesh.points[p] + thicker * (copy - layer_.mesh.points[p]);
  }
  constexpr int rounds = 10;
  for (int round = 0; round <= rounds; ++round)
  {
    std::vector<char> back(layer_.plainPoints, round == rounds ? 1 : 0);
    markPoints(layer_, findShortCells(DualSource(layer_.mesh), toJudge, targets(), context_), back);
    // Cells at points that stay thick were judged.
    std::fill(toJudge.begin(), toJudge.end(), 0);
    const std::size_t wentBack = std::erase_if(thick, [&](const WantedPlace& was) {
      if (back[was.point])
      {
        layer_.mesh.points[layer_.copies[was.point]] = was.place;
        toJudge[layer_.copies[was.point]] = 1;
      }
      return back[was.point] != 0;
    });
    if (wentBack == 0)
    {
      return;
    }
  }
}

/// Elsewhere such targets would take long and gain little.
void LayerImprover::smooth(const SmoothWallTargets& wanted)
{
  thicken();
  OptimiserOptions options;
  options.targets = targets();
  options.targets.faceCosine.target =
      std::max(options.targets.faceCosine.target, std::cos(wanted.nonOrthogonality * std::numbers::pi / 180.0));
  options.targets.skewness.target = std::min(options.targets.skewness.target, wanted.skewness);
  options.targets.scaledJacobian = std::min(options.targets.scaledJacobian, smoothJacobian);
  options.sweeps = 8;
  options.leastPenalty = 5e-4;
  options.leastGain = 0.02;
  options.firstReach = 0.3;
  std::vector<ShortCell> cells =
      findShortCells(DualSource(layer_.mesh), pointsToJudge(layer_), options.targets, context_);
  std::erase_if(cells, [&](const ShortCell& cell) { return !isSmooth(cell.cell); });
  move(cells, options);
}

} // namespace atria
