// SPDX-License-Identifier: GPL-3.0-or-later
/// How far the cells of a region are from good, by the measures solvers judge by.
#pragma once

#include "Optimise/CellMeasure.h"

namespace atria {

/// What a good cell has at least. Each measure is divided by its target, so that 1 is good enough and 0 is the limit
/// of what is valid; see Judge for the measures.
struct QualityTargets
{
  /// Cosine between a face's normal and the way from the cell's centroid to the face's: 1 - CellSquish.
  double pyramidCosine = 0.2;
  /// Sine of the angle by which the centroid of a face lies behind the plane of another of the cell's faces. Two faces
  /// on the mesh's boundary are not compared: what is flat there stays flat.
  double convexity = 0.04;
  /// Cosine between a face's normal and the way between the cells' centroids: 1 - FaceSquish.
  double faceCosine = 0.5;
  /// OpenFOAM's skewness, which may be at most this.
  double skewness = 2.0;
  /// OpenFOAM's interpolation weight.
  double weight = 0.1;
  /// Volumes of neighbours, the smaller over the larger.
  double volumeRatio = 0.04;
  /// Twelve times the least volume of a tetrahedron from the mean of the cell's face centroids to a corner of a face,
  /// over the cube of the cell's mean edge.
  double cornerVolume = 0.02;
  /// Least of a boundary face's triangles about its mean, along its normal, over their mean.
  double boundaryShape = 0.1;
  /// Of the sum of the dyads of a cell's internal face areas over their mean: OpenFOAM's cell determinant.
  double determinant = 0.01;
  /// Whether faces must be star-shaped about their centroids, as OpenFOAM's decomposition into tetrahedra asks.
  bool faceTetrahedra = true;
};

/// Sum of (1 - q)² over all measures q below 1, and the least q.
struct Score
{
  double penalty = 0.0;
  double worst = std::numeric_limits<double>::infinity();
  /// The least of all measures but convexity: above 0 in a cell that is valid.
  double sound = std::numeric_limits<double>::infinity();

  void add(double q)
  {
    sound = std::min(sound, q);
    addShape(q);
  }
  void addShape(double q)
  {
    worst = std::min(worst, q);
    if (q < 1.0)
    {
      penalty += (1.0 - q) * (1.0 - q);
    }
  }
  void add(const Score& other)
  {
    penalty += other.penalty;
    worst = std::min(worst, other.worst);
    sound = std::min(sound, other.sound);
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
  Score scoreOf(const Star& star) const;

  Score scoreOfCell(Index cell) const;
  Score scoreOfFace(Index face) const;

private:
  void measure(Index face);
  void measureOne(Index cell);
  void scoreCorners(Index face, Index cell, Score& score) const;
  void scoreFans(Index face, Score& score) const;
  double cornerScale(Index cell) const;
  const Vec3& middleOf(Index cell) const;
  double determinantOf(Index cell) const;
  void scoreBoundary(Index face, Score& score) const;
  double skewnessOf(Index face, const Vec3& d) const;
  double sign(Index cell, Index face) const { return region_.owner[face] == cell ? 1.0 : -1.0; }

  Region& region_;
  QualityTargets targets_;
  std::vector<FaceMeasure> faces;
  std::vector<CellMeasure> cells;
  std::vector<double> sizes;
};

} // namespace atria
