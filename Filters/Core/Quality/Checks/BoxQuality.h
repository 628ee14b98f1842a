// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures the quality of meshes that are mostly regular boxes.
#pragma once

#include "Quality/Checks/Metrics.h"

#include <functional>
#include <optional>

namespace atria {

/// Number of cells that a thread measures at once. With the cells around them they fit into its cache.
inline constexpr std::size_t measuredAtOnce = 8192;

/// Faces that a mesh must have.
struct AskedFaces
{
  /// Faces of patches, which stay on the boundary.
  std::span<const BoundaryFaceKey> patches;
  /// True if they must be the whole boundary.
  bool patchesAreTheBoundary = false;
  /// Faces of face zones, each between its cell and its entry of `neighbors`.
  std::span<const BoundaryFaceKey> zones;
  std::span<const Index> neighbors;
};

/// Cells and faces that count in a mesh that is a piece of a larger one, with cells of other pieces around its own.
struct CountedPart
{
  /// One entry per cell. Metrics of other cells differ from those in the whole mesh.
  std::span<const char> isOwn;
  /// Returns true if the face between two cells is counted here, and not in another piece. Faces on the boundary count
  /// where their cell does.
  std::function<bool(Index, Index)> countsFace;
};

/// Metrics of a mesh, equal to those of computeQuality() up to rounding, but found without all of its faces: regular
/// boxes (RegularBoxes.h) are ideal, and only the other cells and their surroundings are measured.
struct QualityByBoxes
{
  /// As in RegularBoxes.
  Buffer<char> isRegular;
  Buffer<double> volumes;
  Buffer<double> aspectRatios;
  std::size_t regularCount = 0;
  /// Internal faces whose metrics are 0.
  std::size_t idealFaces = 0;
  /// The cells that are not regular, in rising order, and their metrics. Face metrics cover all faces that are not
  /// ideal; in a part, only those that count.
  std::vector<Index> others;
  QualityMetrics metrics;
};

/// Measures cells that are not regular boxes in windows of `length` to twice as many cells (CellWindow.h), each on one
/// thread. Returns nullopt if this saves nothing, because most cells must be measured and do not fill two windows; a
/// part is measured in any case. Also returns nullopt if cells or faces are wrong; makeFaceMesh() of the whole mesh
/// reports the error. In a part, points of cells that are not its own make cells irregular, and faces of patches must
/// be the boundary of own cells. The result has the same bits for any number of threads. Throws Aborted when asked to.
std::optional<QualityByBoxes> computeQualityByBoxes(std::span<const Vec3> points, const CellArrays& cells,
                                                    const AskedFaces& asked, const RunContext& context,
                                                    std::size_t length = measuredAtOnce,
                                                    const CountedPart* part = nullptr);

} // namespace atria
