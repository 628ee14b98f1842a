// SPDX-License-Identifier: GPL-3.0-or-later
/// Quality of every cell of a mesh, as solvers and their mesh checkers measure it.
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Support/Buffer.h"
#include "Support/RunContext.h"

#include <array>

namespace atria {

/// Below, A is the outward area vector of a face, r goes from the cell's centroid to the face's, d from the
/// centroid of a face's owner to that of its neighbor; see Geometry.h for how these are measured. Everything
/// is dimensionless unless a unit is given. A cell without internal faces is ideal in what needs d.
struct QualityMetrics
{
  /// Greatest 1 - A·r/(|A||r|) over the cell's faces; [0, 2], 0 is ideal (Fluent's volume squish index).
  Buffer<double> cellSquish;
  /// Greatest 1 - A·d/(|A||d|) over the cell's internal faces; [0, 2], 0 is ideal.
  Buffer<double> faceSquish;
  /// Greatest over smallest of the distances from the centroid to the face centroids and corners; [1, ∞), a
  /// cube has √3 (Fluent's aspect ratio).
  Buffer<double> aspectRatio;
  /// The reciprocal of aspectRatio; [0, 1], a cube has 1/√3.
  Buffer<double> inverseAspectRatio;
  /// Smallest cosine of A to r over all faces and to d over internal ones; [-1, 1], 1 is ideal (Fluent).
  Buffer<double> orthogonalQuality;
  /// Greatest angle in degrees between A and d over the internal faces; [0, 180], 0 is ideal (OpenFOAM).
  Buffer<double> nonOrthogonality;
  /// Greatest skewnessOfFaces over the cell's faces; [0, ∞), 0 is ideal (OpenFOAM).
  Buffer<double> skewness;
  /// Cubic model units.
  Buffer<double> volume;
  /// Smallest A·r/3 over the cell's faces, the volume of the pyramid from the face to the centroid; cubic
  /// model units, above 0 in a valid cell (OpenFOAM).
  Buffer<double> facePyramids;
  /// See ScaledJacobian.h; not a number for polyhedra.
  Buffer<double> scaledJacobian;
  /// 1 if the volume and all face pyramids are above 0 and the area vectors add up to zero (to 1e-6 of their absolute
  /// sum by component, OpenFOAM's openness); else 0.
  Buffer<unsigned char> valid;
  std::size_t invalidCells = 0;

  /// One entry per internal face: 1 - A·d/(|A||d|).
  Buffer<double> squishOfFaces;
  /// One entry per internal face: angle in degrees between A and d.
  Buffer<double> nonOrthogonalityOfFaces;
  /// One entry per face, boundary faces included: distance from the face's centroid to where d meets its plane, over
  /// the greatest of 0.2|d| and the face's extent in that direction. On the boundary d is the component of r along A,
  /// and the factor 0.4 (OpenFOAM).
  Buffer<double> skewnessOfFaces;
};

/// All metrics of cells except `valid`, and all metrics of faces.
using QualityList = Buffer<double> QualityMetrics::*;
inline constexpr std::array<QualityList, 10> cellMetrics{
    &QualityMetrics::cellSquish,        &QualityMetrics::faceSquish,
    &QualityMetrics::aspectRatio,       &QualityMetrics::inverseAspectRatio,
    &QualityMetrics::orthogonalQuality, &QualityMetrics::nonOrthogonality,
    &QualityMetrics::skewness,          &QualityMetrics::volume,
    &QualityMetrics::facePyramids,      &QualityMetrics::scaledJacobian};
inline constexpr std::array<QualityList, 3> faceMetrics{
    &QualityMetrics::squishOfFaces, &QualityMetrics::nonOrthogonalityOfFaces, &QualityMetrics::skewnessOfFaces};

/// Returns the skewness of one face, as in skewnessOfFaces.
double faceSkewness(const MeasuredMesh& mesh, std::size_t face);

/// Returns A·d/(|A||d|) of an internal face; at most 1 up to rounding.
double faceCosine(const MeasuredMesh& mesh, std::size_t face);

/// Measures all of the above. `cells` are those the mesh was made of. The result has the same bits for any
/// number of threads. Throws Aborted when asked to.
QualityMetrics computeQuality(const FaceMesh& mesh, const CellArrays& cells, const RunContext& context);
QualityMetrics computeQuality(const MeasuredMesh& measured, const CellArrays& cells, const RunContext& context);

} // namespace atria
