// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/FlatLayers.h"

#include "Layer/LayerHeights.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Least part of the size of the elements beside a wall that they keep above the layers.
constexpr double leastAbove = 0.25;
/// Part of the faces of a tag that are taken to be as large as the largest of them.
constexpr double mostFaces = 0.9;

/// Returns the corner volume of a box with a square base; a cube has 1.
double cornerVolumeOf(double height, double size)
{
  return size * size * height / std::pow((2.0 * size + height) / 3.0, 3);
}

/// Returns the determinant of a box with a square base and neighbors on all sides, except below its base if it stands
/// on a wall.
double determinantOf(double height, double size, bool isOnWall)
{
  const int bases = isOnWall ? 1 : 2;
  const double meanArea = (4.0 * size * height + bases * size * size) / (4 + bases);
  return 0.5 * bases * std::pow(size * size * height, 4) / std::pow(meanArea, 6);
}

} // namespace

void FlatLayers::lower(const FlatLayers& other)
{
  for (double FlatLayers::*measure :
       {&FlatLayers::convexity, &FlatLayers::weight, &FlatLayers::volumeRatio, &FlatLayers::cornerVolume,
        &FlatLayers::determinantRoot, &FlatLayers::cornerVolumeOfAll})
  {
    this->*measure = std::min(this->*measure, other.*measure);
  }
}

FlatLayers flatLayers(const WallLayers& layers, double size)
{
  const double all = thicknessAsked(layers, size, {});
  const double first = layers.firstHeight;
  const double last = first * std::pow(layers.growth, layers.layers - 1);
  const double above = std::max(size - all, leastAbove * size);
  const double thinnest = std::min(first, last);
  FlatLayers out;
  out.convexity = thinnest / std::hypot(thinnest, size);
  out.weight = std::min(last, above) / (last + above);
  out.volumeRatio = std::min(last, above) / std::max(last, above);
  out.cornerVolume = cornerVolumeOf(thinnest, size);
  const double second = std::min(first * layers.growth, last);
  const double determinant = layers.layers > 1
                                 ? std::min(determinantOf(first, size, true), determinantOf(second, size, false))
                                 : determinantOf(first, size, true);
  out.determinantRoot = std::sqrt(std::sqrt(determinant));
  out.cornerVolumeOfAll = cornerVolumeOf(all, size);
  return out;
}

FlatLayers flatLayers(const DualMesh& mesh, const LayerOptions& options)
{
  std::vector<std::vector<double>> sizes(options.ofTag.size());
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    if (options.ofTag[face.tag].hasHeight())
    {
      sizes[face.tag].push_back(std::sqrt(wallNormal(mesh, face).norm()));
    }
  }
  FlatLayers out;
  for (std::size_t tag = 0; tag < sizes.size(); ++tag)
  {
    std::vector<double>& ofTag = sizes[tag];
    const auto largest = ofTag.begin() + static_cast<std::ptrdiff_t>(mostFaces * static_cast<double>(ofTag.size()));
    if (largest != ofTag.end())
    {
      std::nth_element(ofTag.begin(), largest, ofTag.end());
      out.lower(flatLayers(options.ofTag[tag], *largest));
    }
  }
  return out;
}

} // namespace atria
