// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Openings/Openings.h"

#include "Support/Angles.h"
#include "Surface/Openings/PlaneSection.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace atria {

namespace {

/// Part of an opening's border that ends of walls must be to count as all of it, within rounding.
constexpr double allOfIt = 0.98;
/// Least part of a door's border that ends of walls must be, and the least part with the walls that stand up to it. A
/// table in a room has less.
constexpr double leastEnds = 0.25;
constexpr double leastUpright = 0.5;

struct Candidate
{
  FoundOpening opening;
  double area = 0.0;
  Vec3 normal;
  Vec3 center;
  /// Charts that go back from its border, sorted.
  std::vector<Index> reveals;
};

/// Returns the ends of each chain of boundary edges of a plane's walls, if it has two.
std::vector<EdgeKey> chainEnds(const WallPlane& plane, const SectionSource& source)
{
  std::map<Index, std::vector<Index>> next;
  for (const Index t : plane.triangles)
  {
    for (int i = 0; i < 3 && !source.model.isPermeable(t); ++i)
    {
      if (source.usesOf[t][i].size() == 1)
      {
        const auto [a, b] = edgeKey(source.model.triangles[t], i);
        next[a].push_back(b);
        next[b].push_back(a);
      }
    }
  }
  std::vector<EdgeKey> ends;
  for (const auto& [start, beside] : next)
  {
    Index before = start;
    Index at = beside.size() == 1 ? beside[0] : start;
    while (at != start && next.at(at).size() == 2)
    {
      const std::vector<Index>& two = next.at(at);
      before = std::exchange(at, two[0] == before ? two[1] : two[0]);
    }
    if (at > start && next.at(at).size() == 1)
    {
      ends.emplace_back(start, at);
    }
  }
  return ends;
}

/// Returns, per plane, lines that close openings around a corner: chains of boundary edges in two planes that end in
/// the same points.
std::vector<std::vector<EdgeKey>> cornerLines(const std::vector<WallPlane>& planes, const SectionSource& source)
{
  std::map<EdgeKey, std::vector<std::size_t>> planesOf;
  for (std::size_t p = 0; p < planes.size(); ++p)
  {
    for (const EdgeKey& ends : chainEnds(planes[p], source))
    {
      planesOf[ends].push_back(p);
    }
  }
  std::vector<std::vector<EdgeKey>> lines(planes.size());
  for (const auto& [line, sharing] : planesOf)
  {
    for (const std::size_t p : sharing.size() > 1 ? sharing : std::vector<std::size_t>())
    {
      lines[p].push_back(line);
    }
  }
  return lines;
}

/// Judges regions of a section by their triangles, their border, and the ends of walls along it.
class RegionJudge
{
public:
  RegionJudge(const WallPlane& p, const PlaneSection& s, const SurfaceModel& m, const OpeningOptions& o)
      : plane(p), section(s), model(m), options(o), trianglesOf(s.parted.regionCount)
  {
    for (std::size_t t = 0; t < section.parted.triangles.size(); ++t)
    {
      const auto& corners = section.parted.triangles[t];
      trianglesOf[section.parted.regions[t]].push_back(t);
      for (int i = 0; i < 3; ++i)
      {
        regionBeyond[{corners[i], corners[(i + 1) % 3]}] = section.parted.regions[t];
      }
    }
  }

  void judge(Index region, std::vector<Candidate>& out)
  {
    if (section.covered[region])
    {
      return;
    }
    measure(region);
    const bool isAll = ends >= allOfIt * length;
    const bool isDoor = ends >= leastEnds * length && ends + upright >= leastUpright * length && plane.area >= area;
    if ((isAll || isDoor) && widthOf(region) >= options.leastWidth)
    {
      add(region, out);
    }
  }

private:
  const Vec2& at(Index point) const { return section.parted.points[point]; }

  double areaOf(std::size_t triangle) const
  {
    const auto& [a, b, c] = section.parted.triangles[triangle];
    const Vec2 p = at(b) - at(a);
    const Vec2 q = at(c) - at(a);
    return 0.5 * (p[0] * q[1] - p[1] * q[0]);
  }

  void measure(Index region)
  {
    border.clear();
    area = length = ends = upright = 0.0;
    endsOfSurface.clear();
    reveals.clear();
    front = 0.0;
    for (const std::size_t t : trianglesOf[region])
    {
      area += areaOf(t);
      const auto& corners = section.parted.triangles[t];
      for (int i = 0; i < 3; ++i)
      {
        const Index a = corners[i];
        const Index b = corners[(i + 1) % 3];
        const auto beyond = regionBeyond.find({b, a});
        if (beyond == regionBeyond.end() || beyond->second != region)
        {
          border.push_back({a, b});
          measureEdge(a, b);
        }
      }
    }
  }

  void measureEdge(Index a, Index b)
  {
    const Vec2 along = at(b) - at(a);
    const double own = along.norm();
    length += own;
    const Vec2 middle = 0.5 * (at(a) + at(b));
    const auto near = [&](const WallEnd& end) {
      return (onSegment(middle, end.from, end.to) - middle).norm() <= 2.0 * options.planarDistance;
    };
    if (const auto end = std::ranges::find_if(section.ends, near); end != section.ends.end())
    {
      ends += own;
      endsOfSurface[model.surfaceIds[end->triangle]] += own;
      front += own * (model.normal(end->triangle).dot(plane.normal) > 0.0 ? 1.0 : -1.0);
      reveals.insert(reveals.end(), end->reveals.begin(), end->reveals.end());
    }
    else if (std::abs((along[0] * plane.u + along[1] * plane.v)[2]) > alongCosine * own)
    {
      upright += own;
    }
  }

  static Vec2 onSegment(const Vec2& p, const Vec2& a, const Vec2& b)
  {
    const Vec2 along = b - a;
    const double share = along.squaredNorm() > 0.0 ? (p - a).dot(along) / along.squaredNorm() : 0.0;
    return a + std::clamp(share, 0.0, 1.0) * along;
  }

  /// Returns the width of the largest circle around a centroid of the triangles or a middle of an edge between them.
  double widthOf(Index region) const
  {
    double most = 0.0;
    const auto look = [&](const Vec2& p) {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [a, b] : border)
      {
        least = std::min(least, (onSegment(p, at(a), at(b)) - p).norm());
      }
      most = std::max(most, least);
    };
    for (const std::size_t t : trianglesOf[region])
    {
      const auto& corners = section.parted.triangles[t];
      look((at(corners[0]) + at(corners[1]) + at(corners[2])) / 3.0);
      for (int i = 0; i < 3; ++i)
      {
        look(0.5 * (at(corners[i]) + at(corners[(i + 1) % 3]))); // 0 on the border
      }
    }
    return 2.0 * most;
  }

  LatticePoint latticePointOf(Index point) const
  {
    if (point < section.corners.size())
    {
      return section.corners[point];
    }
    const Vec3 p = plane.pointAt(at(point));
    return {std::llround(p[0]), std::llround(p[1]), std::llround(p[2])};
  }

  void add(Index region, std::vector<Candidate>& out) const
  {
    Candidate candidate;
    candidate.area = area;
    candidate.normal = plane.normal;
    candidate.reveals = reveals;
    std::ranges::sort(candidate.reveals);
    const auto longest = std::ranges::max_element(endsOfSurface, {}, [](const auto& entry) { return entry.second; });
    candidate.opening.surface = longest->first;
    if (!options.surfaces.empty() && !options.surfaces[longest->first])
    {
      return;
    }
    Vec2 center = Vec2::Zero();
    std::map<Index, Index> numbers;
    for (const std::size_t t : trianglesOf[region])
    {
      std::array<Index, 3> triangle;
      for (int i = 0; i < 3; ++i)
      {
        const Index point = section.parted.triangles[t][front >= 0.0 ? i : 2 - i];
        const auto [known, isNew] = numbers.try_emplace(point, static_cast<Index>(numbers.size()));
        if (isNew)
        {
          candidate.opening.points.push_back(latticePointOf(point));
        }
        triangle[i] = known->second;
        center += areaOf(t) / (3.0 * area) * at(point);
      }
      candidate.opening.triangles.push_back(triangle);
    }
    candidate.center = plane.pointAt(center);
    out.push_back(std::move(candidate));
  }

  const WallPlane& plane;
  const PlaneSection& section;
  const SurfaceModel& model;
  const OpeningOptions& options;
  std::vector<std::vector<std::size_t>> trianglesOf;
  /// Maps a directed edge to the region of the triangle that runs along it.
  std::map<std::array<Index, 2>, Index> regionBeyond;
  /// Border of the current region.
  std::vector<std::array<Index, 2>> border;
  double area = 0.0;
  double length = 0.0;
  double ends = 0.0;
  double upright = 0.0;
  double front = 0.0;
  std::map<Index, double> endsOfSurface;
  std::vector<Index> reveals;
};

/// True if two openings are at both ends of one reveal, or as near to each other as if they were.
bool areOne(const Candidate& a, const Candidate& b, double near)
{
  constexpr double parallel = 0.99; // cosine: both ends of one reveal, as walls are drawn
  const Vec3 between = b.center - a.center;
  const double apart = std::abs(between.dot(a.normal));
  const double beside = (between - a.normal * between.dot(a.normal)).norm();
  const bool isOver = std::abs(a.normal.dot(b.normal)) > parallel && beside < 0.5 * std::sqrt(std::min(a.area, b.area));
  const auto shared = [&] {
    return std::ranges::any_of(a.reveals, [&](Index chart) { return std::ranges::binary_search(b.reveals, chart); });
  };
  return isOver && (apart < near || shared());
}

/// Keeps the smallest of openings that are one, and the first of equal ones.
void dropRepeated(std::vector<Candidate>& candidates, double near)
{
  std::ranges::stable_sort(candidates, {}, &Candidate::area);
  std::vector<Candidate> kept;
  for (Candidate& candidate : candidates)
  {
    if (std::ranges::none_of(kept, [&](const Candidate& other) { return areOne(candidate, other, near); }))
    {
      kept.push_back(std::move(candidate));
    }
  }
  candidates = std::move(kept);
}

} // namespace

std::vector<FoundOpening> findOpenings(const SurfaceModel& model, const GridFrame& frame, const OpeningOptions& options,
                                       const RunContext& context)
{
  std::vector<WallPlane> planes = findWallPlanes(model, options.planarDistance);
  std::erase_if(planes, [&](const WallPlane& plane) {
    return (plane.bounds.max - plane.bounds.min).norm() < options.leastWidth;
  });
  context.progress.check();
  const SectionSource source(model, frame, options.sidesAreWalls, options.planarDistance, context);
  const std::vector<std::vector<EdgeKey>> lines = cornerLines(planes, source);
  std::vector<std::vector<Candidate>> found(planes.size());
  context.executor.forEach(planes.size(), 1, [&](std::size_t p) {
    context.progress.check();
    const PlaneSection section = sectionAt(planes[p], lines[p], source);
    RegionJudge judge(planes[p], section, model, options);
    for (Index region = 1; region < section.parted.regionCount; ++region)
    {
      judge.judge(region, found[p]);
    }
  });
  std::vector<Candidate> all;
  for (std::vector<Candidate>& some : found)
  {
    std::ranges::move(some, std::back_inserter(all));
  }
  dropRepeated(all, options.leastWidth);
  std::ranges::stable_sort(all, [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.opening.surface, a.center[0], a.center[1], a.center[2]) <
           std::tuple(b.opening.surface, b.center[0], b.center[1], b.center[2]);
  });
  std::vector<FoundOpening> openings;
  std::ranges::transform(all, std::back_inserter(openings),
                         [](Candidate& candidate) { return std::move(candidate.opening); });
  return openings;
}

} // namespace atria
