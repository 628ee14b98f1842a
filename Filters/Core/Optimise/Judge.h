// SPDX-License-Identifier: GPL-3.0-or-later
/// How far the cells of a region are from good, by the measures solvers judge by.
#pragma once

#include "Optimise/CellMeasure.h"
#include "Quality/ScaledJacobian.h"

namespace atria {

/// What of a measure is valid, and what is good enough.
struct QualityRange
{
  double limit;
  double target;

  /// 0 at the limit, 1 at the target.
  double of(double measure) const { return (measure - limit) / (target - limit); }
  /// Another target. The limit moves on where it would come too close.
  void aimAt(double wanted)
  {
    const double limitThere = limit / target * wanted;
    limit = limit < target ? std::min(limit, limitThere) : std::max(limit, limitThere);
    target = wanted;
  }
  /// The target moved away from the limit by this share of the way between them.
  QualityRange beyond(double share) const { return {limit, target + share * (target - limit)}; }
};

/// What good cells have. The limits leave a little room to those of OpenFOAM's checkMesh. See Judge for the measures.
struct QualityTargets
{
  /// Cosine between a face's normal and the way from the cell's centroid to the face's: 1 - CellSquish.
  QualityRange pyramidCosine{0.01, 0.21};
  /// Sine of the angle by which the centroid of a face lies behind the plane of another of the cell's faces. Two faces
  /// on the mesh's boundary may lie in one plane.
  QualityRange convexity{0.0005, 0.04};
  /// Whether cells have to be convex.
  bool convex = true;
  /// Cosine between a face's normal and the way between the cells' centroids: 1 - FaceSquish.
  QualityRange faceCosine{0.03, 0.5};
  /// OpenFOAM's skewness.
  QualityRange skewness{3.8, 2.0};
  /// OpenFOAM's interpolation weight.
  QualityRange weight{0.06, 0.15};
  /// Volumes of neighbours, the smaller over the larger.
  QualityRange volumeRatio{0.015, 0.05};
  /// Twelve times the least volume of a tetrahedron from the mean of the cell's face centroids to a corner of a face,
  /// over the cube of the cell's mean edge.
  QualityRange cornerVolume{0.0, 0.02};
  /// Least of a boundary face's triangles about its mean, along its normal, over their mean.
  QualityRange boundaryShape{0.0, 0.1};
  /// Of the sum of the dyads of a cell's internal face areas over their mean: OpenFOAM's cell determinant. A cell with
  /// other cells beside it on two axes only has none, whatever its shape.
  QualityRange determinant{0.0011, 0.01};
  /// Whether it counts for the worst; if not, it is improved where that is possible.
  bool determinants = true;
  /// Whether faces must be star-shaped about their centroids, as OpenFOAM's decomposition into tetrahedra asks, and
  /// determinants are looked at.
  bool decomposed = true;
  /// Verdict's scaled Jacobian of cells that have one, its limit 0; a target of 0 asks for nothing.
  double scaledJacobian = 0.0;

  /// All targets farther from their limits: measures creep up to what is aimed at and stop just short of it.
  QualityTargets beyond(double share) const;
};

/// Sum of (1 - q)² over all measures q below 1, and the least q.
struct Score
{
  double penalty = 0.0;
  double worst = std::numeric_limits<double>::infinity();

  void add(double q)
  {
    worst = std::min(worst, q);
    addPenalty(q);
  }
  void addPenalty(double q)
  {
    if (q < 1.0)
    {
      penalty += (1.0 - q) * (1.0 - q);
    }
  }
  void add(const Score& other)
  {
    penalty += other.penalty;
    worst = std::min(worst, other.worst);
  }
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
    scaledJacobian,
    weight,      ///< OpenFOAM's interpolation weight
    volumeRatio, ///< of neighbours, the smaller over the larger
    determinant, ///< OpenFOAM's
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

/// The cells about a point that may move, and what depends on it.
struct Star
{
  Index point = noIndex; ///< the leader
  std::vector<Index> points;
  double size = 0.0; ///< mean edge of the cells
  std::vector<Index> cells;
  std::vector<Index> moving; ///< faces that have one of the points
  std::vector<Index> faces;  ///< all faces of the cells
};

/// Keeps the measures of a region's faces and cells and judges by them. Points in whose stars no cell is the same or a
/// neighbour of the other's may be moved at the same time by different threads.
class Judge
{
public:
  Judge(Region& region, const QualityTargets& targets, const RunContext& context);

  const Region& region() const { return region_; }
  double sizeOf(Index cell) const { return sizes[cell]; }

  void enter(std::size_t movable, Star& star) const;
  /// Moves the star's point and measures all that depends on it.
  void move(const Star& star, const Vec3& p);
  /// As soon as the penalty is above `enough` the rest is not looked at.
  Score scoreOf(const Star& star, double enough = std::numeric_limits<double>::infinity()) const;

  Score scoreOfCell(Index cell) const;
  Score scoreOfFace(Index face) const;

  LeastMetrics metricsOf(const Star& star) const;
  LeastMetrics metricsOfCell(Index cell) const;
  LeastMetrics metricsOfFace(Index face) const;

private:
  void measure(Index face);
  void measureOne(Index cell);
  void scoreCorners(Index face, Index cell, Score& score) const;
  void scoreFans(Index face, Score& score) const;
  std::array<double, 4> halfVolumes(Index face, const Vec3& middle) const;
  const Vec3& middleOf(Index cell) const;
  double determinantOf(Index cell) const;
  JacobianTerms jacobiansOf(Index cell) const;
  void scoreBoundary(Index face, Score& score) const;
  void scoreSkewness(Index face, const Vec3& d, Score& score) const;
  double skewnessOf(Index face, const Vec3& d, double good) const;
  double sign(Index cell, Index face) const { return region_.owner[face] == cell ? 1.0 : -1.0; }

  Region& region_;
  QualityTargets targets_;
  std::vector<FaceMeasure> faces;
  /// In the order of the region's face points, twice the area vectors of triangles: those about the face's centroid,
  /// and, of quadrilaterals, 012, 023, 123 and 130 of the corners.
  std::vector<Vec3> fans;
  std::vector<Vec3> halves;
  std::vector<CellMeasure> cells;
  std::vector<double> sizes;
  /// Factors that make volumes of a cell's tetrahedra relative to its size and the target.
  std::vector<double> cornerScales;
  /// Volumes below which a cell counts as flat.
  std::vector<double> flatVolumes;
};

} // namespace atria
