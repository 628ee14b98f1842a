// SPDX-License-Identifier: GPL-3.0-or-later
#include "OpenFOAMCase.h"

#include "CaseFolders.h"
#include "OpenFOAMNames.h"
#include "Support/Error.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <functional>
#include <limits>
#include <map>

namespace atria {

namespace {

namespace fs = std::filesystem;

const char* const meshLocation = "constant/polyMesh";
const char* const defaultPatchName = "defaultFaces";

/// An earlier mesh's zones or compressed files would be read along with, or instead of, the new ones.
void removeEarlierMesh(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const char* name : {"points", "faces", "owner", "neighbour", "boundary", "cellZones", "faceZones", "pointZones",
                           "cellLevel", "pointLevel", "level0Edge", "surfaceIndex"})
  {
    files.push_back(folder / name);
    files.push_back(folder / (std::string(name) + ".gz"));
  }
  removeFiles(files);
}

/// The mesh's parts in the order in which they are written.
struct Layout
{
  struct Patch
  {
    std::string word;
    std::string original;
    std::string group;
    std::string type;
    std::size_t start;
    std::size_t count;
  };
  std::vector<Index> boundary; ///< faces, patch by patch; internal ones come first and stay as they are
  std::vector<Patch> patches;
  std::vector<Index> points;   ///< ids of those that faces have, rising; empty if that is all
  std::vector<Index> newPoint; ///< old id to new; empty likewise
  std::size_t pointCount = 0;

  Index newPointOf(Index point) const { return newPoint.empty() ? point : newPoint[point]; }
};

std::string typeOf(const std::string& name)
{
  return std::find(sideNames.begin(), sideNames.end(), name) != sideNames.end() ? "patch" : "wall";
}

void addPatch(Layout& layout, const FaceMesh& mesh, std::vector<Index> faces, Layout::Patch patch)
{
  std::sort(faces.begin(), faces.end());
  patch.start = mesh.internalFaceCount() + layout.boundary.size();
  patch.count = faces.size();
  layout.boundary.insert(layout.boundary.end(), faces.begin(), faces.end());
  layout.patches.push_back(std::move(patch));
}

/// The boundary faces that are in no patch.
std::vector<Index> unclaimedFaces(const FaceMesh& mesh, std::span<const BoundaryPatch> patches)
{
  const std::size_t internal = mesh.internalFaceCount();
  std::vector<bool> claimed(mesh.faceCount() - internal, false);
  for (const BoundaryPatch& patch : patches)
  {
    for (const Index face : patch.faces)
    {
      if (face < internal || face >= mesh.faceCount() || claimed[face - internal])
      {
        throw Error("face " + std::to_string(face) + " of patch '" + patch.name +
                    "' is not on the boundary or in another patch too");
      }
      claimed[face - internal] = true;
    }
  }
  std::vector<Index> rest;
  for (std::size_t f = internal; f < mesh.faceCount(); ++f)
  {
    if (!claimed[f - internal])
    {
      rest.push_back(static_cast<Index>(f));
    }
  }
  return rest;
}

void layOutFaces(Layout& layout, const FaceMesh& mesh, std::span<const BoundaryPatch> patches)
{
  std::vector<Index> rest = unclaimedFaces(mesh, patches);
  std::vector<std::string> names;
  for (const BoundaryPatch& patch : patches)
  {
    names.push_back(patch.name);
  }
  if (!rest.empty())
  {
    // First, so that it is the one to keep its name.
    names.insert(names.begin(), defaultPatchName);
  }
  std::vector<OpenFOAMName> words = makeOpenFOAMNames(names);
  const std::size_t first = rest.empty() ? 0 : 1;
  for (std::size_t p = 0; p < patches.size(); ++p)
  {
    const OpenFOAMName& name = words[first + p];
    addPatch(layout, mesh, patches[p].faces, {name.word, patches[p].name, name.group, typeOf(patches[p].name), 0, 0});
  }
  if (!rest.empty())
  {
    addPatch(layout, mesh, std::move(rest), {words[0].word, defaultPatchName, "", "patch", 0, 0});
  }
}

void layOutPoints(Layout& layout, const FaceMesh& mesh, const Executor& executor)
{
  std::vector<char> isUsed(mesh.points.size(), 0);
  executor.forEach(mesh.facePoints.size(), 65536, [&](std::size_t i) {
    std::atomic_ref(isUsed[mesh.facePoints[i]]).store(1, std::memory_order_relaxed);
  });
  layout.pointCount = static_cast<std::size_t>(std::count(isUsed.begin(), isUsed.end(), 1));
  if (layout.pointCount == mesh.points.size())
  {
    return;
  }
  layout.points = chosenNumbers(isUsed.size(), executor, [&](std::size_t p) { return isUsed[p] != 0; });
  layout.newPoint.resize(mesh.points.size());
  executor.forEach(layout.points.size(), 65536,
                   [&](std::size_t i) { layout.newPoint[layout.points[i]] = static_cast<Index>(i); });
}

void checkLabels(const FaceMesh& mesh)
{
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (mesh.facePoints.size() > most || mesh.faceCount() >= most || mesh.points.size() > most)
  {
    throw Error("the mesh is too large for OpenFOAM's 32-bit labels");
  }
}

class PolyMeshWriter
{
public:
  PolyMeshWriter(const fs::path& target, const FaceMesh& source, const Layout& order, OpenFOAMFormat listFormat,
                 const ProgressRange& range)
      : folder(target), mesh(source), layout(order), format(listFormat), progress(range)
  {
    note = "nPoints:" + std::to_string(layout.pointCount) + "  nCells:" + std::to_string(mesh.cellCount) +
           "  nFaces:" + std::to_string(mesh.faceCount()) +
           "  nInternalFaces:" + std::to_string(mesh.internalFaceCount());
  }

  void writePoints() const
  {
    OpenFOAMFile file = open("points", "vectorField");
    file.number(static_cast<std::int64_t>(layout.pointCount)).text("\n(");
    for (std::size_t i = 0; i < layout.pointCount; ++i)
    {
      const Vec3& x = mesh.points[layout.points.empty() ? i : layout.points[i]];
      if (binary())
      {
        file.raw(x.data(), 3 * sizeof(double));
      }
      else
      {
        file.text("\n(").number(x[0]).text(" ").number(x[1]).text(" ").number(x[2]).text(")");
      }
    }
    file.text(binary() ? ")\n" : "\n)\n").close();
  }

  void writeFaces() const
  {
    OpenFOAMFile file = open("faces", binary() ? "faceCompactList" : "faceList");
    if (binary())
    {
      writeCompactFaces(file);
    }
    else
    {
      file.number(static_cast<std::int64_t>(mesh.faceCount())).text("\n(");
      for (std::size_t f = 0; f < mesh.internalFaceCount(); ++f)
      {
        writeFace(file, mesh.face(f));
      }
      for (const Index f : layout.boundary)
      {
        writeFace(file, mesh.face(f));
      }
      file.text("\n)\n");
    }
    file.close();
  }

  void writeOwners() const
  {
    std::vector<Index> ofBoundary;
    for (const Index f : layout.boundary)
    {
      ofBoundary.push_back(mesh.owner[f]);
    }
    writeLabelFile("owner", std::span(mesh.owner).first(mesh.internalFaceCount()), ofBoundary);
  }

  void writeNeighbors() const { writeLabelFile("neighbour", mesh.neighbor); }

  void writeBoundary() const
  {
    // Always text, as OpenFOAM itself writes it.
    OpenFOAMFile file(folder / "boundary", {"polyBoundaryMesh", meshLocation, "", OpenFOAMFormat::Ascii});
    file.number(size(layout.patches)).text("\n(\n");
    for (const Layout::Patch& patch : layout.patches)
    {
      file.text("    // ").text(comment(patch.original)).text("\n    ").text(patch.word).text("\n    {\n");
      file.text("        type            ").text(patch.type).text(";\n");
      writeGroups(file, patch);
      file.text("        nFaces          ").number(static_cast<std::int64_t>(patch.count)).text(";\n");
      file.text("        startFace       ").number(static_cast<std::int64_t>(patch.start)).text(";\n    }\n");
    }
    file.text(")\n").close();
  }

  void writeCellZones(const std::map<std::int64_t, std::vector<Index>>& zones) const
  {
    OpenFOAMFile file = open("cellZones", "regIOobject");
    file.number(size(zones)).text("\n(\n");
    for (const auto& [id, cells] : zones)
    {
      const std::string sign = id < 0 ? "_" : ""; // a word such as zone-1 reads badly in expressions
      file.text("zone" + sign).number(id < 0 ? -id : id).text("\n{\n    type cellZone;\n    cellLabels List<label>\n");
      writeLabels(file, cells);
      file.text(";\n}\n");
    }
    file.text(")\n").close();
  }

private:
  bool binary() const { return format == OpenFOAMFormat::Binary; }
  template <typename Container> static std::int64_t size(const Container& container)
  {
    return static_cast<std::int64_t>(container.size());
  }

  OpenFOAMFile open(const char* name, const char* className, const std::string& itsNote = {}) const
  {
    return OpenFOAMFile(folder / name, {className, meshLocation, itsNote, format}, &progress);
  }

  /// One list of both.
  void writeLabels(OpenFOAMFile& file, std::span<const Index> labels, std::span<const Index> more = {}) const
  {
    file.number(size(labels) + size(more)).text("\n(");
    for (const std::span<const Index> part : {labels, more})
    {
      if (binary())
      {
        file.raw(part.data(), part.size_bytes());
        continue;
      }
      for (const Index label : part)
      {
        file.text("\n").number(std::int64_t{label});
      }
    }
    file.text(binary() ? ")" : "\n)");
  }

  void writeLabelFile(const char* name, std::span<const Index> labels, std::span<const Index> more = {}) const
  {
    OpenFOAMFile file = open(name, "labelList", note);
    writeLabels(file, labels, more);
    file.text("\n").close();
  }

  void writeFace(OpenFOAMFile& file, std::span<const Index> face) const
  {
    file.text("\n").number(static_cast<std::int64_t>(face.size())).text("(");
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      file.text(i == 0 ? "" : " ").number(std::int64_t{layout.newPointOf(face[i])});
    }
    file.text(")");
  }

  /// Two lists: where each face's points begin, and the points of all.
  void writeCompactFaces(OpenFOAMFile& file) const
  {
    const std::size_t internal = mesh.internalFaceCount();
    const Index internalCorners = mesh.faceOffsets[internal];
    std::vector<Index> ends; // of boundary faces
    Index end = internalCorners;
    for (const Index f : layout.boundary)
    {
      end += static_cast<Index>(mesh.face(f).size());
      ends.push_back(end);
    }
    writeLabels(file, std::span(mesh.faceOffsets).first(internal + 1), ends);
    file.text("\n\n").number(std::int64_t{end}).text("\n(");
    writeNewPoints(file, std::span(mesh.facePoints).first(internalCorners));
    for (const Index f : layout.boundary)
    {
      writeNewPoints(file, mesh.face(f));
    }
    file.text(")\n");
  }

  void writeNewPoints(OpenFOAMFile& file, std::span<const Index> points) const
  {
    if (layout.newPoint.empty())
    {
      file.raw(points.data(), points.size_bytes());
      return;
    }
    for (const Index p : points)
    {
      file.raw(&layout.newPoint[p], sizeof(Index));
    }
  }

  static void writeGroups(OpenFOAMFile& file, const Layout::Patch& patch)
  {
    // OpenFOAM puts a wall into the group `wall` only where no other groups are given.
    if (!patch.group.empty())
    {
      const bool addWall = patch.type == "wall" && patch.group != "wall";
      file.text("        inGroups        ").text(addWall ? "2(wall " : "1(").text(patch.group).text(");\n");
    }
  }

  /// A name as it may stand in a comment of one line.
  static std::string comment(std::string name)
  {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F || c == '\\'; }, ' ');
    return '"' + name + '"';
  }

  fs::path folder;
  const FaceMesh& mesh;
  const Layout& layout;
  OpenFOAMFormat format;
  const ProgressRange& progress;
  std::string note;
};

std::map<std::int64_t, std::vector<Index>> cellsOfZones(std::span<const std::int64_t> zoneIds)
{
  std::map<std::int64_t, std::vector<Index>> zones;
  if (std::ranges::adjacent_find(zoneIds, std::not_equal_to()) == zoneIds.end())
  {
    return zones; // one or none: nothing to tell
  }
  std::vector<Index>* cells = nullptr;
  for (std::size_t cell = 0; cell < zoneIds.size(); ++cell)
  {
    if (cell == 0 || zoneIds[cell] != zoneIds[cell - 1])
    {
      cells = &zones[zoneIds[cell]];
    }
    cells->push_back(static_cast<Index>(cell));
  }
  return zones;
}

void writeDictionary(const fs::path& caseFolder, const char* name, std::string_view content)
{
  const fs::path path = caseFolder / "system" / name;
  if (!fs::exists(path))
  {
    OpenFOAMFile file(path, {"dictionary", "system", "", OpenFOAMFormat::Ascii});
    file.text(content).close();
  }
}

} // namespace

void writePolyMesh(const fs::path& caseFolder, const FaceMesh& mesh, std::span<const BoundaryPatch> patches,
                   std::span<const std::int64_t> zoneIds, OpenFOAMFormat format, const RunContext& context)
{
  checkLabels(mesh);
  if (!zoneIds.empty() && zoneIds.size() != mesh.cellCount)
  {
    throw Error("there are " + std::to_string(zoneIds.size()) + " zone ids for " + std::to_string(mesh.cellCount) +
                " cells");
  }
  Layout layout;
  layOutFaces(layout, mesh, patches);
  layOutPoints(layout, mesh, context.executor);
  const fs::path folder = caseFolder / "constant" / "polyMesh";
  makeFolder(folder);
  const UnfinishedFolder unfinished(folder / ".unfinished");
  const PolyMeshWriter writer(unfinished.path, mesh, layout, format, context.progress);
  context.progress.report(0.2, "Writing points and faces");
  const std::array files{&PolyMeshWriter::writeFaces, &PolyMeshWriter::writePoints, &PolyMeshWriter::writeOwners,
                         &PolyMeshWriter::writeNeighbors};
  context.executor.forEach(files.size(), 1, [&](std::size_t i) { (writer.*files[i])(); });
  context.progress.report(0.9, "Writing patches");
  writer.writeBoundary();
  const auto zones = cellsOfZones(zoneIds);
  if (!zones.empty())
  {
    writer.writeCellZones(zones);
  }
  context.progress.report(1.0, "Mesh written");
  removeEarlierMesh(folder);
  unfinished.moveFilesTo(folder);
}

void completeCase(const fs::path& caseFolder)
{
  makeFolder(caseFolder / "system");
  writeDictionary(caseFolder, "controlDict",
                  "application     simpleFoam;\nstartFrom       startTime;\nstartTime       0;\nstopAt          "
                  "endTime;\n"
                  "endTime         1000;\ndeltaT          1;\nwriteControl    timeStep;\nwriteInterval   100;\n"
                  "writeFormat     ascii;\nwritePrecision  12;\ntimePrecision   6;\n");
  writeDictionary(caseFolder, "fvSchemes",
                  "ddtSchemes { default steadyState; }\ngradSchemes { default Gauss linear; }\n"
                  "divSchemes { default none; }\nlaplacianSchemes { default Gauss linear corrected; }\n"
                  "interpolationSchemes { default linear; }\nsnGradSchemes { default corrected; }\n");
  writeDictionary(caseFolder, "fvSolution", "solvers {}\nSIMPLE { nNonOrthogonalCorrectors 0; }\n");
  const fs::path whole = fs::absolute(caseFolder).lexically_normal();
  const fs::path named = whole.has_filename() ? whole : whole.parent_path(); // "case/" means "case"
  const fs::path marker = caseFolder / (named.filename().string() + ".foam");
  if (!std::ofstream(marker, std::ios::app))
  {
    throw Error("cannot write '" + marker.string() + "'");
  }
}

} // namespace atria
