// SPDX-License-Identifier: GPL-3.0-or-later
/// Chooses which of several surfaces keeps its faces where they overlap, such as a window and an uncut wall.
#pragma once

#include "Support/Types.h"
#include "Surface/Triangles/SurfaceKind.h"
#include "Surface/Triangles/TriangleSurface.h"

#include <span>
#include <vector>

namespace atria {

/// Areas of the planar patches that triangles belong to.
struct PlanarPatches
{
  /// One entry per triangle: the area of its patch.
  std::vector<double> areas;
  /// One entry per surface: its whole area, and nonzero if an even number of its triangles uses each of its edges.
  std::vector<double> surfaceAreas;
  std::vector<char> isClosed;
};

/// Returns the planar patches. A patch consists of triangles of one surface in one plane that share points. Triangles
/// of a surface with the same corners count once. Points are the same only if their numbers are. O(n).
PlanarPatches findPlanarPatches(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                std::span<const Index> surfaceIds);

/// Compares overlapping triangles. The smaller one keeps its faces, by these rules in turn:
///
/// - Cell zones give way to walls and face zones, and sides of a turned domain to all others.
/// - The triangle of the smaller planar patch stays, as the whole of a surface named by material may be large.
/// - A wall stays if a face zone is not smaller.
/// - The triangle of the surface with the smaller whole area stays.
/// - The first triangle stays.
///
/// Areas that differ by less than a hundredth are equal.
class FacePrecedence
{
public:
  FacePrecedence() = default;
  /// Surfaces are numbered from 0 to `surfaceCount`; higher numbers are sides of a turned domain. `kinds` has one entry
  /// per surface; empty if all are walls.
  FacePrecedence(PlanarPatches patches, std::span<const Index> surfaceIds, std::size_t surfaceCount,
                 std::vector<SurfaceKind> kinds = {});
  /// Compares triangles of `surface`; `pointOf` has for each point the one that stands for it.
  FacePrecedence(const TriangleSurface& surface, std::span<const Index> pointOf, std::vector<SurfaceKind> kinds = {});

  /// Returns the position in `triangles` of the one that stays.
  std::size_t keptOf(std::span<const Index> triangles) const;

  /// True if only the order of two triangles of different surfaces decides which one stays.
  bool areEqual(Index a, Index b) const;
  /// True if the surfaces of two triangles are both closed. Two solids touch where such triangles face each other.
  bool areOfClosedSurfaces(Index a, Index b) const;

  Index surfaceOf(Index triangle) const { return surfaceIds_[triangle]; }
  bool isSide(Index surface) const { return surface >= surfaceCount_; }
  SurfaceKind kindOf(Index surface) const { return surface < kinds_.size() ? kinds_[surface] : SurfaceKind::wall; }

private:
  int orderOf(Index triangle) const;
  bool yieldsToWalls(Index triangle) const;
  double wholeArea(Index triangle) const;

  PlanarPatches patches_;
  std::vector<Index> surfaceIds_;
  std::size_t surfaceCount_ = 0;
  std::vector<SurfaceKind> kinds_;
};

} // namespace atria
