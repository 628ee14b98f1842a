// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares a mesh with the model it was made of.
#pragma once

#include "Audit/BodyAudit.h"
#include "Audit/ClippedTriangles.h"
#include "Audit/MeshDistances.h"
#include "Dual/Zones/UnreachedParts.h"

namespace atria {

/// The model's and the mesh's areas of one surface, and the elements there. Areas are in square model units.
struct SurfaceAudit
{
  /// Area as drawn, within the domain.
  double drawnArea = 0.0;
  /// Area as drawn, beyond the domain's sides or below its bottom.
  double outside = 0.0;
  /// Area in the model that is meshed, with extended terrain and without faces that another surface keeps.
  double placedArea = 0.0;
  /// Area of the surface's faces in the mesh. Faces with elements on both sides count once.
  double meshArea = 0.0;
  /// Areas of parts that see no air: on or under the ground, in solids, in closed rooms that are not meshed.
  double underGround = 0.0;
  double inSolid = 0.0;
  double inRoom = 0.0;
  /// Area of parts that lie upon others, where one is dropped, and of small parts that the repair left out.
  double shared = 0.0;
  double leftOut = 0.0;
  /// The remaining area, which is finer than the mesh.
  double lost = 0.0;
  /// Elements at the surface, in model units: the mean by area, the largest, and the size that was requested.
  double meanSize = 0.0;
  double largestSize = 0.0;
  double requestedSize = 0.0;
  /// The diagonal of the surface's bounds.
  double extent = 0.0;
  SurfaceDistances distances;

  /// Returns the part of the area that should be in the mesh and is; 1 if none should.
  double coverage() const;
};

/// Volumes in cubic model units.
struct VolumeAudit
{
  double domain = 0.0;
  /// Volume of the elements.
  double air = 0.0;
  /// Returns the rest of the domain: solids, rooms that are not meshed, and the space under the ground.
  double displaced() const { return domain - air; }
  /// The same by the model: the volume enclosed by faces that see air on one side.
  double displacedByModel = 0.0;
};

struct MeshAudit
{
  /// One entry per surface.
  std::vector<SurfaceAudit> surfaces;
  VolumeAudit volumes;
  BodyAudit bodies;
};

/// Returns the areas within the domain of the parts that were left aside, one entry per surface.
std::vector<ViewAreas> areasOf(const UnreachedParts& parts, const SurfaceModel& whole, const GridFrame& frame);

/// Measures a mesh along the grid's axes. Drawn areas and all that follows from them are added by finishAudit().
/// \param seen  Views of all triangles, and samples of the surface or those of this rank.
/// The result depends neither on threads nor on ranks.
MeshAudit auditMesh(const DualMesh& mesh, const SeenModel& seen, const MeshShare& share, const MeshingContext& context);

/// Adds the drawn areas, and the areas that the repair left out or found to be shared.
void finishAudit(const DrawnSurfaces& drawn, const SurfaceRepairReport& repair, MeshAudit& audit);

/// Puts the audit's places along the model's axes.
void placeInModel(MeshAudit& audit, const Placement& placement);

} // namespace atria
