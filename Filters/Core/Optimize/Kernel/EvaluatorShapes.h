// SPDX-License-Identifier: GPL-3.0-or-later
/// The shapes of faces that Judge looks at.
#pragma once

#include "Optimize/Kernel/QualityEvaluator.h"

namespace atria {

/// Shapes of faces of a region, made where they are looked at.
class Judge::ShapesOnDemand
{
public:
  explicit ShapesOnDemand(const Judge& judge) : judge_(judge) {}
  std::array<Vec3, 4> fan(Index face, std::size_t) const { return judge_.fanOf(face); }
  std::array<Vec3, 4> halves(Index face, std::size_t) const { return judge_.halvesOf(face); }

private:
  const Judge& judge_;
};

/// Shapes of faces of a star: of those of a cell, by their number in the cell, or of one. Kept in the star.
class Judge::ShapesOfStar
{
public:
  ShapesOfStar(const Judge& judge, Star& star, const Index* slots) : judge_(judge), star_(star), slots_(slots) {}
  const std::array<Vec3, 4>& fan(Index face, std::size_t k) const
  {
    QuadShape& shape = star_.shapes[slots_[k]];
    if (isMissing(k, QuadShape::fanPart))
    {
      shape.fan = judge_.fanOf(face);
    }
    return shape.fan;
  }
  const std::array<Vec3, 4>& halves(Index face, std::size_t k) const
  {
    QuadShape& shape = star_.shapes[slots_[k]];
    if (isMissing(k, QuadShape::halfPart))
    {
      shape.half = judge_.halvesOf(face);
    }
    return shape.half;
  }

private:
  /// It is not from then on.
  bool isMissing(std::size_t k, QuadShape::Part part) const
  {
    std::uint8_t& parts = star_.parts[slots_[k]];
    const bool missing = (parts & part) == 0;
    parts |= part;
    return missing;
  }

  const Judge& judge_;
  Star& star_;
  const Index* slots_;
};

} // namespace atria
