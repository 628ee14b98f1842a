// SPDX-License-Identifier: GPL-3.0-or-later
/// Predicts and checks a mesh before it is made.
#pragma once

#include "Domain/GroundReport.h"
#include "Mesher/ModelOptions.h"
#include "Support/RunContext.h"
#include "Surface/Inspection/NarrowPlaces.h"

namespace atria {

/// Lengths are in model units, points along the model's axes.
struct Preflight
{
  /// Height H: the largest height of a point of the buildings above the ground below it. 0 without buildings.
  double buildingHeight = 0.0;
  PlacedPrism domain;
  /// Degrees from the model's axes to the grid's.
  double gridAngle = 0.0;
  /// Distances from the buildings to each upright side, by its number (see Prism.h), and from their highest point to
  /// zMax; in H. Negative if buildings reach beyond the side, 0 for sides that the domain does not have.
  std::vector<double> distances = std::vector<double>(sideNumbers, 0.0);
  /// Frontal area of the buildings over the domain's cross-section above the lowest ground, for wind square into a
  /// side, by its number. A box is for one wind, along its x into xMin; any side of another prism may be the inlet.
  std::vector<double> blockages = std::vector<double>(sideNumbers, 0.0);
  /// Inlet with the largest blockage; xMin without buildings.
  Index mostBlocked = xMin;
  /// Same as WindDomain::widened.
  double widened = 1.0;
  NarrowPlaces narrow;
  /// Number of finest octants across; infinite without an opening or a gap.
  double octantsAcrossOpening = 0.0;
  double octantsAcrossGap = 0.0;
  /// Number of the octree's leaves inside the domain. The mesh has about as many elements, less those inside solids and
  /// below terrain.
  std::size_t estimatedElements = 0;
  /// Details that are too fine for the mesh; see SurfaceRepairReport.
  std::vector<HiddenDetail> hidden;
  std::vector<std::string> warnings;
  /// Its warnings are among `warnings`.
  GroundReport ground;
};

/// Makes domain, model and octree, and measures them; the octree is not kept. Throws Error if the options cannot be
/// met, Aborted on demand.
Preflight preflight(const TriangleSurface& surface, const ModelOptions& options, const RunContext& context);

} // namespace atria
