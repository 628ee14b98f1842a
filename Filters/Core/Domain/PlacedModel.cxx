// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/PlacedModel.h"

#include "Domain/Alignment.h"
#include "Domain/Domain.h"
#include "Domain/TurnedSides.h"
#include "Support/Angles.h"
#include "Support/Error.h"
#include "Surface/Search/Distance.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace atria {

namespace {

void checkSurfaces(const TriangleSurface& surface)
{
  if (surface.triangles.empty())
  {
    throw Error("there are no surfaces to take the domain from: connect some, or give DomainBounds with DomainMode "
                "Explicit");
  }
}

PlacedBox boundsOfDomain(const TriangleSurface& surface, const SiteOptions& options, SitePlan& plan)
{
  PlacedBox domain{Placement(options.domainAngle), {}};
  switch (options.mode)
  {
    case DomainMode::bounds:
      return turnedAboutMiddle(options.bounds, options.domainAngle);
    case DomainMode::site:
      domain.bounds = siteDomain(surface, options.site, domain.axes);
      return domain;
    case DomainMode::automatic: {
      checkSurfaces(surface);
      const WindDomain wind = windDomain(surface, {plan.isGround, plan.floor}, options.windAngle, options.domainSides);
      plan.widened = wind.widened;
      return wind.box;
    }
    default:
      checkSurfaces(surface);
      domain.bounds = boundsOf(surface, domain.axes);
      return domain;
  }
}

/// Returns the prism with the given sides. The mode says where bottom and top are.
PlacedPrism prismOfPolygon(const TriangleSurface& surface, const SiteOptions& options, SitePlan& plan)
{
  if (options.domainAngle != 0.0)
  {
    throw Error("a domain that is a polygon is not turned: give DomainPolygon or DomainAngle, not both");
  }
  if (options.mode == DomainMode::automatic)
  {
    checkSurfaces(surface);
    const auto [bottom, top] = windHeights(surface, {plan.isGround, plan.floor});
    return {Placement(), options.polygon, bottom, top};
  }
  const Box3 bounds = boundsOfDomain(surface, options, plan).bounds;
  return {Placement(), options.polygon, bounds.min[2], bounds.max[2]};
}

/// Returns the axes at the angle plus quarter turns that are nearest to the domain's, so that the domain's sides keep
/// their names.
Placement gridAxes(const TriangleSurface& surface, GridAlignment alignment, const PlacedBox& domain, double sizeMin)
{
  if (alignment == GridAlignment::domain)
  {
    return domain.axes;
  }
  const double angle = alignment == GridAlignment::walls ? dominantWallAngle(surface) : 0.0;
  const double wanted = domain.axes.angle();
  const Placement grid(angle + 90.0 * std::round((wanted - angle) / 90.0));
  const double difference = std::remainder(grid.angle() - wanted, 360.0);
  const bool along = radians(std::abs(difference)) * domain.bounds.size().norm() <= coincidentRatio * sizeMin;
  return along ? domain.axes : grid;
}

void turnAll(TriangleSurface& surface, const Placement& axes)
{
  for (Vec3& p : surface.points)
  {
    p = axes.fromModel(p);
  }
}

/// True if the ground is not level and covers so much of the model's rectangle that the rest may follow from it.
bool isTerrain(const TriangleSurface& surface, const SurfaceFlags& isGround, double sizeMin)
{
  constexpr double leastCover = 0.5;
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 u = surface.points[b] - surface.points[a];
    const Vec3 v = surface.points[c] - surface.points[a];
    area += isGround[surface.surfaceIds[t]] ? 0.5 * std::abs(u[0] * v[1] - u[1] * v[0]) : 0.0;
  }
  const Ground ground(surface, isGround, 0.0);
  const Vec3 size = boundsOf(surface).size();
  return !ground.empty() && ground.bounds().size()[2] > coincidentRatio * sizeMin &&
         area >= leastCover * size[0] * size[1];
}

/// Turns the model to the domain's axes, extends the terrain, cuts the model to the sides and turns it to the grid.
/// Sets all but the frame.
PlacedModel inGrid(const TriangleSurface& surface, const SitePlan& plan, const GridOptions& sizes)
{
  PlacedModel out;
  out.surface = surface;
  turnAll(out.surface, plan.domain.axes);
  const double beyond = 2.0 * sizes.sizeMax;
  Box3 reach = plan.domain.bounds;
  reach.min -= Vec3::Constant(beyond);
  reach.max += Vec3::Constant(beyond);
  if (plan.hasTerrain)
  {
    out.terrain = extendTerrain(out.surface, plan.isTerrain, reach, weldRatio * sizes.sizeMin);
  }
  if (plan.hasSheetSides())
  {
    out.sharedOnSides = cutToSides(out.surface, plan.domain, beyond, coincidentRatio * sizes.sizeMin);
    turnAll(out.surface, Placement(plan.grid.angle() - plan.domain.axes.angle()));
  }
  return out;
}

} // namespace

SitePlan groundOf(const TriangleSurface& surface, const SiteOptions& options, double sizeMin)
{
  SitePlan plan;
  plan.floor = options.floor;
  plan.isTerrain = terrainSurfaces(surface, options.terrain, options.site, coincidentRatio * sizeMin);
  plan.isGround = plan.isTerrain;
  for (std::size_t i = 0; i < plan.isGround.size(); ++i)
  {
    const bool isNamed = std::ranges::find(options.grounds, surface.names[i]) != options.grounds.end();
    plan.isGround[i] |= isNamed || surface.names[i] == options.site ? 1 : 0;
  }
  if (options.terrain.empty() && !options.grounds.empty() && isTerrain(surface, plan.isGround, sizeMin))
  {
    plan.isTerrain = plan.isGround;
  }
  plan.hasTerrain = std::ranges::find(plan.isTerrain, 1) != plan.isTerrain.end();
  return plan;
}

namespace {

/// Says which part lies far from the others if more than half of the model's length is empty.
std::string farApart(const TriangleSurface& surface)
{
  struct Extent
  {
    double low;
    double high;
    Index surface;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<Extent> extents;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      const auto& [a, b, c] = surface.triangles[t];
      const auto [low, high] = std::minmax({surface.points[a][axis], surface.points[b][axis], surface.points[c][axis]});
      extents.push_back({low, high, surface.surfaceIds[t]});
    }
    std::ranges::stable_sort(extents, {}, &Extent::low);
    const double half = 0.5 * boundsOf(surface).size()[axis];
    Extent before = extents.empty() ? Extent() : extents.front();
    for (const Extent& next : extents)
    {
      if (next.low - before.high > half)
      {
        std::ostringstream text;
        text << "; '" << surface.names[before.surface] << "' and '" << surface.names[next.surface] << "' lie "
             << next.low - before.high << " m apart along "
             << "xyz"[axis]
             << " with nothing between them: leave one of them out (ExcludedSurfaces) or correct its place";
        return text.str();
      }
      before = next.high > before.high ? next : before;
    }
  }
  return "";
}

} // namespace

SitePlan planSite(const TriangleSurface& surface, const SiteOptions& options, const GridOptions& sizes)
{
  SitePlan plan = groundOf(surface, options, sizes.sizeMin);
  plan.domain = options.polygon.empty() ? PlacedPrism(boundsOfDomain(surface, options, plan), options.domainSides)
                                        : prismOfPolygon(surface, options, plan);
  if (plan.hasTerrain)
  {
    const double lowest = Ground(surface, plan.isTerrain, 0.0).bounds().min[2];
    plan.domain.bounds.min[2] = std::min(plan.domain.bounds.min[2], lowest - 2.0 * sizes.sizeMax);
  }
  plan.grid = gridAxes(surface, options.alignment, plan.domain, sizes.sizeMin);
  return plan;
}

PlacedModel placeModel(const TriangleSurface& surface, const SitePlan& plan, const GridOptions& sizes)
{
  GridOptions options = sizes;
  options.domain = boundsAlong(plan.grid, plan.domain);
  const bool turned = plan.hasSheetSides();
  GridOptions upright = sizes;
  upright.domain = plan.domain.bounds;
  try
  {
    makeGridFrame(upright, {}); // throws if the options are invalid
  }
  catch (const Error& error)
  {
    throw Error(error.what() + farApart(surface));
  }
  if (turned)
  {
    // No octant at a corner of the domain may reach a plane of the box around it.
    const Vec3 margin(2.0 * sizes.sizeMax, 2.0 * sizes.sizeMax, 0.0);
    options.domain = {options.domain.min - margin, options.domain.max + margin};
  }
  PlacedModel out = inGrid(surface, plan, sizes);
  out.frame = makeGridFrame(options, boundsOf(out.surface));
  out.frame.placement = plan.grid;
  if (turned)
  {
    out.frame.turnedDomain = plan.domain;
  }
  return out;
}

PlacedModel placeModel(const TriangleSurface& surface, const SiteOptions& options, const GridFrame& frame)
{
  SitePlan plan = groundOf(surface, options, frame.sizeOf(frame.featureLevel));
  plan.grid = frame.placement;
  plan.domain = frame.prism();
  GridOptions sizes;
  sizes.sizeMin = frame.sizeOf(frame.featureLevel);
  sizes.sizeMax = frame.sizeOf(frame.topLevel);
  PlacedModel out = inGrid(surface, plan, sizes);
  out.frame = frame;
  fitLattice(out.frame, boundsOf(out.surface));
  return out;
}

} // namespace atria
