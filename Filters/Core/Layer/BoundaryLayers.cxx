// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/BoundaryLayers.h"

#include "Layer/LayerHeights.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Marks points that have more layers than another point of a face.
std::vector<char> besideFewer(const DualMesh& plain, const LayerMesh& one, const std::vector<Index>& counts)
{
  std::vector<char> marked(counts.size(), 0);
  for (const Index f : one.wallFaces)
  {
    const std::array<Index, 4> points = cornersOf(plain, plain.boundaryFaces[f]);
    const Index fewest = std::ranges::min(points, {}, [&](Index p) { return counts[p]; });
    for (const Index p : points)
    {
      marked[p] = counts[p] > counts[fewest] ? 1 : marked[p];
    }
  }
  return marked;
}

/// Places the points of chains on the lines to the copies. Layers end beside the points marked in `ends`.
void placeChains(LayerMesh& layer, const LayerMesh& one, const std::vector<WallLayers>& asked,
                 const std::vector<char>& ends, const std::vector<double>& heights)
{
  std::vector<Vec3>& points = layer.mesh.points;
  std::copy_n(one.mesh.points.begin(), one.plainPoints, points.begin());
  forChains(layer, [&](Index p, Index first, Index count) {
    WallLayers layers = asked[p];
    layers.layers = static_cast<int>(count);
    // Layers become wedges beside an end; their determinants go with the fourth power of the thinnest.
    layers.growth = ends[p] && layers.firstHeight == 0.0 ? 1.0 : layers.growth;
    const std::vector<double> shares = divideWay(layers, heights[p]);
    const Vec3& wall = one.mesh.points[p];
    const Vec3& copy = one.mesh.points[one.copies[p]];
    for (Index i = 0; i + 1 < count; ++i)
    {
      points[first + i] = wall + shares[i] * (copy - wall);
    }
    points[layer.copies[p]] = copy;
  });
}

} // namespace

std::vector<double> heightsAbove(const LayerWalls& walls, const LayerMesh& layer)
{
  const std::vector<Vec3>& points = layer.mesh.points;
  const auto wayOf = [&](Index p) { return Vec3(points[layer.copies[p]] - points[p]); };
  std::vector<double> heights(layer.plainPoints, 0.0);
  for (Index p = 0; p < heights.size(); ++p)
  {
    heights[p] = layer.copies[p] == noIndex ? 0.0 : wayOf(p).norm();
  }
  const std::vector<double> ways = heights;
  for (Index f = 0; f < walls.roles.size(); ++f)
  {
    const BoundaryFace& face = layer.mesh.boundaryFaces[f];
    const Vec3 inward = walls.roles[f] == FaceRole::wall ? wallNormal(layer.mesh, face).normalized() : Vec3::Zero();
    for (int i = 0; i < 4 && walls.roles[f] == FaceRole::wall; ++i)
    {
      const Index p = cornerOf(layer.mesh, face, i);
      if (layer.copies[p] != noIndex)
      {
        heights[p] = std::max(std::min(heights[p], inward.dot(wayOf(p))), 0.5 * ways[p]);
      }
    }
  }
  return heights;
}

std::vector<WallLayers> layersOfPoints(const DualMesh& mesh, const LayerWalls& walls, const LayerOptions& options)
{
  std::vector<WallLayers> out = layersAskedAt(mesh, walls, options);
  for (std::size_t p = 0; p < out.size(); ++p)
  {
    out[p].layers = static_cast<int>(walls.counts[p]);
  }
  return out;
}

std::vector<Index> layersWanted(const LayerWalls& walls, const LayerMesh& one)
{
  std::vector<Index> counts(one.copies.size());
  for (std::size_t p = 0; p < counts.size(); ++p)
  {
    counts[p] = one.copies[p] == noIndex              ? 0
                : walls.settled.keepsLayers(Index(p)) ? walls.settled.counts[p]
                                                      : walls.counts[p];
  }
  return counts;
}

LayerMesh divideLayer(const DualMesh& plain, const LayerWalls& walls, const LayerMesh& one, const LayerOptions& options,
                      const std::vector<Index>& counts)
{
  LayerMesh out = buildLayer(plain, walls, counts);
  const std::vector<double> heights =
      options.hasHeights() ? heightsAbove(walls, one) : std::vector<double>(one.plainPoints, 0.0);
  placeChains(out, one, layersOfPoints(plain, walls, options), besideFewer(plain, one, counts), heights);
  for (std::size_t i = 0; i < out.wallPoints.size(); ++i)
  {
    if (const Index p = out.wallPoints[i]; walls.settled.keepsLayers(p) && counts[p] == walls.settled.counts[p])
    {
      out.mesh.points[out.plainPoints + i] = walls.settled.aboveOf(p)[out.places[i] - 1];
    }
  }
  return out;
}

} // namespace atria
