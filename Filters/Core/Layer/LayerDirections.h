// SPDX-License-Identifier: GPL-3.0-or-later
/// Directions in which a layer grows from the points of walls.
#pragma once

#include "Layer/LayerWalls.h"

namespace atria {

/// Constraints on the direction at a point. All are unit vectors.
struct DirectionProblem
{
  /// Normals of the walls around the point, into the fluid.
  std::vector<Vec3> walls;
  /// Normals of sheets that have a boundary edge there: the layer tapers to it, in the plane of the sheet.
  std::vector<Vec3> sheets;
  /// Directions out of those sheets across their boundary edges.
  std::vector<Vec3> ways;
  /// Planes of the domain's sides the point must stay in.
  std::vector<Vec3> sides;
};

/// A copy is not made if the cosine of its direction to a wall's normal is below this. The layer then tapers to nothing
/// at boundary edges, where the cosine is 0: a prism wrapped around them would have two faces in the plane of the
/// sheet. A direction with a smaller cosine to a wall does not lift the prism off that wall.
inline constexpr double feasibleCosine = 0.1;

/// Sheets at a boundary edge point are one plane if their normals spread by less than this share of their squares (37
/// degrees between two).
inline constexpr double sheetSpread = 0.1;

struct LayerDirection
{
  /// Unit vector, or zero if there is none in the required planes.
  Vec3 direction = Vec3::Zero();
  /// Smallest cosine to a wall's normal.
  double cosine = -1.0;
};

/// Returns the direction in the planes of sides and boundary edge sheets that is farthest inside all half spaces of
/// walls and ways. It is the point of their convex hull that is nearest to the origin (best of single vectors, pairs
/// and triples, which is exact if some direction is inside all of them). Sheets themselves do not count, as they lie
/// along it.
LayerDirection solveDirection(const DirectionProblem& problem);

/// Directions at the points of one mesh while these move. Directions are kept where nothing moved.
class LayerDirections
{
public:
  /// Both must outlive this.
  LayerDirections(const LayerWalls& walls, const LayerOptions& options) : walls_(walls), options_(options) {}

  /// Finds directions at the points with a count; known ones are found anew only around points that moved since the
  /// last call. There is no direction where faces of the domain's sides are off their planes. A wall face with two
  /// edges on a crease would give a prism with two faces in one plane: directions lean away from that face if they stay
  /// off all walls.
  void update(const DualMesh& mesh, const std::vector<Index>& counts, const RunContext& context);

  /// Returns the direction at a point that had a count.
  const LayerDirection& at(Index point) const { return directions_[point]; }
  /// Returns the area vector of a boundary face, into the fluid.
  const Vec3& normal(Index face) const { return normals_[face]; }

private:
  void forgetMoved(const DualMesh& mesh, const RunContext& context);
  bool liesInSides(const DualMesh& mesh, Index point) const;
  DirectionProblem problemAt(const DualMesh& mesh, Index point) const;
  Vec3 wayFromStraight(const DualMesh& mesh, Index point) const;
  LayerDirection find(const DualMesh& mesh, Index point) const;

  const LayerWalls& walls_;
  const LayerOptions& options_;
  std::vector<Vec3> points_; ///< positions at the last update
  std::vector<Vec3> normals_;
  std::vector<LayerDirection> directions_;
  std::vector<char> isKnown_; ///< one entry per point: 1 if its direction fits the mesh at the last update
};

} // namespace atria
