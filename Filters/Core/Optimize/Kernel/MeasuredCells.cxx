// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/MeasuredCells.h"

#include "Optimize/Kernel/BoxCells.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <type_traits>

namespace atria {

namespace {

constexpr std::size_t grain = 256;

/// Returns the range of a kind of measure.
QualityRange rangeOf(Measure::Kind kind, const QualityTargets& targets)
{
  switch (kind)
  {
    case Measure::pyramidCosine:
      return targets.pyramidCosine;
    case Measure::corners:
    case Measure::fans:
      return {0.0, targets.cornerVolume.target};
    case Measure::convexity:
      return targets.convexity;
    case Measure::determinant:
      return targets.determinantRoot;
    case Measure::jacobian:
      return {targets.jacobianLimit, targets.scaledJacobian};
    case Measure::boundaryShape:
      return targets.boundaryShape;
    case Measure::faceCosine:
      return targets.faceCosine;
    case Measure::skewness:
      return targets.skewness;
    case Measure::weight:
      return targets.weight;
    case Measure::volumeRatio:
    case Measure::kinds:
      break;
  }
  return targets.volumeRatio;
}

/// Returns the lower bound of what a kind of measure contributes to the worst measure of a cell.
double leastOf(Measure::Kind kind, const QualityTargets& targets)
{
  switch (kind)
  {
    case Measure::determinant:
      return targets.leastOfDeterminant;
    case Measure::jacobian:
      return targets.leastOfJacobian;
    case Measure::faceCosine:
      return targets.leastOfFaceCosine;
    case Measure::skewness:
      return targets.leastOfSkewness;
    default:
      return -std::numeric_limits<double>::infinity();
  }
}

/// Measures the cells that are not seen to be good, piece by piece, because measures take many times the memory of the
/// cells. Calls use(evaluator, context) for each piece and returns the results. Each piece is for one thread; if there
/// are few pieces, all threads work on one piece after the other.
template <typename Use>
auto measurePieces(const CellSource& source, const std::vector<Index>& cells, const QualityTargets& targets,
                   const RunContext& context, Use&& use)
{
  const SerialExecutor one;
  const RunContext serial{one, context.progress};
  std::vector<std::vector<Index>> pieces = inPieces(source, cellsToEvaluate(source, cells, targets, context));
  const bool areFew = pieces.size() < 4 * static_cast<std::size_t>(context.executor.threads());
  std::vector<std::invoke_result_t<Use, const QualityEvaluator&, const RunContext&>> found(pieces.size());
  (areFew ? serial : context).executor.forEach(pieces.size(), 1, [&](std::size_t piece) {
    const RunContext& run = areFew ? context : serial;
    std::ranges::sort(pieces[piece]);
    Region region = extractCells(source, std::move(pieces[piece]), targets.looksAtJacobians(), run);
    found[piece] = use(QualityEvaluator(region, targets, run), run);
  });
  return found;
}

/// Returns the entries of all lists, sorted by cell.
template <typename List> List joined(const std::vector<List>& lists)
{
  List all;
  for (const List& list : lists)
  {
    all.insert(all.end(), list.begin(), list.end());
  }
  std::ranges::sort(all, {}, [](const auto& entry) { return entry.cell; });
  return all;
}

} // namespace

std::vector<ShortCell> shortCellsOf(const QualityEvaluator& evaluator, double margin, const RunContext& context)
{
  const Region& region = evaluator.region();
  std::vector<double> worst(region.judgedCount());
  context.executor.forEach(worst.size(), grain, [&](std::size_t c) {
    Score score = evaluator.scoreOfCell(static_cast<Index>(c));
    for (const Index f : region.facesOf(c))
    {
      score.add(evaluator.scoreOfFace(f));
    }
    // Makes measures relative to the targets without the margin. Not exact for scaled Jacobians with a limit above 0
    // and for lower bounds such as leastOfFaceCosine.
    worst[c] = (1.0 + margin) * score.worst;
  });
  std::vector<ShortCell> cells;
  for (Index c = 0; c < worst.size(); ++c)
  {
    if (worst[c] < 1.0)
    {
      cells.push_back({region.cellIds[c], static_cast<float>(worst[c])});
    }
  }
  return cells;
}

std::vector<ShortCell> findShortCells(const CellSource& source, const std::vector<char>& marked,
                                      const QualityTargets& targets, const RunContext& context)
{
  return joined(measurePieces(
      source, cellsWithMarked(source, marked, context), targets, context,
      [](const QualityEvaluator& evaluator, const RunContext& run) { return shortCellsOf(evaluator, 0.0, run); }));
}

void MeasuredCells::outdate(const std::vector<Index>& cells) { mergeUnique(outdated_, cells); }

void MeasuredCells::update(const CellSource& source, const RunContext& context)
{
  if (outdated_.empty())
  {
    return;
  }
  const std::vector<Record> fresh = joined(measurePieces(
      source, outdated_, targets_, context,
      [&](const QualityEvaluator& evaluator, const RunContext& run) { return recordsOf(evaluator, run); }));
  std::erase_if(records_, [&](const Record& r) { return std::ranges::binary_search(outdated_, r.cell); });
  const auto kept = static_cast<std::ptrdiff_t>(records_.size());
  records_.insert(records_.end(), fresh.begin(), fresh.end());
  std::ranges::inplace_merge(records_, records_.begin() + kept, {}, &Record::cell);
  outdated_.clear();
}

auto MeasuredCells::recordsOf(const QualityEvaluator& evaluator, const RunContext& context) const -> std::vector<Record>
{
  const std::vector<Index>& ids = evaluator.region().cellIds;
  std::vector<Record> records;
  for (const ShortCell& cell : shortCellsOf(evaluator, 0.0, context))
  {
    const auto local = static_cast<Index>(std::ranges::lower_bound(ids, cell.cell) - ids.begin());
    const std::array<double, Measure::kinds> least = evaluator.leastOf(local);
    Record& record = records.emplace_back(Record{cell.cell, {}});
    for (std::size_t k = 0; k < least.size(); ++k)
    {
      const bool isShort = least[k] < 1.0;
      record.least[k] = isShort ? static_cast<float>(rangeOf(static_cast<Measure::Kind>(k), targets_).at(least[k]))
                                : std::numeric_limits<float>::infinity();
    }
  }
  return records;
}

std::vector<ShortCell> MeasuredCells::shortOf(const QualityTargets& targets, float below) const
{
  std::array<QualityRange, Measure::kinds> ranges;
  std::array<double, Measure::kinds> least;
  for (std::size_t k = 0; k < ranges.size(); ++k)
  {
    ranges[k] = rangeOf(static_cast<Measure::Kind>(k), targets);
    least[k] = leastOf(static_cast<Measure::Kind>(k), targets);
  }
  std::vector<ShortCell> cells;
  for (const Record& record : records_)
  {
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < ranges.size(); ++k)
    {
      const bool isAsked = ranges[k].limit != ranges[k].target;
      if (isAsked && std::isfinite(record.least[k]))
      {
        worst = std::min(worst, std::max(ranges[k].of(record.least[k]), least[k]));
      }
    }
    if (worst < below)
    {
      cells.push_back({record.cell, static_cast<float>(worst)});
    }
  }
  return cells;
}

void MeasuredCells::renumber(const std::vector<Index>& numbers)
{
  for (Record& record : records_)
  {
    record.cell = numbers[record.cell];
  }
  std::erase_if(records_, [](const Record& record) { return record.cell == noIndex; });
  std::ranges::sort(records_, {}, &Record::cell);
  for (Index& cell : outdated_)
  {
    cell = numbers[cell];
  }
  std::erase(outdated_, noIndex);
  std::ranges::sort(outdated_);
}

} // namespace atria
