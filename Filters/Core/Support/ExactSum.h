// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums that do not depend on the order of what is added up, nor on what was added up before.
#pragma once

#include <cmath>

namespace atria {

/// What numbers are split into multiples of, so that no sum of them is rounded: sums of magnitudes up to 2^9 times
/// `scale`, of up to 2^29 numbers. What is lost of each is less than 2^-68 of the scale.
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
