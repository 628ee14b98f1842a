// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/SizeRules.h"

#include "Support/Error.h"
#include "Support/NamePattern.h"
#include "Support/PatternRule.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace atria {

namespace {

/// Returns one entry per feature edge: the finest level of its surfaces.
std::vector<int> edgeLevels(const SurfaceModel& model, const std::vector<int>& featureOfSurface)
{
  std::map<std::array<Index, 2>, std::size_t> edges;
  for (std::size_t e = 0; e < model.featureEdges.size(); ++e)
  {
    const auto& [a, b] = std::minmax(model.featureEdges[e].a, model.featureEdges[e].b);
    edges.emplace(std::array{a, b}, e);
  }
  std::vector<int> levels(model.featureEdges.size(), 0);
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const auto& [a, b] = std::minmax(model.triangles[t][i], model.triangles[t][(i + 1) % 3]);
      if (const auto found = edges.find(std::array{a, b}); found != edges.end())
      {
        levels[found->second] = std::max(levels[found->second], featureOfSurface[model.surfaceIds[t]]);
      }
    }
  }
  return levels;
}

std::vector<int> cornerLevels(const SurfaceModel& model, const std::vector<int>& ofFeatureEdge)
{
  std::vector<int> ofPoint(model.points.size(), 0);
  for (std::size_t e = 0; e < model.featureEdges.size(); ++e)
  {
    for (const Index p : {model.featureEdges[e].a, model.featureEdges[e].b})
    {
      ofPoint[p] = std::max(ofPoint[p], ofFeatureEdge[e]);
    }
  }
  std::vector<int> levels(model.corners.size());
  std::transform(model.corners.begin(), model.corners.end(), levels.begin(), [&](Index p) { return ofPoint[p]; });
  return levels;
}

} // namespace

std::vector<char> sizedSurfaces(const std::string& pattern, const std::vector<std::string>& names)
{
  return matchingSurfaces(pattern, names, "for which a size is requested");
}

SurfaceSize surfaceSizeFrom(const std::string& text)
{
  const PatternRule rule = patternRuleFrom(text, 1, 2, "size", "PATTERN SIZE [FEATURESIZE]");
  SurfaceSize size{rule.pattern, rule.numbers[0], std::nullopt};
  if (rule.numbers.size() == 2)
  {
    size.featureSize = rule.numbers[1];
  }
  return size;
}

std::vector<DistanceSize> distanceSizesFrom(const std::string& text)
{
  constexpr const char* form = "PATTERN DISTANCE SIZE [DISTANCE SIZE ...]";
  const PatternRule rule = patternRuleFrom(text, 2, std::string::npos, "size", form);
  if (rule.numbers.size() % 2 != 0)
  {
    throw Error("the size rule '" + text + "' is not of the form " + form);
  }
  std::vector<DistanceSize> sizes;
  for (std::size_t i = 0; i < rule.numbers.size(); i += 2)
  {
    sizes.push_back({rule.pattern, rule.numbers[i], rule.numbers[i + 1]});
  }
  return sizes;
}

std::string textOf(const SurfaceSize& rule)
{
  PatternRule text{rule.pattern, {rule.size}};
  if (rule.featureSize)
  {
    text.numbers.push_back(*rule.featureSize);
  }
  return textOf(text);
}

std::string textOf(const DistanceSize& rule) { return textOf(PatternRule{rule.pattern, {rule.distance, rule.size}}); }

double finestSizeOf(const SizingOptions& options)
{
  double finest = std::numeric_limits<double>::infinity();
  const auto take = [&](double size, const std::string& rule) {
    if (!(size > 0.0) || !std::isfinite(size))
    {
      throw Error("the size " + std::to_string(size) + " requested at " + rule + " is not positive");
    }
    finest = std::min(finest, size);
  };
  for (const SurfaceSize& rule : options.surfaceSizes)
  {
    take(rule.size, "surfaces '" + rule.pattern + "'");
    take(rule.featureSize.value_or(rule.size), "features of surfaces '" + rule.pattern + "'");
  }
  for (const RefinementBox& box : options.boxes)
  {
    take(box.size, "a refinement box");
  }
  for (const DistanceSize& rule : options.distanceSizes)
  {
    take(rule.size, "a distance from surfaces '" + rule.pattern + "'");
  }
  return finest;
}

int levelNotAbove(double size, const GridFrame& frame)
{
  constexpr double rounding = 1.0 + 1e-9;
  int level = 0;
  while (level < frame.depth && frame.sizeOf(level) > size * rounding)
  {
    ++level;
  }
  return level;
}

double narrowestSide(const PlacedPrism& domain)
{
  double narrowest = std::numeric_limits<double>::infinity();
  for (const PrismSide& side : domain.sides())
  {
    narrowest = domain.isBox() ? narrowest : std::min(narrowest, (side.end - side.start).norm());
  }
  return narrowest;
}

ModelLevels modelLevels(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options)
{
  constexpr int unset = -1;
  ModelLevels levels;
  levels.ofSurface.assign(model.names.size(), unset);
  levels.featureOfSurface.assign(model.names.size(), unset);
  for (const SurfaceSize& rule : options.surfaceSizes)
  {
    const std::vector<char> matching = sizedSurfaces(rule.pattern, model.names);
    for (std::size_t s = 0; s < matching.size(); ++s)
    {
      if (matching[s])
      {
        levels.ofSurface[s] = std::max(levels.ofSurface[s], levelNotAbove(rule.size, frame));
        if (rule.featureSize)
        {
          levels.featureOfSurface[s] = std::max(levels.featureOfSurface[s], levelNotAbove(*rule.featureSize, frame));
        }
      }
    }
  }
  for (std::size_t s = 0; s < model.names.size(); ++s)
  {
    levels.ofSurface[s] = levels.ofSurface[s] == unset ? frame.midLevel : levels.ofSurface[s];
    const int feature = levels.featureOfSurface[s] == unset ? frame.featureLevel : levels.featureOfSurface[s];
    levels.featureOfSurface[s] = std::max(feature, levels.ofSurface[s]);
  }
  // Sides of a turned domain, whose ids follow the surfaces', request nothing.
  levels.ofSurface.resize(model.names.size() + sideNumbers, 0);
  levels.featureOfSurface.resize(model.names.size() + sideNumbers, 0);
  levels.ofFeatureEdge = edgeLevels(model, levels.featureOfSurface);
  levels.ofCorner = cornerLevels(model, levels.ofFeatureEdge);
  return levels;
}

std::vector<char> surfacesOfRules(const std::vector<std::string>& names, const SizingOptions& options)
{
  std::vector<char> named(names.size(), 0);
  const auto add = [&](const std::string& pattern) {
    const std::vector<char> matching = sizedSurfaces(pattern, names);
    std::ranges::transform(named, matching, named.begin(), std::bit_or<>());
  };
  std::ranges::for_each(options.surfaceSizes, add, &SurfaceSize::pattern);
  std::ranges::for_each(options.distanceSizes, add, &DistanceSize::pattern);
  return named;
}

std::vector<FinerPlace> finerPlaces(const TriangleSurface& surface, const GridFrame& frame,
                                    const SizingOptions& options)
{
  std::vector<FinerPlace> places;
  const auto add = [&](const Box3& box, double size) {
    const int level = levelNotAbove(size, frame);
    if (level > frame.featureLevel && !box.empty())
    {
      places.push_back({{frame.toLattice(box.min), frame.toLattice(box.max)}, level});
    }
  };
  const auto boundsOf = [&](const std::string& pattern, double margin) {
    const std::vector<char> matching = sizedSurfaces(pattern, surface.names);
    Box3 box;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      if (surface.surfaceIds[t] < matching.size() && matching[surface.surfaceIds[t]])
      {
        std::ranges::for_each(surface.triangles[t], [&](Index p) { box.extend(surface.points[p]); });
      }
    }
    return box.empty() ? box : Box3{box.min - Vec3::Constant(margin), box.max + Vec3::Constant(margin)};
  };
  for (const SurfaceSize& rule : options.surfaceSizes)
  {
    add(boundsOf(rule.pattern, 0.0), std::min(rule.size, rule.featureSize.value_or(rule.size)));
  }
  for (const RefinementBox& rule : options.boxes)
  {
    add(rule.bounds, rule.size);
  }
  for (const DistanceSize& rule : options.distanceSizes)
  {
    add(boundsOf(rule.pattern, rule.distance), rule.size);
  }
  return places;
}

} // namespace atria
