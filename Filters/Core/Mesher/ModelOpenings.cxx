// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/ModelOpenings.h"

#include "Support/NamePattern.h"
#include "Surface/Openings/Openings.h"
#include "Surface/Search/Distance.h"

#include <algorithm>
#include <set>

namespace atria {

namespace {

/// Least width of openings, over the size of octants at features. CrackTolerance may close narrower ones.
constexpr double leastWidth = 0.9;

std::vector<char> surfacesWith(const std::vector<std::string>& names, const std::vector<std::string>& without)
{
  std::vector<char> with(names.size(), 1);
  for (const std::string& pattern : without)
  {
    const std::vector<char> matching = matchingSurfaces(pattern, names, "in which no openings are to be found");
    std::ranges::transform(with, matching, with.begin(), [](char is, char matches) { return matches ? 0 : is; });
  }
  return with;
}

/// Returns the first name of this pattern that is not taken.
std::string nameOf(const std::string& wall, int& number, std::set<std::string>& taken)
{
  std::string name;
  do
  {
    name = wall + "_opening_" + std::to_string(++number);
  } while (!taken.insert(name).second);
  return name;
}

/// Adds openings as surfaces of their own after the named ones. Returns the surface that each is an opening of.
std::vector<Index> addOpenings(const std::vector<FoundOpening>& openings, const GridFrame& frame, TriangleSurface& to)
{
  const std::size_t drawn = to.names.size();
  for (Index& id : to.surfaceIds)
  {
    id += id >= drawn ? static_cast<Index>(openings.size()) : 0; // sides of a turned domain come last
  }
  std::set<std::string> taken(to.names.begin(), to.names.end());
  std::vector<int> numbers(drawn, 0);
  std::vector<Index> walls;
  for (const FoundOpening& opening : openings)
  {
    const auto surface = static_cast<Index>(to.names.size());
    const auto first = static_cast<Index>(to.points.size());
    to.names.push_back(nameOf(to.names[opening.surface], numbers[opening.surface], taken));
    walls.push_back(opening.surface);
    std::ranges::transform(opening.points, std::back_inserter(to.points),
                           [&](const LatticePoint& p) { return frame.toModel(p); });
    for (const auto& [a, b, c] : opening.triangles)
    {
      to.triangles.push_back({first + a, first + b, first + c});
      to.surfaceIds.push_back(surface);
    }
  }
  return walls;
}

} // namespace

SurfaceModel withOpenings(SurfaceModel model, const PlacedModel& placed, FeatureOptions features,
                          const ModelOptions& options, const RunContext& context)
{
  const auto size = static_cast<double>(placed.frame.latticeSize(placed.frame.featureLevel));
  OpeningOptions finding;
  finding.surfaces = surfacesWith(placed.surface.names, options.withoutOpenings);
  finding.leastWidth = leastWidth * size;
  finding.planarDistance = coincidentRatio * size;
  finding.sidesAreWalls = options.site.mode == DomainMode::surfaces;
  const std::vector<FoundOpening> openings = findOpenings(model, placed.frame, finding, context.part(0.0, 0.3));
  if (openings.empty())
  {
    return model;
  }
  TriangleSurface surface = placed.surface;
  std::vector<Index> walls = addOpenings(openings, placed.frame, surface);
  features.kinds.resize(placed.surface.names.size(), SurfaceKind::wall);
  features.kinds.resize(surface.names.size(), SurfaceKind::faceZone);
  model = makeSurfaceModel(surface, placed.frame, features, context.part(0.3, 1.0));
  model.walls = std::move(walls);
  return model;
}

} // namespace atria
