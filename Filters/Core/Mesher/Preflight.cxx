// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Preflight.h"

#include "Mesher/ModelStages.h"
#include "Octree/Sizing/ElementBudget.h"
#include "Octree/Tree/SplitOctants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace atria {

namespace {

/// Fewest octants across a space that resolve a flow in it.
constexpr double fewestAcross = 3.0;
/// Height above any building, in meters: a higher model is likely to be in inches or feet.
constexpr double highestBuilding = 830.0;

template <typename... Parts> std::string text(const Parts&... parts)
{
  std::ostringstream out;
  out.precision(4);
  (out << ... << parts);
  return out.str();
}

void measureDistances(const TriangleSurface& surface, const SitePlan& plan, const Box3& buildings, Preflight& out)
{
  std::vector<double> nearest(sideNumbers, std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (const Index p : surface.triangles[t])
    {
      const Vec2 at = plan.domain.axes.fromModel(surface.points[p]).head<2>();
      for (const PrismSide& side : plan.domain.sides())
      {
        double& least = nearest[side.number];
        least = plan.isGround[surface.surfaceIds[t]] ? least : std::min(least, -side.beyond(at));
      }
    }
  }
  for (const PrismSide& side : plan.domain.sides())
  {
    out.distances[side.number] = nearest[side.number] / out.buildingHeight;
  }
  out.distances[zMax] = (plan.domain.bounds.max[2] - buildings.max[2]) / out.buildingHeight;
}

void measureBlockages(const TriangleSurface& surface, const SitePlan& plan, double floor, Preflight& out)
{
  std::vector<const PrismSide*> known;
  for (const PrismSide& side : plan.domain.sides())
  {
    if (plan.domain.isBox() && side.number != xMin)
    {
      continue;
    }
    // Opposite sides have the same blockage.
    const auto facing = std::ranges::find_if(
        known, [&](const PrismSide* other) { return other->normal.dot(side.normal) < -1.0 + 1e-12; });
    double& blockage = out.blockages[side.number];
    if (facing != known.end())
    {
      blockage = out.blockages[(*facing)->number];
      continue;
    }
    const double towards = std::atan2(-side.normal[1], -side.normal[0]) * 180.0 / std::numbers::pi;
    const Placement along(plan.domain.axes.angle() + towards);
    const double section = boundsAlong(along, plan.domain).size()[1] * (plan.domain.bounds.max[2] - floor);
    blockage = section > 0.0 ? frontalArea(surface, plan.isGround, along, floor) / section : 0.0;
    known.push_back(&side);
  }
  for (const PrismSide* side : known)
  {
    out.mostBlocked = out.blockages[side->number] > out.blockages[out.mostBlocked] ? side->number : out.mostBlocked;
  }
}

void measureSite(const TriangleSurface& surface, const SitePlan& plan, Preflight& out)
{
  const Box3 buildings = boundsOfBuildings(surface, plan.isGround, plan.domain.axes);
  out.buildingHeight = heightOfBuildings(surface, {plan.isGround, plan.floor});
  if (buildings.empty() || !(out.buildingHeight > 0.0))
  {
    out.buildingHeight = 0.0;
    return;
  }
  measureDistances(surface, plan, buildings, out);
  const double lowest = lowestGround(surface, {plan.isGround, plan.floor});
  measureBlockages(surface, plan, std::max(lowest, plan.domain.bounds.min[2]), out);
}

std::size_t leavesInside(const Octree& octree)
{
  const GridFrame& frame = octree.frame();
  std::size_t count = 0;
  for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    const bool inside =
        !frame.turnedDomain || frame.turnedDomain->contains(frame.placement.toModel(octree.center(leaf)));
    count += octree.inDomain(leaf) && inside ? 1 : 0;
  }
  return count;
}

/// Warns of sides that are too near. Any side of a prism that is no box may be the outlet, so that the nearest one
/// stands for all.
void warnOfDistances(Preflight& out, const WindRules& rules)
{
  const std::array<double, 6> ofBox{
      rules.inletHeights, rules.outletHeights, rules.sideHeights, rules.sideHeights, -1e300, rules.topHeights};
  const auto isTooNear = [&](Index side, double least) { return out.distances[side] < least * (1.0 - 1e-6); };
  const auto warn = [&](Index side, double least, const std::string& why) {
    out.warnings.push_back(text("the side ", sideName(side), " is ", out.distances[side],
                                " building heights away, less than ", least, why));
  };
  std::vector<Index> tooNear;
  for (const PrismSide& side : out.domain.sides())
  {
    if (isTooNear(side.number, out.domain.isBox() ? ofBox[side.number] : rules.outletHeights))
    {
      tooNear.push_back(side.number);
    }
  }
  std::ranges::sort(tooNear); // sides of a box are numbered by Direction
  if (!out.domain.isBox() && !tooNear.empty())
  {
    const Index nearest = std::ranges::min(tooNear, {}, [&](Index side) { return out.distances[side]; });
    const std::string others = tooNear.size() == 1   ? ""
                               : tooNear.size() == 2 ? ", as is another"
                                                     : text(", as are ", tooNear.size() - 1, " others");
    warn(nearest, rules.outletHeights, others + "; any side may be the outlet");
    tooNear.clear();
  }
  for (const Index side : tooNear)
  {
    warn(side, ofBox[side], "");
  }
  if (isTooNear(zMax, rules.topHeights))
  {
    warn(zMax, rules.topHeights, "");
  }
}

void warnOfDomain(Preflight& out)
{
  const WindRules rules;
  if (out.buildingHeight <= 0.0)
  {
    out.warnings.push_back("there are no buildings: every surface is ground or lies flat");
    return;
  }
  if (out.buildingHeight > highestBuilding)
  {
    out.warnings.push_back(text("the buildings are ", out.buildingHeight,
                                " high: is the model in meters? One in inches is 39 times too large"));
  }
  if (out.widened > 1.0)
  {
    out.warnings.push_back(text("the distances to the sides and the top were made ", out.widened,
                                " times as large to keep the blockage at 3 %"));
  }
  const double blockage = out.blockages[out.mostBlocked];
  if (blockage > rules.mostBlockage * (1.0 + 1e-9))
  {
    const std::string wind = out.domain.isBox() ? "" : ", for wind into " + sideName(out.mostBlocked);
    out.warnings.push_back(text("the buildings block ", 100.0 * blockage, " % of the domain's cross-section", wind,
                                ", more than ", 100.0 * rules.mostBlockage, " %: make the domain wider or higher"));
  }
  warnOfDistances(out, rules);
}

void warnOfNarrow(const char* what, const Narrow& narrow, double across, const std::vector<std::string>& names,
                  std::vector<std::string>& warnings)
{
  const auto name = [&](Index id) { return id < names.size() ? names[id] : std::string("?"); };
  if (across < fewestAcross)
  {
    warnings.push_back(text("the narrowest ", what, ", ", narrow.width, " wide, between '", name(narrow.surfaces[0]),
                            "' and '", name(narrow.surfaces[1]), "' at ", narrow.from.transpose(), ", has ", across,
                            " octants of SizeMin across, fewer than ", fewestAcross));
  }
}

void warnOfTerrain(const TerrainOutline& terrain, std::vector<std::string>& warnings)
{
  if (terrain.openBorders > 0)
  {
    warnings.push_back(text("the terrain has holes, with ", terrain.openBorders,
                            " edges; where no building closes them the space below is open"));
  }
  if (terrain.nonManifoldEdges > 0)
  {
    warnings.push_back(text("the terrain has ", terrain.nonManifoldEdges, " edges that three or more triangles share"));
  }
}

/// Estimates the number of elements. Sizes that make too many are reported, not thrown.
void estimate(const SurfaceModel& model, const GridFrame& frame, const ModelOptions& options, Preflight& out,
              const RunContext& context)
{
  try
  {
    const SizedOctants sized = sizeOctants(model, frame, options, context.part(0.0, 0.7));
    out.estimatedElements = leavesInside(buildOctree(model, frame, sized, context.part(0.7, 1.0))) +
                            (options.sizing.hexahedra ? countSplitPoints(sized.refined, frame, context) : 0);
  }
  catch (const TooManyElements& refusal)
  {
    out.estimatedElements = static_cast<std::size_t>(refusal.elements);
    out.warnings.emplace_back(refusal.what());
  }
}

} // namespace

Preflight preflight(const TriangleSurface& asRead, const ModelOptions& asked, const RunContext& context)
{
  GroundedInput grounded = groundModel(asRead, asked);
  const auto& [surface, options, ground] = grounded;
  const SitePlan plan = planSite(surface, options);
  const PlacedModel placed = placeModel(surface, plan, options);
  context.progress.report(0.02, "Repairing surfaces");
  ModelOptions asDrawn = options;
  asDrawn.findOpenings = false; // openings are to be measured
  const SurfaceModel model = makeSurfaceModel(placed, asDrawn, context.part(0.02, 0.1));
  Preflight out;
  out.warnings = checkDomain(surface, plan, options);
  out.warnings.insert(out.warnings.end(), ground.warnings.begin(), ground.warnings.end());
  out.hidden = model.repair.hidden;
  estimate(model, placed.frame, options, out, context.part(0.1, 0.7));
  context.progress.report(0.7, "Measuring narrow places");
  const GridFrame& frame = placed.frame;
  const double sizeMin = frame.sizeOf(frame.featureLevel);
  out.domain = plan.domain;
  out.gridAngle = plan.grid.angle();
  out.widened = plan.widened;
  measureSite(surface, plan, out);
  // Surfaces closer than this are merged anyhow.
  constexpr double seamRatio = 1e-3;
  out.narrow = findNarrowPlaces(model, frame, seamRatio * sizeMin, context);
  for (Narrow* narrow : {&out.narrow.opening, &out.narrow.gap})
  {
    narrow->from = frame.placement.toModel(narrow->from);
    narrow->to = frame.placement.toModel(narrow->to);
  }
  out.octantsAcrossOpening = out.narrow.opening.width / sizeMin;
  out.octantsAcrossGap = out.narrow.gap.width / sizeMin;
  warnOfDomain(out);
  warnOfNarrow("opening", out.narrow.opening, out.octantsAcrossOpening, surface.names, out.warnings);
  warnOfNarrow("gap or wall", out.narrow.gap, out.octantsAcrossGap, surface.names, out.warnings);
  warnOfTerrain(placed.terrain, out.warnings);
  out.ground = std::move(grounded.report);
  return out;
}

} // namespace atria
