// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds better positions for single points.
#pragma once

#include "Optimize/Kernel/QualityEvaluator.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Rules for the search for better positions.
struct SearchRules
{
  /// True to try the middle of a point's neighbors first if it has a poor cell, and positions along the axes last. If
  /// false, positions along the axes are tried only if a cell is invalid or derivatives are of no use.
  bool tryMiddle = false;
  /// Points stay if the penalty of their cells is below leastPenalty, or would decrease by less than the share
  /// leastGain of it.
  double leastPenalty = 1e-4;
  double leastGain = 0.01;
  /// Lower bound for the smallest relative measure around a point that has a poor cell. No move lowers it below this;
  /// if it is below already, no move lowers it further. Without this bound, cells that are poor by one measure may
  /// become worse by others for a gain in the sum.
  double leastWorst = -std::numeric_limits<double>::infinity();
  /// Number of steps that are tried for a point, each 0.4 times as long as the one before.
  int tries = 2;
  /// Change of the penalty, as a share of it, after which a point that found no better position is searched again.
  double leastChange = 0.3;
};

/// State of a point between two searches.
struct SearchState
{
  /// Largest length of the next step, as a share of the cells' size.
  double trust;
  /// Penalty of the cells around the point when no better position was found; 0 if one was.
  double stuckAt = 0.0;
};

/// Finds a better position for one point at a time.
class PointSearch
{
public:
  /// If `floor` is given, improve() lets no metric of the cells around a point fall below it. `floor` must outlive the
  /// search.
  PointSearch(QualityEvaluator& qualities, const VertexConstraints& vertexConstraints, const SearchRules& rules = {},
              const LeastMetrics* floor = nullptr)
      : judge(qualities), constraints(vertexConstraints), rules_(rules), floor_(floor)
  {
  }

  /// Moves the point to a position near it where the penalty of the cells around it is smaller and their worst measure
  /// is within the bounds of SearchRules. Does nothing if no such position was found before and the penalty is much the
  /// same. Returns true if the point moved.
  bool improve(Index movable, SearchState& state);
  /// Moves the point to `place`, or to 1/2, 1/4 or 1/8 of the way: the first of these where the worst measure around it
  /// is not below `least`, or not below its present value if that is smaller. The point stays if there is none.
  void approach(Index movable, const Vec3& place, double least);

private:
  /// A displacement, and the expected decrease of the penalty.
  struct Step
  {
    Vec3 way;
    double gain;
  };
  bool move(const Score& now, double& trust);
  Step gaussNewtonStep(double reach);
  void derive(const Vec3& way, double h, std::vector<double>& along);
  bool probe(const Score& now, double reach);
  Vec3 middle() const;
  Score scoreAt(const Vec3& p, const LookLimits& limits);
  LookLimits limitsOf(const Score& now) const;
  bool moveIfBetter(const Vec3& p, const Score& now);
  bool isBetter(const Score& there, const Score& now) const;
  bool noMetricIsWorse() const;

  QualityEvaluator& judge;
  const VertexConstraints& constraints;
  SearchRules rules_;
  const LeastMetrics* floor_;
  VertexStar star;
  Residuals residuals;
  std::vector<double> beside;
  /// Derivatives of the residuals along the directions in which the point may move.
  std::array<std::vector<double>, 3> derivatives;
  Index pointId = noIndex;
  Vec3 origin;
};

} // namespace atria
