// SPDX-License-Identifier: GPL-3.0-or-later
/// A volume mesh in the form that solvers' formats share.
#pragma once

#include "MeshZones.h"
#include "PatchNames.h"
#include "Quality/Faces/Geometry.h"
#include "Support/Executor.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace atria {

struct VtkFaceMesh;

/// Boundary faces under one name.
struct BoundaryPatch
{
  std::string name;
  std::vector<Index> faces;
};

/// Returns the patches that came with a mesh.
std::vector<BoundaryPatch> boundaryPatchesOf(const VtkFaceMesh& source);

/// Consecutive boundary faces under one name.
struct SolverPatch
{
  enum Kind
  {
    Wall,
    DomainSide, ///< named xMin … zMax, domainSide1 …
    Unclaimed   ///< faces in no patch, `defaultFaces`
  };
  std::string name; ///< as the input has it
  Kind kind = Wall;
  std::size_t firstFace = 0;
  std::size_t faceCount = 0;

  bool isWall() const { return kind == Wall; }
};

/// Return a patch of that name, and the patch for faces in none. Both have no faces yet.
SolverPatch solverPatch(const std::string& name);
SolverPatch unclaimedPatch();

/// Returns the name of the zone with that number.
std::string zoneName(std::int64_t id);

struct SolverMesh
{
  /// Boundary faces come patch by patch, and by owner within a patch. All points have faces.
  FaceMesh mesh;
  /// Patches that cover the whole boundary. Boundary faces in no patch are the last one.
  std::vector<SolverPatch> patches;
  /// New number of each point of the input; empty if no point was left out.
  std::vector<Index> newPoint;
  /// Faces, and cells below, are in ascending order.
  std::vector<FaceZone> faceZones;
  /// Rooms and cell zones by name; a cell may be in one room and one cell zone. Without any, zones are made of ZoneId,
  /// as zone0, zone1 …, if there is more than one.
  std::vector<CellZone> cellZones;
  /// The part of each cell if cells are written in parts; else empty.
  std::vector<Index> partOf;
};

/// Makes the mesh for solvers. `zoneIds` has one entry for each cell, or none. Throws Error for faces in patches that
/// are not on the boundary or in two patches, and for another number of zone ids.
SolverMesh makeSolverMesh(FaceMesh mesh, std::span<const BoundaryPatch> patches, std::span<const std::int64_t> zoneIds,
                          const Executor& executor);

/// Returns names of the patches, then of `others`; all are unique. `defaultFaces` keeps its name if there are others
/// like it.
std::vector<PatchName> namesOf(std::span<const SolverPatch> patches, const NameRules& rules,
                               std::span<const std::string> others = {});

/// Returns the number of boundary faces with the same points as another one, such as both sides of a sheet one face
/// wide.
std::size_t facesWithCommonPoints(const FaceMesh& mesh);

} // namespace atria
