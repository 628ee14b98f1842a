// SPDX-License-Identifier: GPL-3.0-or-later
/// A mesh of OpenFOAM divided among processors, as its decomposePar does.
#pragma once

#include "OpenFOAMFile.h"
#include "PolyMesh.h"
#include "PolyMeshWriter.h"
#include "Support/RunContext.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace atria {

/// Returns the part of each cell, 0 to parts - 1. Sizes of parts differ by a few cells, and few faces lie between
/// parts. The result does not depend on the number of threads. Throws Error if there are more parts than cells.
std::vector<Index> partitionCells(const FaceMesh& mesh, std::size_t parts);

/// One processor's part. Cells, points and faces keep their order; faces shared with other processors follow all
/// others, in a patch for each other processor, by its number, and in the same order on both sides.
struct ProcessorMesh
{
  FaceMesh mesh; ///< faces in the order of the files
  std::vector<PatchEntry> patches;
  std::vector<FaceZone> faceZones; ///< all of the whole mesh, some of them empty
  std::vector<CellZone> cellZones; ///< the same
  // Numbers in the whole mesh. All are empty if the whole mesh has more entries than a 32-bit label can number.
  std::vector<std::int32_t> cells;
  std::vector<std::int32_t> points;
  std::vector<std::int32_t> faces;     ///< counted from 1; negative where the face is turned around
  std::vector<std::int32_t> ofPatches; ///< patches of the whole mesh; -1 for those between processors
};

/// Makes the mesh of a processor, of any number of them at the same time.
using ProcessorMeshes = std::function<ProcessorMesh(std::size_t)>;

/// Returns a function that makes the mesh of each part. `partOf` has the part of each cell; it and `poly` outlive the
/// result. Throws Error for a patch of a cyclic type, unless it is a
/// side of a divided zone and both are in one part, face by face.
ProcessorMeshes decompose(const PolyMesh& poly, std::span<const Index> partOf, std::size_t parts);

/// Puts the cells on both sides of divided zones into one part.
void keepPairsTogether(const PolyMesh& poly, std::vector<Index>& partOf);

/// Writes all files of a mesh into its folder constant/polyMesh.
void writePolyMesh(const std::filesystem::path& caseFolder, const PolyMesh& poly, OpenFOAMFormat format,
                   const ProgressRange& progress);

/// Returns the patch of a processor's faces that another processor shares.
PatchEntry processorPatch(std::size_t part, std::size_t other);

/// Writes processor<part>/constant/polyMesh into a folder. Also writes cellProcAddressing and so on, unless the numbers
/// in the whole mesh are unknown.
void writeProcessor(const std::filesystem::path& folder, std::size_t part, const ProcessorMesh& mesh,
                    OpenFOAMFormat format, const ProgressRange& progress);

/// Returns the size of the mesh along the axes.
Vec3 sizeOf(const FaceMesh& mesh);

/// Writes processor<i>/constant/polyMesh for each part of the case's mesh, with cellProcAddressing and so on, and
/// system/decomposeParDict. All existing processor folders are replaced, once all is written. Throws Error as the
/// functions above do.
void writeProcessors(const std::filesystem::path& caseFolder, const PolyMesh& poly, std::size_t parts,
                     OpenFOAMFormat format, const RunContext& context);

} // namespace atria
