// SPDX-License-Identifier: GPL-3.0-or-later
#include "SU2Mesh.h"

#include "OutputFile.h"
#include "OutputFolders.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace atria {

namespace {

constexpr std::int64_t triangle = 5; // VTK's numbers, which SU2 has too
constexpr std::int64_t quadrilateral = 9;

class SU2Writer
{
public:
  SU2Writer(const std::filesystem::path& path, const SolverMesh& source, const NativeCells& nativeCells,
            const ProgressRange& range)
      : mesh(source), cells(nativeCells), file(path, &range)
  {
  }

  void write()
  {
    file.text("% Atria\nNDIME= 3\n");
    writeElements();
    writePoints();
    writeMarkers();
    file.close();
  }

private:
  void count(const char* keyword, std::size_t number)
  {
    file.text(keyword).text("= ").number(static_cast<std::int64_t>(number)).text("\n");
  }

  void writeElement(std::int64_t type, std::span<const Index> corners)
  {
    file.number(type);
    for (const Index p : corners)
    {
      file.text(" ").number(std::int64_t{p});
    }
  }

  void writeElements()
  {
    count("NELEM", cells.types.size());
    for (std::size_t cell = 0; cell < cells.types.size(); ++cell)
    {
      file.report(0.0, 0.6, cell, cells.types.size(), "Writing elements");
      writeElement(cells.types[cell], cells.cornersOf(cell));
      file.text(" ").number(static_cast<std::int64_t>(cell)).text("\n");
    }
  }

  void writePoints()
  {
    const std::size_t own = mesh.mesh.points.size();
    const std::size_t all = own + cells.apices.size();
    count("NPOIN", all);
    for (std::size_t i = 0; i < all; ++i)
    {
      file.report(0.6, 0.9, i, all, "Writing points");
      const Vec3& x = i < own ? mesh.mesh.points[i] : cells.apices[i - own];
      file.number(x[0]).text(" ").number(x[1]).text(" ").number(x[2]).text(" ");
      file.number(static_cast<std::int64_t>(i)).text("\n");
    }
  }

  void writeMarkers()
  {
    const std::vector<PatchName> names = namesOf(mesh.patches, su2Names);
    count("NMARK", static_cast<std::size_t>(std::ranges::count_if(
                       mesh.patches, [](const SolverPatch& patch) { return patch.faceCount > 0; })));
    for (std::size_t p = 0; p < names.size(); ++p)
    {
      if (mesh.patches[p].faceCount > 0)
      {
        writeMarker(mesh.patches[p], names[p].word);
      }
    }
  }

  void writeMarker(const SolverPatch& patch, const std::string& word)
  {
    std::vector<std::vector<Index>> parts;
    for (std::size_t f = patch.firstFace; f < patch.firstFace + patch.faceCount; ++f)
    {
      divideFace(mesh.mesh.points, mesh.mesh.face(f),
                 [&](std::span<const Index> part) { parts.emplace_back(part.begin(), part.end()); });
    }
    file.text("% \"").text(inOneLine(patch.name)).text("\"\nMARKER_TAG= ").text(word).text("\n");
    count("MARKER_ELEMS", parts.size());
    for (const std::vector<Index>& part : parts)
    {
      writeElement(part.size() == 3 ? triangle : quadrilateral, part);
      file.text("\n");
    }
  }

  const SolverMesh& mesh;
  const NativeCells& cells;
  OutputFile file;
};

} // namespace

void writeSU2Mesh(const std::filesystem::path& file, const SolverMesh& mesh, const NativeCells& cells,
                  const RunContext& context)
{
  writeInPlace(file,
               [&](const std::filesystem::path& place) { SU2Writer(place, mesh, cells, context.progress).write(); });
}

} // namespace atria
