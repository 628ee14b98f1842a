// SPDX-License-Identifier: GPL-3.0-or-later
/// Weibull distributions of wind speeds, by maximum likelihood.
#pragma once

#include <cstddef>
#include <vector>

namespace atria::weather {

/// The share of hours above a speed v is exp(-(v / scale)^shape).
struct Weibull
{
  double scale = 1.0; ///< m/s
  double shape = 2.0;
};

/// Hourly mean speeds of wind, and calm hours, of which only a bound is known.
struct SpeedSample
{
  std::vector<double> speeds; ///< m/s, above 0; at least one
  double calms = 0.0;         ///< number of calm hours; a sector's part of them need not be whole
  double calmLimit = 0.0;     ///< m/s: calm hours have less
};

/// Shapes that a fit returns. Hourly winds have 1 to 3; beyond these bounds a sample is of one speed, or of no wind.
inline constexpr double leastShape = 0.3;
inline constexpr double greatestShape = 20.0;

/// Returns the distribution under which the sample is likeliest. Calm hours count as values below `calmLimit`
/// (left-censored), so that they lower neither the shape as zeros would, nor are left out.
/// \see Stevens, Smulders 1979: The estimation of the parameters of the Weibull wind speed distribution for wind energy
///      utilization purposes; Burridge 1981: on the concavity of the likelihood of censored samples.
Weibull fitWeibull(const SpeedSample& sample);

/// Returns the likeliest distribution of a given shape.
Weibull fitScale(const SpeedSample& sample, double shape);

} // namespace atria::weather
