// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/BoxCells.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

constexpr std::size_t grain = 2048;
/// Factor by which boxes must be better than the targets: far more than boxes may be out of square.
constexpr double clearly = 1.01;

/// True if targets may be too strict for boxes, which have right angles and no skewness, up to rounding.
bool asksForMoreThanBoxes(const QualityTargets& targets)
{
  return clearly * std::max({targets.pyramidCosine.target, targets.faceCosine.target, targets.boundaryShape.target,
                             targets.scaledJacobian}) >
             1.0 ||
         1.0 + targets.skewness.target < clearly;
}

double volumeOf(const Vec3& lengths) { return lengths[0] * lengths[1] * lengths[2]; }

/// Returns the cube of the mean edge.
double cubeOf(const Vec3& lengths)
{
  const double mean = lengths.sum() / 3.0;
  return mean * mean * mean;
}

/// True if the lengths of a box make it good by itself. It has `across[axis]` internal faces on each axis.
bool hasGoodLengths(const Vec3& lengths, const std::array<int, 3>& across, const QualityTargets& targets)
{
  const double shortest = lengths.minCoeff();
  const double longest = lengths.maxCoeff();
  const double convexity = clearly * targets.convexity.target;
  if (shortest * shortest < convexity * convexity * (shortest * shortest + longest * longest))
  {
    return false;
  }
  const double volume = volumeOf(lengths);
  double areas = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    areas += across[axis] * volume / lengths[axis];
  }
  const double faces = across[0] + across[1] + across[2];
  const double root = clearly * targets.determinantRoot.target;
  const double square = volume * volume;
  const double mean = areas / std::max(faces, 1.0);
  return (faces > 0 || root == 0.0) && across[0] * across[1] * across[2] * square * square >=
                                           8.0 * root * root * root * root * mean * mean * mean * mean * mean * mean;
}

/// True if a box and its neighbor on an axis reach the targets of the weight and of the volume ratio.
bool suits(const Vec3& lengths, const Vec3& beside, int axis, const QualityTargets& targets)
{
  const double less = std::min(lengths[axis], beside[axis]);
  const double more = std::max(lengths[axis], beside[axis]);
  return less >= clearly * targets.weight.target * (less + more) && less >= clearly * targets.volumeRatio.target * more;
}

/// True if corner volumes are good. `volume` is the smallest of a box and its neighbors, `cube` the largest cube of
/// their mean edges.
bool hasGoodCorners(double volume, double cube, const QualityTargets& targets)
{
  return volume >= clearly * targets.cornerVolume.target * cube;
}

enum Kind : char
{
  unknown,
  box,
  other
};

/// True if a cell is a good box among boxes. `kinds` has one entry per cell, `unknown` for those not looked at.
bool isGoodBox(const CellSource& source, Index cell, const std::vector<char>& kinds, const QualityTargets& targets)
{
  CellBox own;
  if (kinds[cell] == other || !source.boxOf(cell, own) ||
      std::ranges::any_of(own.across, [&](Index c) { return c != noIndex && kinds[c] == other; }))
  {
    return false;
  }
  std::array<int, 3> across{};
  for (int direction = 0; direction < 6; ++direction)
  {
    across[axisOf(direction)] += own.across[direction] != noIndex ? 1 : 0;
  }
  if (!hasGoodLengths(own.lengths, across, targets))
  {
    return false;
  }
  double volume = volumeOf(own.lengths);
  double cube = cubeOf(own.lengths);
  CellBox beside;
  for (int direction = 0; direction < 6; ++direction)
  {
    if (own.across[direction] == noIndex)
    {
      continue;
    }
    if (!source.boxOf(own.across[direction], beside) || !suits(own.lengths, beside.lengths, axisOf(direction), targets))
    {
      return false;
    }
    volume = std::min(volume, volumeOf(beside.lengths));
    cube = std::max(cube, cubeOf(beside.lengths));
  }
  return hasGoodCorners(volume, cube, targets);
}

} // namespace

std::vector<Index> cellsToEvaluate(const CellSource& source, const std::vector<Index>& cells,
                                   const QualityTargets& targets, const RunContext& context)
{
  if (asksForMoreThanBoxes(targets))
  {
    return cells;
  }
  std::vector<char> kinds(source.cellCount(), unknown);
  context.executor.forEach(cells.size(), grain, [&](std::size_t i) {
    CellBox own;
    kinds[cells[i]] = source.boxOf(cells[i], own) ? box : other;
  });
  context.progress.check();
  std::vector<char> good(cells.size());
  context.executor.forEach(cells.size(), grain,
                           [&](std::size_t i) { good[i] = isGoodBox(source, cells[i], kinds, targets) ? 1 : 0; });
  std::vector<Index> out;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    if (!good[i])
    {
      out.push_back(cells[i]);
    }
  }
  return out;
}

} // namespace atria
