// SPDX-License-Identifier: GPL-3.0-or-later
/// What OpenFOAM's checkMesh measures beyond the metrics of Metrics.h, as it is defined there (version 1912,
/// primitiveMeshTools, polyMeshTools and polyMeshTetDecomposition).
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Support/RunContext.h"

#include <array>
#include <cstdint>
#include <vector>

namespace atria {

/// A is the area vector of a face. All without unit unless one is given.
enum class CheckQuantity : std::uint8_t
{
  /// By cell: greatest over x, y, z of |sum of A| / sum of |A|; 0 is closed.
  Openness,
  /// By cell: the greater of max / min over x, y, z of the sums of |A|, and the sum of all these over 6 V^(2/3); a cube
  /// along the axes has 1. Depends on the axes.
  AreaAspectRatio,
  /// By cell: |det| of the sum of a aT over internal faces, a = A over their mean |A|, divided by 8; an interior cube
  /// has 1, a cell with fewer than three independent internal faces 0.
  Determinant,
  /// By cell: greatest cosine of a face's normal to the way from its centroid to that of another face of the cell. A
  /// cube has -0.707; at 0 two faces are coplanar, above the cell is concave.
  Concavity,
  /// By internal face: smaller of the distances of both cells' centroids from the face, along its normal, over their
  /// sum; at most 0.5.
  FaceWeight,
  /// By internal face: smaller over greater volume of its two cells; at most 1.
  VolumeRatio,
  /// By face: |A| over the sum of the areas of its triangles about the centroid; 1 is flat.
  FaceFlatness,
  /// By face: greatest angle in degrees by which it turns the wrong way at a corner, 0 to 90; below 10 counts as 0.
  FaceConcaveAngle,
  /// By face: smallest volume of a tetrahedron of an edge, the face's centroid and a cell's centroid, over that of the
  /// regular one of the same circumradius, of both cells; 1 is ideal. Where no corner of the face is the apex of
  /// triangles whose tetrahedra are all positive, at most the best such corner's.
  TetQuality,
  /// By face: length of its shortest edge, model units.
  EdgeLength,
};

constexpr std::size_t checkQuantityCount = 10;

struct CheckQuantityInfo
{
  CheckQuantity quantity;
  const char* name;
  bool ofFaces;        ///< by face, else by cell
  bool greaterIsWorse; ///< else smaller is
  bool needsTwoCells;  ///< is 1 on boundary faces, which tables and checks leave out
};

/// All of them, in order.
const std::array<CheckQuantityInfo, checkQuantityCount>& checkQuantities();
const CheckQuantityInfo& describe(CheckQuantity quantity);

/// One value for each cell or each face. A boundary face has 1 in what needs two cells. The result has the same bits
/// for any number of threads. Throws Aborted when asked to.
std::vector<double> measure(const MeasuredMesh& mesh, CheckQuantity quantity, const RunContext& context);

/// For each cell the worst over its faces.
std::vector<double> worstOverFaces(const MeasuredMesh& mesh, const std::vector<double>& values, bool greaterIsWorse,
                                   const RunContext& context);

/// Volume of the pyramid from a face to the centroid of a cell beside it, above 0 where the face looks out of the cell;
/// as checkMesh computes it, which is not to the last bit as the cell's volume.
double pyramidVolume(const MeasuredMesh& mesh, std::size_t face, Index cell);

} // namespace atria
