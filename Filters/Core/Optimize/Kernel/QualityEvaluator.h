// SPDX-License-Identifier: GPL-3.0-or-later
/// How far the cells of a region are from good, by the measures solvers judge by.
#pragma once

#include "Optimize/Kernel/QualityTargets.h"
#include "Optimize/Kernel/Region.h"
#include "Quality/Checks/ScaledJacobian.h"

namespace atria {

/// Measures below this are hardly valid or not at all.
inline constexpr double poor = 0.3;

/// By how much a measure falls short: 0 at the target. What is poor counts for more, so that it is not left for the
/// good of others.
inline double shortfallOf(double q)
{
  constexpr double stress = 3.0;
  return q >= 1.0 ? 0.0 : 1.0 - q + stress * std::max(0.0, poor - q);
}

/// One of the measures of a cell or a face.
struct Measure
{
  enum Kind : std::uint8_t
  {
    pyramidCosine,
    corners,
    convexity,
    determinant,
    jacobian,
    fans,
    boundaryShape,
    faceCosine,
    skewness,
    weight,
    volumeRatio,
    kinds ///< how many there are
  };
  Kind kind;
  std::uint8_t part = 0; ///< of those that a cell or a face has several of
  Index cell = noIndex;
  Index face = noIndex;
  Index other = noIndex; ///< face
  Index slot = noIndex;  ///< the face's place in a star
};

/// Sum of the squares of what all measures fall short, and the least measure, if it is not far above 1.
struct Score
{
  static constexpr double farAbove = 1.001;
  double penalty = 0.0;
  double worst = std::numeric_limits<double>::infinity();

  void add(const Measure& /*measure*/, double q) { add(q, q); }
  /// Of the worst no less than `least`.
  void add(const Measure& /*measure*/, double q, double least) { add(q, std::max(q, least)); }
  void add(const Score& other)
  {
    penalty += other.penalty;
    worst = std::min(worst, other.worst);
  }

private:
  void add(double q, double forWorst)
  {
    if (q >= farAbove)
    {
      return;
    }
    worst = std::min(worst, forWorst);
    const double shortfall = shortfallOf(q);
    penalty += shortfall * shortfall;
  }
};

/// The measures that fall short, and by how much.
struct Residuals
{
  std::vector<Measure> measures;
  std::vector<double> values;

  void add(const Measure& measure, double q)
  {
    if (q < 1.0)
    {
      measures.push_back(measure);
      values.push_back(shortfallOf(q));
    }
  }
  void add(const Measure& measure, double q, double /*least*/) { add(measure, q); }
};

/// The least of what Quality/Metrics.h measures of cells and their faces, and some of Quality/CheckQuantities.h.
/// Skewness counts negative, so that more is better in all.
struct LeastMetrics
{
  enum Metric : std::uint8_t
  {
    pyramidCosine, ///< 1 - cellSquish
    faceCosine,    ///< 1 - faceSquish, the cosine of nonOrthogonality
    skewness,
    inverseAspectRatio,
    facePyramid,
    volume,
    scaledJacobian, // NOLINT(clang-diagnostic-shadow): named as the function for it
    weight,         ///< OpenFOAM's interpolation weight
    volumeRatio,    ///< of neighbors, the smaller over the larger
    determinant,    ///< OpenFOAM's
    count
  };
  std::array<double, count> values;

  LeastMetrics() { values.fill(std::numeric_limits<double>::infinity()); }
  void take(Metric metric, double value) { values[metric] = std::min(values[metric], value); }
  void take(const LeastMetrics& other)
  {
    for (std::size_t m = 0; m < count; ++m)
    {
      values[m] = std::min(values[m], other.values[m]);
    }
  }
};

/// Twice the area vectors of triangles of a quadrilateral: those about the centroid, and 012, 023, 123 and 130 of the
/// corners.
struct QuadShape
{
  enum Part : std::uint8_t
  {
    none = 0,
    fanPart = 1,
    halfPart = 2
  };
  std::array<Vec3, 4> fan;
  std::array<Vec3, 4> half;
};

/// The cells about a point that may move, and what depends on it.
struct VertexStar
{
  Index point = noIndex; ///< the leader
  std::vector<Index> points;
  std::vector<double> shares; ///< of the leader's way, by point
  double size = 0.0;          ///< mean edge of the cells
  std::vector<Index> cells;
  std::vector<Index> faces; ///< all faces of the cells
  /// Of each cell's faces, in the region's order, the places in `faces`; those of cell i begin at offsets[i].
  std::vector<Index> slots;
  std::vector<Index> offsets;
  /// Cells and, by their places in `faces`, those that have one of the points. The first few are those by which what
  /// falls short is measured.
  std::vector<Index> measured;
  std::vector<Index> moving;
  std::size_t firstMeasured = 0;
  std::size_t firstMoving = 0;
  /// Of the faces; nothing for those that are no quadrilaterals. Parts are made when they are first looked at; which
  /// were is kept apart, as most never are.
  std::vector<QuadShape> shapes;
  std::vector<std::uint8_t> parts;
  /// Of the cells and then of the faces, at the place looked at last.
  std::vector<Score> scores;
  /// Places in `scores`; first what fell short before, as it will tell soonest that a place is no better.
  std::vector<Index> order;
  std::size_t firstInOrder = 0;
  /// As they were before the point was moved: the leader's place and all points', the faces that move, the cells.
  Vec3 origin;
  std::vector<Vec3> pointsBefore;
  std::vector<FaceMeasure> facesBefore;
  std::vector<CellMeasure> cellsBefore;
  /// By face of the region, its place in `faces` if the entry is of this star.
  struct Entry
  {
    Index star = 0;
    Index place = 0;
  };
  std::vector<Entry> entries;
  /// By point of the region, the last star that it was one of the points of.
  std::vector<Index> stars;
  Index number = 0; ///< of this star, from 1 on
  /// Room for marks.
  std::vector<char> marks;
};

/// Up to where a look at a place is of use: scores with a greater penalty or a worse measure need not be complete.
struct LookLimits
{
  double penalty = std::numeric_limits<double>::infinity();
  double worst = -std::numeric_limits<double>::infinity();
};

/// Keeps the measures of a region's faces and cells and judges by them. Points in whose stars no cell is the same or a
/// neighbor of the other's may be moved at the same time by different threads.
class QualityEvaluator
{
public:
  QualityEvaluator(Region& region, const QualityTargets& targets, const RunContext& context);

  const Region& region() const { return region_; }
  double sizeOf(Index cell) const { return sizes[cell]; }

  /// Whether hardly anything about a point falls short: nothing, or less than surely makes a penalty of this.
  bool isGood(std::size_t movable, double penalty) const;
  void enter(std::size_t movable, VertexStar& star) const;
  /// Before the point of a star that was entered is moved.
  void prepare(VertexStar& star) const;
  /// Moves the star's point and measures all that depends on it. Scores are kept as they are until `accept`.
  void move(VertexStar& star, const Vec3& p);
  /// As `move`, but only for `residualsOf`.
  void moveForResiduals(VertexStar& star, const Vec3& p);
  /// All as it was when the star was prepared; the star is of no use then.
  void restore(const VertexStar& star);
  /// Moves the star's point and judges it there. What is beyond the limits is not measured to the end.
  Score look(VertexStar& star, const Vec3& p, const LookLimits& limits = {});
  /// Keeps what was seen in the last look, which was not cut short.
  void accept(const VertexStar& star);

  /// Kept scores.
  Score scoreOf(const VertexStar& star) const;
  Score scoreOfCell(Index cell) const { return cellScores[cell]; }
  Score scoreOfFace(Index face) const { return faceScores[face]; }
  /// Of a cell and its faces, the least of each kind of measure as a share of the way from limit to target; those that
  /// are not below the target need not be told.
  std::array<double, Measure::kinds> leastOf(Index cell) const;

  /// The measures that fall short of the cells and faces of a star whose kept scores do, in the same order always.
  void residualsOf(VertexStar& star, Residuals& out) const;
  /// By how much these fall short after a move.
  void residualsBeside(VertexStar& star, const Residuals& before, std::vector<double>& out) const;

  LeastMetrics metricsOf(const VertexStar& star) const;
  LeastMetrics metricsOfCell(Index cell) const;
  LeastMetrics metricsOfFace(Index face) const;

private:
  void measure(Index face);
  void measureOne(Index cell);
  void place(VertexStar& star, const Vec3& p);
  void measureFirst(const VertexStar& star);
  void measureRest(const VertexStar& star);
  void findFirst(VertexStar& star) const;
  void judgeInOrder(VertexStar& star, Index place) const;
  double meanEdgeOf(Index cell, const std::vector<double>& perimeters) const;
  void judgeAll(const RunContext& context);
  std::array<Vec3, 4> fanOf(Index face) const;
  std::array<Vec3, 4> halvesOf(Index face) const;
  Vec3 fanTriangle(Index face, std::size_t i) const;
  class ShapesOnDemand;
  class ShapesOfVertexStar;
  template <typename Shapes, typename Sink> void judgeCell(Index cell, const Shapes& shapes, Sink& score) const;
  template <typename Shapes, typename Sink> void judgeFace(Index face, const Shapes& shapes, Sink& score) const;
  template <typename Sink> void judgeConvexity(Index face, Index cell, Sink& score) const;
  template <typename Shapes, typename Sink>
  void judgeBoundary(Index face, const Shapes& shapes, Index slot, Sink& score) const;
  template <typename Sink>
  void judgeSizes(const FaceMeasure& face, const Measure& of, const CellMeasure& own, const CellMeasure& other,
                  Sink& score) const;
  template <typename Shapes> double measureOf(const Measure& measure, const Shapes& shapes) const;
  double pyramidOf(Index face, Index cell) const;
  double convexityOf(Index face, Index other, Index cell) const;
  template <typename Shapes>
  double cornersOf(Index face, Index cell, const Vec3& middle, const Shapes& shapes, Index slot) const;
  template <typename Shapes> double fansOf(Index face, const Shapes& shapes, Index slot) const;
  template <typename Shapes>
  double boundaryShapeOf(Index face, std::size_t part, const Shapes& shapes, Index slot) const;
  double orthogonalityOf(Index face) const;
  double straightnessOf(Index face) const;
  std::array<double, 4> halfVolumes(Index face, const std::array<Vec3, 4>& half, const Vec3& middle) const;
  bool isClearlyConvex(Index cell) const;
  const Vec3& middleOf(Index cell) const;
  double determinantOf(Index cell) const;
  JacobianTerms jacobiansOf(Index cell) const;
  QualityRange jacobianRange() const { return {targets_.jacobianLimit, targets_.scaledJacobian}; }
  Vec3 wayAcross(Index face) const;
  bool isClearlyStraight(Index face, const Vec3& d) const;
  double skewnessOf(Index face, const Vec3& d, double good) const;
  double sign(Index cell, Index face) const { return region_.owner[face] == cell ? 1.0 : -1.0; }

  Region& region_;
  QualityTargets targets_;
  std::vector<FaceMeasure> faces;
  std::vector<CellMeasure> cells;
  std::vector<double> sizes;
  /// Factors that make volumes of a cell's tetrahedra relative to its size and the target.
  std::vector<double> cornerScales;
  std::vector<Score> cellScores;
  std::vector<Score> faceScores;
};

} // namespace atria
