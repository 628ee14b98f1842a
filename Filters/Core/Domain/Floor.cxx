// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/Floor.h"

#include <algorithm>

namespace atria {

namespace {

/// Cost of a meter of depth below the floor, against 1 for a meter of height above it. Parts below the floor are lost,
/// but parts above it are let down.
constexpr double costOfDepth = 3.0;
/// Distance from the floor, as a part of the height of the model over a face, above which the face hovers instead of
/// standing on a floor of its own.
constexpr double hoverRatio = 0.25;

double costOf(const std::vector<LowestFace>& faces, double floor)
{
  double cost = 0.0;
  for (const LowestFace& face : faces)
  {
    const double above = face.height - floor;
    cost += face.area * (above < 0.0 ? -costOfDepth * above : above <= hoverRatio * face.rise ? above : face.rise);
  }
  return cost;
}

} // namespace

double findFloor(const std::vector<LowestFace>& faces, double lowestPoint)
{
  std::vector<double> heights;
  for (const LowestFace& face : faces)
  {
    if (face.rise > 0.0 && face.area > 0.0)
    {
      heights.push_back(face.height);
    }
  }
  if (heights.empty())
  {
    return lowestPoint;
  }
  for (const LowestFace& face : faces)
  {
    heights.push_back(face.height);
  }
  std::ranges::sort(heights);
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  constexpr std::size_t mostTried = 512;
  const std::size_t step = 1 + (heights.size() - 1) / mostTried;
  double floor = heights.front();
  double least = costOf(faces, floor);
  for (std::size_t i = step; i < heights.size(); i += step)
  {
    if (const double cost = costOf(faces, heights[i]); cost < least)
    {
      least = cost;
      floor = heights[i];
    }
  }
  return floor;
}

} // namespace atria
