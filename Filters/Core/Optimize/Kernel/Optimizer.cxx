// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/Optimizer.h"

#include "Optimize/Kernel/Coloring.h"
#include "Support/Buckets.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

namespace atria {

namespace {

constexpr std::size_t grain = 256;

/// Marks the points of cells.
void spread(const CellSource& source, const std::vector<Index>& cells, std::vector<char>& points,
            const RunContext& context)
{
  context.executor.forRanges(cells.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> corners;
    for (std::size_t i = begin; i < end; ++i)
    {
      source.cornersOf(cells[i], corners);
      for (const Index p : corners)
      {
        std::atomic_ref(points[p]).store(1, std::memory_order_relaxed);
      }
    }
  });
}

/// Returns marks of the points that may move. A movable point brings along all movable points with the same leader.
std::vector<char> pointsToMove(const CellSource& source, const std::vector<ShortCell>& shortCells,
                               const VertexConstraints& constraints, int rings, const RunContext& context)
{
  std::vector<Index> cells;
  std::ranges::transform(shortCells, std::back_inserter(cells), &ShortCell::cell);
  std::vector<char> points(source.points().size(), 0);
  spread(source, cells, points, context);
  for (int ring = 0; ring < rings; ++ring)
  {
    spread(source, cellsWithMarked(source, points, context), points, context);
  }
  std::vector<char> leaders(points.size(), 0);
  for (Index p = 0; p < points.size(); ++p)
  {
    if (points[p] && constraints.isMovable(p))
    {
      leaders[constraints.leaderOf(p)] = 1;
    }
  }
  context.executor.forEach(points.size(), 8192, [&](std::size_t i) {
    const auto p = static_cast<Index>(i);
    points[p] = leaders[constraints.leaderOf(p)] && constraints.isMovable(p) ? 1 : 0;
  });
  return points;
}

/// Returns the worst metrics of all judged cells and their faces.
LeastMetrics leastOf(const QualityEvaluator& judge, const RunContext& context)
{
  const Region& region = judge.region();
  std::vector<LeastMetrics> pieces(Pieces(region.faceCount()).count);
  const auto takeAll = [&](std::size_t count, auto&& metricsOf) {
    const Pieces of(count);
    context.executor.forEach(of.count, 1, [&](std::size_t piece) {
      for (std::size_t i = of.begin(piece); i < of.end(piece); ++i)
      {
        pieces[piece].take(metricsOf(static_cast<Index>(i)));
      }
    });
  };
  takeAll(region.faceCount(), [&](Index face) { return judge.metricsOfFace(face); });
  takeAll(region.judgedCount(), [&](Index cell) { return judge.metricsOfCell(cell); });
  LeastMetrics least;
  for (const LeastMetrics& piece : pieces)
  {
    least.take(piece);
  }
  return least;
}

/// Makes passes over the movable points of a region.
class Sweeper
{
public:
  Sweeper(QualityEvaluator& qualities, const VertexConstraints& vertexConstraints,
          const OptimizerOptions& optimizerOptions, const RunContext& runContext)
      : judge(qualities), region(qualities.region()), constraints(vertexConstraints), options(optimizerOptions),
        context(runContext), colors(colorPoints(region)), states(region.movable.size(), {options.firstReach}),
        awake(region.movable.size(), 1), failures(region.movable.size(), 0)
  {
    findNeighbors();
    if (options.keepWorst)
    {
      floor = leastOf(judge, context);
    }
  }

  /// Makes one pass. Returns the number of points that moved.
  std::size_t sweep()
  {
    std::vector<char> moved(region.movable.size(), 0);
    for (std::size_t c = 0; c + 1 < colors.offsets.size(); ++c)
    {
      context.progress.check();
      const std::span<const Index> points = pointsToSearch(c);
      context.executor.forRanges(points.size(), colors.isParallel(c) ? 8 : points.size() + 1,
                                 [&](std::size_t first, std::size_t last) {
                                   std::unique_ptr<PointSearch> search = takeSearch();
                                   for (const Index m : points.subspan(first, last - first))
                                   {
                                     moved[m] = improve(m, *search) ? 1 : 0;
                                   }
                                   giveBack(std::move(search));
                                 });
    }
    wake(moved);
    return static_cast<std::size_t>(std::count(moved.begin(), moved.end(), 1));
  }

  bool isAwake() const { return std::ranges::find(awake, 1) != awake.end(); }

private:
  /// Returns the points of a color that may find a better position, in order.
  std::span<const Index> pointsToSearch(std::size_t color)
  {
    toSearch.clear();
    for (std::size_t i = colors.offsets[color]; i < colors.offsets[color + 1]; ++i)
    {
      const Index m = colors.order[i];
      if (awake[m] && (options.patient || failures[m] < mostFailures))
      {
        toSearch.push_back(m);
      }
    }
    return toSearch;
  }

  /// Moves a point to a better position if there is one. Returns true if it moved.
  bool improve(Index m, PointSearch& search)
  {
    const bool moved = search.improve(m, states[m]);
    failures[m] = moved || options.patient ? 0 : failures[m] + 1;
    awake[m] = 0;
    return moved;
  }

  /// Returns a search that is not in use, or a new one. Searches hold much memory, so they are used again.
  std::unique_ptr<PointSearch> takeSearch()
  {
    const std::scoped_lock lock(searchMutex);
    if (searches.empty())
    {
      return std::make_unique<PointSearch>(judge, constraints, options, options.keepWorst ? &floor : nullptr);
    }
    std::unique_ptr<PointSearch> search = std::move(searches.back());
    searches.pop_back();
    return search;
  }
  void giveBack(std::unique_ptr<PointSearch> search)
  {
    const std::scoped_lock lock(searchMutex);
    searches.push_back(std::move(search));
  }

  /// Lists the movable points of each judged cell.
  void findNeighbors()
  {
    pointsOf = fillBuckets(region.judgedCount(), SerialExecutor(), [&](auto&& use) {
      for (Index m = 0; m < region.movable.size(); ++m)
      {
        for (const Index cell : region.cellsAbout(m))
        {
          use(cell, m);
        }
      }
    });
  }

  /// Marks the points to be searched in the next pass: all points of cells around points that moved.
  void wake(const std::vector<char>& moved)
  {
    for (Index m = 0; m < moved.size(); ++m)
    {
      if (moved[m])
      {
        for (const Index cell : region.cellsAbout(m))
        {
          for (const Index point : pointsOf.of(cell))
          {
            awake[point] = 1;
          }
        }
      }
    }
  }

  QualityEvaluator& judge;
  const Region& region;
  const VertexConstraints& constraints;
  const OptimizerOptions& options;
  const RunContext& context;
  /// Worst metrics of the region before the first pass.
  LeastMetrics floor;
  std::mutex searchMutex;
  std::vector<std::unique_ptr<PointSearch>> searches;
  Colors colors;
  std::vector<SearchState> states;
  std::vector<char> awake;
  /// Failures in a row after which a point is not searched any more. Most such points never find a better position.
  static constexpr char mostFailures = 3;
  std::vector<char> failures;
  std::vector<Index> toSearch;
  Buckets pointsOf; ///< one list per judged cell
};

void prepareConstraints(const Region& region, VertexConstraints& constraints, const RunContext& context)
{
  std::vector<Index> ids(region.movable.size());
  std::ranges::transform(region.movable, ids.begin(), [&](Index local) { return region.pointIds[local]; });
  constraints.prepare(ids, context);
}

/// Makes passes until one moves no more than a share of the most points that a pass has moved: the last few points may
/// not be worth a pass. If patient, makes passes until no point is left to search.
void sweepWhileWorthwhile(Sweeper& sweeper, const OptimizerOptions& options, const RunContext& context)
{
  constexpr double worthwhile = 0.02;
  std::size_t most = 1;
  for (int i = 0; i < options.sweeps; ++i)
  {
    if (options.tellProgress)
    {
      context.progress.report(static_cast<double>(i) / options.sweeps, "Moving points");
    }
    const std::size_t moved = sweeper.sweep();
    most = std::max(most, moved);
    const bool isDone =
        options.patient ? !sweeper.isAwake() : static_cast<double>(moved) <= worthwhile * static_cast<double>(most);
    if (isDone)
    {
      return;
    }
  }
}

/// Returns the cells around points that have moved, by their numbers in the mesh, in order.
std::vector<Index> cellsAboutMoved(const Region& region, const std::vector<Vec3>& before, const RunContext& context)
{
  std::vector<char> marked(region.judgedCount(), 0);
  for (Index m = 0; m < region.movable.size(); ++m)
  {
    const Index leader = region.movable[m];
    const bool moved = region.points[leader] != before[region.pointIds[leader]];
    for (const Index cell : region.cellsAbout(m))
    {
      marked[cell] |= moved ? 1 : 0;
    }
  }
  std::vector<Index> cells = numbersOf(marked, context.executor);
  std::ranges::transform(cells, cells.begin(), [&](Index cell) { return region.cellIds[cell]; });
  return cells;
}

/// Copies the positions of the movable points to the mesh.
void takePoints(const Region& region, std::vector<Vec3>& points)
{
  for (const Index local : region.members)
  {
    points[region.pointIds[local]] = region.points[local];
  }
}

} // namespace

std::vector<ShortCell> optimize(const CellSource& source, std::vector<Vec3>& points,
                                const std::vector<ShortCell>& cells, VertexConstraints& constraints,
                                const OptimizerOptions& options, const RunContext& context, std::vector<Index>* changed)
{
  const std::vector<char> moving = pointsToMove(source, cells, constraints, options.rings, context);
  if (std::find(moving.begin(), moving.end(), 1) == moving.end())
  {
    return cells;
  }
  Region region =
      extractRegion(source, moving, constraints, options.keepWorst || options.targets.looksAtJacobians(), context);
  QualityEvaluator judge(region, options.targets.beyond(options.margin), context);
  context.progress.check();
  prepareConstraints(region, constraints, context);
  Sweeper sweeper(judge, constraints, options, context);
  sweepWhileWorthwhile(sweeper, options, context);
  if (changed)
  {
    *changed = cellsAboutMoved(region, points, context);
  }
  takePoints(region, points);
  std::vector<ShortCell> left = shortCellsOf(judge, options.margin, context);
  std::ranges::copy_if(cells, std::back_inserter(left),
                       [&](const ShortCell& cell) { return !std::ranges::binary_search(region.cellIds, cell.cell); });
  std::ranges::sort(left, {}, &ShortCell::cell);
  return left;
}

std::vector<ShortCell> approach(const CellSource& source, std::vector<Vec3>& points,
                                const std::vector<WantedPlace>& wanted, const VertexConstraints& constraints,
                                double least, const QualityTargets& targets, const RunContext& context,
                                std::vector<Index>& changed)
{
  std::vector<char> leaders(points.size(), 0);
  for (const WantedPlace& one : wanted)
  {
    leaders[one.point] = 1;
  }
  std::vector<char> moving(points.size(), 0);
  for (Index p = 0; p < points.size(); ++p)
  {
    moving[p] = leaders[constraints.leaderOf(p)];
  }
  Region region = extractRegion(source, moving, constraints, targets.looksAtJacobians(), context);
  QualityEvaluator judge(region, targets, context);
  PointSearch search(judge, constraints);
  for (Index m = 0; m < region.movable.size(); ++m)
  {
    context.progress.check();
    search.approach(m, wanted[m].place, least);
  }
  changed = cellsAboutMoved(region, points, context);
  takePoints(region, points);
  std::vector<ShortCell> cells = shortCellsOf(judge, 0.0, context);
  std::erase_if(cells, [&](const ShortCell& cell) { return !std::ranges::binary_search(changed, cell.cell); });
  return cells;
}

} // namespace atria
