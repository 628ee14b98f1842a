// SPDX-License-Identifier: GPL-3.0-or-later
/// Options for a model and for the octree it is meshed in.
#pragma once

#include "Domain/SiteOptions.h"
#include "Grid/GridOptions.h"
#include "Octree/Sizing/SizingOptions.h"

#include <optional>
#include <string>
#include <vector>

namespace atria {

/// Lengths are in model units; boxes and points are along the model's axes.
struct ModelOptions
{
  SiteOptions site;
  /// The domain and the finest size asked for follow from the other options.
  GridOptions sizes;
  SizingOptions sizing;
  /// Degrees between normals (creases) or tangents (corners) above which they are kept.
  double featureAngle = 30.0;
  /// Gaps narrower than this are closed; a twentieth of `sizes.sizeMin` where nothing is given.
  std::optional<double> gapTolerance;
  /// Connected parts of the model with a bounding box of a shorter diagonal than this many octants of sizeMin are left
  /// out, but for those of surfaces that rules of sizes name; 0 leaves out none. See findSmallParts.
  double smallPartSize = 1.0;
  /// Patterns of the names of surfaces one can look through, SurfaceKind::faceZone.
  std::vector<std::string> faceZones;
  /// Of closed surfaces that enclose a zone, without being walls: SurfaceKind::cellZone.
  std::vector<std::string> cellZones;
  /// True if openings are found by rule; see withOpenings in Mesher/ModelOpenings.h.
  bool findOpenings = false;
  /// Patterns of the names of surfaces in which none are.
  std::vector<std::string> withoutOpenings;
};

} // namespace atria
