// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures and names the rooms of a mesh and their openings.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Dual/Mesh/OwnElements.h"
#include "Dual/Zones/Rooms.h"
#include "Mesher/RoomReport.h"
#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// With rooms that are neither measured nor named.
RoomReport reportOf(const Rooms& rooms, const SurfaceModel& model);

/// Measures and names the rooms that the elements of a mesh are in, and their openings, of which the report knows the
/// number of rooms alone. `domain` is around the mesh.
void measureRooms(const DualMesh& mesh, const SurfaceModel& model, const Box3& domain, const OwnElements& part,
                  RoomReport& report);

} // namespace atria
