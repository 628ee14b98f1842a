// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/PointSearch.h"

#include <algorithm>

namespace atria {

namespace {

constexpr double difference = 1e-3; ///< of the cells' size, for derivatives
constexpr double mostTrust = 0.5;
constexpr double leastGain = 0.01;
/// Not worth a search.
constexpr double leastPenalty = 1e-4;
constexpr int tries = 4;
/// Of measures that are nothing but rounding.
constexpr double noise = 1e-6;
constexpr double badAnyway = 0.3;

} // namespace

Score PointSearch::scoreAt(const Vec3& p, double enough)
{
  judge.move(star, guide.place(pointId, p));
  return judge.scoreOf(star, enough);
}

bool PointSearch::isBetter(const Score& there, const Score& here) const
{
  return there.penalty < here.penalty * (1.0 - leastGain) &&
         (there.worst >= here.worst - noise || there.worst >= 1.0 || here.worst < badAnyway) && noMetricIsWorse();
}

/// Of the place where the point is now.
bool PointSearch::noMetricIsWorse() const
{
  if (!rules_.floor)
  {
    return true;
  }
  const LeastMetrics now = judge.metricsOf(star);
  for (std::size_t m = 0; m < LeastMetrics::count; ++m)
  {
    if (now.values[m] < rules_.floor->values[m])
    {
      return false;
    }
  }
  return true;
}

PointSearch::Outcome PointSearch::improve(Index movable, double& trust)
{
  judge.enter(movable, star);
  pointId = judge.region().pointIds[star.point];
  origin = judge.region().points[star.point];
  const Score here = judge.scoreOf(star);
  if (here.penalty < leastPenalty)
  {
    return Outcome::good;
  }
  if (rules_.tryMiddle && here.worst < badAnyway)
  {
    const Vec3 way = middle() - origin;
    for (const double part : {1.0, 0.5})
    {
      if (isBetter(scoreAt(origin + part * way, here.penalty), here))
      {
        return Outcome::moved;
      }
    }
  }
  const Vec3 step = newtonStep(here, trust * star.size);
  double scale = 1.0;
  for (int i = 0; i < tries; ++i, scale *= 0.4)
  {
    if (isBetter(scoreAt(origin + scale * step, here.penalty), here))
    {
      trust = std::clamp(i == 0 ? 1.6 * trust : scale * trust, leastTrust, mostTrust);
      return Outcome::moved;
    }
  }
  if (const Vec3 probe = bestProbe(here, trust * star.size); probe != origin)
  {
    judge.move(star, probe);
    return Outcome::moved;
  }
  judge.move(star, origin);
  trust = std::max(leastTrust, 0.3 * trust);
  return Outcome::stuck;
}

void PointSearch::approach(Index movable, const Vec3& place, double least)
{
  judge.enter(movable, star);
  origin = judge.region().points[star.point];
  const double floor = std::min(judge.scoreOf(star).worst, least);
  constexpr int halvings = 4;
  double share = 1.0;
  for (int i = 0; i < halvings; ++i, share *= 0.5)
  {
    judge.move(star, i == 0 ? place : Vec3(origin + share * (place - origin)));
    if (judge.scoreOf(star).worst >= floor)
    {
      return;
    }
  }
  judge.move(star, origin);
}

/// The best place among those at this distance along the axes, or where the point is. Where points coincide the
/// gradient says nothing.
Vec3 PointSearch::bestProbe(const Score& here, double reach)
{
  Vec3 best = origin;
  Score least = here;
  for (int i = 0; i < 6; ++i)
  {
    const Score there = scoreAt(origin + (i < 3 ? reach : -reach) * Vec3::Unit(i % 3), least.penalty);
    if (isBetter(there, here) && there.penalty < least.penalty)
    {
      least = there;
      best = judge.region().points[star.point];
    }
  }
  return best;
}

/// The mean of the points at the other ends of the point's edges.
Vec3 PointSearch::middle() const
{
  const Region& region = judge.region();
  std::vector<Index> ends;
  for (const Index face : star.moving)
  {
    const auto points = region.face(face);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Index next = points[i + 1 < points.size() ? i + 1 : 0];
      const bool first = std::ranges::binary_search(star.points, points[i]);
      const bool second = std::ranges::binary_search(star.points, next);
      if (first != second)
      {
        ends.push_back(first ? next : points[i]);
      }
    }
  }
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  Vec3 sum = Vec3::Zero();
  for (const Index end : ends)
  {
    sum += region.points[end];
  }
  return sum / std::max<double>(1.0, static_cast<double>(ends.size()));
}

/// Down the gradient, along each axis as far as the curvature there says, at most `reach` in all.
Vec3 PointSearch::newtonStep(const Score& here, double reach)
{
  const double h = difference * star.size;
  Vec3 gradient;
  Vec3 curvature;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double up = scoreAt(origin + h * Vec3::Unit(axis)).penalty;
    const double down = scoreAt(origin - h * Vec3::Unit(axis)).penalty;
    gradient[axis] = (up - down) / (2.0 * h);
    curvature[axis] = std::abs(up + down - 2.0 * here.penalty) / (h * h);
  }
  const double slope = gradient.norm();
  if (slope == 0.0)
  {
    return Vec3::Zero();
  }
  Vec3 step = -gradient.cwiseQuotient(curvature.cwiseMax(slope / reach));
  const double length = step.norm();
  return length > reach ? Vec3(step * (reach / length)) : step;
}

} // namespace atria
