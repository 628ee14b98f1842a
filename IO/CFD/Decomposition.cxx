// SPDX-License-Identifier: GPL-3.0-or-later
#include "Decomposition.h"

#include "OutputFolders.h"
#include "ProcessorFolders.h"
#include "Support/Error.h"
#include "ZoneSides.h"

#include <metis.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <tuple>

namespace atria {

namespace {

namespace fs = std::filesystem;
using Label = std::int32_t;

/// Faces of all parts: numbers in the whole mesh from 1 on, negative where the part is the neighbor's.
struct PartFaces
{
  std::vector<Label> faces;
  std::size_t internal = 0;
  std::vector<std::size_t> ofPatch;           ///< number in each patch of the whole mesh
  std::map<Index, std::vector<Label>> shared; ///< keyed by the other part
};

/// Returns the faces of the whole mesh in the order of its files.
std::vector<Index> facesInFile(const PolyMesh& poly)
{
  std::vector<Index> faces(poly.mesh.internalFaceCount());
  std::iota(faces.begin(), faces.end(), 0);
  for (const PolyPatch& patch : poly.patches)
  {
    faces.insert(faces.end(), patch.faces.begin(), patch.faces.end());
  }
  return faces;
}

std::vector<PartFaces> distributeFaces(const PolyMesh& poly, std::span<const Index> partOf, std::size_t parts)
{
  std::vector<PartFaces> out(parts);
  const FaceMesh& mesh = poly.mesh;
  Label label = 0;
  for (std::size_t f = 0; f < mesh.internalFaceCount(); ++f)
  {
    ++label;
    const Index own = partOf[mesh.owner[f]];
    const Index other = partOf[mesh.neighbor[f]];
    if (own == other)
    {
      out[own].faces.push_back(label);
    }
    else
    {
      out[own].shared[other].push_back(label);
      out[other].shared[own].push_back(-label);
    }
  }
  for (PartFaces& part : out)
  {
    part.internal = part.faces.size();
    part.ofPatch.resize(poly.patches.size());
  }
  for (std::size_t p = 0; p < poly.patches.size(); ++p)
  {
    for (const Index face : poly.patches[p].faces)
    {
      PartFaces& part = out[partOf[mesh.owner[face]]];
      part.faces.push_back(++label);
      ++part.ofPatch[p];
    }
  }
  for (PartFaces& part : out)
  {
    for (const auto& [other, faces] : part.shared)
    {
      part.faces.insert(part.faces.end(), faces.begin(), faces.end());
    }
  }
  return out;
}

/// The zones that members are in, sorted: member, zone, flip.
using Members = std::vector<std::tuple<Index, std::size_t, char>>;

std::span<const Members::value_type> zonesOf(const Members& members, Index member)
{
  const auto memberOf = [](const auto& entry) { return std::get<0>(entry); };
  // Clang 14 cannot compile std::ranges::equal_range of this library.
  return {std::ranges::lower_bound(members, member, {}, memberOf),
          std::ranges::upper_bound(members, member, {}, memberOf)};
}

class PartMaker
{
public:
  PartMaker(const PolyMesh& whole, std::span<const Index> partOfCells, std::size_t parts)
      : poly(whole), partOf(partOfCells), inFile(facesInFile(whole)), faces(distributeFaces(whole, partOfCells, parts)),
        cells(parts), localCell(whole.mesh.cellCount)
  {
    for (Index cell = 0; cell < localCell.size(); ++cell)
    {
      std::vector<Label>& own = cells[partOf[cell]];
      localCell[cell] = static_cast<Index>(own.size());
      own.push_back(static_cast<Label>(cell));
    }
    for (std::size_t z = 0; z < poly.faceZones.size(); ++z)
    {
      const FaceZone& zone = poly.faceZones[z];
      for (std::size_t i = 0; i < zone.faces.size(); ++i)
      {
        zoneFaces.emplace_back(zone.faces[i], z, zone.flips[i]);
      }
    }
    for (std::size_t z = 0; z < poly.cellZones.size(); ++z)
    {
      for (const Index cell : poly.cellZones[z].cells)
      {
        zoneCells.emplace_back(cell, z, 0);
      }
    }
    std::sort(zoneFaces.begin(), zoneFaces.end());
    std::sort(zoneCells.begin(), zoneCells.end());
  }

  ProcessorMesh make(std::size_t part) const
  {
    ProcessorMesh out;
    out.cells = cells[part];
    out.faces = faces[part].faces;
    addPoints(out);
    addFaces(faces[part], out);
    addPatches(part, out);
    addZones(out);
    return out;
  }

private:
  Index wholeFace(Label face) const { return inFile[static_cast<std::size_t>(std::abs(face) - 1)]; }

  void addPoints(ProcessorMesh& out) const
  {
    for (const Label face : out.faces)
    {
      const auto corners = poly.mesh.face(wholeFace(face));
      out.points.insert(out.points.end(), corners.begin(), corners.end());
    }
    std::sort(out.points.begin(), out.points.end());
    out.points.erase(std::unique(out.points.begin(), out.points.end()), out.points.end());
    for (const Label point : out.points)
    {
      out.mesh.points.push_back(poly.mesh.points[static_cast<std::size_t>(point)]);
    }
  }

  void addFaces(const PartFaces& part, ProcessorMesh& out) const
  {
    const FaceMesh& whole = poly.mesh;
    const auto addPoint = [&](Index point) {
      const auto at = std::lower_bound(out.points.begin(), out.points.end(), static_cast<Label>(point));
      out.mesh.facePoints.push_back(static_cast<Index>(at - out.points.begin()));
    };
    for (std::size_t i = 0; i < out.faces.size(); ++i)
    {
      const Index f = wholeFace(out.faces[i]);
      const bool isTurned = out.faces[i] < 0;
      const auto corners = whole.face(f);
      for (std::size_t c = 0; c < corners.size(); ++c) // turned around, the first stays the first
      {
        addPoint(corners[isTurned && c > 0 ? corners.size() - c : c]);
      }
      out.mesh.faceOffsets.push_back(static_cast<Index>(out.mesh.facePoints.size()));
      out.mesh.owner.push_back(localCell[isTurned ? whole.neighbor[f] : whole.owner[f]]);
      if (i < part.internal)
      {
        out.mesh.neighbor.push_back(localCell[whole.neighbor[f]]);
      }
    }
    out.mesh.cellCount = out.cells.size();
  }

  void addPatches(std::size_t part, ProcessorMesh& out) const
  {
    std::size_t next = faces[part].internal;
    const auto add = [&](const std::string& name, std::size_t count, Label number) -> PatchEntry& {
      out.patches.push_back({name, {}, next, count});
      out.ofPatches.push_back(number);
      next += count;
      return out.patches.back();
    };
    for (std::size_t p = 0; p < poly.patches.size(); ++p)
    {
      const PolyPatch& patch = poly.patches[p];
      PatchEntry& entry = add(patch.name, faces[part].ofPatch[p], static_cast<Label>(p));
      entry.entries.emplace_back("type", patch.type);
      entry.entries.insert(entry.entries.end(), patch.others.begin(), patch.others.end());
    }
    for (const auto& [other, shared] : faces[part].shared)
    {
      const PatchEntry entry = processorPatch(part, other);
      add(entry.name, shared.size(), -1).entries = entry.entries;
    }
  }

  void addZones(ProcessorMesh& out) const
  {
    for (const FaceZone& zone : poly.faceZones)
    {
      out.faceZones.push_back({zone.name, {}, {}});
    }
    for (const CellZone& zone : poly.cellZones)
    {
      out.cellZones.push_back({zone.name, {}});
    }
    for (std::size_t i = 0; i < out.faces.size() && !zoneFaces.empty(); ++i)
    {
      for (const auto& [face, zone, flip] : zonesOf(zoneFaces, wholeFace(out.faces[i])))
      {
        out.faceZones[zone].faces.push_back(static_cast<Index>(i));
        out.faceZones[zone].flips.push_back((flip != 0) != (out.faces[i] < 0) ? 1 : 0);
      }
    }
    for (std::size_t i = 0; i < out.cells.size() && !zoneCells.empty(); ++i)
    {
      for (const auto& [cell, zone, unused] : zonesOf(zoneCells, static_cast<Index>(out.cells[i])))
      {
        out.cellZones[zone].cells.push_back(static_cast<Index>(i));
      }
    }
  }

  const PolyMesh& poly;
  std::span<const Index> partOf;
  std::vector<Index> inFile;
  std::vector<PartFaces> faces;
  std::vector<std::vector<Label>> cells;
  std::vector<Index> localCell;
  Members zoneFaces, zoneCells;
};

/// Returns the patches of divided zones both of which are in one part, face by face.
std::set<std::string> undividedPatches(const PolyMesh& poly, std::span<const Index> partOf)
{
  std::set<std::string> names;
  const auto partOfFace = [&](Index face) { return partOf[poly.mesh.owner[face]]; };
  for (const auto& [first, second] : pairsOfSides(poly))
  {
    const PolyPatch& one = poly.patches[first];
    const PolyPatch& other = poly.patches[second];
    if (std::ranges::equal(one.faces, other.faces, {}, partOfFace, partOfFace))
    {
      names.insert({one.name, other.name});
    }
  }
  return names;
}

/// Returns the patches of all divided zones.
std::vector<std::string> pairedPatches(const PolyMesh& poly)
{
  std::vector<std::string> names;
  for (const auto& [first, second] : pairsOfSides(poly))
  {
    names.push_back(poly.patches[first].name);
    names.push_back(poly.patches[second].name);
  }
  return names;
}

void writeFiles(const fs::path& target, const ProcessorMesh& mesh, OpenFOAMFormat format, const ProgressRange& progress)
{
  const PolyMeshWriter writer(target, mesh.mesh, format, progress);
  writer.writePoints();
  writer.writeFaces();
  writer.writeOwners();
  writer.writeNeighbors();
  writer.writeBoundary(mesh.patches);
  writer.writeFaceZones(mesh.faceZones);
  writer.writeCellZones(mesh.cellZones);
}

} // namespace

std::vector<Index> partitionCells(const FaceMesh& mesh, std::size_t parts)
{
  if (parts > mesh.cellCount)
  {
    throw Error("a mesh of " + std::to_string(mesh.cellCount) + " cells cannot be divided among " +
                std::to_string(parts) + " processors");
  }
  std::vector<Index> partOf(mesh.cellCount, 0);
  if (parts == 1)
  {
    return partOf;
  }
  // The neighbors of each cell, as METIS takes them.
  std::vector<idx_t> offsets(mesh.cellCount + 1, 0);
  for (std::size_t f = 0; f < mesh.internalFaceCount(); ++f)
  {
    ++offsets[mesh.owner[f] + 1];
    ++offsets[mesh.neighbor[f] + 1];
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<idx_t> neighbors(static_cast<std::size_t>(offsets.back()));
  std::vector<idx_t> next(offsets.begin(), offsets.end() - 1);
  for (std::size_t f = 0; f < mesh.internalFaceCount(); ++f)
  {
    neighbors[static_cast<std::size_t>(next[mesh.owner[f]]++)] = static_cast<idx_t>(mesh.neighbor[f]);
    neighbors[static_cast<std::size_t>(next[mesh.neighbor[f]]++)] = static_cast<idx_t>(mesh.owner[f]);
  }
  auto cells = static_cast<idx_t>(mesh.cellCount);
  idx_t weights = 1;
  auto count = static_cast<idx_t>(parts);
  idx_t cut = 0;
  std::vector<idx_t> found(mesh.cellCount);
  const int status = METIS_PartGraphRecursive(&cells, &weights, offsets.data(), neighbors.data(), nullptr, nullptr,
                                              nullptr, &count, nullptr, nullptr, nullptr, &cut, found.data());
  if (status != METIS_OK)
  {
    throw Error("METIS cannot divide the mesh among " + std::to_string(parts) + " processors: " +
                (status == METIS_ERROR_MEMORY ? "not enough memory" : "status " + std::to_string(status)));
  }
  std::transform(found.begin(), found.end(), partOf.begin(), [](idx_t part) { return static_cast<Index>(part); });
  return partOf;
}

void keepPairsTogether(const PolyMesh& poly, std::vector<Index>& partOf)
{
  const auto pairs = pairsOfSides(poly);
  for (bool isChanged = true; isChanged;) // a cell may be beside several pairs
  {
    isChanged = false;
    for (const auto& [first, second] : pairs)
    {
      for (std::size_t i = 0; i < poly.patches[first].faces.size(); ++i)
      {
        Index& one = partOf[poly.mesh.owner[poly.patches[first].faces[i]]];
        Index& other = partOf[poly.mesh.owner[poly.patches[second].faces[i]]];
        isChanged = isChanged || one != other;
        one = other = std::min(one, other);
      }
    }
  }
}

ProcessorMeshes decompose(const PolyMesh& poly, std::span<const Index> partOf, std::size_t parts)
{
  const std::set<std::string> whole = undividedPatches(poly, partOf);
  for (const PolyPatch& patch : poly.patches)
  {
    if (patch.type.starts_with("cyclic") && !whole.contains(patch.name))
    {
      throw Error("patch '" + patch.name + "' is of type " + patch.type +
                  ", whose halves only OpenFOAM's decomposePar divides: write the case for one processor and run that");
    }
  }
  const auto maker = std::make_shared<const PartMaker>(poly, partOf, parts);
  return [maker](std::size_t part) { return maker->make(part); };
}

void writePolyMesh(const fs::path& caseFolder, const PolyMesh& poly, OpenFOAMFormat format,
                   const ProgressRange& progress)
{
  const std::vector<Index> partOf(poly.mesh.cellCount, 0);
  const fs::path target = caseFolder / "constant" / "polyMesh";
  for (const char* zones : {"faceZones", "cellZones"}) // without zones there is no file
  {
    fs::remove(target / zones);
  }
  writeFiles(target, decompose(poly, partOf, 1)(0), format, progress);
}

PatchEntry processorPatch(std::size_t part, std::size_t other)
{
  const std::string own = std::to_string(part);
  const std::string to = std::to_string(other);
  return {std::string("procBoundary").append(own).append("to").append(to),
          {{"type", "processor"},
           {"inGroups", "1(processor)"},
           {"matchTolerance", "0.0001"},
           {"transform", "unknown"},
           {"myProcNo", own},
           {"neighbProcNo", to}}};
}

void writeProcessor(const fs::path& folder, std::size_t part, const ProcessorMesh& mesh, OpenFOAMFormat format,
                    const ProgressRange& progress)
{
  const fs::path target = folder / ("processor" + std::to_string(part)) / "constant" / "polyMesh";
  makeFolder(target);
  writeFiles(target, mesh, format, progress);
  if (mesh.cells.empty())
  {
    return;
  }
  const PolyMeshWriter writer(target, mesh.mesh, format, progress);
  writer.writeLabelFile("cellProcAddressing", mesh.cells);
  writer.writeLabelFile("faceProcAddressing", mesh.faces);
  writer.writeLabelFile("pointProcAddressing", mesh.points);
  writer.writeLabelFile("boundaryProcAddressing", mesh.ofPatches);
}

Vec3 sizeOf(const FaceMesh& mesh)
{
  Box3 bounds;
  std::ranges::for_each(mesh.points, [&](const Vec3& point) { bounds.extend(point); });
  return bounds.size();
}

void writeProcessors(const fs::path& caseFolder, const PolyMesh& poly, std::size_t parts, OpenFOAMFormat format,
                     const RunContext& context)
{
  context.progress.report(0.0, "Dividing the mesh among processors");
  std::vector<Index> partOf = partitionCells(poly.mesh, parts);
  keepPairsTogether(poly, partOf);
  const ProcessorMeshes meshes = decompose(poly, partOf, parts);
  context.progress.report(0.4, "Writing the processors' meshes");
  const UnfinishedFolder unfinished(unfinishedProcessors(caseFolder));
  context.executor.forEach(parts, 1, [&](std::size_t part) {
    writeProcessor(unfinished.path, part, meshes(part), format, context.progress);
  });
  placeProcessors(caseFolder, parts, sizeOf(poly.mesh), pairedPatches(poly));
  context.progress.report(1.0, "Processors' meshes written");
}

} // namespace atria
