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
/// Nor does one lift a prism off a wall to which its direction has less.
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

/// Directions at the points of one mesh while these move: those that stand where nothing moved are kept.
class LayerDirections
{
public:
  /// Both must outlive this.
  LayerDirections(const LayerWalls& walls, const LayerOptions& options) : walls_(walls), options_(options) {}

  /// Finds directions at the points with a count, of which those about points that moved since the last time are found
  /// anew. There is none where faces of the domain's sides are off their planes. Where a wall face has two edges on a
  /// crease, the prism on it would have two faces in one plane: directions lean away from that face, if they stay off
  /// all walls.
  void update(const DualMesh& mesh, const std::vector<Index>& counts, const RunContext& context);

  /// At a point that had a count.
  const LayerDirection& at(Index point) const { return directions_[point]; }
  /// The area vector of a boundary face, into the fluid.
  const Vec3& normal(Index face) const { return normals_[face]; }

private:
  void forgetMoved(const DualMesh& mesh, const RunContext& context);
  bool liesInSides(const DualMesh& mesh, Index point) const;
  DirectionProblem problemAt(const DualMesh& mesh, Index point) const;
  Vec3 wayFromStraight(const DualMesh& mesh, Index point) const;
  LayerDirection find(const DualMesh& mesh, Index point) const;

  const LayerWalls& walls_;
  const LayerOptions& options_;
  std::vector<Vec3> points_; ///< where they were
  std::vector<Vec3> normals_;
  std::vector<LayerDirection> directions_;
  std::vector<char> isKnown_; ///< by point, whether its direction is that of the mesh as it was
};

} // namespace atria
