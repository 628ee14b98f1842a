// SPDX-License-Identifier: GPL-3.0-or-later
#include "OpenFOAMCase.h"

#include "OutputFolders.h"
#include "Support/Error.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <span>
#include <string_view>

namespace atria {

namespace {

namespace fs = std::filesystem;

const char* const meshLocation = "constant/polyMesh";

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
  PolyMeshWriter(const fs::path& target, const SolverMesh& source, OpenFOAMFormat listFormat,
                 const ProgressRange& range)
      : folder(target), solverMesh(source), mesh(source.mesh), format(listFormat), progress(range)
  {
    note = "nPoints:" + std::to_string(mesh.points.size()) + "  nCells:" + std::to_string(mesh.cellCount) +
           "  nFaces:" + std::to_string(mesh.faceCount()) +
           "  nInternalFaces:" + std::to_string(mesh.internalFaceCount());
  }

  void writePoints() const
  {
    OpenFOAMFile file = open("points", "vectorField");
    file.number(size(mesh.points)).text("\n(");
    if (binary())
    {
      file.raw(mesh.points.data(), mesh.points.size() * sizeof(Vec3));
    }
    for (std::size_t i = 0; i < mesh.points.size() && !binary(); ++i)
    {
      const Vec3& x = mesh.points[i];
      file.text("\n(").number(x[0]).text(" ").number(x[1]).text(" ").number(x[2]).text(")");
    }
    file.text(binary() ? ")\n" : "\n)\n").close();
  }

  void writeFaces() const
  {
    OpenFOAMFile file = open("faces", binary() ? "faceCompactList" : "faceList");
    if (binary())
    {
      // Two lists: where each face's points begin, and the points of all.
      writeLabels(file, mesh.faceOffsets);
      file.text("\n\n");
      writeLabels(file, mesh.facePoints);
      file.text("\n").close();
      return;
    }
    file.number(static_cast<std::int64_t>(mesh.faceCount())).text("\n(");
    for (std::size_t f = 0; f < mesh.faceCount(); ++f)
    {
      writeFace(file, mesh.face(f));
    }
    file.text("\n)\n").close();
  }

  void writeOwners() const { writeLabelFile("owner", mesh.owner); }
  void writeNeighbors() const { writeLabelFile("neighbour", mesh.neighbor); }

  void writeBoundary() const
  {
    // Always text, as OpenFOAM itself writes it.
    OpenFOAMFile file(folder / "boundary", {"polyBoundaryMesh", meshLocation, "", OpenFOAMFormat::Ascii});
    const std::vector<PatchName> names = namesOf(solverMesh.patches, openFOAMNames);
    file.number(size(names)).text("\n(\n");
    for (std::size_t p = 0; p < names.size(); ++p)
    {
      const SolverPatch& patch = solverMesh.patches[p];
      file.text("    // ").text(comment(patch.name)).text("\n    ").text(names[p].word).text("\n    {\n");
      file.text("        type            ").text(patch.isWall() ? "wall" : "patch").text(";\n");
      writeGroups(file, names[p].group, patch.isWall());
      file.text("        nFaces          ").number(static_cast<std::int64_t>(patch.faceCount)).text(";\n");
      file.text("        startFace       ").number(static_cast<std::int64_t>(patch.firstFace)).text(";\n    }\n");
    }
    file.text(")\n").close();
  }

  void writeFaceZones() const
  {
    writeZones("faceZones", std::span<const FaceZone>(solverMesh.faceZones),
               [&](OpenFOAMFile& file, const FaceZone& zone) {
                 file.text("    type faceZone;\n    faceLabels List<label>\n");
                 writeLabels(file, zone.faces);
                 file.text(";\n    flipMap List<bool>\n");
                 writeFlips(file, zone.flips);
                 file.text(";\n");
               });
  }

  /// Rooms tell more than zones by number, which are for meshes without.
  void writeCellZones() const
  {
    std::vector<CellZone> numbered;
    for (const auto& [id, cells] : solverMesh.zones)
    {
      numbered.push_back({zoneName(id), cells});
    }
    writeZones("cellZones", std::span<const CellZone>(solverMesh.cellZones.empty() ? numbered : solverMesh.cellZones),
               [&](OpenFOAMFile& file, const CellZone& zone) {
                 file.text("    type cellZone;\n    cellLabels List<label>\n");
                 writeLabels(file, zone.cells);
                 file.text(";\n");
               });
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

  /// Nothing without zones; write(file, zone) what is in one.
  template <typename Zone, typename Write>
  void writeZones(const char* name, std::span<const Zone> zones, Write&& write) const
  {
    if (zones.empty())
    {
      return;
    }
    std::vector<std::string> names;
    std::ranges::transform(zones, std::back_inserter(names), &Zone::name);
    const std::vector<PatchName> words = makePatchNames(names, openFOAMNames);
    OpenFOAMFile file = open(name, "regIOobject");
    file.number(size(zones)).text("\n(\n");
    for (std::size_t z = 0; z < zones.size(); ++z)
    {
      file.text(words[z].word).text("\n{\n");
      write(file, zones[z]);
      file.text("}\n");
    }
    file.text(")\n").close();
  }

  void writeFlips(OpenFOAMFile& file, std::span<const char> flips) const
  {
    file.number(size(flips)).text("\n(");
    if (binary())
    {
      file.raw(flips.data(), flips.size()).text(")");
      return;
    }
    for (const char flip : flips)
    {
      file.text(flip ? "\n1" : "\n0");
    }
    file.text("\n)");
  }

  void writeLabels(OpenFOAMFile& file, std::span<const Index> labels) const
  {
    file.number(size(labels)).text("\n(");
    if (binary())
    {
      file.raw(labels.data(), labels.size_bytes()).text(")");
      return;
    }
    for (const Index label : labels)
    {
      file.text("\n").number(std::int64_t{label});
    }
    file.text("\n)");
  }

  void writeLabelFile(const char* name, std::span<const Index> labels) const
  {
    OpenFOAMFile file = open(name, "labelList", note);
    writeLabels(file, labels);
    file.text("\n").close();
  }

  static void writeFace(OpenFOAMFile& file, std::span<const Index> face)
  {
    file.text("\n").number(static_cast<std::int64_t>(face.size())).text("(");
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      file.text(i == 0 ? "" : " ").number(std::int64_t{face[i]});
    }
    file.text(")");
  }

  static void writeGroups(OpenFOAMFile& file, const std::string& group, bool isWall)
  {
    // OpenFOAM puts a wall into the group `wall` only where no other groups are given.
    if (!group.empty())
    {
      const bool addWall = isWall && group != "wall";
      file.text("        inGroups        ").text(addWall ? "2(wall " : "1(").text(group).text(");\n");
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
  const SolverMesh& solverMesh;
  const FaceMesh& mesh;
  OpenFOAMFormat format;
  const ProgressRange& progress;
  std::string note;
};
static_assert(sizeof(Vec3) == 3 * sizeof(double)); // written as they are

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

void writePolyMesh(const fs::path& caseFolder, const SolverMesh& mesh, OpenFOAMFormat format, const RunContext& context)
{
  checkLabels(mesh.mesh);
  const fs::path folder = caseFolder / "constant" / "polyMesh";
  makeFolder(folder);
  const UnfinishedFolder unfinished(folder / ".unfinished");
  const PolyMeshWriter writer(unfinished.path, mesh, format, context.progress);
  context.progress.report(0.0, "Writing points and faces");
  const std::array files{&PolyMeshWriter::writeFaces, &PolyMeshWriter::writePoints, &PolyMeshWriter::writeOwners,
                         &PolyMeshWriter::writeNeighbors};
  context.executor.forEach(files.size(), 1, [&](std::size_t i) { (writer.*files[i])(); });
  context.progress.report(0.9, "Writing patches");
  writer.writeBoundary();
  writer.writeFaceZones();
  writer.writeCellZones();
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
