// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/BoundaryLayers.h"

#include "Layer/ElementShape.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Length of layers that start with 1.
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

/// The growth at which `count` layers, the first of height 1, are `length` long in all; between `low` and the maximum.
double growthFor(int count, double length, double low)
{
  double high = std::max(low, maximumGrowth);
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (low + high);
    (sumOf(count, middle) < length ? low : high) = middle;
  }
  return high;
}

/// Puts the points of chains on their ways.
void placeChains(LayerMesh& layer, const LayerMesh& one, const std::vector<WallLayers>& asked)
{
  std::copy_n(one.mesh.points.begin(), one.plainPoints, layer.mesh.points.begin());
  std::vector<double> shares;
  for (std::size_t i = 0; i < layer.wallPoints.size(); ++i)
  {
    const Index p = layer.wallPoints[i];
    const Index point = layer.plainPoints + static_cast<Index>(i);
    const Vec3& wall = one.mesh.points[p];
    const Vec3& copy = one.mesh.points[one.copies[p]];
    if (layer.places[i] == 1)
    {
      WallLayers layers = asked[p];
      layers.layers = static_cast<int>(layer.copies[p] - point) + 1;
      shares = divideWay(layers, (copy - wall).norm());
    }
    layer.mesh.points[point] =
        point == layer.copies[p] ? copy : Vec3(wall + shares[layer.places[i] - 1] * (copy - wall));
  }
}

/// Halves the counts of stacks that hold a prism which is not valid although the undivided one is. Tells whether there
/// was any.
bool halveSpoiled(const DualMesh& plain, const LayerMesh& layer, const LayerMesh& one, std::vector<Index>& counts,
                  const RunContext& context)
{
  std::vector<Index> prismOn(plain.boundaryFaces.size(), noIndex);
  for (std::size_t i = 0; i < one.wallFaces.size(); ++i)
  {
    prismOn[one.wallFaces[i]] = one.plainElements + static_cast<Index>(i);
  }
  const auto isValid = [](const LayerMesh& of, Index element) {
    return shapeOf(of.mesh.points, of.mesh.corners[element]).pyramid > 0.0;
  };
  std::vector<char> spoiled(layer.wallFaces.size(), 0);
  context.executor.forEach(spoiled.size(), 2048, [&](std::size_t i) {
    spoiled[i] =
        !isValid(layer, layer.plainElements + static_cast<Index>(i)) && isValid(one, prismOn[layer.wallFaces[i]]);
  });
  std::vector<char> halved(counts.size(), 0);
  for (std::size_t i = 0; i < spoiled.size(); ++i)
  {
    for (int c = 0; c < 4 && spoiled[i]; ++c)
    {
      halved[cornerOf(plain, plain.boundaryFaces[layer.wallFaces[i]], c)] = 1;
    }
  }
  bool any = false;
  for (std::size_t p = 0; p < counts.size(); ++p)
  {
    any = any || (halved[p] && counts[p] > 1);
    counts[p] = halved[p] ? (counts[p] + 1) / 2 : counts[p];
  }
  return any;
}

} // namespace

std::vector<double> divideWay(const WallLayers& layers, double way)
{
  double growth = layers.growth;
  if (layers.firstHeight > 0.0 && way > layers.firstHeight * sumOf(layers.layers, growth))
  {
    growth = growthFor(layers.layers, way / layers.firstHeight, growth);
  }
  std::vector<double> shares;
  const double whole = sumOf(layers.layers, growth);
  for (int i = 1; i <= layers.layers; ++i)
  {
    shares.push_back(i == layers.layers ? 1.0 : sumOf(i, growth) / whole);
  }
  return shares;
}

std::vector<WallLayers> layersOfPoints(const DualMesh& mesh, const LayerWalls& walls, const LayerOptions& options)
{
  std::vector<WallLayers> out(mesh.points.size());
  std::vector<char> met(mesh.points.size(), 0);
  for (Index f = 0; f < walls.roles.size(); ++f)
  {
    const WallLayers& asked = options.ofTag[mesh.boundaryFaces[f].tag];
    for (int i = 0; i < 4 && walls.roles[f] == FaceRole::wall; ++i)
    {
      const Index p = cornerOf(mesh, mesh.boundaryFaces[f], i);
      WallLayers& least = out[p];
      const double first = least.firstHeight == 0.0   ? asked.firstHeight
                           : asked.firstHeight == 0.0 ? least.firstHeight
                                                      : std::min(least.firstHeight, asked.firstHeight);
      least = !met[p] ? asked
                      : WallLayers{std::min(least.layers, asked.layers), first, std::min(least.growth, asked.growth)};
      met[p] = 1;
    }
  }
  for (std::size_t p = 0; p < out.size(); ++p)
  {
    out[p].layers = static_cast<int>(walls.counts[p]);
  }
  return out;
}

LayerMesh divideLayer(const DualMesh& plain, const LayerWalls& walls, const LayerMesh& one, const LayerOptions& options,
                      const std::vector<Index>& most, const RunContext& context)
{
  const std::vector<WallLayers> asked = layersOfPoints(plain, walls, options);
  std::vector<Index> counts(one.copies.size());
  for (std::size_t p = 0; p < counts.size(); ++p)
  {
    counts[p] = one.copies[p] == noIndex ? 0 : static_cast<Index>(asked[p].layers);
    counts[p] = most.empty() ? counts[p] : std::min(counts[p], most[p]);
  }
  LayerMesh out;
  do
  {
    context.progress.check();
    out = buildLayer(plain, walls, counts);
    placeChains(out, one, asked);
  } while (halveSpoiled(plain, out, one, counts, context));
  return out;
}

LayerMesh layWalls(const DualMesh& plain, const LayerWalls& walls, const LayerOptions& options,
                   const RunContext& context)
{
  std::vector<char> excluded(plain.points.size(), 0);
  LayerMesh one = growLayer(plain, walls, options, excluded, context);
  for (std::vector<Index> points = pointsWithoutRoom(plain, one, context); !points.empty();
       points = pointsWithoutRoom(plain, one, context))
  {
    for (const Index p : points)
    {
      excluded[p] = 1;
    }
    one = growLayer(plain, walls, options, excluded, context);
  }
  const bool divided = std::any_of(options.ofTag.begin(), options.ofTag.end(),
                                   [](const WallLayers& layers) { return layers.layers > 1; });
  return divided ? divideLayer(plain, walls, one, options, {}, context) : std::move(one);
}

} // namespace atria
