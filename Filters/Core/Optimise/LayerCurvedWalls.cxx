// SPDX-License-Identifier: GPL-3.0-or-later
// What is valid is made good at curved walls.
#include "Optimise/LayerCells.h"
#include "Optimise/LayerImprover.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace atria {

namespace {

/// A wall is flat at a point if its faces there turn by less than a quarter of a degree.
constexpr double flatCosine = 1.0 - 1e-5;
/// How much thicker a layer of no asked height may be on curved walls, where nothing beside it needs the room.
constexpr double thicker = 5.0 / 3.0;
/// What hexahedra of a uniform mesh keep of their scaled Jacobian where angles are made better.
constexpr double curvedJacobian = 0.52;
constexpr double leastCurvedJacobian = 0.5;
/// Degrees by which limits lie beyond the targets, stage by stage, and what skewness lies beyond for each.
constexpr std::array stages{10.0, 5.0, 3.0};
constexpr double skewnessPerDegree = 0.03;

double cosineOf(double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); }

} // namespace

/// Marks the points where walls turn from face to face; leaves no marks at all where none do.
void LayerImprover::findCurved()
{
  curved_.assign(layer_.plainPoints, 0);
  context_.executor.forEach(curved_.size(), 4096, [&](std::size_t p) {
    Vec3 first = Vec3::Zero();
    for (const Index f : walls_.graph.facesAt(static_cast<Index>(p)))
    {
      if (walls_.roles[f] != FaceRole::wall)
      {
        continue;
      }
      const Vec3 normal = wallNormal(plain_, plain_.boundaryFaces[f]).normalized();
      first = first.isZero() ? normal : first;
      curved_[p] |= normal.dot(first) < flatCosine ? 1 : 0;
    }
  });
  if (std::ranges::find(curved_, 1) == curved_.end())
  {
    curved_.clear();
  }
}

/// Whether it is a hexahedron at a curved wall, and all its points on walls are away from creases and rims.
bool LayerImprover::isAtCurved(Index cell) const
{
  std::array<Index, 8> corners = layer_.mesh.corners[cell];
  bool isCurved = false;
  for (const Index p : corners)
  {
    const Index wall = layer_.wallPointOf(p);
    const Freedom freedom = anchors_.freedom[vertexOf_[wall]];
    if (freedom != Freedom::free && freedom != Freedom::surface)
    {
      return false;
    }
    isCurved = isCurved || curved_[wall];
  }
  std::ranges::sort(corners);
  return isCurved && std::ranges::adjacent_find(corners) == corners.end();
}

/// Points with a copy, of which all cells with it are at curved walls.
std::vector<Index> LayerImprover::pointsAtCurved() const
{
  std::vector<char> others(layer_.plainPoints, 0);
  for (Index e = 0; e < layer_.mesh.elementCount(); ++e)
  {
    const auto& corners = layer_.mesh.corners[e];
    if (std::ranges::any_of(corners, [&](Index p) { return layer_.isNew(p); }) && !isAtCurved(e))
    {
      for (const Index p : corners)
      {
        others[layer_.wallPointOf(p)] = 1;
      }
    }
  }
  std::vector<Index> points;
  for (Index p = 0; p < layer_.plainPoints; ++p)
  {
    if (layer_.copies[p] != noIndex && !others[p])
    {
      points.push_back(p);
    }
  }
  return points;
}

/// Takes copies back to where they were, as long as cells at their points fall short. `shortCells` are all that do.
void LayerImprover::takeBack(std::vector<WantedPlace> thick, std::vector<ShortCell>& shortCells)
{
  const DualSource source(layer_.mesh);
  std::vector<char> moved(layer_.mesh.points.size(), 0);
  constexpr int rounds = 10;
  for (int round = 0; round <= rounds && !thick.empty(); ++round)
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
    std::erase_if(shortCells, [&](const ShortCell& cell) { return source.hasMarked(cell.cell, fresh); });
    const std::vector<ShortCell> still = findShortCells(source, fresh, targets(), context_);
    shortCells.insert(shortCells.end(), still.begin(), still.end());
  }
  std::ranges::sort(shortCells, {}, &ShortCell::cell);
  const std::vector<Index> changed = withNeighbours(source, cellsWithMarked(source, moved, context_));
  unsure_.insert(unsure_.end(), changed.begin(), changed.end());
  sortUnique(unsure_);
}

/// As findAll, after the layer was made thicker at curved walls as far as no cell falls short by it.
std::vector<ShortCell> LayerImprover::thicken()
{
  findCurved();
  if (curved_.empty())
  {
    return findAll();
  }
  std::vector<WantedPlace> thick; // where their copies were
  for (const Index p : pointsAtCurved())
  {
    Vec3& copy = layer_.mesh.points[layer_.copies[p]];
    thick.push_back({p, copy});
    copy = layer_.mesh.points[p] + thicker * (copy - layer_.mesh.points[p]);
  }
  std::vector<ShortCell> shortCells = findAll();
  takeBack(std::move(thick), shortCells);
  return shortCells;
}

/// What is asked of cells at curved walls.
QualityTargets LayerImprover::targetsAtCurved() const
{
  QualityTargets out = targets();
  out.faceCosine.target = std::max(out.faceCosine.target, cosineOf(curvedWalls_.nonOrthogonality));
  out.skewness.target = std::min(out.skewness.target, curvedWalls_.skewness);
  out.scaledJacobian = std::min(out.scaledJacobian, curvedJacobian);
  return out;
}

/// Elsewhere such targets would take long and gain little.
void LayerImprover::improveAtCurved()
{
  if (curved_.empty())
  {
    return;
  }
  OptimiserOptions options;
  options.targets = targetsAtCurved();
  options.sweeps = 8;
  options.leastPenalty = 5e-4;
  options.leastGain = 0.02;
  options.firstReach = 0.3;
  std::vector<Index> suspects = unsure_;
  std::erase_if(suspects, [&](Index cell) { return !isAtCurved(cell); });
  const auto moveThoseShort = [&] {
    move(findShortAmong(DualSource(layer_.mesh), suspects, options.targets, context_), options);
  };
  moveThoseShort();
  const CurvedWallTargets usual;
  if (curvedWalls_.nonOrthogonality >= usual.nonOrthogonality && curvedWalls_.skewness >= usual.skewness)
  {
    return;
  }
  // Targets that are hard to come up to; the limits rise as in straighten().
  options.targets.leastOfFaceCosine = leastOfOthers;
  options.leastWorst = leastOfOthers;
  options.targets.jacobianLimit = std::min(leastCurvedJacobian, options.targets.scaledJacobian);
  for (const double degrees : stages)
  {
    QualityRange& cosine = options.targets.faceCosine;
    cosine.limit = std::max(cosine.limit, cosineOf(curvedWalls_.nonOrthogonality + degrees));
    QualityRange& skewness = options.targets.skewness;
    skewness.limit = std::min(skewness.limit, curvedWalls_.skewness + skewnessPerDegree * degrees);
    moveThoseShort();
  }
}

} // namespace atria
