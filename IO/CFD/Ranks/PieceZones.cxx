// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/PieceZones.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace atria {

namespace {

/// Merges the zones of all ranks by name.
class ZoneGatherer
{
public:
  void add(const VtkPatches& some)
  {
    for (const VtkPatches::Patch& zone : some.patches)
    {
      const auto [known, isNew] = numbers.try_emplace(zone.name, names.size());
      if (isNew)
      {
        names.push_back(zone.name);
        faces.emplace_back();
      }
      VtkPatches& to = faces[known->second];
      for (std::size_t f = zone.firstFace; f < zone.firstFace + zone.faceCount; ++f)
      {
        to.append(some.owners[f], some.neighbors[f], some.face(f));
      }
    }
  }

  VtkPatches take()
  {
    VtkPatches out;
    for (std::size_t zone = 0; zone < names.size(); ++zone)
    {
      const std::size_t first = out.owners.size();
      for (std::size_t f = 0; f < faces[zone].owners.size(); ++f)
      {
        out.append(faces[zone].owners[f], faces[zone].neighbors[f], faces[zone].face(f));
      }
      out.close(names[zone], first);
    }
    return out;
  }

private:
  std::map<std::string, std::size_t> numbers;
  std::vector<std::string> names;
  std::vector<VtkPatches> faces;
};

VtkPatches gatherZones(const VtkPatches& own, RankExchange& exchange)
{
  std::vector<char> names; // each with a zero after it
  std::vector<std::size_t> counts;
  for (const VtkPatches::Patch& zone : own.patches)
  {
    names.insert(names.end(), zone.name.c_str(), zone.name.c_str() + zone.name.size() + 1);
    counts.push_back(zone.faceCount);
  }
  ZoneGatherer gatherer;
  for (const Bytes& bytes : exchange.gather(bytesOf(names, counts, own.owners, own.neighbors, own.offsets, own.points)))
  {
    VtkPatches some;
    readBytes(bytes, names, counts, some.owners, some.neighbors, some.offsets, some.points);
    const char* name = names.data();
    std::size_t first = 0;
    for (const std::size_t count : counts)
    {
      some.patches.push_back({name, first, count});
      name += some.patches.back().name.size() + 1;
      first += count;
    }
    gatherer.add(some);
  }
  return gatherer.take();
}

/// Returns the index of a number in an ascending list; noIndex if it is not there.
Index placeOf(std::int64_t id, const std::vector<std::int64_t>& rising)
{
  const auto found = std::ranges::lower_bound(rising, id);
  return found != rising.end() && *found == id ? static_cast<Index>(found - rising.begin()) : noIndex;
}

} // namespace

PieceZones::PieceZones(const MeshPiece& piece, RankExchange& exchange)
    : all(gatherZones(piece.facesOfZones(), exchange))
{
}

void PieceZones::find(const WideNumbers& piece, const FaceMesh& mesh, const Executor& executor)
{
  VtkPatches here;
  std::vector<Index> zoneOf;
  for (Index zone = 0; zone < all.patches.size(); ++zone)
  {
    const VtkPatches::Patch& its = all.patches[zone];
    for (std::size_t f = its.firstFace; f < its.firstFace + its.faceCount; ++f)
    {
      const Index owner = piece.findCell(all.owners[f]);
      const Index neighbor = piece.findCell(all.neighbors[f]);
      if (owner == noIndex || neighbor == noIndex)
      {
        continue;
      }
      std::vector<std::int64_t> corners;
      std::ranges::transform(all.face(f), std::back_inserter(corners),
                             [&](std::int64_t id) { return std::int64_t{placeOf(id, piece.pointIds)}; });
      here.append(owner, neighbor, corners);
      zoneOf.push_back(zone);
    }
  }
  found.clear();
  std::ranges::transform(all.patches, std::back_inserter(found), [](const VtkPatches::Patch& zone) {
    return ZonedFaces{zone.name, {}};
  });
  const std::vector<BoundaryFaceKey> keys = here.keys();
  const std::vector<Index> faces = findInternalFaces(mesh, keys, here.neighbors, executor);
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    if (faces[f] == noIndex)
    {
      throw RanksDisagree("a face of face zone '" + all.patches[zoneOf[f]].name + "' is no face between its cells");
    }
    found[zoneOf[f]].faces.push_back(zonedFace(mesh, faces[f], here.owners[f]));
  }
}

} // namespace atria
