// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares a mesh with the model it was made of.
#pragma once

#include "Audit/BodyAudit.h"
#include "Audit/ClippedTriangles.h"
#include "Audit/MeshDistances.h"
#include "Dual/Zones/UnreachedParts.h"

namespace atria {

/// What became of one surface. Areas in square model units.
struct SurfaceAudit
{
  /// As drawn, within the domain.
  double drawnArea = 0.0;
  /// As drawn, beyond the domain's sides or below its bottom.
  double outside = 0.0;
  /// Of the model that is meshed: with terrain that was extended, without what another surface has.
  double placedArea = 0.0;
  /// Of the surface's faces; what has elements on both of its sides counts once.
  double meshArea = 0.0;
  /// Of parts that see no air: on or under the ground, in solids, in closed rooms that are not meshed.
  double underGround = 0.0;
  double inSolid = 0.0;
  double inRoom = 0.0;
  /// Of parts that lie upon others, where one is dropped; of small parts that it left out.
  double shared = 0.0;
  double leftOut = 0.0;
  /// The rest: finer than the mesh.
  double lost = 0.0;
  /// Elements at the surface, in model units: the mean by area, the largest, and the size that was requested.
  double meanSize = 0.0;
  double largestSize = 0.0;
  double requestedSize = 0.0;
  /// The diagonal of the surface's bounds.
  double extent = 0.0;
  SurfaceDistances distances;

  /// Of the area that should be in the mesh; 1 where there is none.
  double coverage() const;
};

/// In cubic model units.
struct VolumeAudit
{
  double domain = 0.0;
  /// Of the elements.
  double air = 0.0;
  /// The rest of the domain: solids, rooms that are not meshed, and what is under the ground.
  double displaced() const { return domain - air; }
  /// The same by the model: enclosed by what sees air on one side.
  double displacedByModel = 0.0;
};

struct MeshAudit
{
  /// By surface.
  std::vector<SurfaceAudit> surfaces;
  VolumeAudit volumes;
  BodyAudit bodies;
};

/// Returns the areas, by surface and within the domain, of what was left aside of a model.
std::vector<ViewAreas> areasOf(const UnreachedParts& parts, const SurfaceModel& whole, const GridFrame& frame);

/// Measures a mesh along the grid's axes: all but the drawn areas and what follows from them, for which see
/// finishAudit().
/// \param seen  Views of all triangles, and samples of the surface or of what a rank has of it.
/// The result depends neither on threads nor on ranks.
MeshAudit auditMesh(const DualMesh& mesh, const SeenModel& seen, const MeshShare& share, const MeshingContext& context);

/// Adds what was drawn, and what the repair did with it.
void finishAudit(const DrawnSurfaces& drawn, const SurfaceRepairReport& repair, MeshAudit& audit);

/// Puts the audit's places along the model's axes.
void placeInModel(MeshAudit& audit, const Placement& placement);

} // namespace atria
