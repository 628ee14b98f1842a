// SPDX-License-Identifier: GPL-3.0-or-later
/// The files of a mesh in a folder constant/polyMesh.
#pragma once

#include "OpenFOAMFile.h"
#include "SolverMesh.h"

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace atria {

/// A patch as it stands in `boundary`.
struct PatchEntry
{
  std::string name;
  std::vector<std::pair<std::string, std::string>> entries; ///< all but nFaces and startFace, in order
  std::size_t firstFace = 0;
  std::size_t faceCount = 0;
  std::string comment = {}; ///< a line of its own before the patch; without one if empty
};

/// Writes one file a call. Names must be valid. All functions throw Error naming a file that cannot be written.
class PolyMeshWriter
{
public:
  /// Faces of `source` are in the order of the files. `source` outlives this object.
  PolyMeshWriter(std::filesystem::path target, const FaceMesh& source, OpenFOAMFormat format,
                 const ProgressRange& progress);

  void writePoints() const;
  void writeFaces() const;
  void writeOwners() const;
  void writeNeighbors() const;
  void writeBoundary(std::span<const PatchEntry> patches) const;
  /// Write no file if there are no zones.
  void writeFaceZones(std::span<const FaceZone> zones) const;
  void writeCellZones(std::span<const CellZone> zones) const;
  /// Writes a list of labels to the file `name`.
  void writeLabelFile(const char* name, std::span<const std::int32_t> labels) const;

private:
  bool binary() const { return format == OpenFOAMFormat::Binary; }
  OpenFOAMFile open(const char* name, const char* className, const std::string& itsNote = {}) const;
  template <typename Zone, typename Write>
  void writeZones(const char* name, std::span<const Zone> zones, Write&& write) const;
  void writeFlips(OpenFOAMFile& file, std::span<const char> flips) const;
  template <typename Label> void writeLabels(OpenFOAMFile& file, std::span<const Label> labels) const;

  std::filesystem::path folder;
  const FaceMesh& mesh;
  OpenFOAMFormat format;
  const ProgressRange& progress;
  std::string note;
};

} // namespace atria
