// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Vertices/TurnedDomain.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace atria {

namespace {

using Edge = std::array<Index, 2>;

/// Distance of points on sides from the sides' planes, at most: sides are surfaces whose corners are on the lattice.
constexpr double roundingUnits = 4.0;

/// Returns the turn from the axes of the grid to those of the domain.
Placement turnOf(const GridFrame& frame)
{
  return Placement(frame.turnedDomain->axes.angle() - frame.placement.angle());
}

/// Returns the mesh edges in which faces of one upright side meet those of another. Keys are the two sides.
std::map<SideBits, std::vector<Edge>> edgesBetweenSides(const DualMesh& mesh, std::size_t surfaceCount)
{
  std::map<Edge, SideBits> sidesOf;
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    if (face.tag < surfaceCount || !isUprightSide(face.tag - surfaceCount))
    {
      continue;
    }
    const ReducedFace reduced = faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < reduced.count; ++i)
    {
      const Index p = reduced.points[i];
      const Index q = reduced.points[(i + 1) % reduced.count];
      sidesOf[{std::min(p, q), std::max(p, q)}] |= SideBits{1} << (face.tag - surfaceCount);
    }
  }
  std::map<SideBits, std::vector<Edge>> between;
  for (const auto& [edge, sides] : sidesOf)
  {
    if (std::popcount(sides) == 2)
    {
      between[sides].push_back(edge);
    }
  }
  return between;
}

/// Returns the corner in which the two sides meet, if they do.
std::optional<Vec2> cornerOf(const PlacedPrism& domain, SideBits sides)
{
  const std::vector<PrismSide>& all = domain.sides();
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const Index next = all[(i + 1) % all.size()].number;
    if ((SideBits{1} << all[i].number | SideBits{1} << next) == sides)
    {
      return all[i].end;
    }
  }
  return std::nullopt;
}

/// Returns the chains that edges form, each from its lower end up. Rings and branching chains are left out.
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
    // Each chain is found from both ends.
    const auto key = [&](Index p) { return std::pair(points[p][2], p); };
    if (next[chain.back()].size() == 1 && key(chain.front()) < key(chain.back()))
    {
      chains.push_back(std::move(chain));
    }
  }
  return chains;
}

/// Returns the heights of a chain's points. If some do not rise, as where the chain runs level from one octant to the
/// next, they are spread up to the next that does.
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

std::vector<double> farthestFromSides(const Zones& zones, const GridPlaces& grid, const GridPart& part)
{
  const GridFrame& frame = grid.octree().frame();
  if (!frame.turnedDomain)
  {
    return {};
  }
  const Placement relative = turnOf(frame);
  std::vector<double> farthest(zones.count(), 0.0);
  for (Index point = part.points().begin; point < part.points().end; ++point)
  {
    const Vec3 p = relative.fromModel(frame.toModel(grid.place(point)));
    const double beyond = frame.turnedDomain->beyond(p.head<2>());
    double& known = farthest[zones.ofPoint[point]];
    known = std::abs(beyond) > std::abs(known) ? beyond : known;
  }
  return addAll(part.exchange(), std::move(farthest),
                [](double more, double& known) { known = std::abs(more) > std::abs(known) ? more : known; });
}

Vec3 onTurnedSides(const Vec3& position, SideBits sides, const GridFrame& frame)
{
  if (!frame.turnedDomain)
  {
    return position;
  }
  const Placement relative = turnOf(frame);
  const Vec3 p = relative.fromModel(position);
  Vec3 inside = p;
  inside.head<2>() = frame.turnedDomain->nearest(p.head<2>(), sides);
  return inside == p ? position : relative.toModel(inside);
}

void keepWithinSides(std::span<Vec3> positions, const GridFrame& frame)
{
  std::ranges::transform(positions, positions.begin(), [&](const Vec3& p) { return onTurnedSides(p, 0, frame); });
}

std::vector<SideBits> turnedSidesOf(const DualMesh& mesh, const GridFrame& frame, std::size_t surfaceCount)
{
  std::vector<SideBits> sides(frame.turnedDomain ? mesh.points.size() : 0, 0);
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    if (sides.empty() || face.tag < surfaceCount || !isUprightSide(face.tag - surfaceCount))
    {
      continue;
    }
    const SideBits side = SideBits{1} << (face.tag - surfaceCount);
    const ReducedFace reduced = faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < reduced.count; ++i)
    {
      const Index p = reduced.points[i];
      const double away = (onTurnedSides(mesh.points[p], side, frame) - mesh.points[p]).norm();
      sides[p] |= away <= roundingUnits * frame.latticeUnit() ? side : 0;
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
  const Placement relative = turnOf(frame);
  for (auto& [sides, edges] : edgesBetweenSides(mesh, surfaceCount))
  {
    const std::optional<Vec2> corner = cornerOf(*frame.turnedDomain, sides);
    if (!corner)
    {
      continue; // a side shorter than elements lies between them
    }
    const Vec3 upright = relative.toModel({(*corner)[0], (*corner)[1], 0.0});
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

std::vector<Vec3> sideNormalsOf(const GridFrame& frame)
{
  std::vector<Vec3> normals(sideNumbers, Vec3::Zero());
  normals[zMin] = -Vec3::UnitZ();
  normals[zMax] = Vec3::UnitZ();
  const PlacedPrism domain = frame.prism();
  const Placement relative(domain.axes.angle() - frame.placement.angle());
  for (const PrismSide& side : domain.sides())
  {
    normals[side.number] = relative.toModel({side.normal[0], side.normal[1], 0.0});
  }
  return normals;
}

} // namespace atria
