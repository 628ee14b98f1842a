// SPDX-License-Identifier: GPL-3.0-or-later
/// The stages up to the zones, and a room with a hole.
#pragma once

#include "Dual/Displacement/DisplacedGrid.h"
#include "Dual/Zones/CrackClosing.h"
#include "Dual/Zones/Cracks.h"
#include "Dual/Zones/Leaks.h"
#include "Octree/Sizing/Refinement.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>

#include <numbers>

namespace atria::testing {

struct FoundZones
{
  FoundZones(const TriangleSurface& surface, const GridOptions& options, int threads = 1) : executor(threads)
  {
    Box3 extent;
    for (const Vec3& p : surface.points)
    {
      extent.extend(p);
    }
    const GridFrame frame = makeGridFrame(options, extent);
    FeatureOptions features;
    features.gapTolerance = 0.0; // gaps are what is asked for
    model = makeSurfaceModel(surface, frame, features, context());
    octree = buildOctree(model, frame, SizingOptions{}, context());
    points = findGridPoints(octree, context());
    crossings = findCrossings(grid, model, context());
    zones = findZones(crossings, model.names.size(), whole(), context());
  }

  void modify()
  {
    DisplacedGrid displaced = displaceGrid(points, std::move(crossings), whole(), context());
    for (const Index point : displaced.places.displacedPoints())
    {
      grid.move(point, displaced.places.place(point));
    }
    crossings = std::move(displaced.crossings);
    zones = findZones(crossings, model.names.size(), whole(), context());
  }
  void closeCracksUpTo(double tolerance)
  {
    crossings = closeCracks(std::move(crossings), findBoundaryGaps(context()), grid, tolerance, context());
    zones = findZones(crossings, model.names.size(), whole(), context());
  }

  GridPart whole() const { return GridPart(points); }
  MeshingContext context() { return {quietContext(executor), octree, model, tree}; }
  std::int32_t zoneAt(const Vec3& seed) const { return zones.ofPoint[pointOfSeed(seed, "seed", grid, model)]; }
  std::vector<char> kept(ZoneRule rule, const std::vector<Vec3>& seeds = {}) const
  {
    return keptZones(zones, rule, zonesOfSeeds(zones, seeds, grid, whole(), model));
  }
  std::vector<Leak> leaks(const std::vector<Vec3>& sealed)
  {
    return findLeaks(sealed, zones, crossings, grid, whole(), model, context());
  }
  std::vector<Crack> cracks(ZoneRule rule = ZoneRule::all)
  {
    return findCracks(findBoundaryGaps(context()), zones, kept(rule), crossings, grid, whole(), context());
  }
  Vec3 position(Index point) const { return octree.frame().toModel(grid.place(point)); }

  ThreadExecutor executor;
  SurfaceModel model;
  TriangleTreeOnDemand tree{model};
  Octree octree;
  GridPoints points;
  GridPlaces grid{octree, points};
  Crossings crossings;
  Zones zones;
};

/// Octants of one size throughout.
inline GridOptions uniformGrid(const Box3& domain, double size)
{
  GridOptions grid;
  grid.domain = domain;
  grid.sizeMin = grid.sizeMid = grid.sizeMax = size;
  return grid;
}

/// A rectangle at `corner` with edges u and v, less the rectangle [low, high] in parts of u and v; all its triangles
/// share their edges.
inline void addPierced(TriangleSurface& to, const std::string& name, const Vec3& corner, const Vec3& u, const Vec3& v,
                       const std::array<double, 2>& low, const std::array<double, 2>& high)
{
  const double s[4] = {0.0, low[0], high[0], 1.0};
  const double t[4] = {0.0, low[1], high[1], 1.0};
  std::vector<Vec3> points;
  for (const double b : t)
  {
    for (const double a : s)
    {
      points.push_back(corner + a * u + b * v);
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  for (Index j = 0; j < 3; ++j)
  {
    for (Index i = 0; i < 3; ++i)
    {
      const Index p = 4 * j + i;
      if (i != 1 || j != 1)
      {
        triangles.push_back({p, p + 1, p + 5});
        triangles.push_back({p, p + 5, p + 4});
      }
    }
  }
  addSurface(to, name, points, triangles);
}

/// Five whole sides of a box, and the one at its upper x with a hole, in meters from that side's lower corner.
inline void addRoom(TriangleSurface& to, const std::string& name, const Box3& box, const std::array<double, 2>& low,
                    const std::array<double, 2>& high)
{
  const Vec3 size = box.size();
  const Vec3 x(size[0], 0, 0), y(0, size[1], 0), z(0, 0, size[2]);
  addSheet(to, name + "West", box.min, y, z);
  addSheet(to, name + "South", box.min, x, z);
  addSheet(to, name + "North", box.min + y, x, z);
  addSheet(to, name + "Floor", box.min, x, y);
  addSheet(to, name + "Roof", box.min + z, x, y);
  addPierced(to, name + "East", box.min + x, y, z, {low[0] / size[1], low[1] / size[2]},
             {high[0] / size[1], high[1] / size[2]});
}

inline Vec3 turned(const Vec3& p, double degrees)
{
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vec3::UnitZ()) * p;
}

} // namespace atria::testing
