// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums that do not depend on the order of their terms, nor on how these were grouped.
#pragma once

#include <cmath>

namespace atria {

/// Units that numbers are split into multiples of, so that their sums are not rounded. This holds for sums of
/// magnitudes up to 2^9 times `scale`, of up to 2^29 numbers. Each number loses less than 2^-68 of the scale.
struct SumUnits
{
  explicit SumUnits(double scale) : coarse(std::exp2(std::ceil(std::log2(scale)) - 44.0)) {}

  double coarse;
  double fine() const { return std::ldexp(coarse, -24); }
};

struct ExactSum
{
  double coarse = 0.0;
  double fine = 0.0;

  void add(double value, const SumUnits& units)
  {
    const double part = units.coarse * std::round(value / units.coarse);
    coarse += part;
    fine += units.fine() * std::round((value - part) / units.fine());
  }
  void add(const ExactSum& other)
  {
    coarse += other.coarse;
    fine += other.fine;
  }
  double value() const { return coarse + fine; }
};

} // namespace atria
