// SPDX-License-Identifier: GPL-3.0-or-later
/// The shapes of faces that QualityEvaluator looks at.
#pragma once

#include "Optimize/Kernel/QualityEvaluator.h"

namespace atria {

/// Shapes of faces of a region, made where they are looked at.
class QualityEvaluator::ShapesOnDemand
{
public:
  explicit ShapesOnDemand(const QualityEvaluator& judge) : evaluator_(judge) {}
  static Index slotOf(std::size_t) { return noIndex; }
  std::array<Vec3, 4> fan(Index face, Index) const { return evaluator_.fanOf(face); }
  std::array<Vec3, 4> halves(Index face, Index) const { return evaluator_.halvesOf(face); }

private:
  const QualityEvaluator& evaluator_;
};

/// Shapes of faces of a star, kept in the star. `slots` are the places of those of a cell, or of one.
class QualityEvaluator::ShapesOfVertexStar
{
public:
  ShapesOfVertexStar(const QualityEvaluator& judge, VertexStar& star, const Index* slots)
      : evaluator_(judge), star_(star), slots_(slots)
  {
  }
  Index slotOf(std::size_t k) const { return slots_[k]; }
  const std::array<Vec3, 4>& fan(Index face, Index slot) const
  {
    QuadShape& shape = star_.shapes[slot];
    if (isMissing(slot, QuadShape::fanPart))
    {
      shape.fan = evaluator_.fanOf(face);
    }
    return shape.fan;
  }
  const std::array<Vec3, 4>& halves(Index face, Index slot) const
  {
    QuadShape& shape = star_.shapes[slot];
    if (isMissing(slot, QuadShape::halfPart))
    {
      shape.half = evaluator_.halvesOf(face);
    }
    return shape.half;
  }

private:
  /// It is not from then on.
  bool isMissing(Index slot, QuadShape::Part part) const
  {
    std::uint8_t& parts = star_.parts[slot];
    const bool missing = (parts & part) == 0;
    parts |= part;
    return missing;
  }

  const QualityEvaluator& evaluator_;
  VertexStar& star_;
  const Index* slots_;
};

} // namespace atria
