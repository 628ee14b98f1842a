// SPDX-License-Identifier: GPL-3.0-or-later
// The conforming layer is divided into boundary layers, as many as elements are valid with.
#include "Mesher/Improvement/LayerCells.h"
#include "Mesher/Improvement/LayerImprover.h"
#include "Optimize/Constraints/ChainConstraints.h"
#include "Optimize/Constraints/LayerConstraints.h"

#include <algorithm>
#include <array>

namespace atria {

namespace {

/// The share of the way to targets that is aimed at: there are many cells, and it is enough that they are sound.
constexpr double soundShare = 0.6;
/// After so many rounds of improving and lowering it is done by lowering alone.
constexpr int mostRounds = 24;

/// A pass over cells whose least measure is below `below`. Those that are bad after the last lose layers.
struct DivisionPass
{
  bool byChains; ///< whether chains move as a whole, which brings most cells where they are to be with few moves
  float below;
  int sweeps;
};
constexpr std::array divisionPasses{DivisionPass{true, 0.5F, 10}, DivisionPass{false, 0.3F, 12},
                                    DivisionPass{false, soundEnough, 20}};

/// Takes a layer away at the points of cells that have several; where they have different numbers, at those with more.
void lower(const LayerMesh& layer, const std::vector<ShortCell>& cells, std::vector<Index>& counts)
{
  std::vector<char> marked(counts.size(), 0);
  for (const ShortCell& cell : cells)
  {
    const auto countOf = [&](Index p) { return counts[layer.wallPointOf(p)]; };
    const auto [fewest, most] = std::ranges::minmax(layer.mesh.corners[cell.cell], {}, countOf);
    for (const Index p : layer.mesh.corners[cell.cell])
    {
      marked[layer.wallPointOf(p)] |= countOf(p) > countOf(fewest) || countOf(fewest) == countOf(most) ? 1 : 0;
    }
  }
  for (Index p = 0; p < counts.size(); ++p)
  {
    counts[p] = marked[p] && counts[p] > 1 ? counts[p] - 1 : counts[p];
  }
}

/// Marks the points of a layer that are, or are of a face with one, above points of the wall whose counts differ.
std::vector<char> pointsChanged(const DualMesh& plain, const LayerMesh& layer, const std::vector<Index>& before,
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

/// Takes over the points of chains that are as long as before and not held.
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

/// Layers of an asked height stay as they are: nothing can be improved by moving their points.
LayerMesh LayerImprover::divide(const LayerMesh& one) const
{
  if (!hasHeights_)
  {
    if (std::optional<LayerMesh> divided = divideAndImprove(one))
    {
      return std::move(*divided);
    }
  }
  return divideEvenly(one);
}

/// All layers everywhere, up to where there are none; elements that are poor are improved, and those that are bad still
/// lose layers. Nothing where that does not come to an end.
std::optional<LayerMesh> LayerImprover::divideAndImprove(const LayerMesh& given) const
{
  LayerMesh one = given;
  std::vector<Index> counts = layersWanted(plain_, walls_, one, options_);
  std::vector<char> held(one.plainPoints, 0);
  LayerMesh divided = divideLayer(plain_, walls_, one, options_, counts);
  std::vector<char> toEvaluate = pointsToEvaluate(divided, context_.executor);
  for (int round = 0; round < mostRounds; ++round)
  {
    context_.progress.check();
    const std::vector<ShortCell> bad = badOf(improveDivided(divided, toEvaluate, held));
    if (bad.empty())
    {
      return divided;
    }
    std::copy_n(divided.mesh.points.begin(), one.plainPoints, one.mesh.points.begin());
    takeCopies(divided, held, one);
    const std::vector<Index> before = counts;
    lower(divided, bad, counts);
    std::vector<char> changed(one.plainPoints, 0);
    restore(given, divided, bad, before, one, held, changed);
    const LayerMesh previous = std::move(divided);
    divided = divideLayer(plain_, walls_, one, options_, counts);
    takeChains(previous, held, divided);
    toEvaluate = pointsChanged(plain_, divided, before, counts);
    markPoints(previous, bad, changed);
    for (Index p = 0; p < toEvaluate.size(); ++p)
    {
      toEvaluate[p] |= changed[divided.wallPointOf(p)];
    }
  }
  return std::nullopt;
}

/// Improves the poor cells at marked points; those about points that moved in the last pass that fall short then.
std::vector<ShortCell> LayerImprover::improveDivided(LayerMesh& divided, const std::vector<char>& toEvaluate,
                                                     const std::vector<char>& held) const
{
  ModelConstraints model(context_, classification_, divided.mesh.points, vertexOf_);
  LayerConstraints layer(divided, walls_, options_, vertexOf_, letGo_, model);
  HeldConstraints points(layer, divided, held);
  ChainConstraints chains(divided, points);
  const DualSource source(divided.mesh);
  OptimizerOptions options;
  options.targets = targets().within(soundShare);
  options.leastPenalty = 0.01;
  options.leastGain = 0.02;
  options.firstReach = 0.2;
  std::vector<ShortCell> cells = findShortCells(source, toEvaluate, options.targets, context_);
  for (const DivisionPass& pass : divisionPasses)
  {
    std::erase_if(cells, [&](const ShortCell& cell) { return cell.worst >= pass.below; });
    options.sweeps = pass.sweeps;
    VertexConstraints& constraints = pass.byChains ? static_cast<VertexConstraints&>(chains) : points;
    cells = optimize(source, divided.mesh.points, cells, constraints, options, context_);
  }
  return cells;
}

/// What is bad with one layer at its points was good before it was improved: these points go back there, and stay.
void LayerImprover::restore(const LayerMesh& given, const LayerMesh& divided, const std::vector<ShortCell>& bad,
                            const std::vector<Index>& counts, LayerMesh& one, std::vector<char>& held,
                            std::vector<char>& changed) const
{
  std::vector<char> leads(one.plainPoints, 0);
  for (const ShortCell& cell : bad)
  {
    const auto& corners = divided.mesh.corners[cell.cell];
    if (std::ranges::all_of(corners, [&](Index p) { return counts[divided.wallPointOf(p)] <= 1; }))
    {
      for (const Index p : corners)
      {
        leads[vertexOf_[divided.wallPointOf(p)]] = 1;
      }
    }
  }
  // The two sides of a sheet go together, whatever layers the other one has.
  for (Index p = 0; p < one.plainPoints; ++p)
  {
    if (leads[vertexOf_[p]])
    {
      held[p] = changed[p] = 1;
      one.mesh.points[p] = given.mesh.points[p];
      if (given.copies[p] != noIndex)
      {
        one.mesh.points[one.copies[p]] = given.mesh.points[given.copies[p]];
      }
    }
  }
}

/// Layers taper one at a time, and elements that are bad lose some until there are none.
LayerMesh LayerImprover::divideEvenly(const LayerMesh& one) const
{
  std::vector<Index> counts = layersWanted(plain_, walls_, one, options_);
  limitSteps(plain_, one, counts);
  LayerMesh divided = divideLayer(plain_, walls_, one, options_, counts);
  std::vector<char> toEvaluate = pointsToEvaluate(divided, context_.executor);
  for (;;)
  {
    context_.progress.check();
    const std::vector<Index> before = counts;
    lower(divided, badOf(findShortCells(DualSource(divided.mesh), toEvaluate, targets(), context_)), counts);
    if (counts == before)
    {
      return divided;
    }
    limitSteps(plain_, one, counts);
    divided = divideLayer(plain_, walls_, one, options_, counts);
    toEvaluate = pointsChanged(plain_, divided, before, counts);
  }
}

} // namespace atria
