// SPDX-License-Identifier: GPL-3.0-or-later
#include "PolyMeshWriter.h"

namespace atria {

namespace {

namespace fs = std::filesystem;

const char* const meshLocation = "constant/polyMesh";

template <typename Container> std::int64_t lengthOf(const Container& container)
{
  return static_cast<std::int64_t>(container.size());
}

void writeFace(OpenFOAMFile& file, std::span<const Index> face)
{
  file.text("\n").number(lengthOf(face)).text("(");
  for (std::size_t i = 0; i < face.size(); ++i)
  {
    file.text(i == 0 ? "" : " ").number(std::int64_t{face[i]});
  }
  file.text(")");
}

} // namespace

static_assert(sizeof(Vec3) == 3 * sizeof(double)); // written as they are

PolyMeshWriter::PolyMeshWriter(fs::path target, const FaceMesh& source, OpenFOAMFormat listFormat,
                               const ProgressRange& range)
    : folder(std::move(target)), mesh(source), format(listFormat), progress(range)
{
  note = "nPoints:" + std::to_string(mesh.points.size()) + "  nCells:" + std::to_string(mesh.cellCount) +
         "  nFaces:" + std::to_string(mesh.faceCount()) +
         "  nInternalFaces:" + std::to_string(mesh.internalFaceCount());
}

OpenFOAMFile PolyMeshWriter::open(const char* name, const char* className, const std::string& itsNote) const
{
  return OpenFOAMFile(folder / name, {className, meshLocation, itsNote, format}, &progress);
}

template <typename Label> void PolyMeshWriter::writeLabels(OpenFOAMFile& file, std::span<const Label> labels) const
{
  file.number(lengthOf(labels)).text("\n(");
  if (binary())
  {
    file.raw(labels.data(), labels.size_bytes()).text(")");
    return;
  }
  for (const Label label : labels)
  {
    file.text("\n").number(std::int64_t{label});
  }
  file.text("\n)");
}

void PolyMeshWriter::writePoints() const
{
  OpenFOAMFile file = open("points", "vectorField");
  file.number(lengthOf(mesh.points)).text("\n(");
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

void PolyMeshWriter::writeFaces() const
{
  OpenFOAMFile file = open("faces", binary() ? "faceCompactList" : "faceList");
  if (binary())
  {
    // Two lists: where each face's points begin, and the points of all.
    writeLabels(file, std::span<const Index>(mesh.faceOffsets));
    file.text("\n\n");
    writeLabels(file, std::span<const Index>(mesh.facePoints));
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

void PolyMeshWriter::writeOwners() const
{
  OpenFOAMFile file = open("owner", "labelList", note);
  writeLabels(file, std::span<const Index>(mesh.owner));
  file.text("\n").close();
}

void PolyMeshWriter::writeNeighbors() const
{
  OpenFOAMFile file = open("neighbour", "labelList", note);
  writeLabels(file, std::span<const Index>(mesh.neighbor));
  file.text("\n").close();
}

void PolyMeshWriter::writeLabelFile(const char* name, std::span<const std::int32_t> labels) const
{
  OpenFOAMFile file = open(name, "labelList");
  writeLabels(file, labels);
  file.text("\n").close();
}

void PolyMeshWriter::writeBoundary(std::span<const PatchEntry> patches) const
{
  // Always text, as OpenFOAM itself writes it.
  OpenFOAMFile file(folder / "boundary", {"polyBoundaryMesh", meshLocation, "", OpenFOAMFormat::Ascii});
  const auto entry = [&](const std::string& key) -> OutputFile& {
    return file.text("        ").text(key).text(std::string(key.size() < 16 ? 16 - key.size() : 1, ' '));
  };
  file.number(lengthOf(patches)).text("\n(\n");
  for (const PatchEntry& patch : patches)
  {
    if (!patch.comment.empty())
    {
      file.text("    // ").text(patch.comment).text("\n");
    }
    file.text("    ").text(patch.name).text("\n    {\n");
    for (const auto& [key, value] : patch.entries)
    {
      entry(key).text(value).text(";\n");
    }
    entry("nFaces").number(static_cast<std::int64_t>(patch.faceCount)).text(";\n");
    entry("startFace").number(static_cast<std::int64_t>(patch.firstFace)).text(";\n    }\n");
  }
  file.text(")\n").close();
}

/// Writes zones; write(file, zone) writes the content of one.
template <typename Zone, typename Write>
void PolyMeshWriter::writeZones(const char* name, std::span<const Zone> zones, Write&& write) const
{
  if (zones.empty())
  {
    return;
  }
  OpenFOAMFile file = open(name, "regIOobject");
  file.number(lengthOf(zones)).text("\n(\n");
  for (const Zone& zone : zones)
  {
    file.text(zone.name).text("\n{\n");
    write(file, zone);
    file.text("}\n");
  }
  file.text(")\n").close();
}

void PolyMeshWriter::writeFaceZones(std::span<const FaceZone> zones) const
{
  writeZones("faceZones", zones, [&](OpenFOAMFile& file, const FaceZone& zone) {
    file.text("    type faceZone;\n    faceLabels List<label>\n");
    writeLabels(file, std::span<const Index>(zone.faces));
    file.text(";\n    flipMap List<bool>\n");
    writeFlips(file, zone.flips);
    file.text(";\n");
  });
}

void PolyMeshWriter::writeCellZones(std::span<const CellZone> zones) const
{
  writeZones("cellZones", zones, [&](OpenFOAMFile& file, const CellZone& zone) {
    file.text("    type cellZone;\n    cellLabels List<label>\n");
    writeLabels(file, std::span<const Index>(zone.cells));
    file.text(";\n");
  });
}

void PolyMeshWriter::writeFlips(OpenFOAMFile& file, std::span<const char> flips) const
{
  file.number(lengthOf(flips)).text("\n(");
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

} // namespace atria
