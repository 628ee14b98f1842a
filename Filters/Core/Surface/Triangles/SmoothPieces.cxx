// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/SmoothPieces.h"

#include "Support/Angles.h"
#include "Support/UnionFind.h"
#include "Surface/Triangles/PointPlaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace atria {

namespace {

struct EdgeUse
{
  Index group;
  Index a;
  Index b;
  Index triangle;

  auto edge() const { return std::tie(group, a, b); }
  bool operator<(const EdgeUse& other) const
  {
    return std::tie(group, a, b, triangle) < std::tie(other.group, other.a, other.b, other.triangle);
  }
};

std::vector<EdgeUse> edgeUses(std::span<const std::array<Index, 3>> triangles, std::span<const Index> groups,
                              const std::vector<Index>& places)
{
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto [a, b] = std::minmax(places[triangles[i][k]], places[triangles[i][(k + 1) % 3]]);
      uses.push_back({groups[i], a, b, static_cast<Index>(i)});
    }
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

} // namespace

std::vector<Index> smoothPieces(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                std::span<const Index> groups, double degrees)
{
  const auto normal = [&](Index i) {
    const auto& [a, b, c] = triangles[i];
    return Vec3((points[b] - points[a]).cross(points[c] - points[a]).stableNormalized());
  };
  constexpr double rounding = 1e-12; // planes that differ by the very angle are together
  const double leastCosine = cosOfDegrees(degrees) - rounding;
  UnionFind pieces(triangles.size());
  const std::vector<EdgeUse> uses = edgeUses(triangles, groups, placesOf(points, 0.0));
  for (std::size_t i = 0; i < uses.size();)
  {
    const std::size_t first = i;
    while (i < uses.size() && uses[i].edge() == uses[first].edge())
    {
      ++i;
    }
    const Index s = uses[first].triangle;
    const Index t = uses[i - 1].triangle;
    if (i - first == 2 && std::abs(normal(s).dot(normal(t))) >= leastCosine)
    {
      pieces.join(s, t);
    }
  }
  std::vector<Index> numbers(triangles.size(), noIndex);
  std::vector<Index> out(triangles.size());
  Index count = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    Index& number = numbers[pieces.find(static_cast<Index>(i))];
    number = number == noIndex ? count++ : number;
    out[i] = number;
  }
  return out;
}

} // namespace atria
