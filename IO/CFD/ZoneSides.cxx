// SPDX-License-Identifier: GPL-3.0-or-later
#include "ZoneSides.h"

#include "Support/Error.h"

#include <algorithm>
#include <set>

namespace atria {

namespace {

/// Group of patches that marks the sides of zones on file.
constexpr const char* groupOfSides = "zoneSides";

/// New number of a face, and that of the copy that its old neighbor owns.
struct NewFace
{
  Index own = noIndex;
  Index copy = noIndex;
  bool isTurned = false; ///< the new face's normal is opposite
};

/// Rebuilds a mesh from its faces in a new order. A face that appears twice is divided.
std::vector<NewFace> rebuild(FaceMesh& mesh, std::vector<OrderedFace> faces)
{
  std::ranges::sort(faces);
  FaceMesh out;
  out.points = std::move(mesh.points);
  out.cellCount = mesh.cellCount;
  std::vector<NewFace> numbers(mesh.faceCount());
  std::vector<Index> loop;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    const OrderedFace& face = faces[i];
    const auto old = mesh.face(face.face);
    loop.assign(old.begin(), old.end());
    if (face.turned) // turned around, the first point stays the first
    {
      // Clang 14 cannot compile std::ranges::rotate of this library.
      std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
    appendFace(out, face, loop);
    NewFace& number = numbers[face.face];
    const bool isCopy = face.onBoundary && face.turned;
    (isCopy ? number.copy : number.own) = static_cast<Index>(i);
    number.isTurned = face.turned && !face.onBoundary;
  }
  mesh = std::move(out);
  return numbers;
}

FaceZone& zoneCalled(PolyMesh& poly, const std::string& name)
{
  const auto found = std::ranges::find(poly.faceZones, name, &FaceZone::name);
  if (found == poly.faceZones.end())
  {
    throw Error("the mesh has no face zone '" + name + "'");
  }
  return *found;
}

void refuseTakenNames(const PolyMesh& poly, const std::string& zone)
{
  const auto sides = sidesOfZone(zone);
  const auto taken = std::ranges::find_if(sides, [&](const std::string& name) {
    return std::ranges::find(poly.patches, name, &PolyPatch::name) != poly.patches.end();
  });
  if (taken != sides.end())
  {
    throw Error("the mesh has a patch '" + *taken + "' already, which is the name of a side of '" + zone + "'");
  }
  if (std::ranges::find(poly.cellZones, cellsBesideZone(zone), &CellZone::name) != poly.cellZones.end())
  {
    throw Error("the mesh has a cell zone '" + cellsBesideZone(zone) +
                "' already, which is the name of the cells beside '" + zone + "'");
  }
}

/// The sides of the faces to divide: +1 if the first side is that of the face's owner, -1 if of its neighbor, else 0.
std::vector<int> firstSides(PolyMesh& poly, std::span<const DividedZone> zones)
{
  std::vector<int> sides(poly.mesh.internalFaceCount(), 0);
  for (const DividedZone& divided : zones)
  {
    refuseTakenNames(poly, divided.zone);
    const FaceZone& zone = zoneCalled(poly, divided.zone);
    for (std::size_t i = 0; i < zone.faces.size(); ++i)
    {
      if (zone.faces[i] >= sides.size())
      {
        throw Error("face zone '" + zone.name + "' has faces on the boundary of the mesh");
      }
      int& side = sides[zone.faces[i]];
      if (side != 0)
      {
        throw Error("face zone '" + zone.name + "' shares faces with another zone that has a screen or a fan");
      }
      side = (zone.flips[i] != 0) == divided.isTurned ? 1 : -1;
    }
  }
  return sides;
}

std::vector<OrderedFace> dividedFaces(const FaceMesh& mesh, const std::vector<int>& sides)
{
  std::vector<OrderedFace> faces;
  for (Index f = 0; f < mesh.faceCount(); ++f)
  {
    const bool isInternal = f < mesh.internalFaceCount();
    const bool isDivided = isInternal && sides[f] != 0;
    faces.push_back(orderFace(f, mesh.owner[f], isInternal && !isDivided ? mesh.neighbor[f] : noIndex));
    if (isDivided)
    {
      faces.push_back(orderFace(f, noIndex, mesh.neighbor[f]));
    }
  }
  return faces;
}

PolyPatch sideOf(const std::string& name, const std::string& other)
{
  return {name, "cyclic", {}, {{"inGroups", std::string("1(") + groupOfSides + ")"}, {"neighbourPatch", other}}};
}

/// Adds the patches of a zone and the cells beside them. The zone's faces have their old numbers.
void addSides(PolyMesh& poly, const FaceZone& zone, const std::vector<int>& sides, const std::vector<NewFace>& numbers)
{
  const std::array<std::string, 2> names = sidesOfZone(zone.name);
  PolyPatch first = sideOf(names[0], names[1]);
  PolyPatch second = sideOf(names[1], names[0]);
  CellZone beside{cellsBesideZone(zone.name), {}};
  for (const Index face : zone.faces)
  {
    const NewFace& number = numbers[face];
    first.faces.push_back(sides[face] > 0 ? number.own : number.copy);
    second.faces.push_back(sides[face] > 0 ? number.copy : number.own);
    beside.cells.push_back(poly.mesh.owner[first.faces.back()]);
    beside.cells.push_back(poly.mesh.owner[second.faces.back()]);
  }
  std::ranges::sort(beside.cells);
  beside.cells.erase(std::unique(beside.cells.begin(), beside.cells.end()), beside.cells.end());
  poly.patches.push_back(std::move(first));
  poly.patches.push_back(std::move(second));
  poly.cellZones.push_back(std::move(beside));
}

bool isMarked(const PolyPatch& patch)
{
  const auto groups = patch.others.find("inGroups");
  return patch.type == "cyclic" && groups != patch.others.end() &&
         groups->second.find(groupOfSides) != std::string::npos;
}

/// Returns the faces of a mesh in which each boundary face and its entry of `other` are one internal face.
std::vector<OrderedFace> unitedFaces(const FaceMesh& mesh, const std::vector<Index>& other)
{
  std::vector<char> isGone(mesh.faceCount(), 0);
  for (const Index face : other)
  {
    if (face != noIndex)
    {
      isGone[face] = 1;
    }
  }
  std::vector<OrderedFace> faces;
  for (Index f = 0; f < mesh.faceCount(); ++f)
  {
    const bool isInternal = f < mesh.internalFaceCount();
    const Index united = other[f] == noIndex ? noIndex : mesh.owner[other[f]];
    if (!isGone[f])
    {
      faces.push_back(orderFace(f, mesh.owner[f], isInternal ? mesh.neighbor[f] : united));
    }
  }
  return faces;
}

void renumber(PolyMesh& poly, const std::vector<NewFace>& numbers)
{
  for (PolyPatch& patch : poly.patches)
  {
    std::ranges::transform(patch.faces, patch.faces.begin(), [&](Index face) { return numbers[face].own; });
  }
}

} // namespace

std::array<std::string, 2> sidesOfZone(const std::string& zone) { return {zone + "_side1", zone + "_side2"}; }

std::string cellsBesideZone(const std::string& zone) { return zone + "_sides"; }

void divideZones(PolyMesh& poly, std::span<const DividedZone> zones)
{
  const std::vector<int> sides = firstSides(poly, zones);
  const std::vector<NewFace> numbers = rebuild(poly.mesh, dividedFaces(poly.mesh, sides));
  renumber(poly, numbers);
  for (const DividedZone& divided : zones)
  {
    const FaceZone zone = zoneCalled(poly, divided.zone);
    addSides(poly, zone, sides, numbers);
  }
  for (FaceZone& zone : poly.faceZones)
  {
    for (std::size_t i = 0; i < zone.faces.size(); ++i)
    {
      const Index old = zone.faces[i];
      const bool isOfNeighbor = old < sides.size() && sides[old] < 0;
      zone.faces[i] = isOfNeighbor ? numbers[old].copy : numbers[old].own;
      zone.flips[i] = static_cast<char>((zone.flips[i] != 0) != isOfNeighbor);
    }
  }
}

std::vector<std::array<std::size_t, 2>> pairsOfSides(const PolyMesh& poly)
{
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t i = 0; i < poly.patches.size(); ++i)
  {
    const auto name = poly.patches[i].others.find("neighbourPatch");
    for (std::size_t j = i + 1; name != poly.patches[i].others.end() && j < poly.patches.size(); ++j)
    {
      if (poly.patches[j].name == name->second && isMarked(poly.patches[i]) && isMarked(poly.patches[j]) &&
          poly.patches[i].faces.size() == poly.patches[j].faces.size())
      {
        pairs.push_back({i, j});
      }
    }
  }
  return pairs;
}

bool uniteSides(PolyMesh& poly)
{
  const std::vector<std::array<std::size_t, 2>> pairs = pairsOfSides(poly);
  if (pairs.empty())
  {
    return false;
  }
  std::vector<Index> other(poly.mesh.faceCount(), noIndex);
  std::set<std::string> names;
  for (const auto& [first, second] : pairs)
  {
    for (std::size_t i = 0; i < poly.patches[first].faces.size(); ++i)
    {
      other[poly.patches[first].faces[i]] = poly.patches[second].faces[i];
    }
    names.insert({poly.patches[first].name, poly.patches[second].name});
    const std::string zone = poly.patches[first].name.substr(0, poly.patches[first].name.rfind('_'));
    std::erase_if(poly.cellZones, [&](const CellZone& cells) { return cells.name == cellsBesideZone(zone); });
  }
  std::erase_if(poly.patches, [&](const PolyPatch& patch) { return names.contains(patch.name); });
  std::vector<NewFace> numbers = rebuild(poly.mesh, unitedFaces(poly.mesh, other));
  for (std::size_t f = 0; f < other.size(); ++f)
  {
    if (other[f] != noIndex)
    {
      numbers[other[f]] = {numbers[f].own, noIndex, !numbers[f].isTurned};
    }
  }
  renumber(poly, numbers);
  for (FaceZone& zone : poly.faceZones)
  {
    for (std::size_t i = 0; i < zone.faces.size(); ++i)
    {
      const NewFace& number = numbers[zone.faces[i]];
      zone.faces[i] = number.own;
      zone.flips[i] = static_cast<char>((zone.flips[i] != 0) != number.isTurned);
    }
  }
  return true;
}

} // namespace atria
