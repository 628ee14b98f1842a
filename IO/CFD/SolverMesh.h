// SPDX-License-Identifier: GPL-3.0-or-later
/// A volume mesh as formats of solvers take it, and what they share.
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

/// Some of a mesh's boundary faces under one name.
struct BoundaryPatch
{
  std::string name;
  std::vector<Index> faces;
};

/// Those that came with a mesh.
std::vector<BoundaryPatch> boundaryPatchesOf(const VtkFaceMesh& source);

/// Boundary faces that follow each other.
struct SolverPatch
{
  enum Kind
  {
    Wall,
    DomainSide, ///< by its name: xMin … zMax, domainSide1 …
    Unclaimed   ///< those in no patch, `defaultFaces`
  };
  std::string name; ///< as the input has it
  Kind kind = Wall;
  std::size_t firstFace = 0;
  std::size_t faceCount = 0;

  bool isWall() const { return kind == Wall; }
};

/// Of that name, without faces; and the one of those in no patch.
SolverPatch solverPatch(const std::string& name);
SolverPatch unclaimedPatch();

/// What a zone of that number is called.
std::string zoneName(std::int64_t id);

struct SolverMesh
{
  /// Boundary faces come patch by patch, in each by owner. All points have faces.
  FaceMesh mesh;
  /// All of the boundary. Boundary faces in no patch are the last one.
  std::vector<SolverPatch> patches;
  /// Of each point there was the number it has now; empty where none was left out.
  std::vector<Index> newPoint;
  /// Faces, and cells below, are rising.
  std::vector<FaceZone> faceZones;
  /// Rooms and cell zones by name, of which a cell may be in one of each. Where there are none, cells by ZoneId, as
  /// zone0, zone1 …, if there is more than one.
  std::vector<CellZone> cellZones;
  /// Of each cell, where they are to be written in parts; else empty.
  std::vector<Index> partOf;
};

/// `zoneIds` has one for each cell, or none. Throws Error for faces in patches that are not on the boundary or in two
/// patches, and for another number of zone ids.
SolverMesh makeSolverMesh(FaceMesh mesh, std::span<const BoundaryPatch> patches, std::span<const std::int64_t> zoneIds,
                          const Executor& executor);

/// Of each patch, and then of `others` that must not have the same. `defaultFaces` is the one to keep its name.
std::vector<PatchName> namesOf(std::span<const SolverPatch> patches, const NameRules& rules,
                               std::span<const std::string> others = {});

} // namespace atria
