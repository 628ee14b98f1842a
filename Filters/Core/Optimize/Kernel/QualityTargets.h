// SPDX-License-Identifier: GPL-3.0-or-later
/// What is asked of cells.
#pragma once

#include <algorithm>
#include <limits>

namespace atria {

/// What of a measure is valid, and what is good enough.
struct QualityRange
{
  double limit;
  double target;

  /// 0 at the limit, 1 at the target.
  double of(double measure) const { return (measure - limit) / (target - limit); }
  /// The measure that this is of.
  double at(double share) const { return limit + share * (target - limit); }
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

/// What hexahedra on curved walls, away from creases and boundary edges, are to have; the less, the longer it takes.
struct CurvedWallTargets
{
  /// Degrees, greater than 0 and below 90.
  double nonOrthogonality = 20.0;
  /// OpenFOAM's, greater than 0.
  double skewness = 0.5;
};

/// What good cells have. The limits leave a little room to those of OpenFOAM's checkMesh. See QualityEvaluator for the
/// measures.
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
  /// What it makes of the worst at least: where its limit is above what is valid, others are not given up for it.
  double leastOfFaceCosine = -std::numeric_limits<double>::infinity();
  /// OpenFOAM's skewness.
  QualityRange skewness{3.8, 2.0};
  /// As leastOfFaceCosine.
  double leastOfSkewness = -std::numeric_limits<double>::infinity();
  /// OpenFOAM's interpolation weight.
  QualityRange weight{0.06, 0.15};
  /// Volumes of neighbors, the smaller over the larger.
  QualityRange volumeRatio{0.015, 0.05};
  /// Twelve times the least volume of a tetrahedron from the mean of the cell's face centroids to a corner of a face,
  /// over the cube of the cell's mean edge.
  QualityRange cornerVolume{0.0, 0.02};
  /// Least of a boundary face's triangles about its mean, along its normal, over their mean.
  QualityRange boundaryShape{0.0, 0.1};
  /// Fourth root of the determinant of the sum of the dyads of a cell's internal face areas over their mean: OpenFOAM's
  /// cell determinant goes with the fourth power of a cell's least thickness. A cell with other cells beside it on two
  /// axes only has none, whatever its shape.
  QualityRange determinantRoot{0.182, 0.316};
  /// What it makes of the worst at least: cells may fall short by it without being bad. Infinite: they do not count as
  /// short by it, either, but are improved where others do.
  double leastOfDeterminant = -std::numeric_limits<double>::infinity();
  /// Whether faces must be star-shaped about their centroids, as OpenFOAM's decomposition into tetrahedra asks, and
  /// determinants are looked at.
  bool decomposed = true;
  /// Verdict's scaled Jacobian of cells that have one, and its limit; a target of 0 asks for nothing.
  double scaledJacobian = 0.0;
  double jacobianLimit = 0.0;
  /// As leastOfDeterminant.
  double leastOfJacobian = -std::numeric_limits<double>::infinity();

  bool looksAtJacobians() const { return scaledJacobian > 0.0; }
  /// All targets farther from their limits: measures creep up to what is aimed at and stop just short of it.
  QualityTargets beyond(double share) const;
  /// All targets at this share of their way from the limits.
  QualityTargets within(double share) const { return beyond(share - 1.0); }
};

} // namespace atria
