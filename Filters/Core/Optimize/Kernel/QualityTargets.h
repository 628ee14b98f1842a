// SPDX-License-Identifier: GPL-3.0-or-later
/// Defines what quality the cells of a mesh should have, and from which limits on they are valid.
#pragma once

#include <algorithm>
#include <limits>

namespace atria {

/// Limit from which on a measure is valid, and target from which on it is good. More is better if the target is greater
/// than the limit, otherwise less.
struct QualityRange
{
  double limit;
  double target;

  /// Returns the relative measure: 0 at the limit, 1 at the target.
  double of(double measure) const { return (measure - limit) / (target - limit); }
  /// Returns the measure that has this relative measure.
  double at(double share) const { return limit + share * (target - limit); }
  /// Sets another target. If it is easier to reach, the limit is scaled by the same factor, so that they stay apart.
  /// Otherwise the limit stays.
  void aimAt(double wanted)
  {
    const double limitThere = limit / target * wanted;
    limit = limit < target ? std::min(limit, limitThere) : std::max(limit, limitThere);
    target = wanted;
  }
  /// Returns the range with its target moved away from the limit by `share` of the distance between them.
  QualityRange beyond(double share) const { return {limit, target + share * (target - limit)}; }
};

/// Ranges of the measures of cells and their faces, all dimensionless. Limits of measures that OpenFOAM's checkMesh
/// knows are a little stricter than there. QualityEvaluator takes the measures.
struct QualityTargets
{
  /// Cosine between a face's normal and the vector from the cell's centroid to the face's: 1 - CellSquish.
  QualityRange pyramidCosine{0.01, 0.21};
  /// Sine of the angle by which the centroid of a face lies behind the plane of another of the cell's faces. Two
  /// boundary faces are also good if they lie in one plane, or if the sine is above twice checkMesh's limit.
  QualityRange convexity{0.0005, 0.04};
  /// True if cells must be convex; `convexity` is not measured otherwise.
  bool convex = true;
  /// Cosine between a face's normal and the vector between the centroids of its two cells: 1 - FaceSquish.
  QualityRange faceCosine{0.03, 0.5};
  /// Lower bound of what `faceCosine` contributes to Score::worst. It serves ranges whose limit is stricter than what
  /// is valid: other measures are then not given up for this one.
  double leastOfFaceCosine = -std::numeric_limits<double>::infinity();
  /// OpenFOAM's skewness.
  QualityRange skewness{3.8, 2.0};
  /// Lower bound of what `skewness` contributes to Score::worst, as leastOfFaceCosine.
  double leastOfSkewness = -std::numeric_limits<double>::infinity();
  /// OpenFOAM's interpolation weight.
  QualityRange weight{0.06, 0.15};
  /// Smaller over larger volume of two neighbors.
  QualityRange volumeRatio{0.015, 0.05};
  /// Smallest volume of the tetrahedra over the triangles of the cell's faces, over the cube of the cell's mean edge;
  /// scaled so that a cube has 1. Their apex is the cell's centroid, or the mean of its face centroids if the cell is
  /// nearly flat or `decomposed` is false.
  QualityRange cornerVolume{0.0, 0.02};
  /// Smallest area of the triangles of a boundary face around its centroid, along its normal, over their mean area.
  /// Triangular faces are not judged by it.
  QualityRange boundaryShape{0.0, 0.1};
  /// Fourth root of OpenFOAM's cell determinant: |det| of the sum of a a^T over the internal faces, divided by 8, with
  /// the area vectors a over their mean length. The determinant goes with the fourth power of a cell's smallest
  /// thickness. It is 0 for a cell with neighbors on two axes only, whatever the cell's shape.
  QualityRange determinantRoot{0.182, 0.316};
  /// Lower bound of what `determinantRoot` contributes to Score::worst: cells may fall short by it without being bad.
  /// If it is infinite, no cell is short by the determinant alone, but determinants of cells around moved points are
  /// improved.
  double leastOfDeterminant = -std::numeric_limits<double>::infinity();
  /// True if faces must be star-shaped around their centroids, as OpenFOAM's decomposition into tetrahedra requires,
  /// and if determinants are judged.
  bool decomposed = true;
  /// Target and limit of Verdict's scaled Jacobian, for cells that have one. A target of 0 turns it off.
  double scaledJacobian = 0.0;
  double jacobianLimit = 0.0;
  /// Lower bound of what `scaledJacobian` contributes to Score::worst, as leastOfDeterminant.
  double leastOfJacobian = -std::numeric_limits<double>::infinity();

  bool looksAtJacobians() const { return scaledJacobian > 0.0; }
  /// Returns the targets moved away from their limits by `share` of the distance. The target of the scaled Jacobian is
  /// multiplied by 1 + share instead. Measures stop just short of what is aimed at, which is why callers aim beyond the
  /// targets.
  QualityTargets beyond(double share) const;
  /// Returns the targets at `share` of their distance from the limits, as beyond() does.
  QualityTargets within(double share) const { return beyond(share - 1.0); }
};

} // namespace atria
