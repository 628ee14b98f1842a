// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/PointSearch.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <numeric>

namespace atria {

namespace {

/// Smallest and largest length of steps, as shares of the cells' size. Derivatives are taken over the smallest.
constexpr double leastTrust = 1e-3;
constexpr double mostTrust = 0.5;
/// Difference of relative measures that is nothing but rounding.
constexpr double noise = 1e-6;
/// Share of the trace of the normal equations that is added to their diagonal. It keeps steps short in directions on
/// which residuals hardly depend.
constexpr double damping = 0.03;

} // namespace

/// Moves the point to the allowed position nearest to p, and returns the score there.
Score PointSearch::scoreAt(const Vec3& p, const LookLimits& limits)
{
  return judge.look(star, constraints.place(pointId, p), limits);
}

/// Returns the limits beyond which no position is better. The worst measure may not get worse, unless it stays at its
/// target or is poor already; see SearchRules::leastWorst.
LookLimits PointSearch::limitsOf(const Score& now) const
{
  const double enough = now.worst < poor ? rules_.leastWorst : 1.0;
  return {now.penalty * (1.0 - rules_.leastGain), std::min(now.worst - noise, enough)};
}

bool PointSearch::isBetter(const Score& there, const Score& now) const
{
  const LookLimits limits = limitsOf(now);
  return there.penalty < limits.penalty && there.worst >= limits.worst && noMetricIsWorse();
}

/// True if no metric is below the floor at the present position of the point.
bool PointSearch::noMetricIsWorse() const
{
  if (!floor_)
  {
    return true;
  }
  const LeastMetrics metrics = judge.metricsOf(star);
  for (std::size_t m = 0; m < LeastMetrics::count; ++m)
  {
    if (metrics.values[m] < floor_->values[m])
    {
      return false;
    }
  }
  return true;
}

/// Moves the point to the allowed position nearest to p. Returns true, and keeps the scores there, if it is better than
/// `now`. Otherwise the caller must move the point on or back.
bool PointSearch::moveIfBetter(const Vec3& p, const Score& now)
{
  const bool better = isBetter(scoreAt(p, limitsOf(now)), now);
  if (better)
  {
    judge.accept(star);
  }
  return better;
}

bool PointSearch::improve(Index movable, SearchState& state)
{
  if (judge.isGood(movable, rules_.leastPenalty))
  {
    return false;
  }
  judge.enter(movable, star);
  const Score now = judge.scoreOf(star);
  if (now.penalty < rules_.leastPenalty || std::abs(now.penalty - state.stuckAt) < rules_.leastChange * state.stuckAt)
  {
    return false;
  }
  judge.prepare(star);
  pointId = judge.region().pointIds[star.point];
  origin = judge.region().points[star.point];
  const bool moved = move(now, state.trust);
  state.stuckAt = moved ? 0.0 : now.penalty;
  return moved;
}

/// Moves the point that was entered if there is a better position. Returns true if it moved.
bool PointSearch::move(const Score& now, double& trust)
{
  if (rules_.tryMiddle && now.worst < poor)
  {
    const Vec3 way = middle() - origin;
    if (moveIfBetter(origin + way, now) || moveIfBetter(origin + 0.5 * way, now))
    {
      return true;
    }
    judge.move(star, origin);
  }
  const Step step = gaussNewtonStep(trust * star.size);
  double scale = 1.0;
  for (int i = 0; i < rules_.tries && step.gain > rules_.leastGain * now.penalty; ++i, scale *= 0.4)
  {
    if (moveIfBetter(origin + scale * step.way, now))
    {
      trust = std::clamp(i == 0 ? 1.6 * trust : scale * trust, leastTrust, mostTrust);
      return true;
    }
  }
  // Derivatives are of no use if points coincide.
  if ((now.worst < 0.0 || step.gain <= 0.0 || rules_.tryMiddle) && probe(now, trust * star.size))
  {
    return true;
  }
  judge.restore(star);
  trust = std::max(leastTrust, 0.3 * trust);
  return false;
}

void PointSearch::approach(Index movable, const Vec3& place, double least)
{
  judge.enter(movable, star);
  judge.prepare(star);
  origin = judge.region().points[star.point];
  const LookLimits limits{.worst = std::min(judge.scoreOf(star).worst, least)};
  constexpr int halvings = 4;
  double share = 1.0;
  for (int i = 0; i < halvings; ++i, share *= 0.5)
  {
    if (judge.look(star, i == 0 ? place : Vec3(origin + share * (place - origin)), limits).worst >= limits.worst)
    {
      judge.accept(star);
      return;
    }
  }
  judge.restore(star);
}

/// Moves the point to the best of the six positions at distance `reach` along the axes. Returns true if that one is
/// better than `now`.
bool PointSearch::probe(const Score& now, double reach)
{
  Vec3 best = origin;
  double least = now.penalty;
  LookLimits limits = limitsOf(now);
  for (int i = 0; i < 6; ++i)
  {
    const Vec3 place = origin + (i < 3 ? reach : -reach) * Vec3::Unit(i % 3);
    const Score there = scoreAt(place, limits);
    if (isBetter(there, now) && there.penalty < least)
    {
      least = there.penalty;
      limits.penalty = std::min(limits.penalty, least);
      best = place;
    }
  }
  return best != origin && moveIfBetter(best, now);
}

/// Returns the mean of the points at the other ends of the point's edges.
Vec3 PointSearch::middle() const
{
  const Region& region = judge.region();
  std::vector<Index> ends;
  for (const Index i : star.moving)
  {
    const auto points = region.face(star.faces[i]);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const Index next = points[k + 1 < points.size() ? k + 1 : 0];
      const bool first = std::ranges::binary_search(star.points, points[k]);
      const bool second = std::ranges::binary_search(star.points, next);
      if (first != second)
      {
        ends.push_back(first ? next : points[k]);
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

/// Sets `along` to the derivatives along a direction of the residuals that are not 0, as differences over the length h.
void PointSearch::derive(const Vec3& way, double h, std::vector<double>& along)
{
  along.assign(residuals.values.size(), 0.0);
  judge.moveForResiduals(star, origin + h * way);
  judge.residualsBeside(star, residuals, beside);
  for (std::size_t i = 0; i < along.size(); ++i)
  {
    along[i] = residuals.values[i] > 0.0 ? (beside[i] - residuals.values[i]) / h : 0.0;
  }
}

/// Returns the damped Gauss-Newton step: to the smallest sum of squares of the linearized residuals, but not longer
/// than `reach`.
PointSearch::Step PointSearch::gaussNewtonStep(double reach)
{
  judge.residualsOf(star, residuals);
  const double h = leastTrust * star.size;
  const Ways ways = constraints.waysFrom(pointId, origin, h);
  // Entries of missing directions stay 0.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vec3 gradient = Vec3::Zero();
  for (int i = 0; i < ways.count; ++i)
  {
    derive(ways.along[i], h, derivatives[i]);
    const auto sumWith = [&](const std::vector<double>& values) {
      return std::inner_product(values.begin(), values.end(), derivatives[i].begin(), 0.0);
    };
    gradient[i] = sumWith(residuals.values);
    for (int j = 0; j <= i; ++j)
    {
      normal(i, j) = normal(j, i) = sumWith(derivatives[j]);
    }
  }
  const double trace = normal.trace();
  if (trace <= 0.0)
  {
    return {Vec3::Zero(), 0.0};
  }
  Eigen::Matrix3d damped = normal;
  damped.diagonal().array() += damping * trace;
  Vec3 shares = -damped.ldlt().solve(gradient);
  const double length = shares.norm();
  shares *= length > reach ? reach / length : 1.0;
  Vec3 way = Vec3::Zero();
  for (int i = 0; i < ways.count; ++i)
  {
    way += shares[i] * ways.along[i];
  }
  return {way, -2.0 * gradient.dot(shares) - shares.dot(normal * shares)};
}

} // namespace atria
