// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Unions/PolygonUnion.h"

#include "Quality/Faces/Geometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace atria {

namespace {

bool hasEdge(std::span<const Index> loop, Index from, Index to)
{
  const auto at = std::find(loop.begin(), loop.end(), from);
  return at != loop.end() && (at + 1 == loop.end() ? loop.front() : *(at + 1)) == to;
}

/// Returns one entry per edge of a, which runs from point i to the next: true if b has it in the opposite direction.
std::vector<bool> sharedEdges(std::span<const Index> a, std::span<const Index> b)
{
  std::vector<bool> shared(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    shared[i] = hasEdge(b, a[(i + 1) % a.size()], a[i]);
  }
  return shared;
}

/// Counts the runs of true around a loop; a run that never ends does not count.
std::size_t runsIn(const std::vector<bool>& flags)
{
  std::size_t runs = 0;
  for (std::size_t i = 0; i < flags.size(); ++i)
  {
    runs += flags[i] && !flags[i == 0 ? flags.size() - 1 : i - 1] ? 1 : 0;
  }
  return runs;
}

std::size_t runsOfPointsIn(std::span<const Index> a, std::span<const Index> b)
{
  std::vector<bool> shared(a.size());
  std::transform(a.begin(), a.end(), shared.begin(), [&](Index point) { return contains(b, point); });
  return runsIn(shared);
}

bool hasRepeatedPoint(std::span<const Index> loop)
{
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    if (contains(loop.subspan(i + 1), loop[i]))
    {
      return true;
    }
  }
  return false;
}

/// True if the triangle from an apex to an edge is oriented along the normal, with an angle of a sine above `sine` at
/// the apex.
bool looksAlong(const Vec3& normal, const Vec3& apex, const Vec3& from, const Vec3& to, double sine)
{
  const Vec3 u = from - apex;
  const Vec3 v = to - apex;
  return u.cross(v).dot(normal) > sine * std::sqrt(u.squaredNorm() * v.squaredNorm());
}

} // namespace

bool contains(std::span<const Index> list, Index number)
{
  return std::find(list.begin(), list.end(), number) != list.end();
}

bool shareAnEdge(std::span<const Index> a, std::span<const Index> b)
{
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    if (hasEdge(b, a[(i + 1) % a.size()], a[i]))
    {
      return true;
    }
  }
  return false;
}

std::optional<std::vector<Index>> unite(std::span<const Index> a, std::span<const Index> b)
{
  const std::vector<bool> shared = sharedEdges(a, b);
  if (runsIn(shared) != 1)
  {
    return std::nullopt;
  }
  const auto count = static_cast<std::size_t>(std::count(shared.begin(), shared.end(), true));
  std::size_t first = 0;
  while (!shared[first] || shared[first == 0 ? a.size() - 1 : first - 1])
  {
    ++first;
  }
  std::vector<Index> loop;
  for (std::size_t i = count; i <= a.size(); ++i)
  {
    loop.push_back(a[(first + i) % a.size()]);
  }
  // The run is reversed in b, so the points that b adds lie between the run's first point and its last.
  const auto from = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[first]) - b.begin());
  for (std::size_t i = 1; i + count < b.size(); ++i)
  {
    loop.push_back(b[(from + i) % b.size()]);
  }
  if (loop.size() < 3 || hasRepeatedPoint(loop))
  {
    return std::nullopt;
  }
  return loop;
}

bool shareOneRun(std::span<const Index> a, std::span<const Index> b)
{
  const auto common =
      static_cast<std::size_t>(std::count_if(a.begin(), a.end(), [&](Index point) { return contains(b, point); }));
  return common < 2 || (runsOfPointsIn(a, b) == 1 && runsOfPointsIn(b, a) == 1);
}

bool coplanar(std::span<const Vec3> points, std::span<const Index> a, std::span<const Index> b, double sine)
{
  const PolygonMeasure ofA = measurePolygon(points, a);
  const PolygonMeasure ofB = measurePolygon(points, b);
  const double product = ofA.area.norm() * ofB.area.norm();
  if (!(ofA.area.dot(ofB.area) > 0.0) || !(ofA.area.cross(ofB.area).norm() < sine * product))
  {
    return false;
  }
  const Vec3 normal = (ofA.area + ofB.area).normalized();
  const Vec3 middle = 0.5 * (ofA.centroid + ofB.centroid);
  double longest = 0.0;
  double furthest = 0.0;
  for (const auto& loop : {a, b})
  {
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const Vec3& here = points[loop[i]];
      longest = std::max(longest, (points[loop[(i + 1) % loop.size()]] - here).norm());
      furthest = std::max(furthest, std::abs((here - middle).dot(normal)));
    }
  }
  return furthest <= sine * longest;
}

bool isStarShaped(std::span<const Vec3> points, std::span<const Index> loop, const Vec3& center, double sine)
{
  const PolygonMeasure face = measurePolygon(points, loop);
  const Vec3 normal = face.area.normalized();
  if (!((face.centroid - center).dot(normal) > sine * std::sqrt(face.area.norm())))
  {
    return false;
  }
  const std::size_t size = loop.size();
  const auto seesEdge = [&](const Vec3& apex, std::size_t i) {
    return looksAlong(normal, apex, points[loop[i % size]], points[loop[(i + 1) % size]], sine);
  };
  for (std::size_t i = 0; i < size; ++i)
  {
    if (!seesEdge(face.centroid, i))
    {
      return false;
    }
  }
  for (std::size_t apex = 0; apex < size; ++apex)
  {
    std::size_t seen = 1;
    while (seen + 1 < size && seesEdge(points[loop[apex]], apex + seen))
    {
      ++seen;
    }
    if (seen + 1 == size)
    {
      return true;
    }
  }
  return false;
}

double leastTetrahedron(std::span<const Vec3> points, std::span<const Index> loop, const Vec3& center,
                        const Vec3* beyond)
{
  const std::size_t size = loop.size();
  const auto volume = [](const Vec3& from, const Vec3& to, const Vec3& apex, const Vec3& seenFrom) {
    return (from - seenFrom).cross(to - seenFrom).dot(apex - seenFrom) / 6.0;
  };
  /// Smallest volume over the triangles of an apex and `count` edges.
  const auto leastOf = [&](const Vec3& apex, std::size_t first, std::size_t count) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < first + count; ++i)
    {
      const Vec3& from = points[loop[i % size]];
      const Vec3& to = points[loop[(i + 1) % size]];
      least = std::min(least, volume(from, to, apex, center));
      least = beyond ? std::min(least, -volume(from, to, apex, *beyond)) : least;
    }
    return least;
  };
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t base = 0; base < size; ++base)
  {
    best = std::max(best, leastOf(points[loop[base]], base + 1, size - 2));
  }
  const PolygonMeasure face = measurePolygon(points, loop);
  return std::min(best, leastOf(face.centroid, 0, size)) / std::pow(face.area.norm(), 1.5);
}

} // namespace atria
