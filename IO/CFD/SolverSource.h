// SPDX-License-Identifier: GPL-3.0-or-later
/// The patches and zones of a mesh to write, adapted as cells and faces are merged.
#pragma once

#include "Quality/Unions/JudgedUnions.h"
#include "SolverMesh.h"
#include "Support/Buffer.h"
#include "Support/Executor.h"
#include "VtkFaceMesh.h"
#include "ZonedFaces.h"

namespace atria {

/// Zones that a cell array of the mesh numbers. A negative number is no zone.
struct CellLabels
{
  std::vector<std::string> names;
  Buffer<std::int64_t> ofCell;
};

/// Faces have their numbers in the mesh that the source was made of until followUnions() is called.
struct SolverSource
{
  std::vector<BoundaryPatch> patches;
  std::vector<ZonedFaces> faceZones;
  /// Zones by ZoneId, without names. `cellZones` has the kinds of zones with names, one after the other.
  CellLabels zones;
  std::vector<CellLabels> cellZones;
  /// The part of each cell if cells are written in parts; else empty. A union is in the part of its last cell.
  Buffer<std::int64_t> partOf;
};

/// Returns the patches and zones of a mesh. Zones with names are rooms (cell array RoomId, field array RoomName) and
/// cell zones (CellZoneId and CellZoneName).
SolverSource solverSourceOf(vtkUnstructuredGrid* volume, const VtkFaceMesh& faces, const Executor& executor);

/// Returns the number of the patch for each boundary face, or noIndex.
std::vector<Index> patchOfFaces(const SolverSource& source, const FaceMesh& mesh);

/// Returns the number of the face zone for each internal face. Faces where zones of cells meet have a further number.
/// Returns an empty list if there are no zones.
std::vector<Index> zoneOfFaces(const SolverSource& source, const FaceMesh& mesh, const Executor& executor);

/// Changes the faces and cells of patches and zones to those that are written.
void followUnions(SolverSource& source, const JudgedMesh& written);

/// Returns the mesh for solvers, made of the faces that are written.
SolverMesh solverMeshFrom(SolverSource source, FaceMesh mesh, const Executor& executor);

} // namespace atria
