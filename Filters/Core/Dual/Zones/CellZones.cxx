// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/CellZones.h"

#include "Support/Error.h"
#include "Support/GlobalCount.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <optional>

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

namespace {

/// A point of another process within a surface's bounds: the part that sees it, the depth from there, and whether it is
/// sure, as in DepthLink.
struct SeenDepth
{
  Index part;
  int depth;
  bool isSure;
};

const PointDepth& depthAt(Index point, const SurfaceDepths& depths)
{
  const auto found = std::ranges::lower_bound(depths.points, point, {}, &PointDepth::point);
  if (found == depths.points.end() || found->point != point)
  {
    throw RanksDisagree("a grid point within the bounds of a cell zone is not known to its owner");
  }
  return *found;
}

/// Returns the links between the parts of all processes, which are numbered one process after the other. The parts of
/// this process begin at `first`.
std::vector<DepthLink> joinLinks(const SurfaceDepths& depths, Index first, const GridPart& part)
{
  std::vector<DepthLink> own;
  for (const DepthLink& link : depths.links)
  {
    own.push_back({first + link.part, first + link.other, link.depth, link.isSure});
  }
  std::vector<AtPoint<SeenDepth>> seen;
  for (const auto& [joint, isSure] : depths.joints)
  {
    seen.push_back({joint.point, {first + joint.part, joint.depth, isSure}});
  }
  for (const auto& [point, from] : part.send(seen))
  {
    const PointDepth& at = depthAt(point, depths);
    own.push_back({from.part, first + at.part, at.depth - from.depth, from.isSure});
  }
  sortUnique(own);
  return joinAll(part.exchange(), std::move(own));
}

/// Gives own points that a surface encloses its number, unless they have one. Returns false, in all processes, if the
/// surface is not closed.
bool fillZone(Index surface, const SurfaceDepths& depths, const GridPart& part, std::vector<std::int32_t>& zoneOf)
{
  RankExchange& exchange = part.exchange();
  const auto first = static_cast<Index>(countBefore(depths.parts.size(), exchange).before);
  const std::optional<std::vector<int>> outside =
      depthsOutside(joinAll(exchange, depths.parts), joinLinks(depths, first, part));
  if (isAnywhere(!depths.isClosed || !outside, exchange))
  {
    return false;
  }
  bool encloses = false;
  for (const PointDepth& at : depths.points)
  {
    if (at.depth > (*outside)[first + at.part])
    {
      std::int32_t& zone = zoneOf[at.point];
      zone = zone == noCellZone ? static_cast<std::int32_t>(surface) : zone;
      encloses = true;
    }
  }
  return isAnywhere(encloses, exchange) || !isAnywhere(depths.isMet, exchange);
}

} // namespace

std::vector<std::int32_t> findCellZones(const Crossings& crossings, const GridPlaces& grid, const GridPart& part,
                                        const SurfaceModel& model, const RunContext& context)
{
  const std::vector<Index> zones = cellZonesOf(model);
  if (zones.empty())
  {
    return {};
  }
  std::vector<std::int32_t> zoneOf(crossings.neighbors.size(), noCellZone);
  const DepthFinder finder(crossings, grid, model, part.points().begin, part.points().end);
  for (const Index surface : zones)
  {
    context.progress.check();
    const SurfaceDepths depths = finder.find(surface);
    if (!fillZone(surface, depths, part, zoneOf))
    {
      throw Error("surface '" + model.names[surface] +
                  "' is to enclose a cell zone, but it is not closed: close its holes, or leave it out");
    }
  }
  part.refresh(zoneOf, noCellZone);
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
