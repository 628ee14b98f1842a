// SPDX-License-Identifier: GPL-3.0-or-later
#include "FluentMesh.h"

#include "OutputFile.h"
#include "OutputFolders.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace atria {

namespace {

/// Fluent's numbers of cell types.
enum FluentCell : int
{
  mixedCells = 0,
  fluentTetrahedron = 2,
  fluentHexahedron = 4,
  fluentPyramid = 5,
  fluentWedge = 6,
  fluentPolyhedron = 7
};

/// Returns the type that a cell's faces make. Any cell of no other type is a polyhedron.
FluentCell typeOf(const FaceMesh& mesh, std::span<const Index> faces)
{
  constexpr std::size_t mostCorners = 24; // six quadrilaterals
  if (faces.size() > 6)
  {
    return fluentPolyhedron;
  }
  std::array<Index, mostCorners> corners;
  std::size_t count = 0;
  std::size_t quads = 0;
  for (const Index f : faces)
  {
    const auto loop = mesh.face(f);
    if (loop.size() > 4)
    {
      return fluentPolyhedron;
    }
    quads += loop.size() == 4 ? 1 : 0;
    count = static_cast<std::size_t>(std::ranges::copy(loop, corners.begin() + count).out - corners.begin());
  }
  std::sort(corners.begin(), corners.begin() + count);
  const auto points = static_cast<std::size_t>(std::unique(corners.begin(), corners.begin() + count) - corners.begin());
  // The numbers of faces, of quadrilaterals among them, and of points. A closed cell with these is of the type.
  struct Type
  {
    std::size_t faces;
    std::size_t quads;
    std::size_t points;
    FluentCell type;
  };
  constexpr Type types[] = {
      {4, 0, 4, fluentTetrahedron}, {5, 1, 5, fluentPyramid}, {5, 3, 6, fluentWedge}, {6, 6, 8, fluentHexahedron}};
  for (const Type& t : types)
  {
    if (t.faces == faces.size() && t.quads == quads && t.points == points)
    {
      return t.type;
    }
  }
  return fluentPolyhedron;
}

/// The cells of a zone, with consecutive numbers.
struct CellSection
{
  std::string name;
  std::size_t firstCell;
  std::size_t cellCount;
};

/// Faces of a zone.
struct FaceSection
{
  std::string name;
  const char* type;
  int typeNumber;
  std::vector<Index> faces;
};

class FluentWriter
{
public:
  FluentWriter(const std::filesystem::path& path, const SolverMesh& source, const RunContext& runContext)
      : solverMesh(source), mesh(source.mesh), context(runContext), file(path, &runContext.progress)
  {
  }

  void write()
  {
    numberCells();
    sortFaces();
    writeHeader();
    context.progress.report(0.1, "Writing points");
    writePoints();
    context.progress.report(0.3, "Writing cells");
    writeCells();
    context.progress.report(0.4, "Writing faces");
    for (std::size_t z = 0; z < faceZones.size(); ++z)
    {
      writeFaces(firstFaceZone() + z, faceZones[z]);
    }
    writeNames();
    file.close();
  }

private:
  static constexpr std::size_t pointZone = 1;
  static constexpr std::size_t firstCellZone = 2;
  std::size_t firstFaceZone() const { return firstCellZone + cellZones.size(); }

  /// Puts each cell into one zone: the last of several, such as a tree in a room.
  void numberCells()
  {
    std::vector<std::string> names{"fluid"};
    std::vector<Index> labels(mesh.cellCount, 0);
    const auto label = [&](const std::string& name, const std::vector<Index>& cells) {
      std::ranges::for_each(cells, [&](Index cell) { labels[cell] = static_cast<Index>(names.size()); });
      names.push_back(name);
    };
    std::ranges::for_each(solverMesh.cellZones, [&](const CellZone& zone) { label(zone.name, zone.cells); });
    oldCell.resize(mesh.cellCount);
    std::iota(oldCell.begin(), oldCell.end(), Index{0});
    std::ranges::stable_sort(oldCell, {}, [&](Index cell) { return labels[cell]; });
    newCell.resize(mesh.cellCount);
    zoneOf.resize(mesh.cellCount);
    for (std::size_t i = 0; i < oldCell.size(); ++i)
    {
      const Index cell = oldCell[i];
      if (i == 0 || labels[cell] != labels[oldCell[i - 1]])
      {
        cellZones.push_back({names[labels[cell]], i, 0});
      }
      ++cellZones.back().cellCount;
      zoneOf[cell] = static_cast<Index>(cellZones.size() - 1);
      newCell[cell] = static_cast<Index>(i);
    }
  }

  /// Sorts internal faces by the zones of their cells. Faces of face zones follow, then patches.
  void sortFaces()
  {
    std::vector<bool> inZone(mesh.internalFaceCount(), false);
    for (const FaceZone& zone : solverMesh.faceZones)
    {
      std::ranges::for_each(zone.faces, [&](Index face) { inZone[face] = true; });
    }
    std::map<std::pair<Index, Index>, std::vector<Index>> internal;
    for (std::size_t f = 0; f < mesh.internalFaceCount(); ++f)
    {
      if (inZone[f])
      {
        continue;
      }
      internal[std::minmax(zoneOf[mesh.owner[f]], zoneOf[mesh.neighbor[f]])].push_back(static_cast<Index>(f));
    }
    for (auto& [zones, faces] : internal)
    {
      const std::string& first = cellZones[zones.first].name;
      const std::string& second = cellZones[zones.second].name;
      faceZones.push_back(
          {"interior-" + (first == second ? first : first + "-" + second), "interior", 2, std::move(faces)});
    }
    for (const FaceZone& zone : solverMesh.faceZones)
    {
      faceZones.push_back({zone.name, "interior", 2, zone.faces});
    }
    nameZones();
    for (std::size_t p = 0; p < solverMesh.patches.size(); ++p)
    {
      const SolverPatch& patch = solverMesh.patches[p];
      if (patch.faceCount == 0)
      {
        continue;
      }
      FaceSection zone{patchNames[p].word, patch.isWall() ? "wall" : "pressure-outlet", patch.isWall() ? 3 : 5,
                       std::vector<Index>(patch.faceCount)};
      std::iota(zone.faces.begin(), zone.faces.end(), static_cast<Index>(patch.firstFace));
      faceZones.push_back(std::move(zone));
    }
  }

  /// Names zones. A patch keeps its name if a zone has the same.
  void nameZones()
  {
    std::vector<std::string> others;
    std::ranges::transform(cellZones, std::back_inserter(others), &CellSection::name);
    std::ranges::transform(faceZones, std::back_inserter(others), &FaceSection::name);
    patchNames = namesOf(solverMesh.patches, fluentNames, others);
    auto name = patchNames.begin() + static_cast<std::ptrdiff_t>(solverMesh.patches.size());
    for (CellSection& zone : cellZones)
    {
      zone.name = (name++)->word;
    }
    for (FaceSection& zone : faceZones)
    {
      zone.name = (name++)->word;
    }
  }

  void writeHeader()
  {
    file.text("(0 \"Atria\")\n(2 3)\n");
    const auto total = [&](const char* section, std::size_t count, const char* end) {
      file.text("(").text(section).text(" (0 1 ").hex(count).text(end);
    };
    total("10", mesh.points.size(), " 0 3))\n");
    total("12", mesh.cellCount, " 0 0))\n");
    total("13", mesh.faceCount(), " 0 0))\n");
  }

  void writeRange(const char* section, std::size_t zone, std::size_t first, std::size_t count)
  {
    file.text("(").text(section).text(" (").hex(zone).text(" ").hex(first + 1).text(" ").hex(first + count);
  }

  void writePoints()
  {
    writeRange("10", pointZone, 0, mesh.points.size());
    file.text(" 1 3)(\n");
    for (const Vec3& x : mesh.points)
    {
      file.number(x[0]).text(" ").number(x[1]).text(" ").number(x[2]).text("\n");
    }
    file.text("))\n");
  }

  void writeCells()
  {
    const CellFaces cellFaces = makeCellFaces(solverMesh.mesh);
    std::vector<unsigned char> types(mesh.cellCount);
    context.executor.forEach(types.size(), 4096, [&](std::size_t i) {
      types[i] = static_cast<unsigned char>(typeOf(mesh, cellFaces.of(oldCell[i])));
    });
    for (std::size_t z = 0; z < cellZones.size(); ++z)
    {
      const CellSection& zone = cellZones[z];
      const std::span own = std::span(types).subspan(zone.firstCell, zone.cellCount);
      const bool uniform = std::ranges::adjacent_find(own, std::not_equal_to()) == own.end();
      writeRange("12", firstCellZone + z, zone.firstCell, zone.cellCount);
      file.text(" 1 ").hex(uniform ? std::uint64_t{own.front()} : std::uint64_t{mixedCells}).text(")");
      if (!uniform)
      {
        file.text("(");
        for (std::size_t i = 0; i < own.size(); ++i)
        {
          constexpr std::size_t perLine = 40;
          file.text(i % perLine == 0 ? "\n" : " ").hex(own[i]);
        }
        file.text("\n)");
      }
      file.text(")\n");
    }
  }

  void writeFaces(std::size_t id, const FaceSection& zone)
  {
    const bool hasPolygons = std::ranges::any_of(zone.faces, [&](Index f) { return mesh.face(f).size() > 4; });
    writeRange("13", id, writtenFaces, zone.faces.size());
    file.text(" ").hex(static_cast<std::uint64_t>(zone.typeNumber)).text(hasPolygons ? " 5)(\n" : " 0)(\n");
    writtenFaces += zone.faces.size();
    for (const Index f : zone.faces)
    {
      // Fluent's faces point into the cell that is named first.
      const auto loop = mesh.face(f);
      file.hex(loop.size());
      for (auto point = loop.rbegin(); point != loop.rend(); ++point)
      {
        file.text(" ").hex(std::uint64_t{*point} + 1);
      }
      const bool isInternal = f < mesh.internalFaceCount();
      file.text(" ").hex(std::uint64_t{newCell[mesh.owner[f]]} + 1).text(" ");
      file.hex(isInternal ? std::uint64_t{newCell[mesh.neighbor[f]]} + 1 : 0).text("\n");
    }
    file.text("))\n");
    context.progress.report(0.4 + 0.6 * static_cast<double>(writtenFaces) / static_cast<double>(mesh.faceCount()),
                            "Writing faces");
  }

  void writeNames()
  {
    const auto name = [&](std::size_t id, const char* type, const std::string& word) {
      file.text("(45 (").number(static_cast<std::int64_t>(id)).text(" ").text(type).text(" ").text(word).text(")())\n");
    };
    for (std::size_t z = 0; z < cellZones.size(); ++z)
    {
      name(firstCellZone + z, "fluid", cellZones[z].name);
    }
    for (std::size_t z = 0; z < faceZones.size(); ++z)
    {
      name(firstFaceZone() + z, faceZones[z].type, faceZones[z].name);
    }
  }

  const SolverMesh& solverMesh;
  const FaceMesh& mesh;
  const RunContext& context;
  OutputFile file;
  std::vector<CellSection> cellZones;
  std::vector<FaceSection> faceZones;
  std::vector<PatchName> patchNames;
  std::vector<Index> newCell; ///< number in the file, one per cell
  std::vector<Index> oldCell; ///< the inverse
  std::vector<Index> zoneOf;  ///< index in cellZones, one per cell
  std::size_t writtenFaces = 0;
};

} // namespace

void writeFluentMesh(const std::filesystem::path& file, const SolverMesh& mesh, const RunContext& context)
{
  writeInPlace(file, [&](const std::filesystem::path& place) { FluentWriter(place, mesh, context).write(); });
}

} // namespace atria
