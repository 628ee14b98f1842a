// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/StageOptions.h"

#include <algorithm>
#include <bit>
#include <concepts>
#include <ranges>
#include <tuple>

namespace atria {

namespace {

// Lists the members of structures. Structured bindings name them, so that a member that is added to a structure is a
// compiler error until it is listed here.

auto membersOf(const Box3& of)
{
  const auto& [min, max] = of;
  return std::tie(min, max);
}

auto membersOf(const TriangleSurface& of)
{
  const auto& [points, triangles, surfaceIds, names] = of;
  return std::tie(points, triangles, surfaceIds, names);
}

auto membersOf(const SiteOptions& of)
{
  const auto& [mode, bounds, sides, polygon, domainAngle, windAngle, site, terrain, alignment, grounds, snap, floor] =
      of;
  return std::tie(mode, bounds, sides, polygon, domainAngle, windAngle, site, terrain, alignment, grounds, snap, floor);
}

auto membersOf(const GridOptions& of)
{
  const auto& [domain, sizeMin, sizeMid, sizeMax, startLevel, finestAsked] = of;
  return std::tie(domain, sizeMin, sizeMid, sizeMax, startLevel, finestAsked);
}

auto membersOf(const SurfaceSize& of)
{
  const auto& [pattern, size, featureSize] = of;
  return std::tie(pattern, size, featureSize);
}

auto membersOf(const RefinementBox& of)
{
  const auto& [bounds, size] = of;
  return std::tie(bounds, size);
}

auto membersOf(const DistanceSize& of)
{
  const auto& [pattern, distance, size] = of;
  return std::tie(pattern, distance, size);
}

auto membersOf(const SizingOptions& of)
{
  const auto& [surfaces, boxes, distances, curvature, acrossGap, perLevel, hexahedra, maxElements, memoryLimit] = of;
  return std::tie(surfaces, boxes, distances, curvature, acrossGap, perLevel, hexahedra, maxElements, memoryLimit);
}

auto membersOf(const ModelOptions& of)
{
  const auto& [site, sizes, sizing, angle, gap, parts, faceZones, cellZones, findOpenings, without] = of;
  return std::tie(site, sizes, sizing, angle, gap, parts, faceZones, cellZones, findOpenings, without);
}

auto membersOf(const PrismSide& of)
{
  const auto& [number, normal, offset, start, end] = of;
  return std::tie(number, normal, offset, start, end);
}

auto membersOf(const GridFrame& of)
{
  const auto& [origin, finest, depth, start, mid, top, feature, subBits, domain, low, high, placement, turned] = of;
  return std::tie(origin, finest, depth, start, mid, top, feature, subBits, domain, low, high, placement, turned);
}

auto membersOf(const OctreeSets& of)
{
  const auto& [frame, refined] = of;
  return std::tie(frame, refined);
}

auto membersOf(const CrossingOptions& of)
{
  const auto& [crackTolerance] = of;
  return std::tie(crackTolerance);
}

auto membersOf(const RoomOptions& of)
{
  const auto& [sidesAreWalls] = of;
  return std::tie(sidesAreWalls);
}

auto membersOf(const ZoneOptions& of)
{
  const auto& [rule, seeds, sealedSeeds, rooms] = of;
  return std::tie(rule, seeds, sealedSeeds, rooms);
}

struct Same
{
  bool operator()(double a, double b) const
  {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  }
  template <typename T>
  requires std::integral<T> || std::is_enum_v<T>
  bool operator()(T a, T b) const { return a == b; }
  bool operator()(const std::string& a, const std::string& b) const { return a == b; }
  bool operator()(const Placement& a, const Placement& b) const { return operator()(a.angle(), b.angle()); }
  bool operator()(const PlacedPrism& a, const PlacedPrism& b) const
  {
    return operator()(a.axes, b.axes) && operator()(a.bounds, b.bounds) && operator()(a.sides(), b.sides());
  }
  template <typename T> bool operator()(const std::optional<T>& a, const std::optional<T>& b) const
  {
    return a.has_value() == b.has_value() && (!a || operator()(*a, *b));
  }
  /// Compares ranges, among them Eigen's vectors.
  template <std::ranges::range T> bool operator()(const T& a, const T& b) const
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), *this);
  }
  template <typename T>
  requires requires(const T& of) { membersOf(of); }
  bool operator()(const T& a, const T& b) const
  {
    const auto compare = [&]<std::size_t... I>(const auto& x, const auto& y, std::index_sequence<I...>)
    {
      return (operator()(std::get<I>(x), std::get<I>(y)) && ...);
    };
    const auto members = membersOf(a);
    return compare(members, membersOf(b), std::make_index_sequence<std::tuple_size_v<decltype(members)>>());
  }
};

} // namespace

bool isSame(const TriangleSurface& a, const TriangleSurface& b) { return Same()(a, b); }
bool isSame(const OctreeSets& a, const OctreeSets& b) { return Same()(a, b); }
bool isSame(const ModelOptions& a, const ModelOptions& b) { return Same()(a, b); }
bool isSame(const CrossingOptions& a, const CrossingOptions& b) { return Same()(a, b); }
bool isSame(const ZoneOptions& a, const ZoneOptions& b) { return Same()(a, b); }
bool isSame(const ElementOptions& a, const ElementOptions& b)
{
  return a.hexahedra == b.hexahedra && isSame(static_cast<const ZoneOptions&>(a), b);
}

} // namespace atria
