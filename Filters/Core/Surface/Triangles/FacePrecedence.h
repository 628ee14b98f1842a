// SPDX-License-Identifier: GPL-3.0-or-later
/// Decides which of several surfaces keeps its faces where they lie upon each other, such as a window and an uncut
/// wall.
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
  /// Per triangle: the area of its patch.
  std::vector<double> areas;
  /// Per surface: its whole area, and whether an even number of its triangles uses each of its edges.
  std::vector<double> surfaceAreas;
  std::vector<char> isClosed;
};

/// A patch is what triangles of one surface that share points make up in one plane. Triangles of a surface with the
/// same corners count once. Points are the same only if their numbers are. O(n).
PlanarPatches findPlanarPatches(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                std::span<const Index> surfaceIds);

/// Compares triangles that lie upon each other. The smaller one keeps its faces, by these rules in turn:
///
/// - Cell zones give way to walls and face zones, and sides of a turned domain to all others.
/// - The triangle of the smaller planar patch stays, as the whole of a surface named by material may be large.
/// - A wall stays where a face zone is not smaller.
/// - The triangle of the surface with the smaller whole area stays.
/// - The first triangle stays.
///
/// Areas that differ by less than a hundredth are equal.
class FacePrecedence
{
public:
  FacePrecedence() = default;
  /// Surfaces are numbered from 0 to `surfaceCount`, those from there on are sides of a turned domain. `kinds` is by
  /// surface; empty where all are walls.
  FacePrecedence(PlanarPatches patches, std::span<const Index> surfaceIds, std::size_t surfaceCount,
                 std::vector<SurfaceKind> kinds = {});
  /// Of a surface's triangles; `pointOf` has for each point the one that stands for it.
  FacePrecedence(const TriangleSurface& surface, std::span<const Index> pointOf, std::vector<SurfaceKind> kinds = {});

  /// The position in `triangles` of the one that stays.
  std::size_t keptOf(std::span<const Index> triangles) const;

  /// Whether nothing but the order of two triangles of different surfaces says which stays.
  bool areEqual(Index a, Index b) const;
  /// Whether the surfaces of two triangles are closed: where these face each other, two solids touch.
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
