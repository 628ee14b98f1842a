// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/GroundedModel.h"

#include "Domain/BodiesOnGround.h"
#include "Domain/Floor.h"
#include "Domain/GroundTexts.h"
#include "Domain/UpperSide.h"
#include "Surface/Search/Distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace atria {

namespace {

/// Distance in octants up to which bodies touch.
constexpr double touchRatio = 0.05;

std::vector<Index> trianglesOf(const ModelBodies& bodies)
{
  std::vector<Index> triangles;
  for (Index t = 0; t < bodies.ofTriangle.size(); ++t)
  {
    if (bodies.ofTriangle[t] != noIndex)
    {
      triangles.push_back(t);
    }
  }
  return triangles;
}

/// Returns the lowest faces, without those of bases that other bodies hold up, as posts do.
std::vector<LowestFace> facesThatStand(const BodyBases& found, const SupportSearch& supports)
{
  constexpr double anyDepth = -std::numeric_limits<double>::infinity();
  std::vector<char> isHeld(found.bases.size(), 0);
  for (Index base = 0; base < isHeld.size(); ++base)
  {
    isHeld[base] = supports.find(base, anyDepth) == BaseSupport::below ? 1 : 0;
  }
  std::vector<LowestFace> faces = found.lowest;
  std::erase_if(faces, [&](const LowestFace& face) { return face.base != noIndex && isHeld[face.base]; });
  return faces;
}

bool isAny(const SurfaceFlags& flags) { return std::ranges::find(flags, 1) != flags.end(); }

/// Returns the plan with the ground surfaces of the options, or else with a slab. Keeps only the upper side of ground
/// that is solid.
SitePlan prepareGround(GroundedModel& model, double sizeMin)
{
  const double tolerance = coincidentRatio * sizeMin;
  SitePlan plan = groundOf(model.surface, model.site, sizeMin);
  if (!isAny(plan.isGround) && model.site.mode == DomainMode::automatic)
  {
    const ModelBodies bodies = findBodies(model.surface, plan.isGround);
    if (const Index slab = findGroundSlab(model.surface, bodies, tolerance); slab != noIndex)
    {
      model.site.grounds.push_back(model.surface.names[slab]);
      plan = groundOf(model.surface, model.site, sizeMin);
    }
  }
  for (const Index id : keepUpperSides(model.surface, plan.isGround, tolerance))
  {
    model.report.slabs.push_back(model.surface.names[id]);
  }
  return model.report.slabs.empty() ? plan : groundOf(model.surface, model.site, sizeMin);
}

} // namespace

GroundedModel groundModel(const TriangleSurface& surface, const SiteOptions& options, const GroundRules& rules)
{
  GroundedModel out{surface, options, {}};
  if (options.mode == DomainMode::surfaces || surface.triangles.empty())
  {
    return out;
  }
  const double tolerance = coincidentRatio * rules.sizeMin;
  const SitePlan plan = prepareGround(out, rules.sizeMin);
  const ModelBodies bodies = findBodies(out.surface, plan.isGround);
  const PlumbLines lines(out.surface, trianglesOf(bodies));
  const BodyBases found = findBases(out.surface, bodies, lines, rules.sizeMin, tolerance);
  const SupportSearch supports(out.surface, bodies, lines, found.bases, touchRatio * rules.sizeMin, tolerance);
  GroundBelow below{Ground(out.surface, plan.isGround, 0.0), {}, plan.hasTerrain, plan.hasTerrain};
  const Box3 buildings = boundsOfBuildings(out.surface, plan.isGround, {});
  if (buildings.empty())
  {
    return out;
  }
  const bool isLevel = !below.surface.empty() && below.surface.bounds().size()[2] <= tolerance;
  below.useSurface = plan.hasTerrain || isLevel;
  bool isGiven = options.mode == DomainMode::bounds;
  if (isGiven)
  {
    below.floor = options.bounds.min[2];
  }
  else if (!below.useSurface)
  {
    out.site.floor = below.floor = findFloor(facesThatStand(found, supports), buildings.min[2]);
    // The floor of given octants may be a different one.
    isGiven = rules.bottom && std::abs(*rules.bottom - *below.floor) > tolerance;
    below.floor = isGiven ? rules.bottom : below.floor;
  }
  const SnapOptions snap{rules.sizeMin, tolerance, isGiven ? 0.0 : options.groundSnapRatio, rules.asDrawn};
  StandingBodies standing = standOnGround(out.surface, bodies, found.bases, supports, below, snap);
  standing.report.floor = below.useSurface ? below.surface.bounds().min[2] : *below.floor;
  standing.report.slabs = std::move(out.report.slabs);
  out.report = std::move(standing.report);
  addTexts(out.report, {rules.sizeMin, isGiven, plan.hasTerrain});
  lowerPlaces(out.surface, bodies, standing.heights);
  return out;
}

} // namespace atria
