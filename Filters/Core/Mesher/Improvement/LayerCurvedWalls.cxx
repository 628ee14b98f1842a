// SPDX-License-Identifier: GPL-3.0-or-later
// What is valid is made good at curved walls.
#include "Mesher/Improvement/LayerCells.h"
#include "Mesher/Improvement/LayerImprover.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace atria {

namespace {

/// A wall is flat if its chart is, or at a point if its faces there turn by less than a quarter of a degree.
constexpr double flatCosine = 1.0 - 1e-5;
/// It is smooth if they turn by less than 12 degrees, or are at an edge of the domain: other elements, where octants
/// are coarse or a wall stands on the ground, do not come to be as good, and trying to takes long for little: half of
/// the whole time for one degree in the mean.
constexpr double smoothCosine = 0.978;
/// Beyond 60 degrees it is an edge, though none of one surface, as where a wall stands on the ground.
constexpr double edgeCosine = 0.5;
/// How much thicker a layer of no asked height may be on curved walls, where nothing beside it needs the room.
constexpr double thicker = 5.0 / 3.0;
/// What hexahedra of a uniform mesh keep of their scaled Jacobian where angles are made better.
constexpr double curvedJacobian = 0.52;
constexpr double leastCurvedJacobian = 0.5;
/// Of stages.
constexpr double leastDegrees = 1.0;
constexpr double leastSkewness = 0.01;

/// By chart whether it is not flat. Triangles that are thinner than rounding may turn them are not looked at.
std::vector<char> findBent(const SurfaceModel& model)
{
  constexpr double leastHeight = 1e3; // lattice units
  std::vector<Index> widest;
  std::vector<double> areas;
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    const std::size_t chart = model.charts[t];
    if (chart >= widest.size())
    {
      widest.resize(chart + 1, noIndex);
      areas.resize(chart + 1, -1.0);
    }
    if (const double area = model.normal(t).squaredNorm(); area > areas[chart])
    {
      widest[chart] = t;
      areas[chart] = area;
    }
  }
  std::vector<char> bent(widest.size(), 0);
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    const std::size_t chart = model.charts[t];
    const Vec3 normal = model.normal(t);
    const Vec3 across = model.normal(widest[chart]).normalized();
    const double longest = model.bounds(t).size().norm();
    if (normal.norm() > leastHeight * longest && std::abs(normal.normalized().dot(across)) < flatCosine)
    {
      bent[chart] = 1;
    }
  }
  return bent;
}

double cosineOf(double degrees) { return std::cos(std::max(degrees, leastDegrees) * std::numbers::pi / 180.0); }

} // namespace

/// How far the limits and the aims of a stage lie beyond the targets, in degrees and in skewness. Cells below a share
/// of the way from limit to aim are moved.
struct LayerImprover::CurvedStage
{
  QualityRange degrees;
  QualityRange skewness;
  float below;
};

/// Finds how walls turn from face to face at points; leaves nothing at all where none do.
void LayerImprover::findCurved()
{
  const std::vector<char> bent = findBent(context_.model);
  curved_.assign(layer_.plainPoints, straight);
  context_.executor.forEach(curved_.size(), 4096, [&](std::size_t p) {
    const BoundaryFace* first = nullptr;
    Vec3 normalOfFirst;
    for (const Index f : walls_.graph.facesAt(static_cast<Index>(p)))
    {
      if (walls_.roles[f] != FaceRole::wall)
      {
        continue;
      }
      const BoundaryFace& face = plain_.boundaryFaces[f];
      const Vec3 normal = wallNormal(plain_, face).normalized();
      if (!first)
      {
        first = &face;
        normalOfFirst = normal;
      }
      const double cosine = normal.dot(normalOfFirst);
      const bool onSides = face.chart == noIndex && first->chart == noIndex;
      const bool isBent = cosine < flatCosine && face.chart != noIndex && bent[face.chart];
      if (isBent || (cosine < edgeCosine && onSides))
      {
        curved_[p] |= cosine > smoothCosine || onSides ? curved : curved | edged;
      }
      else if (cosine < edgeCosine)
      {
        curved_[p] |= edged;
      }
    }
  });
  if (std::ranges::all_of(curved_, [](std::uint8_t bend) { return (bend & curved) == 0; }))
  {
    curved_.clear();
  }
}

bool LayerImprover::isAwayFromCreases(Index cell) const
{
  return std::ranges::all_of(layer_.mesh.corners[cell], [&](Index p) {
    const VertexClass vertexClass = classification_.classes[vertexOf_[layer_.wallPointOf(p)]];
    return vertexClass == VertexClass::free || vertexClass == VertexClass::surface;
  });
}

/// Whether it is a hexahedron at a curved wall, and all its points on walls are away from creases and boundary edges.
bool LayerImprover::isAtCurved(Index cell) const
{
  std::array<Index, 8> corners = layer_.mesh.corners[cell];
  const bool isCurved =
      std::ranges::any_of(corners, [&](Index p) { return (curved_[layer_.wallPointOf(p)] & curved) != 0; });
  std::ranges::sort(corners);
  return isCurved && std::ranges::adjacent_find(corners) == corners.end() && isAwayFromCreases(cell);
}

/// Whether none of its points are on walls that are curved but not smooth.
bool LayerImprover::isAtSmooth(Index cell) const
{
  return std::ranges::all_of(layer_.mesh.corners[cell],
                             [&](Index p) { return (curved_[layer_.wallPointOf(p)] & edged) == 0; });
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
  mergeUnique(unsure_, withNeighbors(source, cellsWithMarked(source, moved, context_), context_));
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

QualityTargets LayerImprover::targetsAtCurved(const CurvedWallTargets& wanted) const
{
  QualityTargets out = targets();
  out.faceCosine.target = std::max(out.faceCosine.target, cosineOf(wanted.nonOrthogonality));
  out.skewness.target = std::min(out.skewness.target, wanted.skewness);
  out.scaledJacobian = std::min(out.scaledJacobian, curvedJacobian);
  return out;
}

/// Of hexahedra at curved walls those below a share of targets, of other shapes, which may be far from them wherever
/// their points are, those that are slightly beyond the limit.
std::vector<ShortCell> LayerImprover::farAtCurved(const QualityTargets& wanted, float share,
                                                  const std::vector<Index>& candidates) const
{
  QualityTargets by = wanted;
  by.leastOfFaceCosine = by.leastOfSkewness = -std::numeric_limits<double>::infinity();
  std::vector<ShortCell> found = findBelow(by, share, candidates);
  constexpr float slightly = -0.5F;
  std::erase_if(found, [&](const ShortCell& cell) {
    return (cell.worst >= 0.0F || cell.worst < slightly) && !isAtCurved(cell.cell);
  });
  return found;
}

QualityTargets LayerImprover::targetsOf(const CurvedStage& stage) const
{
  QualityTargets out = targets();
  const auto cosineAt = [&](double beyond) { return cosineOf(curvedWalls_.nonOrthogonality + beyond); };
  out.faceCosine = {std::max(out.faceCosine.limit, cosineAt(stage.degrees.limit)),
                    std::max(out.faceCosine.target, cosineAt(stage.degrees.target))};
  const auto skewnessAt = [&](double beyond) { return std::max(curvedWalls_.skewness + beyond, leastSkewness); };
  out.skewness = {std::min(out.skewness.limit, skewnessAt(stage.skewness.limit)),
                  std::min(out.skewness.target, skewnessAt(stage.skewness.target))};
  out.scaledJacobian = std::min(out.scaledJacobian, curvedJacobian);
  out.jacobianLimit = std::min(leastCurvedJacobian, out.scaledJacobian);
  out.leastOfFaceCosine = out.leastOfSkewness = leastOfOthers;
  return out;
}

/// The hexahedra at smooth walls that are not known to be good.
std::vector<Index> LayerImprover::unsureAtSmooth() const
{
  std::vector<Index> cells;
  std::ranges::copy_if(unsure_, std::back_inserter(cells),
                       [&](Index cell) { return isAtCurved(cell) && isAtSmooth(cell); });
  return cells;
}

/// First all at smooth walls that fall short, but not for long. Then the few that are far from the targets, where all
/// walls are smooth: elsewhere the elements at edges are the worst of the mesh anyhow.
void LayerImprover::improveAtCurved()
{
  if (curved_.empty())
  {
    return;
  }
  OptimizerOptions options;
  options.rings = 1;
  options.sweeps = 8;
  options.leastPenalty = 5e-4;
  options.leastGain = 0.02;
  options.firstReach = 0.15;
  options.leastWorst = leastOfOthers;
  options.targets = targetsAtCurved(curvedWalls_);
  move(findBelow(options.targets, 1.0F, unsureAtSmooth()), options);
  if (std::ranges::none_of(curved_, [](std::uint8_t bend) { return (bend & edged) != 0; }))
  {
    bringClose();
  }
}

/// Moves those of the candidates that a stage is for; new ones are those that changed by it, and their neighbors.
void LayerImprover::bringClose(const CurvedStage& stage, std::vector<Index>& candidates)
{
  OptimizerOptions options;
  options.targets = targetsOf(stage);
  options.rings = 1;
  options.sweeps = 12;
  options.patient = true;
  options.leastPenalty = 0.002;
  options.leastWorst = leastOfOthers;
  std::vector<Index> about;
  move(farAtCurved(options.targets, stage.below, candidates), options, &about);
  std::erase_if(about, [&](Index cell) { return !isAtSmooth(cell) || !isAtCurved(cell); });
  mergeUnique(candidates, about);
}

/// The limits rise, as in straighten(). By the last one cells are moved that have 1.6 degrees less than the target.
void LayerImprover::bringClose()
{
  constexpr CurvedStage first{{4.0, -2.0}, {0.1, 0.0}, 0.5F};
  constexpr CurvedStage second{{1.0, -5.0}, {0.05, -0.05}, 0.4F};
  constexpr CurvedStage last{{0.0, -6.0}, {0.03, -0.07}, 0.3F};
  constexpr CurvedStage lowered{{4.0, -6.0}, {0.1, -0.07}, 0.5F};
  constexpr float leastShare = 0.5F; // above the last stage's, and of its range below those of all others
  std::vector<Index> candidates = withNeighbors(DualSource(layer_.mesh), unsureAtSmooth(), context_);
  std::erase_if(candidates, [&](Index cell) { return !isAtSmooth(cell) || !isAwayFromCreases(cell); });
  candidates = cellsOf(farAtCurved(targetsOf(last), leastShare, candidates));
  for (const CurvedStage& stage : {first, second, last})
  {
    bringClose(stage, candidates);
  }
  // What is just at a limit is hard to move on, as what is above may not fall below: it is lowered and raised again, as
  // long as a third of those beyond it gets in by that.
  constexpr int most = 4;
  std::size_t before = std::numeric_limits<std::size_t>::max() / 3;
  for (int i = 0; i < most; ++i)
  {
    const std::size_t beyond = farAtCurved(targetsOf(last), 0.0F, candidates).size();
    if (beyond == 0 || 3 * beyond > 2 * before)
    {
      return;
    }
    before = beyond;
    bringClose(lowered, candidates);
    bringClose(last, candidates);
  }
}

} // namespace atria
