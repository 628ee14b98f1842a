// SPDX-License-Identifier: GPL-3.0-or-later
#include "GmshEntities.h"

#include "GmshMesh.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace atria {

namespace {

const char* const restName = "fluid"; // cells in no zone

/// Cells that are in the same zones.
struct Region
{
  std::vector<Index> zones;
  std::vector<Index> cells;
};

std::vector<Region> regionsOf(const SolverMesh& mesh)
{
  std::vector<Region> regions(1);
  std::vector<Index> regionOf(mesh.mesh.cellCount, 0);
  for (std::size_t z = 0; z < mesh.cellZones.size(); ++z)
  {
    std::map<Index, Index> within; // regions in this zone, by the region that they were a part of
    for (const Index cell : mesh.cellZones[z].cells)
    {
      const auto [place, isNew] = within.try_emplace(regionOf[cell], static_cast<Index>(regions.size()));
      if (isNew)
      {
        regions.push_back({regions[regionOf[cell]].zones, {}});
        regions.back().zones.push_back(static_cast<Index>(z));
      }
      regionOf[cell] = place->second;
    }
  }
  for (std::size_t cell = 0; cell < regionOf.size(); ++cell)
  {
    regions[regionOf[cell]].cells.push_back(static_cast<Index>(cell));
  }
  std::erase_if(regions, [](const Region& region) { return region.cells.empty(); });
  return regions;
}

class EntityMaker
{
public:
  explicit EntityMaker(const ElementMesh& source) : mesh(source), solverMesh(source.mesh), faces(source.mesh.mesh) {}

  GmshEntities run()
  {
    names = wordsOf();
    addSurfaces();
    addVolumes();
    dealOutPoints();
    return std::move(out);
  }

private:
  /// Returns the names of patches, of zones, and of the cells in no zone.
  std::vector<PatchName> wordsOf() const
  {
    std::vector<std::string> others;
    std::ranges::transform(solverMesh.cellZones, std::back_inserter(others), &CellZone::name);
    others.emplace_back(restName);
    return namesOf(solverMesh.patches, gmshNames, others);
  }

  Index addGroup(int dimension, const PatchName& word, const std::string& name)
  {
    out.groups.push_back({dimension, out.groups.size() + 1, word.word, name});
    return static_cast<Index>(out.groups.size());
  }

  void addSurfaces()
  {
    for (std::size_t p = 0; p < solverMesh.patches.size(); ++p)
    {
      const SolverPatch& patch = solverMesh.patches[p];
      if (patch.faceCount > 0)
      {
        GmshEntity& surface = out.surfaces.emplace_back();
        surface.groups = {addGroup(2, names[p], patch.name)};
        surface.members.resize(patch.faceCount);
        std::iota(surface.members.begin(), surface.members.end(), static_cast<Index>(patch.firstFace));
      }
    }
  }

  void addVolumes()
  {
    std::vector<Region> regions = regionsOf(solverMesh);
    const std::size_t patches = solverMesh.patches.size();
    std::vector<Index> tags;
    for (std::size_t z = 0; z < solverMesh.cellZones.size(); ++z)
    {
      tags.push_back(addGroup(3, names[patches + z], solverMesh.cellZones[z].name));
    }
    for (Region& region : regions)
    {
      GmshEntity& volume = out.volumes.emplace_back();
      std::ranges::stable_sort(region.zones, {}, [&](Index z) { return solverMesh.cellZones[z].cells.size(); });
      std::ranges::transform(region.zones, std::back_inserter(volume.groups), [&](Index z) { return tags[z]; });
      if (region.zones.empty())
      {
        volume.groups = {addGroup(3, names.back(), restName)};
      }
      volume.members = std::move(region.cells);
    }
    findBounds();
  }

  void findBounds()
  {
    std::vector<Index> volumeOf(faces.cellCount);
    for (std::size_t v = 0; v < out.volumes.size(); ++v)
    {
      std::ranges::for_each(out.volumes[v].members, [&](Index cell) { volumeOf[cell] = static_cast<Index>(v); });
    }
    for (std::size_t s = 0; s < out.surfaces.size(); ++s)
    {
      for (const Index face : out.surfaces[s].members)
      {
        std::vector<Index>& bounds = out.volumes[volumeOf[faces.owner[face]]].bounds;
        if (bounds.empty() || bounds.back() != s + 1)
        {
          bounds.push_back(static_cast<Index>(s + 1));
        }
      }
    }
  }

  void dealOutPoints()
  {
    isDealt.assign(faces.points.size(), false);
    for (GmshEntity& surface : out.surfaces)
    {
      takePoints(surface, [&](Index face) { return faces.face(face); });
    }
    for (GmshEntity& volume : out.volumes)
    {
      takePoints(volume, [&](Index cell) { return mesh.elements.cornersOf(cell); });
    }
  }

  template <typename PointsOf> void takePoints(GmshEntity& entity, PointsOf&& pointsOf)
  {
    entity.low = entity.high = faces.points[pointsOf(entity.members.front())[0]];
    for (const Index member : entity.members)
    {
      for (const Index p : pointsOf(member))
      {
        entity.low = entity.low.cwiseMin(faces.points[p]);
        entity.high = entity.high.cwiseMax(faces.points[p]);
        if (!isDealt[p])
        {
          isDealt[p] = true;
          entity.points.push_back(p);
        }
      }
    }
    std::ranges::sort(entity.points);
  }

  const ElementMesh& mesh;
  const SolverMesh& solverMesh;
  const FaceMesh& faces;
  std::vector<PatchName> names;
  std::vector<bool> isDealt;
  GmshEntities out;
};

} // namespace

GmshEntities gmshEntitiesOf(const ElementMesh& mesh) { return EntityMaker(mesh).run(); }

} // namespace atria
