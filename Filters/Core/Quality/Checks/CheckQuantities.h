// SPDX-License-Identifier: GPL-3.0-or-later
/// Quantities that OpenFOAM's checkMesh measures beyond the metrics of Metrics.h, by OpenFOAM's definitions (version
/// 1912, primitiveMeshTools, polyMeshTools and polyMeshTetDecomposition).
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Support/RunContext.h"

#include <array>
#include <cstdint>
#include <vector>

namespace atria {

/// A is the area vector of a face. Quantities are dimensionless unless a unit is given. Each has one value per cell,
/// internal face or face, as stated.
enum class CheckQuantity : std::uint8_t
{
  /// Per cell: greatest over x, y, z of |sum of A| / sum of |A|; 0 is closed.
  Openness,
  /// Per cell: the greater of max / min over x, y, z of the sums of |A|, and the total of these sums over 6 V^(2/3). A
  /// cube along the axes has 1. Depends on the axes.
  AreaAspectRatio,
  /// Per cell: |det| of the sum of a a^T over internal faces, divided by 8, with a = A over their mean |A|. An interior
  /// cube has 1, a cell with fewer than three independent internal faces 0.
  Determinant,
  /// Per cell: greatest cosine of a face's normal to the vector from its centroid to that of another face of the cell.
  /// A cube has -0.707. At 0 two faces are coplanar; above 0 the cell is concave.
  Concavity,
  /// Per internal face: smaller of the distances of both cells' centroids from the face, along its normal, over their
  /// sum; at most 0.5.
  FaceWeight,
  /// Per internal face: smaller over greater volume of its two cells; at most 1.
  VolumeRatio,
  /// Per face: |A| over the sum of the areas of its triangles around the centroid; 1 is flat.
  FaceFlatness,
  /// Per face: greatest angle in degrees by which it turns the wrong way at a corner, 0 to 90; below 10 counts as 0.
  FaceConcaveAngle,
  /// Per face: smallest volume, for both cells, of a tetrahedron of an edge, the face's centroid and the cell's
  /// centroid, over that of the regular tetrahedron of the same circumradius; 1 is ideal. If no corner of the face
  /// gives triangles whose tetrahedra are all positive, at most the value of the best corner.
  TetQuality,
  /// Per face: length of its shortest edge, model units.
  EdgeLength,
};

constexpr std::size_t checkQuantityCount = 10;

struct CheckQuantityInfo
{
  CheckQuantity quantity;
  const char* name;
  bool ofFaces;        ///< true: one value per face; false: one per cell
  bool greaterIsWorse; ///< else smaller is
  bool needsTwoCells;  ///< true if boundary faces have the value 1; tables and checks omit them
};

/// Returns all quantities, in order.
const std::array<CheckQuantityInfo, checkQuantityCount>& checkQuantities();
const CheckQuantityInfo& describe(CheckQuantity quantity);

/// Returns one value for each cell or each face; 1 on boundary faces for quantities that need two cells. The result has
/// the same bits for any number of threads. Throws Aborted when asked to.
std::vector<double> measure(const MeasuredMesh& mesh, CheckQuantity quantity, const RunContext& context);

/// Returns the worst value over the faces of each cell.
std::vector<double> worstOverFaces(const MeasuredMesh& mesh, const std::vector<double>& values, bool greaterIsWorse,
                                   const RunContext& context);

/// Returns the volume of the pyramid from a face to the centroid of a cell beside it; above 0 if the face points out of
/// the cell. It is computed as checkMesh does, which differs from the cell's volume in the last bits.
double pyramidVolume(const MeasuredMesh& mesh, std::size_t face, Index cell);

} // namespace atria
