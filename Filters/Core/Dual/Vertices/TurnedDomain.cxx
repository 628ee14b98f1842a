// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Vertices/TurnedDomain.h"

#include "Support/Error.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace atria {

namespace {

using Edge = std::array<Index, 2>;

/// The sides are surfaces whose corners are on the lattice: points on them are this near to the planes.
constexpr double roundingUnits = 4.0;

/// From the axes of the grid to those of the domain.
Placement turnOf(const GridFrame& frame)
{
  return Placement(frame.turnedDomain->axes.angle() - frame.placement.angle());
}

/// By the two sides, as bits by Direction: the mesh edges in which faces of one lateral side meet those of another.
std::map<unsigned, std::vector<Edge>> edgesBetweenSides(const DualMesh& mesh, std::size_t surfaceCount)
{
  std::map<Edge, unsigned> sidesOf;
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    if (face.tag < surfaceCount || face.tag - surfaceCount > yMax)
    {
      continue;
    }
    const ReducedFace reduced = faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < reduced.count; ++i)
    {
      const Index p = reduced.points[i];
      const Index q = reduced.points[(i + 1) % reduced.count];
      sidesOf[{std::min(p, q), std::max(p, q)}] |= 1u << (face.tag - surfaceCount);
    }
  }
  std::map<unsigned, std::vector<Edge>> between;
  for (const auto& [edge, sides] : sidesOf)
  {
    constexpr unsigned alongX = 1u << xMin | 1u << xMax;
    if ((sides & alongX) != 0 && (sides & ~alongX) != 0)
    {
      between[sides].push_back(edge);
    }
  }
  return between;
}

/// The chains that edges form, each from its lower end up. Rings and what branches are left out.
std::vector<std::vector<Index>> chainsOf(const std::vector<Edge>& edges, const std::vector<Vec3>& points)
{
  std::map<Index, std::vector<Index>> next;
  for (const auto& [a, b] : edges)
  {
    next[a].push_back(b);
    next[b].push_back(a);
  }
  std::vector<std::vector<Index>> chains;
  for (const auto& [start, ahead] : next)
  {
    if (ahead.size() != 1)
    {
      continue;
    }
    std::vector<Index> chain{start};
    for (Index at = ahead.front(); at != noIndex;)
    {
      const Index before = chain.back();
      chain.push_back(at);
      const std::vector<Index>& around = next[at];
      at = around.size() == 2 ? around[around[0] == before ? 1 : 0] : noIndex;
    }
    // Each is found from both ends.
    const auto key = [&](Index p) { return std::pair(points[p][2], p); };
    if (next[chain.back()].size() == 1 && key(chain.front()) < key(chain.back()))
    {
      chains.push_back(std::move(chain));
    }
  }
  return chains;
}

/// The heights of a chain's points; where they do not rise, as where the chain runs level from one octant to the next,
/// they are spread up to the next that does.
std::vector<double> risingHeights(const std::vector<Index>& chain, const std::vector<Vec3>& points)
{
  std::vector<double> heights(chain.size());
  std::transform(chain.begin(), chain.end(), heights.begin(), [&](Index p) { return points[p][2]; });
  const double top = heights.back();
  for (std::size_t i = 1; i + 1 < heights.size(); ++i)
  {
    const double below = heights[i - 1];
    std::size_t j = i;
    while (j + 1 < heights.size() && !(heights[j] > below && heights[j] < top))
    {
      ++j;
    }
    const double step = (heights[j] - below) / static_cast<double>(j - i + 1);
    for (; i < j; ++i)
    {
      heights[i] = heights[i - 1] + step;
    }
  }
  return heights;
}

} // namespace

Crossings markTurnedSides(Crossings crossings, std::size_t surfaceCount)
{
  for (BoundaryFace& face : crossings.boundaryFaces)
  {
    face.onDomainSide = face.onDomainSide || face.tag >= surfaceCount;
  }
  return crossings;
}

std::vector<char> zonesWithinSides(std::vector<char> kept, const Zones& zones, const GridPlaces& grid)
{
  const GridFrame& frame = grid.octree().frame();
  if (!frame.turnedDomain)
  {
    return kept;
  }
  const Box3& box = frame.turnedDomain->bounds;
  const Placement relative = turnOf(frame);
  std::vector<double> farthest(zones.count(), 0.0);
  for (Index point = 0; point < grid.points().size(); ++point)
  {
    const Vec3 p = relative.fromModel(frame.toModel(grid.place(point)));
    const double beyond = std::max({box.min[0] - p[0], p[0] - box.max[0], box.min[1] - p[1], p[1] - box.max[1]});
    double& known = farthest[zones.ofPoint[point]];
    known = std::abs(beyond) > std::abs(known) ? beyond : known;
  }
  for (std::size_t zone = 0; zone < kept.size(); ++zone)
  {
    kept[zone] = kept[zone] && farthest[zone] < 0.0;
  }
  if (std::find(kept.begin(), kept.end(), 1) == kept.end())
  {
    throw Error("no zone is left to mesh inside the turned domain: keep all zones, or give seeds inside it");
  }
  return kept;
}

Vec3 onTurnedSides(const Vec3& position, unsigned sides, const GridFrame& frame)
{
  if (!frame.turnedDomain)
  {
    return position;
  }
  const Box3& box = frame.turnedDomain->bounds;
  const Placement relative = turnOf(frame);
  const Vec3 p = relative.fromModel(position);
  Vec3 inside = p;
  inside.head<2>() = p.head<2>().cwiseMax(box.min.head<2>()).cwiseMin(box.max.head<2>());
  for (int side = xMin; side <= yMax; ++side)
  {
    if (sides >> side & 1)
    {
      inside[axisOf(side)] = isUpper(side) ? box.max[axisOf(side)] : box.min[axisOf(side)];
    }
  }
  return inside == p ? position : relative.toModel(inside);
}

void keepWithinSides(std::span<Vec3> positions, const GridFrame& frame)
{
  std::ranges::transform(positions, positions.begin(), [&](const Vec3& p) { return onTurnedSides(p, 0, frame); });
}

std::vector<std::uint8_t> turnedSidesOf(const DualMesh& mesh, const GridFrame& frame, std::size_t surfaceCount)
{
  std::vector<std::uint8_t> sides(frame.turnedDomain ? mesh.points.size() : 0, 0);
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    if (sides.empty() || face.tag < surfaceCount || face.tag - surfaceCount > yMax)
    {
      continue;
    }
    const unsigned side = 1U << (face.tag - surfaceCount);
    const ReducedFace reduced = faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < reduced.count; ++i)
    {
      const Index p = reduced.points[i];
      const double away = (onTurnedSides(mesh.points[p], side, frame) - mesh.points[p]).norm();
      sides[p] |= static_cast<std::uint8_t>(away <= roundingUnits * frame.latticeUnit() ? side : 0);
    }
  }
  return sides;
}

void sharpenTurnedEdges(DualMesh& mesh, const GridFrame& frame, std::size_t surfaceCount)
{
  if (!frame.turnedDomain)
  {
    return;
  }
  const Box3& box = frame.turnedDomain->bounds;
  const Placement relative = turnOf(frame);
  for (auto& [sides, edges] : edgesBetweenSides(mesh, surfaceCount))
  {
    Vec3 upright = Vec3::Zero();
    upright[0] = sides & 1u << xMax ? box.max[0] : box.min[0];
    upright[1] = sides & 1u << yMax ? box.max[1] : box.min[1];
    upright = relative.toModel(upright);
    for (const std::vector<Index>& chain : chainsOf(edges, mesh.points))
    {
      const std::vector<double> heights = risingHeights(chain, mesh.points);
      for (std::size_t i = 0; i < chain.size(); ++i)
      {
        mesh.points[chain[i]] = {upright[0], upright[1], heights[i]};
      }
    }
  }
}

std::array<Vec3, 6> sideNormalsOf(const GridFrame& frame)
{
  const Placement relative(frame.turnedDomain ? frame.turnedDomain->axes.angle() - frame.placement.angle() : 0.0);
  std::array<Vec3, 6> normals;
  for (int side = 0; side < 6; ++side)
  {
    normals[side] = relative.toModel((isUpper(side) ? 1.0 : -1.0) * Vec3::Unit(axisOf(side)));
  }
  return normals;
}

} // namespace atria
