// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/LayerDivision.h"

#include "Layer/BoundaryLayers.h"
#include "Layer/LayerHeights.h"
#include "Mesher/Improvement/LayerCells.h"
#include "Optimize/Constraints/ChainConstraints.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace atria {

namespace {

/// Greatest difference in layers between points of a wall face after some were taken away. The requested difference is
/// allowed in any case.
constexpr Index greatestStep = 4;

/// Marks the points of cells that lose layers: if their numbers differ, those with more. Settled points lose none.
std::vector<char> pointsWithMost(const LayerMesh& layer, const std::vector<ShortCell>& cells,
                                 const std::vector<Index>& counts, const SettledPoints& settled)
{
  std::vector<char> marked(counts.size(), 0);
  std::vector<Index> open;
  for (const ShortCell& cell : cells)
  {
    open.clear();
    std::ranges::transform(layer.mesh.corners[cell.cell], std::back_inserter(open),
                           [&](Index p) { return layer.wallPointOf(p); });
    std::erase_if(open, [&](Index p) { return settled.stays(p); });
    const auto countOf = [&](Index p) { return counts[p]; };
    const auto [fewest, most] = open.empty() ? std::pair(noIndex, noIndex)
                                             : std::pair(countOf(std::ranges::min(open, {}, countOf)),
                                                         countOf(std::ranges::max(open, {}, countOf)));
    for (const Index p : open)
    {
      marked[p] |= countOf(p) > fewest || fewest == most ? 1 : 0;
    }
  }
  return marked;
}

/// Marks the points of a layer above wall faces with a point whose count changed.
std::vector<char> pointsBesideChange(const DualMesh& plain, const LayerMesh& layer, const std::vector<Index>& before,
                                     const std::vector<Index>& after)
{
  std::vector<char> about(before.size(), 0);
  for (const Index f : layer.wallFaces)
  {
    bool changed = false;
    for (int i = 0; i < 4; ++i)
    {
      const Index p = cornerOf(plain, plain.boundaryFaces[f], i);
      changed = changed || before[p] != after[p];
    }
    for (int i = 0; i < 4 && changed; ++i)
    {
      about[cornerOf(plain, plain.boundaryFaces[f], i)] = 1;
    }
  }
  std::vector<char> marked(layer.mesh.points.size());
  for (Index p = 0; p < marked.size(); ++p)
  {
    marked[p] = about[layer.wallPointOf(p)];
  }
  return marked;
}

/// Copies the points of chains that are as long as before and not held.
void takeChains(const LayerMesh& from, const std::vector<char>& held, LayerMesh& to)
{
  const auto lengthOf = [](const LayerMesh& layer, Index p) {
    return layer.places[layer.copies[p] - layer.plainPoints];
  };
  for (std::size_t i = 0; i < to.wallPoints.size(); ++i)
  {
    const Index p = to.wallPoints[i];
    if (!held[p] && from.copies[p] != noIndex && lengthOf(from, p) == lengthOf(to, p))
    {
      to.mesh.points[to.plainPoints + i] = from.mesh.points[from.copies[p] + to.places[i] - lengthOf(to, p)];
    }
  }
}

/// Keeps some points where they are, by the point of the wall that they stand above.
class HeldConstraints : public VertexConstraints
{
public:
  HeldConstraints(VertexConstraints& constraints, const LayerMesh& layer, const std::vector<char>& held)
      : constraints_(constraints), layer_(layer), held_(held)
  {
  }
  void prepare(std::span<const Index> points, const RunContext& context) override
  {
    constraints_.prepare(points, context);
  }
  bool isMovable(Index point) const override
  {
    return !held_[layer_.wallPointOf(leaderOf(point))] && constraints_.isMovable(point);
  }
  Index leaderOf(Index point) const override { return constraints_.leaderOf(point); }
  Vec3 place(Index point, const Vec3& p) const override { return constraints_.place(point, p); }
  Ways waysFrom(Index point, const Vec3& p, double step) const override
  {
    return constraints_.waysFrom(point, p, step);
  }

private:
  VertexConstraints& constraints_;
  const LayerMesh& layer_;
  const std::vector<char>& held_;
};

} // namespace

void flattenTops(ImproverState& state)
{
  const ImproverStage stage = flatteningStage(state.traits);
  state.measureBy(stage.options.targets);
  std::vector<ShortCell> cells = state.findShort(stage.options.targets, stage.below);
  std::erase_if(cells, [&](const ShortCell& cell) {
    return std::ranges::none_of(state.layer.mesh.corners[cell.cell], [&](Index p) { return state.layer.isNew(p); });
  });
  state.run(stage, cells);
  state.measureBy(strictestTargets(state.traits, nullptr));
}

void LayerDivision::run()
{
  given_ = one_ = state_.layer;
  wanted_ = counts_ = layersWanted(state_.walls, one_);
  held_.resize(one_.plainPoints);
  for (Index p = 0; p < one_.plainPoints; ++p)
  {
    held_[p] = state_.walls.settled.stays(p) ? 1 : 0;
  }
  state_.layer = divideLayer(state_.plain, state_.walls, one_, state_.options, counts_);
  state_.measureBy(strictestOfDivided(state_.traits));
  improveUntilSound(pointsToEvaluate(state_.layer, state_.context.executor));
}

bool LayerDivision::giveWay(const std::vector<ShortCell>& cells)
{
  const std::optional<std::vector<char>> marked = takeAway(cells);
  if (marked)
  {
    improveUntilSound(*marked);
  }
  return marked.has_value();
}

/// Improves poor elements at marked points, and takes layers away where they stay bad, in rounds.
void LayerDivision::improveUntilSound(std::vector<char> marked)
{
  for (int round = 0; round < mostDivisionRounds; ++round)
  {
    std::optional<std::vector<char>> next = takeAway(improve(marked));
    if (!next)
    {
      return;
    }
    marked = std::move(*next);
  }
}

/// Takes layers away at cells. Points with one layer go back to where they were before division. Returns marks of the
/// points changed, or nullopt if there is nothing to take away.
std::optional<std::vector<char>> LayerDivision::takeAway(const std::vector<ShortCell>& cells)
{
  if (std::ranges::all_of(cells, [&](const ShortCell& cell) { return isHeld(cell); }))
  {
    return {};
  }
  std::copy_n(state_.layer.mesh.points.begin(), one_.plainPoints, one_.mesh.points.begin());
  takeCopies(state_.layer, held_, one_);
  const std::vector<Index> before = counts_;
  lower(cells);
  std::vector<char> changed(one_.plainPoints, 0);
  restore(cells, before, changed);
  markPoints(state_.layer, cells, changed);
  LayerMesh next = divideLayer(state_.plain, state_.walls, one_, state_.options, counts_);
  takeChains(state_.layer, held_, next);
  state_.replaceLayer(std::move(next));
  std::vector<char> marked = pointsBesideChange(state_.plain, state_.layer, before, counts_);
  for (Index p = 0; p < marked.size(); ++p)
  {
    marked[p] |= changed[state_.layer.wallPointOf(p)];
  }
  return marked;
}

/// Takes layers away at points of cells that have several. Points that lost some before lose twice as many as these: if
/// one is not enough, most often only the last remains.
void LayerDivision::lower(const std::vector<ShortCell>& cells)
{
  const std::vector<char> lowered = pointsWithMost(state_.layer, cells, counts_, state_.walls.settled);
  for (Index p = 0; p < counts_.size(); ++p)
  {
    if (lowered[p] && counts_[p] > 1)
    {
      const Index loss = std::max<Index>(1, 2 * (wanted_[p] - counts_[p]));
      counts_[p] -= std::min(loss, counts_[p] - 1);
    }
  }
  lowerNeighbors();
}

/// Takes layers away at points that have many more than others of their wall faces. That saves later rounds.
void LayerDivision::lowerNeighbors()
{
  for (bool isLowered = true; isLowered;)
  {
    isLowered = false;
    for (const Index f : one_.wallFaces)
    {
      const std::array<Index, 4> points = cornersOf(state_.plain, state_.plain.boundaryFaces[f]);
      const Index most = mostOn(points);
      for (const Index p : points)
      {
        if (counts_[p] > most && !state_.walls.settled.stays(p))
        {
          counts_[p] = most;
          isLowered = true;
        }
      }
    }
  }
}

/// Returns the most layers that a point of a wall face may have beside the others.
Index LayerDivision::mostOn(const std::array<Index, 4>& points) const
{
  Index fewest = noIndex, fewestWanted = noIndex, mostWanted = 0;
  for (const Index p : points)
  {
    if (counts_[p] > 0)
    {
      fewest = std::min(fewest, counts_[p]);
      fewestWanted = std::min(fewestWanted, wanted_[p]);
      mostWanted = std::max(mostWanted, wanted_[p]);
    }
  }
  return fewest == noIndex ? 0 : fewest + std::max(greatestStep, mostWanted - fewestWanted);
}

bool LayerDivision::isHeld(const ShortCell& cell) const
{
  return std::ranges::all_of(state_.layer.mesh.corners[cell.cell],
                             [&](Index p) { return held_[state_.layer.wallPointOf(p)] != 0; });
}

/// Improves the poor cells at marked points. Returns the cells that are bad afterwards.
std::vector<ShortCell> LayerDivision::improve(const std::vector<char>& marked)
{
  LayerFreedom freedom(state_);
  HeldConstraints points(freedom.layer, state_.layer, held_);
  ChainConstraints chains(state_.layer, points);
  const std::vector<ImproverStage> stages = divisionStages(state_.traits);
  const QualityTargets& targets = stages.front().options.targets;
  std::vector<ShortCell> cells = state_.findShort(targets);
  std::erase_if(cells, [&](const ShortCell& cell) { return !hasMarked(state_.layer.mesh.corners[cell.cell], marked); });
  for (const ImproverStage& stage : stages)
  {
    std::erase_if(cells, [&](const ShortCell& cell) { return cell.worst >= stage.below; });
    cells = state_.run(stage.options, cells, stage.byChains ? static_cast<VertexConstraints&>(chains) : points);
  }
  return state_.findShort(targets, badBelow);
}

/// Moves the points of cells that are bad with one layer back to where they were before division, where they were good.
/// They stay there.
void LayerDivision::restore(const std::vector<ShortCell>& cells, const std::vector<Index>& counts,
                            std::vector<char>& changed)
{
  std::vector<char> leads(one_.plainPoints, 0);
  for (const ShortCell& cell : cells)
  {
    const auto& corners = state_.layer.mesh.corners[cell.cell];
    if (std::ranges::all_of(corners, [&](Index p) { return counts[state_.layer.wallPointOf(p)] <= 1; }))
    {
      for (const Index p : corners)
      {
        leads[state_.vertexOf[state_.layer.wallPointOf(p)]] = 1;
      }
    }
  }
  // Both sides of a sheet go together, whatever layers the other one has.
  for (Index p = 0; p < one_.plainPoints; ++p)
  {
    if (leads[state_.vertexOf[p]])
    {
      held_[p] = changed[p] = 1;
      one_.mesh.points[p] = given_.mesh.points[p];
      if (given_.copies[p] != noIndex)
      {
        one_.mesh.points[one_.copies[p]] = given_.mesh.points[given_.copies[p]];
      }
    }
  }
}

namespace {

/// Moves the points of layers to the requested heights where cells stay sound.
class HeightRestorer
{
public:
  explicit HeightRestorer(ImproverState& state)
      : state_(state), asked_(layersOfPoints(state.plain, state.walls, state.options)),
        targets_(targetsOfHeights(state.traits))
  {
  }

  /// Moves all points. Then moves points of cells back that are not sound and got worse, until there are none.
  void run(bool withCopies)
  {
    LayerMesh& layer = state_.layer;
    std::unordered_map<Index, float> shortBefore;
    for (const ShortCell& cell : state_.findShort(targets_, badBelow))
    {
      shortBefore[cell.cell] = cell.worst;
    }
    const std::vector<Vec3> before = std::exchange(layer.mesh.points, places(withCopies));
    std::vector<char> changed(layer.plainPoints, 0);
    for (Index p = layer.plainPoints; p < before.size(); ++p)
    {
      changed[layer.wallPointOf(p)] |= layer.mesh.points[p] != before[p] ? 1 : 0;
    }
    std::vector<char> isRestored = changed;
    while (std::ranges::find(changed, 1) != changed.end())
    {
      state_.outdateAt(changed);
      changed = pointsToPutBack(isRestored, shortBefore);
      for (Index p = layer.plainPoints; p < before.size(); ++p)
      {
        layer.mesh.points[p] = changed[layer.wallPointOf(p)] ? before[p] : layer.mesh.points[p];
      }
      std::ranges::transform(isRestored, changed, isRestored.begin(), [](char is, char back) { return back ? 0 : is; });
    }
  }

private:
  std::vector<char> pointsToPutBack(const std::vector<char>& isRestored,
                                    const std::unordered_map<Index, float>& shortBefore) const
  {
    std::vector<char> marked(isRestored.size(), 0);
    for (const ShortCell& cell : state_.findShort(targets_, badBelow))
    {
      const auto found = shortBefore.find(cell.cell);
      const bool isWorse = found == shortBefore.end() || cell.worst < found->second;
      for (const Index p : state_.layer.mesh.corners[cell.cell])
      {
        const Index wallPoint = state_.layer.wallPointOf(p);
        marked[wallPoint] = isWorse && isRestored[wallPoint] ? 1 : marked[wallPoint];
      }
    }
    return marked;
  }

  /// Returns the places of points when chains, with or without their copies, have the requested heights.
  std::vector<Vec3> places(bool withCopies) const
  {
    const LayerMesh& layer = state_.layer;
    const std::vector<double> heights = heightsAbove(state_.walls, layer);
    std::vector<Vec3> places = layer.mesh.points;
    forChains(layer, [&](Index p, Index first, Index count) {
      if (asked_[p].firstHeight == 0.0 || state_.walls.settled.stays(p))
      {
        return;
      }
      WallLayers layers = asked_[p];
      layers.layers = static_cast<int>(count);
      const bool movesCopy = withCopies && layers.layers == asked_[p].layers;
      const double scale = movesCopy ? thicknessAsked(layers, 0.0, {}) / heights[p] : 1.0;
      const std::vector<double> shares = divideWay(layers, scale * heights[p]);
      const Vec3& wall = layer.mesh.points[p];
      const Vec3 way = layer.mesh.points[layer.copies[p]] - wall;
      for (Index i = 0; i + (scale == 1.0 ? 1 : 0) < count; ++i)
      {
        places[first + i] = wall + scale * shares[i] * way;
      }
    });
    return places;
  }

  ImproverState& state_;
  const std::vector<WallLayers> asked_;
  const QualityTargets targets_;
};

} // namespace

void restoreHeights(ImproverState& state)
{
  if (state.traits.hasHeights)
  {
    HeightRestorer restorer(state);
    restorer.run(true);
    restorer.run(false);
  }
}

} // namespace atria
