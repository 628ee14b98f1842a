// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/UpperSide.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace atria {

namespace {

/// Largest sine against the vertical of upright triangles, and least cosine between triangles of one side.
constexpr double uprightSine = 0.02;
constexpr double samePlane = 0.98;

Vec3 normalOf(const TriangleSurface& surface, std::size_t triangle)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vec3 area = (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]);
  return area.norm() > 0.0 ? Vec3(area.normalized()) : Vec3(Vec3::Zero());
}

std::vector<char> closedBodies(const TriangleSurface& surface, const ModelBodies& bodies)
{
  std::vector<char> isClosed(bodies.boxes.size(), 1);
  for (const FreeEdge& edge : findFreeEdges(surface, bodies))
  {
    isClosed[bodies.ofTriangle[edge.triangle]] = 0;
  }
  return isClosed;
}

/// Adds to `isLower` the upright sides that border on its triangles.
void addSides(const TriangleSurface& surface, const ModelBodies& bodies, const std::vector<char>& isClosed,
              std::vector<char>& isLower)
{
  std::map<std::array<Index, 2>, std::vector<Index>> around;
  const auto edgeOf = [&](std::size_t t, int i) {
    const Index a = bodies.placeOf[surface.triangles[t][i]];
    const Index b = bodies.placeOf[surface.triangles[t][(i + 1) % 3]];
    return std::array{std::min(a, b), std::max(a, b)};
  };
  std::vector<Index> open;
  for (std::size_t t = 0; t < isLower.size(); ++t)
  {
    if (bodies.ofTriangle[t] == noIndex || !isClosed[bodies.ofTriangle[t]])
    {
      continue;
    }
    for (int i = 0; i < 3; ++i)
    {
      around[edgeOf(t, i)].push_back(static_cast<Index>(t));
    }
    if (isLower[t])
    {
      open.push_back(static_cast<Index>(t));
    }
  }
  while (!open.empty())
  {
    const Index t = open.back();
    open.pop_back();
    const Vec3 own = normalOf(surface, t);
    for (int i = 0; i < 3; ++i)
    {
      for (const Index other : around[edgeOf(t, i)])
      {
        const Vec3 normal = normalOf(surface, other);
        const bool isOneSide = std::abs(own[2]) > uprightSine || std::abs(own.dot(normal)) >= samePlane;
        if (!isLower[other] && std::abs(normal[2]) <= uprightSine && isOneSide)
        {
          isLower[other] = 1;
          open.push_back(other);
        }
      }
    }
  }
}

} // namespace

std::vector<Index> keepUpperSides(TriangleSurface& surface, const SurfaceFlags& isGround, double tolerance)
{
  SurfaceFlags others(isGround.size());
  std::ranges::transform(isGround, others.begin(), [](char ground) { return ground ? 0 : 1; });
  const ModelBodies bodies = findBodies(surface, others);
  const std::vector<char> isClosed = closedBodies(surface, bodies);
  std::vector<Index> solid;
  for (std::size_t t = 0; t < bodies.ofTriangle.size(); ++t)
  {
    if (bodies.ofTriangle[t] != noIndex && isClosed[bodies.ofTriangle[t]])
    {
      solid.push_back(static_cast<Index>(t));
    }
  }
  if (solid.empty())
  {
    return {};
  }
  const PlumbLines lines(surface, solid);
  std::vector<char> isLower(surface.triangles.size(), 0);
  std::vector<PlumbHit> hits;
  for (const Index t : solid)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 center = (surface.points[a] + surface.points[b] + surface.points[c]) / 3.0;
    lines.find(center[0], center[1], hits);
    isLower[t] = std::abs(normalOf(surface, t)[2]) > uprightSine && std::ranges::any_of(hits, [&](const PlumbHit& hit) {
                   return bodies.ofTriangle[hit.triangle] == bodies.ofTriangle[t] && hit.height > center[2] + tolerance;
                 });
  }
  addSides(surface, bodies, isClosed, isLower);
  std::vector<char> isCut(surface.names.size(), 0);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < isLower.size(); ++t)
  {
    const Index id = surface.surfaceIds[t];
    if (isLower[t])
    {
      isCut[id] = 1;
      continue;
    }
    surface.triangles[kept] = surface.triangles[t];
    surface.surfaceIds[kept++] = id;
  }
  surface.triangles.resize(kept);
  surface.surfaceIds.resize(kept);
  std::vector<Index> cut;
  for (Index id = 0; id < isCut.size(); ++id)
  {
    if (isCut[id])
    {
      cut.push_back(id);
    }
  }
  return cut;
}

Index findGroundSlab(const TriangleSurface& surface, const ModelBodies& bodies, double tolerance)
{
  constexpr double mostHeight = 0.1; // part of the width
  constexpr double leastArea = 2.0;  // ratio to the area of all else
  std::vector<double> areas(bodies.boxes.size());
  std::ranges::transform(bodies.boxes, areas.begin(), [](const Box3& box) { return box.size()[0] * box.size()[1]; });
  const auto widest = std::ranges::max_element(areas);
  const auto slab = static_cast<Index>(widest - areas.begin());
  if (bodies.boxes.size() < 2 || bodies.height(slab) > mostHeight * bodies.boxes[slab].size().head<2>().minCoeff() ||
      !(bodies.height(slab) > tolerance) || closedBodies(surface, bodies)[slab] == 0)
  {
    return noIndex;
  }
  const Box3& box = bodies.boxes[slab];
  std::array<std::vector<Vec2>, 2> points;
  Index id = noIndex;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const bool isSlab = bodies.ofTriangle[t] == slab;
    id = isSlab && id == noIndex ? surface.surfaceIds[t] : id;
    for (const Index p : surface.triangles[t])
    {
      const Vec3& q = surface.points[p];
      points[isSlab ? 1 : 0].emplace_back(q.head<2>());
      if (((q - box.min).array() < -tolerance).any() || ((box.max - q).head<2>().array() < -tolerance).any())
      {
        return noIndex;
      }
    }
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if ((surface.surfaceIds[t] == id) != (bodies.ofTriangle[t] == slab))
    {
      return noIndex; // other bodies have the name too
    }
  }
  const auto [others, own] = std::pair(hullOf(std::move(points[0])), hullOf(std::move(points[1])));
  return own.area >= leastArea * others.area && others.area > 0.0 ? id : noIndex;
}

} // namespace atria
