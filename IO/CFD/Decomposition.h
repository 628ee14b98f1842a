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

/// The part of each cell, 0 to parts - 1. Parts have as many cells within a few, and few faces between them. The same
/// for any number of threads. Throws Error for more parts than cells.
std::vector<Index> partitionCells(const FaceMesh& mesh, std::size_t parts);

/// One processor's part. Cells, points and faces keep their order; faces shared with other processors follow all
/// others, in a patch for each other processor, by its number, and in the same order on both sides.
struct ProcessorMesh
{
  FaceMesh mesh; ///< faces in the order of the files
  std::vector<PatchEntry> patches;
  std::vector<FaceZone> faceZones; ///< all of the whole mesh, some of them empty
  std::vector<CellZone> cellZones; ///< the same
  // What belongs to what in the whole mesh; empty where that has more than a label of 32 bits can tell.
  std::vector<std::int32_t> cells;
  std::vector<std::int32_t> points;
  std::vector<std::int32_t> faces;     ///< counted from 1; negative where the face is turned around
  std::vector<std::int32_t> ofPatches; ///< -1 of those between processors
};

/// Makes the mesh of a processor, of any number of them at the same time.
using ProcessorMeshes = std::function<ProcessorMesh(std::size_t)>;

/// `partOf` has the part of each cell; it and `poly` outlive what is returned. Throws Error for a patch of a cyclic
/// type.
ProcessorMeshes decompose(const PolyMesh& poly, std::span<const Index> partOf, std::size_t parts);

/// The patch of a processor's faces that another one has, too.
PatchEntry processorPatch(std::size_t part, std::size_t other);

/// Writes processor<part>/constant/polyMesh into a folder, with cellProcAddressing and so on, unless there are no
/// numbers of a whole.
void writeProcessor(const std::filesystem::path& folder, std::size_t part, const ProcessorMesh& mesh,
                    OpenFOAMFormat format, const ProgressRange& progress);

/// Along the axes.
Vec3 sizeOf(const FaceMesh& mesh);

/// Where the folders of processors stand until all are complete: a hidden one in the case's.
std::filesystem::path unfinishedProcessors(const std::filesystem::path& caseFolder);

/// Puts the complete folders in place of all processor folders there are, and writes system/decomposeParDict for a mesh
/// of that size. Throws Error as refuseProcessorResults() does.
void placeProcessors(const std::filesystem::path& caseFolder, std::size_t parts, const Vec3& size);

/// Throws Error where the case has processor folders with more than a mesh and the folder 0: results of a run.
void refuseProcessorResults(const std::filesystem::path& caseFolder);

/// With all that is in them.
void removeProcessors(const std::filesystem::path& caseFolder);

/// Writes system/decomposeParDict, which OpenFOAM's parallel runs ask for: parts with as many cells each, in a grid
/// over the ground that is as square as their number allows. `size` is that of the mesh along the axes.
void writeDecomposition(const std::filesystem::path& caseFolder, std::size_t parts, const Vec3& size);

/// Writes processor<i>/constant/polyMesh for each part of the case's mesh, with cellProcAddressing and so on, in place
/// of all processor folders there are, and system/decomposeParDict. Nothing is replaced until all is written. Throws
/// Error as the above do.
void writeProcessors(const std::filesystem::path& caseFolder, const PolyMesh& poly, std::size_t parts,
                     OpenFOAMFormat format, const RunContext& context);

} // namespace atria
