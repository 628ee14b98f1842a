// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/LayerHeights.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Share of an element beside a wall that layers take at most if their number or growth is free.
constexpr double mostOfElement = 0.75;

/// Returns the total height of layers whose first height is 1.
double sumOf(int count, double growth)
{
  double sum = 0.0;
  double height = 1.0;
  for (int i = 0; i < count; ++i, height *= growth)
  {
    sum += height;
  }
  return sum;
}

/// Returns the growth from `low` to `high` at which `isLow` changes from true to false.
template <typename IsLow> double growthWhere(double low, double high, IsLow&& isLow)
{
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (low + high);
    (isLow(middle) ? low : high) = middle;
  }
  return high;
}

double heightOf(const WallLayers& layers) { return layers.firstHeight * sumOf(layers.layers, layers.growth); }

/// True if one more layer would be lower than what is left of the element.
bool leavesRoom(WallLayers layers, double size)
{
  const double before = heightOf(layers);
  ++layers.layers;
  const double next = heightOf(layers) - before;
  return before + next < size && before + next <= mostOfElement * size;
}

} // namespace

WallLayers fitted(const WallLayers& asked, double size)
{
  WallLayers layers = asked;
  if (layers.growth == WallLayers::fittingGrowth)
  {
    layers.growth = growthWhere(1.0, maximumGrowth, [&](double growth) {
      return layers.firstHeight * sumOf(layers.layers + 1, growth) < size;
    });
  }
  if (layers.layers == WallLayers::asManyAsFit)
  {
    layers.layers = 1;
    while (layers.layers < mostLayers && leavesRoom(layers, size))
    {
      ++layers.layers;
    }
  }
  return layers;
}

int mostLayersOf(const std::vector<WallLayers>& walls, double size)
{
  int most = 0;
  for (const WallLayers& wall : walls)
  {
    most = std::max(most, fitted(wall, size).layers);
  }
  return most;
}

double thicknessAsked(const WallLayers& layers, double wallSize, const LayerOptions& options)
{
  return layers.firstHeight > 0.0
             ? heightOf(layers)
             : (layers.layers > 1 ? options.dividedThickness : options.relativeThickness) * wallSize;
}

std::vector<double> divideWay(const WallLayers& layers, double height)
{
  const double growth =
      layers.firstHeight > 0.0
          ? growthWhere(std::min(layers.growth, 1.0), std::max(layers.growth, maximumGrowth),
                        [&](double g) { return layers.firstHeight * sumOf(layers.layers, g) < height; })
          : layers.growth;
  std::vector<double> shares;
  const double whole = sumOf(layers.layers, growth);
  for (int i = 1; i <= layers.layers; ++i)
  {
    shares.push_back(i == layers.layers ? 1.0 : sumOf(i, growth) / whole);
  }
  return shares;
}

} // namespace atria
