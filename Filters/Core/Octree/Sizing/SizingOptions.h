// SPDX-License-Identifier: GPL-3.0-or-later
/// Rules for the sizes of octants at surfaces, in boxes, at distances, in gaps.
#pragma once

#include "Support/Types.h"

#include <optional>
#include <string>
#include <vector>

namespace atria {

/// Sizes at the surfaces whose name matches `pattern`: `*` stands for any text, `?` for any one character. They take
/// the place of SizeMid and SizeMin there, and may be coarser. The finest size holds if several rules match a surface.
struct SurfaceSize
{
  std::string pattern;
  /// Octants that touch the surface are at most this large.
  double size = 1.0;
  /// Octants at its feature curves and corners, and where it comes close to other surfaces, are at most this large. If
  /// not set: SizeMin, or `size` if that is finer.
  std::optional<double> featureSize;
};

/// Octants that share volume with `bounds` are at most `size` large.
struct RefinementBox
{
  Box3 bounds;
  double size = 1.0;
};

/// Octants nearer than `distance` to a surface that matches `pattern` are at most `size` large.
struct DistanceSize
{
  std::string pattern;
  double distance = 0.0;
  double size = 1.0;
};

/// Sizing rules beyond the three sizes of GridOptions. Lengths are in model units. Octants have a size of SizeMin *
/// 2^j: the largest of these that is not above the requested size is taken.
struct SizingOptions
{
  static constexpr int maximumCellsPerLevel = 8;
  static constexpr int maximumCellsAcrossGap = 64;

  std::vector<SurfaceSize> surfaceSizes;
  std::vector<RefinementBox> boxes;
  std::vector<DistanceSize> distanceSizes;
  /// Degrees, at most 90, by which the normals of one smooth piece may differ in an octant. Octants with more are
  /// refined, but not below the size of the surface's features; 0 turns this off.
  double curvatureAngle = 0.0;
  /// Number of octants across the space between surfaces that face each other. They are not refined below the size of
  /// the surfaces' features; 0 turns this off.
  int cellsAcrossGap = 0;
  /// Layers of octants of each size between the next finer and the next coarser ones; 1 is the 2:1 balance alone.
  int cellsPerLevel = 1;
  /// True if octants are refined for a mesh of hexahedra only: in families of eight siblings, and with one size at and
  /// near each connected piece of surface (UniformWalls.h).
  bool hexahedra = false;
  /// Upper limit of the number of elements; 0 is no limit. Coarser sizes are taken to keep to it, first of all in the
  /// open and last at features (see SizeSteps in KeptSizes.h).
  std::size_t maxElements = 0;
  /// Bytes of memory that meshing may take; 0 is no limit.
  std::size_t memoryLimit = 0;
};

/// Returns the smallest size that any rule requests; infinity without rules. Throws Error for sizes not above 0.
double finestSizeOf(const SizingOptions& options);

} // namespace atria
