// SPDX-License-Identifier: GPL-3.0-or-later
/// Judges how far the cells of a region are from good, by the measures that solvers use.
#pragma once

#include "Optimize/Kernel/QualityTargets.h"
#include "Optimize/Kernel/Region.h"
#include "Quality/Checks/ScaledJacobian.h"

namespace atria {

/// Relative measure below which a cell is poor: hardly valid or not at all.
inline constexpr double poor = 0.3;

/// Returns the shortfall of a relative measure: 0 if it reaches the target. Poor measures count more, so that they are
/// not left as they are for the good of others.
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
    kinds ///< number of kinds
  };
  Kind kind;
  std::uint8_t part = 0; ///< number among the measures of this kind of the same cell or face
  Index cell = noIndex;
  Index face = noIndex;
  Index other = noIndex; ///< the other face, for convexity
  Index slot = noIndex;  ///< place of the face in VertexStar::faces
};

/// Sum of the squared shortfalls of all measures, and the smallest relative measure. Measures above farAbove are
/// ignored; if all are, the smallest is infinite.
struct Score
{
  static constexpr double farAbove = 1.001;
  double penalty = 0.0;
  double worst = std::numeric_limits<double>::infinity();

  void add(const Measure& /*measure*/, double q) { add(q, q); }
  /// Adds a measure that lowers `worst` to no less than `least`.
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

/// The measures that fall short, and their shortfalls.
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

/// Worst values of the metrics in Quality/Checks/Metrics.h, and of some quantities in Quality/Checks/CheckQuantities.h.
/// They are in a form in which more is better; skewness is negated.
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
    volumeRatio,    ///< smaller over larger volume of neighbors
    determinant,    ///< OpenFOAM's cell determinant
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

/// Twice the area vectors of triangles of a quadrilateral: four around its centroid, and 012, 023, 123 and 130 of its
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

/// The cells around a point that may move, and all that depends on its position.
struct VertexStar
{
  Index point = noIndex; ///< the leader
  std::vector<Index> points;
  std::vector<double> shares; ///< one entry per point: its share of the leader's displacement
  double size = 0.0;          ///< mean edge of the cells, in model units
  std::vector<Index> cells;
  std::vector<Index> faces; ///< all faces of the cells
  /// Places in `faces` of each cell's faces, in the region's order. Cell i has those from offsets[i] on.
  std::vector<Index> slots;
  std::vector<Index> offsets;
  /// `measured` lists all cells by their places in `cells`. `moving` lists the faces that have one of the points by
  /// their places in `faces`. The first firstMeasured and firstMoving of them are all that shortfalls depend on.
  std::vector<Index> measured;
  std::vector<Index> moving;
  std::size_t firstMeasured = 0;
  std::size_t firstMoving = 0;
  /// Shapes of the faces that are quadrilaterals, and the QuadShape::Part bits of those computed. They are computed
  /// when first needed. `parts` is a separate list because most shapes never are.
  std::vector<QuadShape> shapes;
  std::vector<std::uint8_t> parts;
  /// Scores of the cells, then of the faces, at the position judged last.
  std::vector<Score> scores;
  /// Places in `scores` in the order of judging. The first firstInOrder of them fell short before: they show soonest
  /// that a position is no better.
  std::vector<Index> order;
  std::size_t firstInOrder = 0;
  /// State before the point was moved: positions of the leader and of all points, measures of the moving faces and of
  /// the cells.
  Vec3 origin;
  std::vector<Vec3> pointsBefore;
  std::vector<FaceMeasure> facesBefore;
  std::vector<CellMeasure> cellsBefore;
  /// One entry per face of the region: its place in `faces`, valid if `star` is the number of this star.
  struct Entry
  {
    Index star = 0;
    Index place = 0;
  };
  std::vector<Entry> entries;
  /// One entry per point of the region: number of the last star that it was a member of.
  std::vector<Index> stars;
  Index number = 0; ///< number of this star, 1 and up
  /// Buffer for marks.
  std::vector<char> marks;
};

/// Limits beyond which a position is of no use. Scores with a greater penalty or a smaller worst measure need not be
/// complete.
struct LookLimits
{
  double penalty = std::numeric_limits<double>::infinity();
  double worst = -std::numeric_limits<double>::infinity();
};

/// Keeps the measures and scores of a region's faces and cells. Threads may move two points at the same time if no cell
/// around one is the same as a cell around the other, or its neighbor.
class QualityEvaluator
{
public:
  QualityEvaluator(Region& region, const QualityTargets& targets, const RunContext& context);

  const Region& region() const { return region_; }
  double sizeOf(Index cell) const { return sizes[cell]; }

  /// Returns true if the penalty around a movable point is 0, or below `penalty` for certain.
  bool isGood(std::size_t movable, double penalty) const;
  /// Fills a star with the cells around a movable point.
  void enter(std::size_t movable, VertexStar& star) const;
  /// Stores the state of a star that was entered, before its point is moved.
  void prepare(VertexStar& star) const;
  /// Moves the star's point and measures all that depends on it. Kept scores do not change until accept().
  void move(VertexStar& star, const Vec3& p);
  /// The same, but measures only what residualsOf() and residualsBeside() depend on.
  void moveForResiduals(VertexStar& star, const Vec3& p);
  /// Restores the state that prepare() stored. The star must be prepared again before further use.
  void restore(const VertexStar& star);
  /// Moves the star's point and returns the score there. Stops early once a limit is exceeded; the score is then not
  /// complete.
  Score look(VertexStar& star, const Vec3& p, const LookLimits& limits = {});
  /// Keeps the scores of the last look(), which must not have stopped early.
  void accept(const VertexStar& star);

  /// Return kept scores; that of a star is the sum over its cells and faces.
  Score scoreOf(const VertexStar& star) const;
  Score scoreOfCell(Index cell) const { return cellScores[cell]; }
  Score scoreOfFace(Index face) const { return faceScores[face]; }
  /// Returns the smallest relative measure of each kind, of a cell and its faces. Kinds that reach their target may be
  /// infinite.
  std::array<double, Measure::kinds> leastOf(Index cell) const;

  /// Lists the measures that fall short, of the cells and faces of a star whose kept scores do; always in the same
  /// order.
  void residualsOf(VertexStar& star, Residuals& out) const;
  /// Sets `out` to the shortfalls that the measures in `before` have after a move.
  void residualsBeside(VertexStar& star, const Residuals& before, std::vector<double>& out) const;

  /// Return metrics in the current state; that of a star is the worst of its cells and faces.
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
  /// One entry per cell: factor that makes volumes of its tetrahedra relative to its size and the target.
  std::vector<double> cornerScales;
  std::vector<Score> cellScores;
  std::vector<Score> faceScores;
};

} // namespace atria
