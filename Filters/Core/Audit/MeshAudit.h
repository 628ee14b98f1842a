// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares a mesh with the model it was made of.
#pragma once

#include "Audit/AuditResult.h"
#include "Audit/BodyAudit.h"
#include "Audit/ClippedTriangles.h"
#include "Audit/MeshDistances.h"
#include "Dual/Zones/UnreachedParts.h"

namespace atria {

/// Returns the areas within the domain of the parts that were left aside, one entry per surface.
std::vector<ViewAreas> areasOf(const UnreachedParts& parts, const SurfaceModel& whole, const GridFrame& frame);

/// Measures a mesh along the grid's axes. Drawn areas and all that follows from them are added by finishAudit().
/// \param seen  Views of all triangles, and the samples of surfaces that this process took.
/// The result does not depend on threads.
MeshAudit auditMesh(const DualMesh& mesh, const SeenModel& seen, const OwnElements& part,
                    const MeshingContext& context);

/// Adds the drawn areas, and the areas that the repair left out or found to be shared.
void finishAudit(const DrawnSurfaces& drawn, const SurfaceRepairReport& repair, MeshAudit& audit);

/// Puts the audit's places along the model's axes.
void placeInModel(MeshAudit& audit, const Placement& placement);

} // namespace atria
