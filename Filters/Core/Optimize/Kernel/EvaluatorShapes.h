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
  std::array<Vec3, 4> fan(Index face, std::size_t) const { return evaluator_.fanOf(face); }
  std::array<Vec3, 4> halves(Index face, std::size_t) const { return evaluator_.halvesOf(face); }

private:
  const QualityEvaluator& evaluator_;
};

/// Shapes of faces of a star: of those of a cell, by their number in the cell, or of one. Kept in the star.
class QualityEvaluator::ShapesOfVertexStar
{
public:
  ShapesOfVertexStar(const QualityEvaluator& judge, VertexStar& star, const Index* slots)
      : evaluator_(judge), star_(star), slots_(slots)
  {
  }
  const std::array<Vec3, 4>& fan(Index face, std::size_t k) const
  {
    QuadShape& shape = star_.shapes[slots_[k]];
    if (isMissing(k, QuadShape::fanPart))
    {
      shape.fan = evaluator_.fanOf(face);
    }
    return shape.fan;
  }
  const std::array<Vec3, 4>& halves(Index face, std::size_t k) const
  {
    QuadShape& shape = star_.shapes[slots_[k]];
    if (isMissing(k, QuadShape::halfPart))
    {
      shape.half = evaluator_.halvesOf(face);
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

  const QualityEvaluator& evaluator_;
  VertexStar& star_;
  const Index* slots_;
};

} // namespace atria
