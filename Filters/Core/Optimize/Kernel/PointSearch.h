// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Optimize/Kernel/QualityEvaluator.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// How better places are looked for.
struct SearchRules
{
  /// Whether points of bad cells are tried in the middle of the points about them first.
  bool tryMiddle = false;
  /// Points whose cells have less of a penalty stay, and those that would lose less than this share of it.
  double leastPenalty = 1e-4;
  double leastGain = 0.01;
  /// No cell whose least measure is above this falls below it for the good of others. Without it, what is bad by one
  /// measure may become worse by others for what is gained in the whole.
  double leastWorst = -std::numeric_limits<double>::infinity();
  /// Steps that are tried for a point, each 0.4 of the one before, and by which share of itself the penalty has to
  /// change before a point that found no better place is looked at again.
  int tries = 2;
  double leastChange = 0.3;
};

/// What is known of a point from one search to the next.
struct SearchState
{
  /// How far to go, as a part of the cells' size.
  double trust;
  /// The penalty of the cells about it when no better place was found; 0 where one was.
  double stuckAt = 0.0;
};

/// Looks for a better place for one point at a time.
class PointSearch
{
public:
  /// Below `floor`, if it is given, no metric of the cells about a point may get; it must outlive the search.
  PointSearch(QualityEvaluator& qualities, const VertexConstraints& vertexConstraints, const SearchRules& rules = {},
              const LeastMetrics* floor = nullptr)
      : judge(qualities), constraints(vertexConstraints), rules_(rules), floor_(floor)
  {
  }

  /// Moves the point if there is a place near it where the penalty of the cells about it is less and their worst no
  /// worse. It is not looked for where there was none before and the penalty is much the same. Whether it moved.
  bool improve(Index movable, SearchState& state);
  /// Moves the point towards `place` as far as the worst of the cells about it is not below `least`, or not below what
  /// it is.
  void approach(Index movable, const Vec3& place, double least);

private:
  /// A way to go, and what the penalty is expected to lose by it.
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
  /// Of the residuals, along the ways the point may go.
  std::array<std::vector<double>, 3> derivatives;
  Index pointId = noIndex;
  Vec3 origin;
};

} // namespace atria
