// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/FacePrecedence.h"

#include "Support/Angles.h"
#include "Support/Buckets.h"
#include "Support/UnionFind.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace atria {

namespace {

using Triangle = std::array<Index, 3>;

/// Degrees between normals up to which triangles are in one plane. Facets of round walls differ by more, and rounding
/// by exporters changes less.
constexpr double planarAngle = 0.5;
/// Part of the smaller area up to which areas are equal. Copies of a face that were rounded or triangulated otherwise
/// differ by less.
constexpr double equalRatio = 0.01;
/// Largest number of planes that are told apart at one point.
constexpr std::size_t mostPlanes = 32;

bool areEqualAreas(double a, double b) { return std::abs(a - b) <= equalRatio * std::min(a, b); }

class PatchFinder
{
public:
  PatchFinder(std::span<const Vec3> points, std::span<const Triangle> triangles, std::span<const Index> surfaceIds)
      : soup(triangles), surfaces(surfaceIds), patches(triangles.size()), areas(triangles.size()),
        isClosed(surfaceIds.empty() ? 0 : *std::ranges::max_element(surfaceIds) + 1, 1)
  {
    normals.reserve(soup.size());
    for (std::size_t t = 0; t < soup.size(); ++t)
    {
      const auto& [a, b, c] = soup[t];
      const Vec3 normal = (points[b] - points[a]).cross(points[c] - points[a]);
      areas[t] = 0.5 * normal.norm();
      normals.push_back(normal.stableNormalized());
    }
    const Buckets atPoints = fillBuckets(points.size(), SerialExecutor(), [&](auto&& use) {
      for (Index t = 0; t < soup.size(); ++t)
      {
        for (const Index p : soup[t])
        {
          use(p, t);
        }
      }
    });
    for (Index p = 0; p < points.size(); ++p)
    {
      joinPlanes(atPoints.of(p));
      countOnce(p, atPoints.of(p));
      findOpenEdges(p, atPoints.of(p));
    }
  }

  PlanarPatches take()
  {
    std::vector<double> sums(soup.size(), 0.0);
    PlanarPatches out;
    out.surfaceAreas.resize(isClosed.size(), 0.0);
    for (Index t = 0; t < soup.size(); ++t)
    {
      sums[patches.find(t)] += areas[t];
      out.surfaceAreas[surfaces[t]] += areas[t];
    }
    out.areas.resize(soup.size());
    for (Index t = 0; t < soup.size(); ++t)
    {
      out.areas[t] = sums[patches.find(t)];
    }
    out.isClosed = std::move(isClosed);
    return out;
  }

private:
  /// Joins the triangles at a point that are of one surface and in one plane.
  void joinPlanes(std::span<const Index> triangles)
  {
    static const double leastCosine = cosOfDegrees(planarAngle);
    planes.clear();
    for (const Index t : triangles)
    {
      if (normals[t].isZero(0.0))
      {
        continue;
      }
      const auto found = std::ranges::find_if(planes, [&](Index other) {
        return surfaces[other] == surfaces[t] && std::abs(normals[other].dot(normals[t])) >= leastCosine;
      });
      if (found != planes.end())
      {
        patches.join(*found, t);
      }
      else if (planes.size() < mostPlanes)
      {
        planes.push_back(t);
      }
    }
  }

  /// Keeps the area of only one of the triangles of a surface with the same corners, `point` the lowest of them.
  void countOnce(Index point, std::span<const Index> triangles)
  {
    corners.clear();
    for (const Index t : triangles)
    {
      if (Triangle sorted = soup[t]; std::ranges::min(sorted) == point)
      {
        std::ranges::sort(sorted);
        corners.push_back({surfaces[t], sorted, t});
      }
    }
    std::ranges::sort(corners);
    for (std::size_t i = 1; i < corners.size(); ++i)
    {
      const auto& [surface, sorted, t] = corners[i];
      const auto& [surfaceBefore, sortedBefore, before] = corners[i - 1];
      if (surface == surfaceBefore && sorted == sortedBefore)
      {
        areas[t] = 0.0;
      }
    }
  }

  /// Marks surfaces as open at edges of which `point` is the lower end.
  void findOpenEdges(Index point, std::span<const Index> triangles)
  {
    edges.clear();
    for (const Index t : triangles)
    {
      for (std::size_t i = 0; i < 3 && areas[t] > 0.0; ++i)
      {
        const auto [low, high] = std::minmax(soup[t][i], soup[t][(i + 1) % 3]);
        if (low == point)
        {
          edges.emplace_back(surfaces[t], high);
        }
      }
    }
    std::ranges::sort(edges);
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      const bool isPair = i + 1 < edges.size() && edges[i + 1] == edges[i];
      isClosed[edges[i].first] &= isPair ? 1 : 0;
      i += isPair ? 1 : 0;
    }
  }

  std::span<const Triangle> soup;
  std::span<const Index> surfaces;
  UnionFind patches;
  std::vector<double> areas;  ///< per triangle
  std::vector<char> isClosed; ///< per surface
  std::vector<Vec3> normals;
  std::vector<Index> planes; ///< one triangle of each plane at a point
  std::vector<std::tuple<Index, Triangle, Index>> corners;
  std::vector<std::pair<Index, Index>> edges;
};

/// Keeps the candidates with the least key, or with one that `isLeast(key, least)` accepts as equal.
template <typename KeyOf, typename IsLeast>
void narrow(std::vector<std::size_t>& candidates, const KeyOf& keyOf, const IsLeast& isLeast)
{
  if (candidates.size() > 1)
  {
    const auto least = keyOf(*std::ranges::min_element(candidates, {}, keyOf));
    std::erase_if(candidates, [&](std::size_t i) { return !isLeast(keyOf(i), least); });
  }
}

} // namespace

PlanarPatches findPlanarPatches(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                std::span<const Index> surfaceIds)
{
  return PatchFinder(points, triangles, surfaceIds).take();
}

FacePrecedence::FacePrecedence(PlanarPatches patches, std::span<const Index> surfaceIds, std::size_t surfaceCount,
                               std::vector<SurfaceKind> kinds)
    : patches_(std::move(patches)), surfaceIds_(surfaceIds.begin(), surfaceIds.end()), surfaceCount_(surfaceCount),
      kinds_(std::move(kinds))
{
}

FacePrecedence::FacePrecedence(const TriangleSurface& surface, std::span<const Index> pointOf,
                               std::vector<SurfaceKind> kinds)
    : FacePrecedence({}, surface.surfaceIds, surface.names.size(), std::move(kinds))
{
  std::vector<Triangle> triangles = surface.triangles;
  for (Triangle& triangle : triangles)
  {
    std::ranges::transform(triangle, triangle.begin(), [&](Index p) { return pointOf[p]; });
  }
  patches_ = findPlanarPatches(surface.points, triangles, surface.surfaceIds);
}

std::size_t FacePrecedence::keptOf(std::span<const Index> triangles) const
{
  std::vector<std::size_t> candidates(triangles.size());
  std::iota(candidates.begin(), candidates.end(), std::size_t{0});
  const auto isSame = [](auto a, auto b) { return a == b; };
  narrow(
      candidates, [&](std::size_t i) { return orderOf(triangles[i]); }, isSame);
  narrow(
      candidates, [&](std::size_t i) { return patches_.areas[triangles[i]]; }, areEqualAreas);
  narrow(
      candidates, [&](std::size_t i) { return yieldsToWalls(triangles[i]); }, isSame);
  narrow(
      candidates, [&](std::size_t i) { return wholeArea(triangles[i]); }, areEqualAreas);
  narrow(
      candidates, [&](std::size_t i) { return triangles[i]; }, isSame);
  return candidates.front();
}

bool FacePrecedence::areEqual(Index a, Index b) const
{
  return surfaceIds_[a] != surfaceIds_[b] && orderOf(a) == orderOf(b) && yieldsToWalls(a) == yieldsToWalls(b) &&
         areEqualAreas(patches_.areas[a], patches_.areas[b]) && areEqualAreas(wholeArea(a), wholeArea(b));
}

bool FacePrecedence::areOfClosedSurfaces(Index a, Index b) const
{
  return patches_.isClosed[surfaceIds_[a]] && patches_.isClosed[surfaceIds_[b]];
}

int FacePrecedence::orderOf(Index triangle) const
{
  const Index surface = surfaceIds_[triangle];
  return isSide(surface) ? 2 : kindOf(surface) == SurfaceKind::cellZone ? 1 : 0;
}

bool FacePrecedence::yieldsToWalls(Index triangle) const
{
  return kindOf(surfaceIds_[triangle]) == SurfaceKind::faceZone;
}

double FacePrecedence::wholeArea(Index triangle) const { return patches_.surfaceAreas[surfaceIds_[triangle]]; }

} // namespace atria
