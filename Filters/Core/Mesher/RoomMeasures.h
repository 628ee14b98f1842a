// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures and names the rooms of a mesh and their openings.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Dual/Mesh/OwnElements.h"
#include "Dual/Zones/Rooms.h"
#include "Mesher/RoomReport.h"
#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// Returns a report whose rooms are neither measured nor named.
RoomReport reportOf(const Rooms& rooms, const SurfaceModel& model);

/// Measures and names the rooms that the elements of a mesh are in, and their openings. The report has only the number
/// of rooms before. `domain` is around the mesh.
void measureRooms(const DualMesh& mesh, const SurfaceModel& model, const Box3& domain, const OwnElements& part,
                  RoomReport& report);

} // namespace atria
