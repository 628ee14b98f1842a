// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes the shapes of faces that QualityEvaluator judges.
#pragma once

#include "Optimize/Kernel/QualityEvaluator.h"

namespace atria {

/// Shapes of the faces of a region, computed at each request.
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

/// Shapes of the faces of a star, computed once and kept in the star. `slots` are places in VertexStar::faces: one for
/// each face of a cell, or that of a single face.
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
  /// Returns true if the part has not been computed, and marks it as computed.
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

/// Returns twice the area vector of the triangle between edge i of a face and its centroid.
inline Vec3 QualityEvaluator::fanTriangle(Index face, std::size_t i) const
{
  const auto points = region_.face(face);
  const Vec3& centroid = faces[face].centroid;
  return crossOf(region_.points[points[i]] - centroid,
                 region_.points[points[i + 1 < points.size() ? i + 1 : 0]] - centroid);
}

/// Returns QuadShape::fan of a quadrilateral.
inline std::array<Vec3, 4> QualityEvaluator::fanOf(Index face) const
{
  const auto points = region_.face(face);
  std::array<Vec3, 4> to;
  for (int i = 0; i < 4; ++i)
  {
    to[i] = region_.points[points[i]] - faces[face].centroid;
  }
  return {crossOf(to[0], to[1]), crossOf(to[1], to[2]), crossOf(to[2], to[3]), crossOf(to[3], to[0])};
}

/// Returns QuadShape::half of a quadrilateral.
inline std::array<Vec3, 4> QualityEvaluator::halvesOf(Index face) const
{
  const auto points = region_.face(face);
  const auto way = [&](int a, int b) -> Vec3 { return region_.points[points[b]] - region_.points[points[a]]; };
  const Vec3 diagonal = way(0, 2);
  const Vec3 other = way(1, 3);
  return {crossOf(way(0, 1), diagonal), crossOf(diagonal, way(0, 3)), crossOf(way(1, 2), other),
          crossOf(other, way(1, 0))};
}

} // namespace atria
