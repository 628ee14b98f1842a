// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/Overlaps.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace atria {

namespace {

FacePrecedence precedenceIn(const TriangleSoup& drawn, std::size_t surfaceCount, std::vector<SurfaceKind> kinds)
{
  std::vector<Vec3> points(drawn.points.size());
  std::ranges::transform(drawn.points, points.begin(), toVector);
  // Sources ascend, and some may be missing.
  const std::size_t count = drawn.sources.empty() ? 0 : drawn.sources.back() + 1;
  const PlanarPatches found = findPlanarPatches(points, drawn.triangles, drawn.surfaceIds);
  PlanarPatches bySource{std::vector<double>(count, 0.0), found.surfaceAreas, found.isClosed};
  std::vector<Index> surfaceIds(count, 0);
  for (Index t = 0; t < drawn.triangles.size(); ++t)
  {
    bySource.areas[drawn.sources[t]] = found.areas[t];
    surfaceIds[drawn.sources[t]] = drawn.surfaceIds[t];
  }
  return {std::move(bySource), surfaceIds, surfaceCount, std::move(kinds)};
}

/// Of triangles with the same corners, whether they are wound in opposite directions.
bool areOpposite(const std::array<Index, 3>& a, const std::array<Index, 3>& b)
{
  const auto at = static_cast<std::size_t>(std::ranges::find(b, a[0]) - b.begin());
  return a[1] != b[(at + 1) % 3];
}

} // namespace

Overlaps::Overlaps(const TriangleSoup& drawn, std::size_t surfaceCount, std::vector<SurfaceKind> kinds,
                   const GridFrame& frame)
    : precedence_(precedenceIn(drawn, surfaceCount, std::move(kinds))),
      areaUnit_(0.5 * frame.latticeUnit() * frame.latticeUnit())
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    sides_[axis] = {frame.domainLow[axis], frame.domainHigh[axis]};
  }
}

std::size_t Overlaps::settle(const TriangleSoup& soup, std::span<const Index> equal)
{
  sources_.clear();
  std::ranges::transform(equal, std::back_inserter(sources_), [&](Index t) { return soup.sources[t]; });
  const std::size_t kept = precedence_.keptOf(sources_);
  const bool isWithin = !isOnSide(soup, equal[0]) &&
                        std::ranges::none_of(equal, [&](Index t) { return precedence_.isSide(soup.surfaceIds[t]); });
  for (std::size_t i = 0; i < equal.size(); ++i)
  {
    if (i != kept)
    {
      add(soup, equal[kept], equal[i], isWithin);
    }
  }
  return kept;
}

void Overlaps::add(const TriangleSoup& soup, Index kept, Index dropped, bool isWithin)
{
  const Index keeps = soup.surfaceIds[kept];
  const Index gives = soup.surfaceIds[dropped];
  Overlap& overlap = byPair_[{gives, keeps}];
  const Vec3 u = between(soup.corner(dropped, 0), soup.corner(dropped, 1));
  const Vec3 v = between(soup.corner(dropped, 0), soup.corner(dropped, 2));
  const double area = areaUnit_ * u.cross(v).norm();
  if (overlap.pieces++ == 0)
  {
    overlap.place = toVector(soup.corner(dropped, 0)) + (u + v) / 3.0;
  }
  const Index source = soup.sources[kept];
  const Index other = soup.sources[dropped];
  const bool doSolidsTouch =
      precedence_.areOfClosedSurfaces(source, other) && areOpposite(soup.triangles[kept], soup.triangles[dropped]);
  const bool isOpened =
      isWithin && precedence_.kindOf(keeps) == SurfaceKind::faceZone && precedence_.kindOf(gives) == SurfaceKind::wall;
  overlap.shared.keeps = keeps;
  overlap.shared.gives = gives;
  overlap.shared.area += area;
  overlap.shared.equalArea += precedence_.areEqual(source, other) && !doSolidsTouch ? area : 0.0;
  overlap.shared.openedArea += isOpened ? area : 0.0;
}

bool Overlaps::isOnSide(const TriangleSoup& soup, Index triangle) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t at = soup.corner(triangle, 0)[axis];
    if ((at == sides_[axis][0] || at == sides_[axis][1]) && soup.corner(triangle, 1)[axis] == at &&
        soup.corner(triangle, 2)[axis] == at)
    {
      return true;
    }
  }
  return false;
}

std::vector<Overlap> Overlaps::all() const
{
  std::vector<Overlap> out;
  for (const auto& [pair, overlap] : byPair_)
  {
    out.push_back(overlap);
  }
  return out;
}

std::vector<SharedArea> Overlaps::shared() const
{
  std::vector<SharedArea> out;
  for (const auto& [pair, overlap] : byPair_)
  {
    const auto& [gives, keeps] = pair;
    if (gives != keeps && !precedence_.isSide(gives) && !precedence_.isSide(keeps))
    {
      out.push_back(overlap.shared);
    }
  }
  return out;
}

} // namespace atria
