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
  /// The domain and the finest requested size follow from the other options.
  GridOptions sizes;
  SizingOptions sizing;
  /// Angle in degrees between normals (creases) or tangents (corners) above which features are kept.
  double featureAngle = 30.0;
  /// Closes gaps narrower than this; a twentieth of `sizes.sizeMin` if not given.
  std::optional<double> gapTolerance;
  /// Leaves out connected parts of the model whose bounding box has a diagonal shorter than this many octants of
  /// sizeMin, except surfaces that rules of sizes name; 0 leaves out none. See findSmallParts.
  double smallPartSize = 1.0;
  /// Name patterns of surfaces that air passes through: SurfaceKind::faceZone.
  std::vector<std::string> faceZones;
  /// Name patterns of closed surfaces that enclose a zone, but are no walls: SurfaceKind::cellZone.
  std::vector<std::string> cellZones;
  /// True if openings are found by rule; see withOpenings in Mesher/ModelOpenings.h.
  bool findOpenings = false;
  /// Name patterns of surfaces in which no openings are searched.
  std::vector<std::string> withoutOpenings;
};

} // namespace atria
