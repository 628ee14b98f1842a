// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/ThinLayers.h"

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
  add(flat.determinantRoot < std::sqrt(std::sqrt(checkLimits::determinant)), "Determinant");
  add(flat.weight < checkLimits::faceWeight, "FaceWeight");
  add(flat.volumeRatio < checkLimits::volumeRatio, "VolumeRatio");
  return names;
}

std::string nameOf(Index tag, const std::vector<std::string>& names)
{
  return tag < names.size() ? names[tag] : sideName(tag - static_cast<Index>(names.size()));
}

/// Says what to do about walls with thin layers, by the worst of them.
std::string noteOn(const Wall& worst, std::size_t others, const std::string& name,
                   const std::vector<std::string>& checks)
{
  WallLayers more = worst.layers;
  more.layers = WallLayers::asManyAsFit;
  const int enough = fitted(more, worst.size).layers;
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
       << std::round(worst.jump()) << " times as high; ask for " << enough
       << " layers, for a growth that fits ('auto' in its place), or for smaller elements there";
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
      options.flat.lower(flatLayers(layers, sizes[tag].typical));
      const FlatLayers largest = flatLayers(layers, sizes[tag].largest);
      atLargest.lower(largest);
      if (!failingOn(largest).empty())
      {
        thin.push_back({tag, layers, sizes[tag].largest});
      }
    }
  }
  if (!thin.empty())
  {
    const Wall& worst = *std::ranges::max_element(thin, {}, &Wall::jump);
    out.failingChecks = failingOn(atLargest);
    out.note = noteOn(worst, thin.size() - 1, nameOf(worst.tag, context.model.names), out.failingChecks);
  }
  return out;
}

} // namespace atria
