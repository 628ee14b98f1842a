// SPDX-License-Identifier: GPL-3.0-or-later
/// Quality of meshes most of which are regular boxes.
#pragma once

#include "Quality/Checks/Metrics.h"

#include <functional>
#include <optional>

namespace atria {

/// Cells that are measured at once: with those about them, some 80 MB.
inline constexpr std::size_t measuredAtOnce = 131072;

/// Faces that a mesh is to have.
struct AskedFaces
{
  /// Those of patches, which stay on the boundary.
  std::span<const BoundaryFaceKey> patches;
  /// Whether they are to be all of it.
  bool patchesAreTheBoundary = false;
  /// Those of face zones, each between its cell and that of `neighbors`.
  std::span<const BoundaryFaceKey> zones;
  std::span<const Index> neighbors;
};

/// What counts of a mesh that is a piece of a larger one, with cells of other pieces about its own.
struct CountedPart
{
  /// By cell. The metrics of others are not those in the whole.
  std::span<const char> isOwn;
  /// Whether a face of two cells is counted here, and not in another piece; one on the boundary is where its cell is.
  std::function<bool(Index, Index)> countsFace;
};

/// The metrics that computeQuality() finds in a mesh, up to rounding, without all of its faces: regular boxes
/// (RegularBoxes.h) are ideal, and only what is about the others is measured.
struct QualityByBoxes
{
  /// As in RegularBoxes.
  Buffer<char> isRegular;
  Buffer<double> volumes;
  Buffer<double> aspectRatios;
  std::size_t regularCount = 0;
  /// Internal faces whose metrics are 0.
  std::size_t idealFaces = 0;
  /// The cells that are not regular, in rising order, and their metrics; those of faces are of all but ideal ones, and
  /// of a part of those alone that count.
  std::vector<Index> others;
  QualityMetrics metrics;
};

/// The others are measured in windows of `length` cells and up to twice as many (CellWindow.h), so that no more of
/// their faces and geometry is there at once. Nothing where that saves nothing, as most cells are to be measured and
/// there are no two windows of them, and where something is wrong with cells or faces: makeFaceMesh() of the whole mesh
/// tells it. Of a part it is told in any case: no box has points of cells that are not its own, and faces of patches
/// are to be the boundary of own ones. The same bits for any number of threads. Throws Aborted when asked to.
std::optional<QualityByBoxes> computeQualityByBoxes(std::span<const Vec3> points, const CellArrays& cells,
                                                    const AskedFaces& asked, const RunContext& context,
                                                    std::size_t length = measuredAtOnce,
                                                    const CountedPart* part = nullptr);

} // namespace atria
