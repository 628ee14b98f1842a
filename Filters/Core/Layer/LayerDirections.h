// SPDX-License-Identifier: GPL-3.0-or-later
/// Which way a layer grows from each point of a wall.
#pragma once

#include "Layer/LayerWalls.h"

namespace atria {

/// What the direction at a point has to look to. All are unit vectors.
struct DirectionProblem
{
  /// Normals into the fluid of the walls about the point.
  std::vector<Vec3> walls;
  /// Normals of sheets that have a boundary edge there: the layer tapers to it, in the plane of the sheet.
  std::vector<Vec3> sheets;
  /// Ways out of those sheets across their boundary edges.
  std::vector<Vec3> ways;
  /// Planes of the domain's sides the point must stay in.
  std::vector<Vec3> sides;
};

/// A copy whose direction has a cosine to a wall's normal below this is not made. So the layer tapers to nothing at
/// boundary edges, where the cosine is 0: wrapped round them, a prism would have two faces in the plane of the sheet.
inline constexpr double feasibleCosine = 0.1;

/// Sheets whose normals spread over a boundary edge point by less than this share of their squares are one plane (37
/// degrees between two).
inline constexpr double sheetSpread = 0.1;

struct LayerDirection
{
  /// Unit vector, or zero where there is none in the planes asked for.
  Vec3 direction = Vec3::Zero();
  /// The least cosine to a wall's normal.
  double cosine = -1.0;
};

/// The direction in the planes of sides and boundary edge sheets that is farthest inside all half spaces of walls and
/// ways: the point of their convex hull that is nearest to the origin (best of single vectors, pairs and triples, which
/// is exact where some direction is inside all of them). Sheets themselves do not count, as they lie along it.
LayerDirection solveDirection(const DirectionProblem& problem);

/// Area vectors of boundary faces, into the fluid.
std::vector<Vec3> wallNormals(const DualMesh& mesh, const RunContext& context);

/// For each point with a count the direction; zero for others, and where faces of the domain's sides are off their
/// planes.
std::vector<LayerDirection> findDirections(const DualMesh& mesh, const LayerWalls& walls,
                                           const std::vector<Vec3>& normals, const std::vector<Index>& counts,
                                           const LayerOptions& options, const RunContext& context);

/// Where a wall face has two edges on a crease, the prism on it would have two faces in one plane. Directions there
/// lean away from that face, if they stay off all walls.
void leanFromStraight(const DualMesh& mesh, const LayerWalls& walls, const std::vector<Vec3>& normals,
                      std::vector<LayerDirection>& directions);

} // namespace atria
