// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/Overlaps.h"

#include "Surface/Search/Distance.h"
#include "Surface/Triangles/Weld.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace atria {

namespace {

/// True if two triangles with the same corners are wound in opposite directions.
bool areOpposite(const std::array<Index, 3>& a, const std::array<Index, 3>& b)
{
  const auto at = static_cast<std::size_t>(std::ranges::find(b, a[0]) - b.begin());
  return a[1] != b[(at + 1) % 3];
}

} // namespace

Overlaps::Overlaps(const TriangleSurface& drawn, std::vector<SurfaceKind> kinds, const GridFrame& frame)
    : drawn_(drawn), kinds_(std::move(kinds)), frame_(frame)
{
}

/// Patches take points for the same if they nearly are: exporters round neighbors apart.
void Overlaps::findPrecedence()
{
  std::vector<LatticePoint> points(drawn_.points.size());
  std::ranges::transform(drawn_.points, points.begin(), [&](const Vec3& p) { return frame_.toLattice(p); });
  const auto size = static_cast<double>(frame_.latticeSize(frame_.featureLevel));
  precedence_.emplace(drawn_, weldPoints(points, static_cast<std::int64_t>(coincidentRatio * size)), kinds_);
}

std::size_t Overlaps::settle(const TriangleSoup& soup, std::span<const Index> equal)
{
  const auto surfaceOf = [&](Index t) { return soup.surfaceIds[t]; };
  std::size_t kept = 0;
  if (std::ranges::any_of(equal, [&](Index t) { return surfaceOf(t) != surfaceOf(equal[0]); }))
  {
    if (!precedence_)
    {
      findPrecedence();
    }
    sources_.clear();
    std::ranges::transform(equal, std::back_inserter(sources_), [&](Index t) { return soup.sources[t]; });
    kept = precedence_->keptOf(sources_);
  }
  const bool isWithin =
      !isOnSide(soup, equal[0]) && std::ranges::none_of(equal, [&](Index t) { return isSide(surfaceOf(t)); });
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
  const double area = 0.5 * frame_.latticeUnit() * frame_.latticeUnit() * u.cross(v).norm();
  if (overlap.pieces++ == 0)
  {
    overlap.place = toVector(soup.corner(dropped, 0)) + (u + v) / 3.0;
  }
  overlap.shared.keeps = keeps;
  overlap.shared.gives = gives;
  overlap.shared.area += area;
  if (keeps != gives)
  {
    const Index source = soup.sources[kept];
    const Index other = soup.sources[dropped];
    const bool doSolidsTouch =
        precedence_->areOfClosedSurfaces(source, other) && areOpposite(soup.triangles[kept], soup.triangles[dropped]);
    const bool isOpened = isWithin && precedence_->kindOf(keeps) == SurfaceKind::faceZone &&
                          precedence_->kindOf(gives) == SurfaceKind::wall;
    overlap.shared.equalArea += precedence_->areEqual(source, other) && !doSolidsTouch ? area : 0.0;
    overlap.shared.openedArea += isOpened ? area : 0.0;
  }
}

bool Overlaps::isOnSide(const TriangleSoup& soup, Index triangle) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t at = soup.corner(triangle, 0)[axis];
    if ((at == frame_.domainLow[axis] || at == frame_.domainHigh[axis]) && soup.corner(triangle, 1)[axis] == at &&
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
    if (!isSide(gives) && !isSide(keeps))
    {
      out.push_back(overlap.shared);
    }
  }
  return out;
}

} // namespace atria
