// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/BodiesOnGround.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace atria {

namespace {

/// Height in meters above which one can walk below a part. Such a gap may be drawn on purpose.
constexpr double passageHeight = 2.0;
/// Ratio of width to height from which on no air passes through a space below a part of a body.
constexpr double leastWidth = 2.0;
/// The least part of its outline that a body stands on.
constexpr double broadPart = 0.5;
/// Gap, as a part of its height, up to which a hovering body may be meant to stand.
constexpr double doubtfulRatio = 0.25;

/// Distances from the ground up to a base, and the height of the lowest ground below it.
struct Gap
{
  double least = 0.0;
  double most = 0.0;
  double lowestGround = 0.0;
};

struct BodyState
{
  std::vector<Index> triangles;
  Vec3 lowest = Vec3::Zero();
  std::vector<Index> bases;
  bool touches = false;
  bool isAsDrawn = false;
  BodyAtGround letDown;
  BodyAtGround hovers;
};

class Judge
{
public:
  Judge(const TriangleSurface& model, const ModelBodies& modelBodies, const std::vector<BodyBase>& bodyBases,
        const SupportSearch& supportSearch, const GroundBelow& below, const SnapOptions& snapOptions)
      : surface(model), bodies(modelBodies), bases(bodyBases), supports(supportSearch), ground(below),
        options(snapOptions), states(bodies.boxes.size())
  {
    out.heights.assign(surface.points.size(), std::nan(""));
  }

  StandingBodies run()
  {
    collect();
    for (Index body = 0; body < states.size(); ++body)
    {
      // Smaller bodies are left out of the mesh, and flat ones are no bodies.
      if (bodies.boxes[body].size().norm() >= options.sizeMin && bodies.height(body) > options.tolerance)
      {
        states[body].bases.empty() ? judgeWithoutBase(body) : judge(body);
        report(body);
      }
    }
    const auto nearer = [](const BodyAtGround& l, const BodyAtGround& r) { return l.distance < r.distance; };
    const auto farther = [](const BodyAtGround& l, const BodyAtGround& r) { return l.distance > r.distance; };
    std::ranges::stable_sort(out.report.hovering, nearer);
    std::ranges::stable_sort(out.report.letDown, farther);
    std::ranges::stable_sort(out.report.belowGround, farther);
    return std::move(out);
  }

private:
  void collect()
  {
    for (Index t = 0; t < surface.triangles.size(); ++t)
    {
      if (bodies.ofTriangle[t] == noIndex)
      {
        continue;
      }
      BodyState& state = states[bodies.ofTriangle[t]];
      state.lowest = state.triangles.empty() ? surface.points[surface.triangles[t][0]] : state.lowest;
      state.triangles.push_back(t);
      state.isAsDrawn = state.isAsDrawn || (!options.asDrawn.empty() && options.asDrawn[surface.surfaceIds[t]] != 0);
      for (const Index p : surface.triangles[t])
      {
        state.lowest = surface.points[p][2] < state.lowest[2] ? surface.points[p] : state.lowest;
      }
    }
    for (Index base = 0; base < bases.size(); ++base)
    {
      states[bases[base].body].bases.push_back(base);
    }
  }

  Gap gapOf(const BodyBase& base) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Gap gap{infinity, -infinity, infinity};
    for (const Index place : base.places)
    {
      const Vec3& p = surface.points[place];
      const double height = ground.heightAt(p);
      gap.least = std::min(gap.least, p[2] - height);
      gap.most = std::max(gap.most, p[2] - height);
      gap.lowestGround = std::min(gap.lowestGround, height);
    }
    for (const Index t : base.triangles)
    {
      const auto& [a, b, c] = surface.triangles[t];
      const Vec3 center = (surface.points[a] + surface.points[b] + surface.points[c]) / 3.0;
      gap.lowestGround = std::min(gap.lowestGround, ground.heightAt(center));
    }
    return gap;
  }

  /// True if the hull of all bases near the ground is at least half as large as that of the body, both seen from above.
  /// A body's lowest places alone do not make it stand.
  bool isBroad(Index body, const std::vector<Gap>& gaps) const
  {
    const double most = std::max(options.ratio, doubtfulRatio);
    std::vector<Vec2> below;
    for (std::size_t i = 0; i < gaps.size(); ++i)
    {
      const BodyBase& base = bases[states[body].bases[i]];
      if (gaps[i].most <= std::max(options.tolerance, most * (base.top - base.low)))
      {
        below.insert(below.end(), base.outline.corners.begin(), base.outline.corners.end());
      }
    }
    std::vector<Vec2> all;
    for (const Index t : states[body].triangles)
    {
      for (const Index p : surface.triangles[t])
      {
        all.emplace_back(surface.points[p].head<2>());
      }
    }
    return !below.empty() && hullOf(std::move(below)).area >= broadPart * hullOf(std::move(all)).area;
  }

  void judge(Index body)
  {
    BodyState& state = states[body];
    std::vector<Gap> gaps;
    for (const Index number : state.bases)
    {
      gaps.push_back(gapOf(bases[number]));
      state.touches = state.touches || gaps.back().least <= options.tolerance;
    }
    const bool hasGap = std::ranges::any_of(gaps, [&](const Gap& gap) { return gap.most > options.tolerance; });
    const bool broad = hasGap && isBroad(body, gaps);
    for (std::size_t i = 0; i < gaps.size(); ++i)
    {
      if (gaps[i].most > options.tolerance)
      {
        judgeBase(state.bases[i], gaps[i], broad, state);
      }
    }
  }

  void judgeBase(Index number, const Gap& gap, bool isBroadBody, BodyState& state)
  {
    const BodyBase& base = bases[number];
    const BaseSupport support = supports.find(number, gap.lowestGround);
    if (support == BaseSupport::below)
    {
      return;
    }
    const bool isBeside = support == BaseSupport::beside;
    const double height = base.top - base.low;
    const bool isClosed =
        isBeside ? gap.most < passageHeight && base.outline.width >= leastWidth * gap.most : isBroadBody;
    if (isClosed && !state.isAsDrawn && gap.most <= options.ratio * height)
    {
      letDown(base, gap, state);
      return;
    }
    const bool isDoubtful =
        isClosed && !state.isAsDrawn && (gap.most < options.sizeMin || gap.most <= doubtfulRatio * height);
    const bool isFree = !isBeside && gap.least > options.tolerance;
    const double by = isFree ? gap.least : gap.most;
    if ((isFree || isDoubtful) && (state.hovers.distance == 0.0 || by < state.hovers.distance))
    {
      state.hovers = {surface.names[base.surface], by, airBelow(base), base.lowest, isDoubtful};
    }
  }

  double airBelow(const BodyBase& base) const
  {
    double volume = 0.0;
    for (const Index t : base.triangles)
    {
      const auto& [i, j, k] = surface.triangles[t];
      const auto& [a, b, c] = std::tie(surface.points[i], surface.points[j], surface.points[k]);
      const Vec3 center = (a + b + c) / 3.0;
      volume += 0.5 * std::abs((b - a).cross(c - a)[2]) * std::max(0.0, center[2] - ground.heightAt(center));
    }
    return volume;
  }

  void letDown(const BodyBase& base, const Gap& gap, BodyState& state)
  {
    // Below terrain no edge of the base may show between two of its points.
    const double height = ground.isTerrain ? gap.lowestGround - options.sizeMin : gap.lowestGround;
    for (const Index place : base.places)
    {
      out.heights[place] = std::min(surface.points[place][2], height);
    }
    if (gap.most > state.letDown.distance)
    {
      state.letDown = {surface.names[base.surface], gap.most, 0.0, base.lowest};
    }
  }

  void judgeWithoutBase(Index body)
  {
    BodyState& state = states[body];
    const double height = ground.heightAt(state.lowest);
    const double gap = state.lowest[2] - height;
    state.touches = gap <= options.tolerance;
    if (!state.touches && !supports.isBesideOther(body, state.lowest[2], height))
    {
      state.hovers = {surface.names[surface.surfaceIds[state.triangles.front()]], gap, 0.0, state.lowest};
    }
  }

  void report(Index body)
  {
    const BodyState& state = states[body];
    const double height = ground.heightAt(state.lowest);
    const double depth = height - state.lowest[2];
    const bool isDeep = ground.isTerrain ? depth > doubtfulRatio * bodies.height(body) : depth > options.tolerance;
    if (isDeep)
    {
      out.report.belowGround.push_back({nameOf(state), depth, 0.0, state.lowest});
    }
    if (state.letDown.distance > 0.0)
    {
      out.report.letDown.push_back(state.letDown);
    }
    else if (state.touches && bodies.boxes[body].max[2] > height + options.tolerance)
    {
      ++out.report.standing;
    }
    if (state.hovers.distance > 0.0)
    {
      out.report.hovering.push_back(state.hovers);
    }
  }

  /// Returns the surface of the body's lowest base.
  std::string nameOf(const BodyState& state) const
  {
    const auto lowest = std::ranges::min_element(state.bases, {}, [&](Index base) { return bases[base].low; });
    return surface
        .names[lowest == state.bases.end() ? surface.surfaceIds[state.triangles.front()] : bases[*lowest].surface];
  }

  const TriangleSurface& surface;
  const ModelBodies& bodies;
  const std::vector<BodyBase>& bases;
  const SupportSearch& supports;
  const GroundBelow& ground;
  const SnapOptions& options;
  std::vector<BodyState> states;
  StandingBodies out;
};

} // namespace

StandingBodies standOnGround(const TriangleSurface& surface, const ModelBodies& bodies,
                             const std::vector<BodyBase>& bases, const SupportSearch& supports,
                             const GroundBelow& ground, const SnapOptions& options)
{
  return Judge(surface, bodies, bases, supports, ground, options).run();
}

void lowerPlaces(TriangleSurface& surface, const ModelBodies& bodies, const std::vector<double>& heights)
{
  std::vector<Index> copyOf(heights.size(), noIndex);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (bodies.ofTriangle[t] == noIndex)
    {
      continue;
    }
    for (Index& p : surface.triangles[t])
    {
      const double height = heights[bodies.placeOf[p]];
      if (std::isnan(height))
      {
        continue;
      }
      if (copyOf[p] == noIndex)
      {
        copyOf[p] = static_cast<Index>(surface.points.size());
        const Vec3 lowered(surface.points[p][0], surface.points[p][1], height);
        surface.points.push_back(lowered);
      }
      p = copyOf[p];
    }
  }
}

} // namespace atria
