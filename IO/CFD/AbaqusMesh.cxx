// SPDX-License-Identifier: GPL-3.0-or-later
#include "AbaqusMesh.h"

#include "OutputFile.h"
#include "OutputFolders.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace atria {

namespace {

constexpr std::size_t entriesPerLine = 16; // as many as Abaqus reads

/// A type of elements. Its faces S1, S2 … are lists of its nodes, which count from 0; -1 fills up triangles.
struct AbaqusType
{
  CellType cell;
  const char* name;
  std::size_t faceCount;
  std::array<std::array<std::int8_t, 4>, 6> faces;
};

constexpr AbaqusType abaqusTypes[] = {
    {hexahedronCell, "C3D8", 6, {{{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}}},
    {wedgeCell, "C3D6", 5, {{{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}}},
    {tetrahedronCell, "C3D4", 4, {{{0, 1, 2, -1}, {0, 3, 1, -1}, {1, 3, 2, -1}, {2, 3, 0, -1}}}}};

const AbaqusType* typeOf(unsigned char cell)
{
  const auto* const found = std::ranges::find(abaqusTypes, cell, &AbaqusType::cell);
  return found == std::end(abaqusTypes) ? nullptr : found;
}

class AbaqusWriter
{
public:
  AbaqusWriter(const std::filesystem::path& path, const ElementMesh& source, const ProgressRange& range)
      : solverMesh(source.mesh), mesh(source.mesh.mesh), elements(source.elements), file(path, &range)
  {
  }

  void write()
  {
    file.text("*HEADING\nAtria\n");
    writeNodes();
    for (const AbaqusType& type : abaqusTypes)
    {
      writeElements(type);
    }
    const std::vector<PatchName> names = wordsOf();
    const std::size_t patches = solverMesh.patches.size();
    for (std::size_t z = 0; z < solverMesh.cellZones.size(); ++z)
    {
      writeSet(names[patches + z].word, solverMesh.cellZones[z]);
    }
    for (std::size_t p = 0; p < patches; ++p)
    {
      if (solverMesh.patches[p].faceCount > 0)
      {
        writeSurface(names[p].word, solverMesh.patches[p]);
      }
    }
    file.close();
  }

private:
  /// Returns the names of patches, then of zones.
  std::vector<PatchName> wordsOf() const
  {
    std::vector<std::string> sets{"EALL"}; // this name is used already
    std::ranges::transform(solverMesh.cellZones, std::back_inserter(sets), &CellZone::name);
    std::vector<PatchName> words = namesOf(solverMesh.patches, abaqusNames, sets);
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(solverMesh.patches.size()));
    return words;
  }

  void writeNodes()
  {
    file.text("*NODE, NSET=NALL\n");
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      file.report(0.0, 0.4, i, mesh.points.size(), "Writing points");
      file.number(static_cast<std::int64_t>(i + 1));
      for (int axis = 0; axis < 3; ++axis)
      {
        file.text(", ").text(abaqusNumber(mesh.points[i][axis]));
      }
      file.text("\n");
    }
  }

  void writeElements(const AbaqusType& type)
  {
    const std::size_t count = elements.types.size();
    if (std::ranges::find(elements.types, type.cell) == elements.types.end())
    {
      return;
    }
    file.text("*ELEMENT, TYPE=").text(type.name).text(", ELSET=EALL\n");
    for (std::size_t cell = 0; cell < count; ++cell)
    {
      if (elements.types[cell] != type.cell)
      {
        continue;
      }
      file.report(0.4, 0.9, cell, count, "Writing elements");
      file.number(static_cast<std::int64_t>(cell + 1));
      const auto corners = elements.cornersOf(cell);
      for (const std::uint8_t i : standardOrder(type.cell))
      {
        file.text(", ").number(std::int64_t{corners[i]} + 1);
      }
      file.text("\n");
    }
  }

  void writeOriginal(const std::string& name) { file.text("** \"").text(inOneLine(name)).text("\"\n"); }

  void writeSet(const std::string& word, const CellZone& zone)
  {
    writeOriginal(zone.name);
    file.text("*ELSET, ELSET=").text(word).text("\n");
    for (std::size_t i = 0; i < zone.cells.size(); ++i)
    {
      const bool endsLine = i + 1 == zone.cells.size() || (i + 1) % entriesPerLine == 0;
      file.number(std::int64_t{zone.cells[i]} + 1).text(endsLine ? "\n" : ", ");
    }
  }

  void writeSurface(const std::string& word, const SolverPatch& patch)
  {
    writeOriginal(patch.name);
    file.text("*SURFACE, NAME=").text(word).text(", TYPE=ELEMENT\n");
    for (std::size_t f = patch.firstFace; f < patch.firstFace + patch.faceCount; ++f)
    {
      file.report(0.9, 1.0, f - mesh.internalFaceCount(), mesh.faceCount() - mesh.internalFaceCount(),
                  "Writing patches");
      const Index cell = mesh.owner[f];
      const int face = abaqusFace(elements.types[cell], elements.cornersOf(cell), mesh.face(f));
      file.number(std::int64_t{cell} + 1).text(", S").number(std::int64_t{face}).text("\n");
    }
  }

  const SolverMesh& solverMesh;
  const FaceMesh& mesh;
  const NativeCells& elements;
  OutputFile file;
};

} // namespace

std::string abaqusNumber(double value)
{
  constexpr std::size_t longest = 20;
  constexpr int fewerDigits = 13; // with sign, point and an exponent of three digits
  std::array<char, 32> text;
  const char* end = std::to_chars(text.begin(), text.end(), value).ptr;
  if (static_cast<std::size_t>(end - text.data()) > longest)
  {
    end = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, fewerDigits).ptr;
  }
  return {text.data(), static_cast<std::size_t>(end - text.data())};
}

int abaqusFace(unsigned char type, std::span<const Index> corners, std::span<const Index> face)
{
  const AbaqusType* const known = typeOf(type);
  const auto order = standardOrder(type);
  for (std::size_t s = 0; known && s < known->faceCount; ++s)
  {
    const auto& nodes = known->faces[s];
    const std::size_t size = nodes.back() < 0 ? 3 : 4;
    const auto isOfFace = [&](std::int8_t i) {
      return i < 0 || std::ranges::find(face, corners[order[static_cast<std::size_t>(i)]]) != face.end();
    };
    if (size == face.size() && std::ranges::all_of(nodes, isOfFace))
    {
      return static_cast<int>(s + 1);
    }
  }
  return 0;
}

void writeAbaqusMesh(const std::filesystem::path& file, const ElementMesh& mesh, const RunContext& context)
{
  writeInPlace(file, [&](const std::filesystem::path& place) { AbaqusWriter(place, mesh, context.progress).write(); });
}

} // namespace atria
