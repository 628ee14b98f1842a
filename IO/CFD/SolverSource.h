// SPDX-License-Identifier: GPL-3.0-or-later
/// The patches and zones of a mesh that a writer has to write; they follow where cells and faces are merged.
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

/// Faces are numbered as in the mesh that the source was made of until followUnions().
struct SolverSource
{
  std::vector<BoundaryPatch> patches;
  std::vector<ZonedFaces> faceZones;
  /// By ZoneId, without names; and those that have names, one after the other.
  CellLabels zones;
  std::vector<CellLabels> cellZones;
  /// Of each cell, where they are to be written in parts; else empty. A union is in the part of its last cell.
  Buffer<std::int64_t> partOf;
};

/// Of a mesh and its faces. Named are rooms, by the cell array RoomId and the field array RoomName, and cell zones, by
/// CellZoneId and CellZoneName.
SolverSource solverSourceOf(vtkUnstructuredGrid* volume, const VtkFaceMesh& faces, const Executor& executor);

/// By boundary face the number of its patch, or noIndex.
std::vector<Index> patchOfFaces(const SolverSource& source, const FaceMesh& mesh);

/// By internal face the number of its face zone; a number of their own where zones of cells meet. Empty without any.
std::vector<Index> zoneOfFaces(const SolverSource& source, const FaceMesh& mesh, const Executor& executor);

/// Patches and zones by the faces and cells that are written.
void followUnions(SolverSource& source, const JudgedMesh& written);

/// The mesh for solvers, of the faces that are written.
SolverMesh solverMeshFrom(SolverSource source, FaceMesh mesh, const Executor& executor);

} // namespace atria
