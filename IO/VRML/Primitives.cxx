// SPDX-License-Identifier: GPL-3.0-or-later
#include "Primitives.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atria::vrml {

namespace {

/// Adds a ring of points around the y axis, counter-clockwise as seen from above.
std::vector<Index> addRing(SurfaceBuilder& builder, double radius, double y, int segments)
{
  std::vector<Index> ring;
  for (int i = 0; i < segments; ++i)
  {
    const double angle = 2.0 * std::numbers::pi * i / segments;
    ring.push_back(builder.point({radius * std::sin(angle), y, radius * std::cos(angle)}));
  }
  return ring;
}

void addBand(SurfaceBuilder& builder, const std::vector<Index>& lower, const std::vector<Index>& upper)
{
  for (std::size_t i = 0; i < lower.size(); ++i)
  {
    const std::size_t next = (i + 1) % lower.size();
    builder.quad(lower[i], lower[next], upper[next], upper[i]);
  }
}

void addFan(SurfaceBuilder& builder, const std::vector<Index>& ring, Index tip)
{
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    builder.polygon(std::array<Index, 3>{ring[i], ring[(i + 1) % ring.size()], tip});
  }
}

/// Cuts a disc into a zigzag of triangles from side to side, so that no point gets many triangles.
void addCap(SurfaceBuilder& builder, std::vector<Index> ring, bool upwards)
{
  if (!upwards)
  {
    std::reverse(ring.begin(), ring.end());
  }
  std::size_t low = 0;
  std::size_t high = ring.size() - 1;
  for (bool fromLow = true; high - low > 1; fromLow = !fromLow)
  {
    const std::size_t middle = fromLow ? low + 1 : high - 1;
    builder.polygon(std::array<Index, 3>{ring[low], ring[middle], ring[high]});
    (fromLow ? low : high) = middle;
  }
}

} // namespace

double sagittaOf(double degrees, double radius)
{
  return radius * (1.0 - std::cos(degrees * std::numbers::pi / 360.0));
}

int segmentsOf(double degrees)
{
  // The tolerance prevents one more segment because 360 / 7.2 came out as 50.000000000000007.
  return std::max(3, static_cast<int>(std::ceil(360.0 / degrees - 1e-9)));
}

namespace {

/// Returns the number of points around an axis. Neighbors are at most twice the angle with this cosine apart.
int segmentsOfCosine(double cosine)
{
  const double half = cosine < 1.0 ? std::acos(std::max(cosine, 0.5)) : 0.0; // three points at least
  const double enough = half > 0.0 ? std::ceil(std::numbers::pi / half - 1e-9) : mostSegments;
  return static_cast<int>(std::min<double>(enough, mostSegments));
}

/// `cosineOf` takes a distance between facets and the true surface, as a share of the radius.
template <typename CosineOf> int segmentsBy(const Tessellation& wanted, double radius, const CosineOf& cosineOf)
{
  int segments = segmentsOf(wanted.angle);
  if (wanted.negligible > 0.0)
  {
    segments = std::min(segments, std::max(fewestSegments, segmentsOfCosine(cosineOf(wanted.negligible / radius))));
  }
  return wanted.error > 0.0 ? std::max(segments, segmentsOfCosine(cosineOf(wanted.error / radius))) : segments;
}

} // namespace

int segmentsOf(const Tessellation& wanted, double radius)
{
  return segmentsBy(wanted, radius, [](double share) { return 1.0 - share; });
}

int segmentsOfSphere(const Tessellation& wanted, double radius)
{
  return segmentsBy(wanted, radius, [](double share) { return std::sqrt(std::max(0.0, 1.0 - share)); });
}

LocalSurface makeBox(const Vec3& size)
{
  SurfaceBuilder builder;
  const Vec3 h = 0.5 * size;
  for (int i = 0; i < 8; ++i)
  {
    builder.point({i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(), i & 4 ? h.z() : -h.z()});
  }
  builder.quad(0, 4, 6, 2);
  builder.quad(1, 3, 7, 5);
  builder.quad(0, 1, 5, 4);
  builder.quad(2, 6, 7, 3);
  builder.quad(0, 2, 3, 1);
  builder.quad(4, 5, 7, 6);
  return builder.take();
}

LocalSurface makeSphere(double radius, int segments)
{
  SurfaceBuilder builder;
  const int bands = std::max(2, (segments + 1) / 2);
  const Index bottom = builder.point({0.0, -radius, 0.0});
  std::vector<Index> below;
  for (int i = 1; i < bands; ++i)
  {
    const double angle = std::numbers::pi * (static_cast<double>(i) / bands - 0.5);
    const std::vector<Index> ring = addRing(builder, radius * std::cos(angle), radius * std::sin(angle), segments);
    if (below.empty())
    {
      std::vector<Index> reversed(ring.rbegin(), ring.rend());
      addFan(builder, reversed, bottom);
    }
    else
    {
      addBand(builder, below, ring);
    }
    below = ring;
  }
  addFan(builder, below, builder.point({0.0, radius, 0.0}));
  return builder.take();
}

LocalSurface makeCylinder(const Cylinder& cylinder, int segments)
{
  SurfaceBuilder builder;
  const double h = 0.5 * cylinder.height;
  std::vector<Index> lower;
  std::vector<Index> upper;
  if (cylinder.side || cylinder.bottom)
  {
    lower = addRing(builder, cylinder.radius, -h, segments);
  }
  if (cylinder.side || cylinder.top)
  {
    upper = addRing(builder, cylinder.radius, h, segments);
  }
  if (cylinder.side)
  {
    addBand(builder, lower, upper);
  }
  if (cylinder.bottom)
  {
    addCap(builder, lower, false);
  }
  if (cylinder.top)
  {
    addCap(builder, upper, true);
  }
  return builder.take();
}

LocalSurface makeCone(const Cone& cone, int segments)
{
  SurfaceBuilder builder;
  const double h = 0.5 * cone.height;
  if (!cone.side && !cone.bottom)
  {
    return {};
  }
  const std::vector<Index> ring = addRing(builder, cone.bottomRadius, -h, segments);
  if (cone.side)
  {
    addFan(builder, ring, builder.point({0.0, h, 0.0}));
  }
  if (cone.bottom)
  {
    addCap(builder, ring, false);
  }
  return builder.take();
}

} // namespace atria::vrml
