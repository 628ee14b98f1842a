// SPDX-License-Identifier: GPL-3.0-or-later
/// The domain of a wind case without its buildings: a run of a minute that says how the wind's profile changes on its
/// way to them. See Blocken, Stathopoulos and Carmeliet (2007), "CFD simulation of the atmospheric boundary layer: wall
/// function problems", Atmospheric Environment 41, 238-252.
#pragma once

#include "CaseValues.h"

#include <nlohmann/json.hpp>

namespace atria {

/// Cells over the height of a domain.
struct Grading
{
  int cells = 1;
  double topOverFirst = 1.0; ///< height of the top cell over that of the first
};
/// Returns cells whose heights grow by a constant factor from `first` at the ground to `top`, as nearly as their number
/// allows. Cells at the ground keep their height if there would be too many or too few.
Grading gradingOf(double height, double first, double top);
/// Returns the heights of the centers of these cells.
std::vector<double> centersOf(const Grading& grading, double height);

/// A block of hexahedra along the wind, one cell wide. Lengths in meters.
struct EmptyDomain
{
  Vec3 start; ///< on the inlet and the ground, in the middle of the block's width
  Vec3 wind;  ///< level, length 1
  double length = 0.0;
  double fetch = 0.0; ///< from the inlet to the buildings; half of the length if there are none
  double height = 0.0;
  double heightOfInterest = 0.0; ///< profiles are compared below it
  int cellsAlong = 1;
  Grading grading;

  double cellLength() const { return length / cellsAlong; }
};

/// Returns the empty domain of a wind case:
/// - It runs along the wind through the middle of the walls, from an inlet to an outlet.
/// - Cells at the ground and at the top are as high as those of the mesh, for most of the area; cells along the wind as
///   long as at the inlet, within limits.
/// - The height of interest is twice that of the tallest wall, or the reference height of the wind without walls.
/// Throws Error if the mesh has no ground or no inlet.
EmptyDomain emptyDomainOf(const CaseOfDirection& flow);

/// Removes the empty domain that an earlier case had. Throws Error if that is impossible.
void removeEmptyDomain(const std::filesystem::path& folder);
/// Writes the folder `empty_domain` of a case, with Allrun and Allclean. Inlet, ground, outlet and top have the names
/// of the case's patches, and so their conditions. `roughness` is the ground's roughness length if grounds have their
/// own. Returns an entry for case.json.
nlohmann::ordered_json writeEmptyDomain(const std::filesystem::path& folder, const CaseOfDirection& flow,
                                        std::optional<double> roughness);

} // namespace atria
