// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/ThinLayers.h"

#include "Layer/FlatLayers.h"
#include "Layer/LayerHeights.h"
#include "Layer/TypicalSizes.h"
#include "Quality/Checks/CheckLimits.h"
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

/// Says what would pass checks in place of layers. Only a height of their own helps thin elements, and only as many as
/// grow to the size of the elements beside them help those.
std::string adviceOn(const WallLayers& layers, double size, const std::vector<std::string>& checks)
{
  WallLayers more = layers;
  more.layers = WallLayers::asManyAsFit;
  const std::string enough = std::to_string(fitted(more, size).layers) + " layers";
  const bool areLow = checks.front() == "Determinant";
  const bool jump = checks.back() != "Determinant";
  return "ask for " +
         (!areLow ? enough + ", for a growth that fits ('auto' in its place)"
          : jump  ? "a higher first layer and so many that they grow to these"
                  : "a higher first layer") +
         ", or for smaller elements there";
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

ThinLayers fitLayers(LayerOptions& options, const MeshPort& port, const MeshingContext& context)
{
  ThinLayers out;
  if (!options.hasHeights())
  {
    return out;
  }
  const Octree& octree = context.octree;
  const std::vector<WallSize> sizes =
      typicalSizes(octree, context.model, context, port.ownLeaves(octree), port.exchange());
  FlatLayers atLargest;
  bool anyPasses = false;
  std::vector<Wall> thin;
  for (Index tag = 0; tag < sizes.size(); ++tag)
  {
    WallLayers& layers = options.ofTag[tag];
    if (layers.layers == 0 || layers.firstHeight == 0.0)
    {
      continue;
    }
    const bool hasOctants = sizes[tag].typical > 0.0;
    layers = fitted(layers, hasOctants ? sizes[tag].typical : octree.frame().finestSize);
    if (hasOctants)
    {
      anyPasses = anyPasses || !failsDeterminant(flatLayers(layers, sizes[tag].typical));
      const FlatLayers largest = flatLayers(layers, sizes[tag].largest);
      atLargest.lower(largest);
      if (!failingOn(largest).empty())
      {
        thin.push_back({tag, layers, sizes[tag].largest});
      }
    }
  }
  options.failsDeterminants = !thin.empty() && !anyPasses;
  if (!thin.empty())
  {
    const Wall& worst = *std::ranges::max_element(thin, {}, &Wall::jump);
    out.failingChecks = failingOn(atLargest);
    out.note = noteOn(worst, thin.size() - 1, tagName(worst.tag, context.model.names), out.failingChecks);
  }
  return out;
}

} // namespace atria
