// SPDX-License-Identifier: GPL-3.0-or-later
#include "PolyMesh.h"

#include "FoamParser.h"
#include "FoamText.h"
#include "Support/Error.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <utility>

namespace atria {

namespace {

namespace fs = std::filesystem;

fs::path meshFile(const fs::path& caseFolder, const char* name) { return caseFolder / "constant" / "polyMesh" / name; }

bool isThere(const fs::path& file) { return fs::exists(file) || fs::exists(file.string() + ".gz"); }

/// Faces in the order of the file.
struct RawFaces
{
  std::vector<Index> offsets{0};
  std::vector<Index> points;
  std::vector<Index> owner;
  std::vector<Index> neighbor;

  std::size_t count() const { return offsets.size() - 1; }
};

RawFaces readFaces(FoamParser file, std::size_t pointCount)
{
  RawFaces faces;
  if (file.className() == "faceCompactList")
  {
    faces.offsets = file.labels();
    faces.points = file.labels();
    if (faces.offsets.empty() || faces.offsets.front() != 0 || faces.offsets.back() != faces.points.size() ||
        !std::is_sorted(faces.offsets.begin(), faces.offsets.end()))
    {
      file.fail("the lists of faces do not go together");
    }
  }
  else
  {
    const std::int64_t count = file.label();
    file.expect('(');
    for (std::int64_t f = 0; f < count; ++f)
    {
      const std::vector<Index> face = file.labels();
      faces.points.insert(faces.points.end(), face.begin(), face.end());
      faces.offsets.push_back(static_cast<Index>(faces.points.size()));
    }
    file.expect(')');
  }
  const auto beyond = std::find_if(faces.points.begin(), faces.points.end(), [&](Index p) { return p >= pointCount; });
  if (beyond != faces.points.end())
  {
    file.fail("a face has point " + std::to_string(*beyond) + ", but there are " + std::to_string(pointCount));
  }
  return faces;
}

void readOwners(RawFaces& faces, const fs::path& caseFolder)
{
  faces.owner = FoamParser(meshFile(caseFolder, "owner")).labels();
  faces.neighbor = FoamParser(meshFile(caseFolder, "neighbour")).labels();
  const std::string mesh = (caseFolder / "constant" / "polyMesh").string();
  if (faces.owner.size() != faces.count() || faces.neighbor.size() > faces.count())
  {
    throw Error("'" + mesh + "': there are " + std::to_string(faces.count()) + " faces, but " +
                std::to_string(faces.owner.size()) + " owners and " + std::to_string(faces.neighbor.size()) +
                " neighbours");
  }
  for (std::size_t f = 0; f < faces.neighbor.size(); ++f)
  {
    const bool inOrder =
        f == 0 || std::pair(faces.owner[f - 1], faces.neighbor[f - 1]) <= std::pair(faces.owner[f], faces.neighbor[f]);
    if (!inOrder || faces.neighbor[f] <= faces.owner[f])
    {
      throw Error("'" + mesh + "': face " + std::to_string(f) +
                  " is not in upper-triangular order; OpenFOAM's renumberMesh sorts faces");
    }
  }
}

/// Fills the mesh. Returns the new number of each face.
std::vector<Index> sortFaces(const RawFaces& raw, FaceMesh& mesh)
{
  std::vector<Index> order(raw.count());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(raw.neighbor.size()), order.end(),
                   [&](Index a, Index b) { return raw.owner[a] < raw.owner[b]; });
  std::vector<Index> newNumber(order.size());
  mesh.neighbor.assign(raw.neighbor.begin(), raw.neighbor.end());
  for (std::size_t f = 0; f < order.size(); ++f)
  {
    const Index old = order[f];
    newNumber[old] = static_cast<Index>(f);
    mesh.owner.push_back(raw.owner[old]);
    mesh.facePoints.insert(mesh.facePoints.end(), raw.points.begin() + raw.offsets[old],
                           raw.points.begin() + raw.offsets[old + 1]);
    mesh.faceOffsets.push_back(static_cast<Index>(mesh.facePoints.size()));
  }
  for (const std::vector<Index>& cells : {raw.owner, raw.neighbor})
  {
    for (const Index cell : cells)
    {
      mesh.cellCount = std::max<std::size_t>(mesh.cellCount, std::size_t{cell} + 1);
    }
  }
  return newNumber;
}

using Entries = std::map<std::string, FoamParser::Value>;

std::size_t numberOf(const Entries& entries, const char* key, const std::string& patch, const FoamParser& file)
{
  const auto found = entries.find(key);
  std::size_t number = 0;
  if (found != entries.end())
  {
    const std::string& text = found->second.text;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size())
    {
      return number;
    }
  }
  file.fail("patch '" + patch + "' has no number " + key);
}

/// Returns each patch with its entries, in order.
std::vector<std::pair<std::string, Entries>> patchEntries(FoamParser& file)
{
  std::vector<std::pair<std::string, Entries>> patches;
  const std::int64_t count = file.label();
  file.expect('(');
  for (std::int64_t i = 0; i < count; ++i)
  {
    std::string name = file.word();
    patches.emplace_back(std::move(name), file.entries());
  }
  file.expect(')');
  return patches;
}

/// Reads `name { entries }` for each zone; the names distinguish its two lists.
template <typename Zone, typename Entry> std::vector<Zone> readZones(const fs::path& path, Entry&& entry)
{
  std::vector<Zone> zones;
  if (!isThere(path))
  {
    return zones;
  }
  FoamParser file(path);
  const std::int64_t count = file.label();
  file.expect('(');
  for (std::int64_t i = 0; i < count; ++i)
  {
    Zone zone;
    zone.name = file.word();
    file.expect('{');
    while (!file.take('}'))
    {
      const std::string key = file.word();
      if (!entry(zone, key, file))
      {
        file.untilSemicolon();
      }
    }
    zones.push_back(std::move(zone));
  }
  file.expect(')');
  return zones;
}

/// Reads `List<label>` and the list after it.
std::vector<Index> listOfLabels(FoamParser& file)
{
  file.word();
  std::vector<Index> list = file.labels();
  file.expect(';');
  return list;
}

std::vector<FaceZone> readFaceZones(const fs::path& path)
{
  return readZones<FaceZone>(path, [](FaceZone& zone, const std::string& key, FoamParser& file) {
    if (key == "faceLabels")
    {
      zone.faces = listOfLabels(file);
      return true;
    }
    if (key == "flipMap")
    {
      file.word();
      zone.flips = file.flags();
      file.expect(';');
      return true;
    }
    return false;
  });
}

std::vector<CellZone> readCellZones(const fs::path& path)
{
  return readZones<CellZone>(path, [](CellZone& zone, const std::string& key, FoamParser& file) {
    if (key == "cellLabels")
    {
      zone.cells = listOfLabels(file);
      return true;
    }
    return false;
  });
}

/// Changes the faces of zones to their new numbers.
void renumberZones(PolyMesh& poly, const std::vector<Index>& newNumber, const fs::path& caseFolder)
{
  for (FaceZone& zone : poly.faceZones)
  {
    const bool fits =
        std::all_of(zone.faces.begin(), zone.faces.end(), [&](Index face) { return face < newNumber.size(); });
    if (!fits || zone.flips.size() != zone.faces.size())
    {
      throw Error(meshFile(caseFolder, "faceZones").string() + ": zone '" + zone.name +
                  "' names faces that there are not, or not each with a flip");
    }
    std::ranges::transform(zone.faces, zone.faces.begin(), [&](Index face) { return newNumber[face]; });
  }
  for (const CellZone& zone : poly.cellZones)
  {
    if (std::any_of(zone.cells.begin(), zone.cells.end(), [&](Index cell) { return cell >= poly.mesh.cellCount; }))
    {
      throw Error(meshFile(caseFolder, "cellZones").string() + ": zone '" + zone.name +
                  "' names cells that there are not");
    }
  }
}

std::vector<PolyPatch> readPatches(FoamParser file, const std::vector<Index>& newNumber, std::size_t internal)
{
  std::vector<PolyPatch> patches;
  std::size_t next = internal;
  for (const auto& [name, entries] : patchEntries(file))
  {
    const auto type = entries.find("type");
    PolyPatch patch{name, type == entries.end() ? "" : type->second.text, {}};
    for (const auto& [key, value] : entries)
    {
      if (key != "type" && key != "startFace" && key != "nFaces")
      {
        patch.others[key] = value.text;
      }
    }
    const std::size_t start = numberOf(entries, "startFace", name, file);
    const std::size_t count = numberOf(entries, "nFaces", name, file);
    if (start != next || count > newNumber.size() - start)
    {
      file.fail("patch '" + name + "' has " + std::to_string(count) + " faces from " + std::to_string(start) +
                " on, but should begin at " + std::to_string(next) + " and end at " + std::to_string(newNumber.size()) +
                " at most");
    }
    next += count;
    patch.faces.assign(newNumber.begin() + static_cast<std::ptrdiff_t>(start),
                       newNumber.begin() + static_cast<std::ptrdiff_t>(next));
    patches.push_back(std::move(patch));
  }
  if (next != newNumber.size())
  {
    file.fail("the patches end at face " + std::to_string(next) + ", but there are " +
              std::to_string(newNumber.size()));
  }
  return patches;
}

} // namespace

void setPatchTypes(const fs::path& caseFolder, const std::map<std::string, std::string>& types)
{
  const fs::path path = meshFile(caseFolder, "boundary");
  FoamParser file(path);
  std::string text = file.text();
  const auto patches = patchEntries(file);
  for (auto patch = patches.rbegin(); patch != patches.rend(); ++patch) // places before stay where they are
  {
    const auto wanted = types.find(patch->first);
    const auto type = patch->second.find("type");
    if (wanted != types.end() && type != patch->second.end())
    {
      text.replace(type->second.offset, type->second.text.size(), wanted->second);
    }
  }
  writePlainFile(path, text);
}

PolyMesh readPolyMesh(const fs::path& caseFolder)
{
  if (!fs::is_directory(caseFolder / "constant" / "polyMesh"))
  {
    throw Error("'" + caseFolder.string() + "' has no mesh of OpenFOAM: there is no folder constant/polyMesh");
  }
  PolyMesh poly;
  poly.mesh.points = FoamParser(meshFile(caseFolder, "points")).vectors();
  RawFaces faces = readFaces(FoamParser(meshFile(caseFolder, "faces")), poly.mesh.points.size());
  readOwners(faces, caseFolder);
  const std::vector<Index> newNumber = sortFaces(faces, poly.mesh);
  poly.patches = readPatches(FoamParser(meshFile(caseFolder, "boundary")), newNumber, poly.mesh.internalFaceCount());
  poly.faceZones = readFaceZones(meshFile(caseFolder, "faceZones"));
  poly.cellZones = readCellZones(meshFile(caseFolder, "cellZones"));
  renumberZones(poly, newNumber, caseFolder);
  return poly;
}

} // namespace atria
