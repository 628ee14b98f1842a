// SPDX-License-Identifier: GPL-3.0-or-later
#include "WeibullFit.h"

#include <cmath>
#include <numeric>

namespace atria::weather {

namespace {

/// Enough halvings for all digits of a double.
constexpr int halvings = 60;

double meanOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Sums over the speeds v, in units of their mean, so that powers stay small.
struct PowerSums
{
  double powers = 0.0;    ///< sum of v^k
  double logPowers = 0.0; ///< sum of v^k ln v
  double logs = 0.0;      ///< sum of ln v
  double calmPower = 0.0; ///< c^k of the calm limit c
  double calmLog = 0.0;   ///< ln c; 0 without calms
};

PowerSums sumsOf(const SpeedSample& sample, double shape, double unit)
{
  PowerSums sums;
  for (const double speed : sample.speeds)
  {
    const double log = std::log(speed / unit);
    const double power = std::exp(shape * log);
    sums.powers += power;
    sums.logPowers += power * log;
    sums.logs += log;
  }
  const bool hasCalms = sample.calms > 0.0 && sample.calmLimit > 0.0;
  sums.calmLog = hasCalms ? std::log(sample.calmLimit / unit) : 0.0;
  sums.calmPower = hasCalms ? std::exp(shape * sums.calmLog) : 0.0;
  return sums;
}

/// Returns c^k / (exp(rate c^k) - 1), by which a calm hour adds to the derivative of the log-likelihood.
double calmTerm(const PowerSums& sums, double rate)
{
  return sums.calmPower > 0.0 ? sums.calmPower / std::expm1(rate * sums.calmPower) : 0.0;
}

/// Returns the likeliest rate, scale^-shape, for a shape: the root of a falling function between two bounds.
double likeliestRate(const SpeedSample& sample, const PowerSums& sums)
{
  const double hours = static_cast<double>(sample.speeds.size());
  double low = hours / sums.powers;
  double high = (hours + sample.calms) / sums.powers;
  for (int i = 0; i < halvings && sums.calmPower > 0.0; ++i)
  {
    const double rate = 0.5 * (low + high);
    const double slope = hours / rate - sums.powers + sample.calms * calmTerm(sums, rate);
    (slope > 0.0 ? low : high) = rate;
  }
  return low;
}

/// Returns the derivative by the shape of the log-likelihood at the likeliest scale.
double slopeAt(const SpeedSample& sample, double shape, double unit)
{
  const PowerSums sums = sumsOf(sample, shape, unit);
  const double rate = likeliestRate(sample, sums);
  return static_cast<double>(sample.speeds.size()) / shape + sums.logs - rate * sums.logPowers +
         sample.calms * rate * sums.calmLog * calmTerm(sums, rate);
}

} // namespace

Weibull fitWeibull(const SpeedSample& sample)
{
  const double unit = meanOf(sample.speeds);
  double low = leastShape, high = greatestShape;
  for (int i = 0; i < halvings; ++i)
  {
    const double shape = std::sqrt(low * high);
    (slopeAt(sample, shape, unit) > 0.0 ? low : high) = shape;
  }
  return fitScale(sample, std::sqrt(low * high));
}

Weibull fitScale(const SpeedSample& sample, double shape)
{
  const double unit = meanOf(sample.speeds);
  const double rate = likeliestRate(sample, sumsOf(sample, shape, unit));
  return {unit * std::pow(rate, -1.0 / shape), shape};
}

} // namespace atria::weather
