// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/ThinLayers.h"

#include "Layer/FlatLayers.h"
#include "Layer/LayerHeights.h"
#include "Layer/TypicalSizes.h"
#include "Quality/Checks/CheckLimits.h"
#include "Support/Error.h"
#include "Support/Text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace atria {

namespace {

/// Layers of a surface and the size of the elements beside them.
struct Wall
{
  Index tag = noIndex;
  WallLayers layers;
  double size = 0.0;

  double lastHeight() const { return layers.firstHeight * std::pow(layers.growth, layers.layers - 1); }
  /// Size of the elements beside the layers over the height of the last one.
  double jump() const { return size / lastHeight(); }
};

bool failsDeterminant(const FlatLayers& flat)
{
  return flat.determinantRoot < std::sqrt(std::sqrt(checkLimits::determinant));
}

void checkHeight(const WallLayers& layers, const std::string& surface, double domainSize)
{
  if (layers.firstHeight > domainSize)
  {
    std::ostringstream text;
    text << "layers on '" << surface << "': the first height of " << layers.firstHeight
         << " m exceeds the domain, which is " << domainSize << " m long";
    throw Error(text.str());
  }
}

/// Returns the names of the checks that fail on a flat wall with these measures.
std::vector<std::string> failingOn(const FlatLayers& flat)
{
  std::vector<std::string> names;
  const auto add = [&](bool fails, const char* name) {
    if (fails)
    {
      names.push_back(name);
    }
  };
  add(failsDeterminant(flat), "Determinant");
  add(flat.weight < checkLimits::faceWeight, "FaceWeight");
  add(flat.volumeRatio < checkLimits::volumeRatio, "VolumeRatio");
  return names;
}

/// Says what would pass the checks. Thin elements need a higher first layer. A jump in size needs layers that grow to
/// the size of the elements beside them.
std::string adviceOn(const WallLayers& layers, double size, const std::vector<std::string>& checks)
{
  WallLayers more = layers;
  more.layers = WallLayers::asManyAsFit;
  const std::string enough = std::to_string(fitted(more, size).layers) + " layers";
  const bool areLow = checks.front() == "Determinant";
  const bool jump = checks.back() != "Determinant";
  const bool grows = layers.growth > 1.0;
  std::string text = areLow ? "a higher first layer" : grows ? enough : "a growth above 1";
  if (areLow && jump)
  {
    text += grows ? " and so many that they grow to these" : " and a growth above 1";
  }
  else if (!areLow && layers.growth < maximumGrowth)
  {
    text += ", for a growth that fits ('auto' in its place)";
  }
  return "ask for " + text + ", or for smaller elements there";
}

/// Says which layers are thin, by the worst of them, and what to do.
std::string noteOn(const Wall& worst, std::size_t others, const std::string& name,
                   const std::vector<std::string>& checks)
{
  std::ostringstream text;
  text << std::setprecision(3) << "layers are so thin that " << joined(checks, " and ")
       << (checks.size() == 1 ? " of checkMesh fails" : " of checkMesh fail")
       << " on any wall, which alone is no failure: on " << name;
  if (others > 0)
  {
    text << " and " << others << " more surfaces";
  }
  text << ", " << worst.layers.layers << (worst.layers.layers == 1 ? " layer" : " layers") << " from "
       << worst.layers.firstHeight << " to " << worst.lastHeight() << " m meet elements of " << worst.size << " m, "
       << std::round(worst.jump()) << " times as high; " << adviceOn(worst.layers, worst.size, checks);
  return text.str();
}

} // namespace

FittedLayers fitLayers(LayerOptions& options, const MeshPort& port, const MeshingContext& context)
{
  FittedLayers out;
  if (!options.hasHeights())
  {
    return out;
  }
  const GridFrame& frame = context.octree.frame();
  const std::vector<WallSize> sizes =
      typicalSizes(context.octree, context.model, context, port.ownLeaves(context.octree), port.exchange());
  FlatLayers atLargest;
  bool anyPasses = false;
  std::vector<Wall> thin;
  for (Index tag = 0; tag < sizes.size(); ++tag)
  {
    WallLayers& layers = options.ofTag[tag];
    if (!layers.hasHeight())
    {
      continue;
    }
    checkHeight(layers, tagName(tag, context.model.names), frame.domain.size().maxCoeff());
    const bool hasOctants = sizes[tag].typical > 0.0;
    layers = fitted(layers, hasOctants ? sizes[tag].typical : frame.finestSize);
    if (!hasOctants)
    {
      continue;
    }
    const FlatLayers typical = flatLayers(layers, sizes[tag].typical);
    out.flat.lower(typical);
    anyPasses = anyPasses || !failsDeterminant(typical);
    const FlatLayers largest = flatLayers(layers, sizes[tag].largest);
    const Wall wall{tag, layers, sizes[tag].largest};
    if (wall.jump() > 1.0 && !failingOn(largest).empty())
    {
      atLargest.lower(largest);
      thin.push_back(wall);
    }
  }
  options.failsDeterminants = !thin.empty() && !anyPasses;
  if (!thin.empty())
  {
    const Wall& worst = *std::ranges::max_element(thin, {}, &Wall::jump);
    out.thin.failingChecks = failingOn(atLargest);
    out.thin.note = noteOn(worst, thin.size() - 1, tagName(worst.tag, context.model.names), out.thin.failingChecks);
  }
  return out;
}

} // namespace atria
