// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/CellZones.h"

#include "Support/Error.h"

#include <algorithm>

namespace atria {

std::vector<Index> cellZonesOf(const SurfaceModel& model)
{
  std::vector<Index> zones;
  for (Index surface = 0; surface < model.kinds.size(); ++surface)
  {
    if (model.kinds[surface] == SurfaceKind::cellZone)
    {
      zones.push_back(surface);
    }
  }
  return zones;
}

void failOpenCellZone(const std::string& surface)
{
  throw Error("surface '" + surface +
              "' is to enclose a cell zone, but it is not closed: close its holes, or leave it out");
}

bool fillCellZone(Index surface, const SurfaceDepths& depths, std::span<const int> outside, Index first,
                  std::vector<std::int32_t>& zoneOf)
{
  bool any = false;
  for (const PointDepth& at : depths.points)
  {
    if (at.depth > outside[at.part])
    {
      std::int32_t& zone = zoneOf[at.point - first];
      zone = zone == noCellZone ? static_cast<std::int32_t>(surface) : zone;
      any = true;
    }
  }
  return any;
}

std::vector<std::int32_t> findCellZones(const Crossings& crossings, const GridPlaces& grid, const SurfaceModel& model,
                                        const RunContext& context)
{
  const std::vector<Index> zones = cellZonesOf(model);
  if (zones.empty())
  {
    return {};
  }
  const auto count = static_cast<Index>(crossings.neighbors.size());
  std::vector<std::int32_t> zoneOf(count, noCellZone);
  const DepthFinder finder(crossings, grid, model, 0, count);
  for (const Index surface : zones)
  {
    context.progress.check();
    const SurfaceDepths depths = finder.find(surface);
    const auto outside = depths.isClosed ? depthsOutside(depths.parts, depths.links) : std::nullopt;
    if (!outside || (!fillCellZone(surface, depths, *outside, 0, zoneOf) && depths.isMet))
    {
      failOpenCellZone(model.names[surface]);
    }
  }
  return zoneOf;
}

std::vector<char> metCellZones(std::span<const std::int32_t> zones, const SurfaceModel& model)
{
  std::vector<char> isMet(model.names.size(), 0);
  for (const std::int32_t zone : zones)
  {
    if (zone != noCellZone)
    {
      isMet[static_cast<std::size_t>(zone)] = 1;
    }
  }
  return isMet;
}

std::vector<std::string> warningsOfEmptyCellZones(const std::vector<char>& isMet, const SurfaceModel& model)
{
  std::vector<std::string> warnings;
  for (const Index surface : cellZonesOf(model))
  {
    if (!isMet[surface])
    {
      warnings.push_back(
          "cell zone '" + model.names[surface] +
          "' holds no element: it is outside of the mesh, within another zone, has all of its faces in "
          "common with other surfaces, or is smaller than elements there; if so, give its surface a size");
    }
  }
  return warnings;
}

} // namespace atria
