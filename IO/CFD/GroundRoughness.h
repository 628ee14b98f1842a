// SPDX-License-Identifier: GPL-3.0-or-later
/// Roughness lengths of grounds: kinds of terrain, rules by name, and whether they suit mesh and wind.
#pragma once

#include "CaseValues.h"
#include "PolyMesh.h"

#include <optional>
#include <span>

namespace atria {

/// A class of terrain in the Davenport classification of roughness lengths, with the values of Wieringa (1992),
/// "Updating the Davenport roughness classification", J. Wind Eng. Ind. Aerodyn. 41, 357-368; see also Wieringa,
/// Davenport, Grimmond and Oke (2001), "New revision of Davenport roughness classification", 3EACWE, Eindhoven.
struct GroundKind
{
  std::string_view name;
  std::string_view davenportClass;
  double roughness; ///< meters
};
std::span<const GroundKind> groundKinds();

/// Parses a length in meters or the name of a kind. Throws Error listing the kinds.
double roughnessFrom(const std::string& lengthOrKind);
/// Parses `PATTERN LENGTH` and `PATTERN KIND` to a rule that makes patches ground. A pattern with blanks is in double
/// quotes. Throws Error if a part is missing or wrong.
PatchRule groundRuleFrom(const std::string& text);

/// Returns the logarithmic mean, weighted by area, of the ground's roughness lengths upstream of all buildings,
/// meters; over the whole ground if there are none. Returns nothing without such ground.
std::optional<double> roughnessUpstream(const PolyMesh& poly, const CaseOfDirection& flow);

/// Returns warnings for grounds whose roughness length the first cells are too low for, and for roughness lengths above
/// the wind's reference height.
std::vector<std::string> warnOfRoughness(const CaseOfDirection& flow);

/// A direction of the wind and the roughness length of the ground upstream.
struct Upstream
{
  std::string folder;
  double roughness = 0.0; ///< meters
};
/// Returns a warning if the roughness length of the wind's profile and of the ground upstream differ by more than a
/// factor of 2 in any of the directions.
std::vector<std::string> warnOfUpstream(const WindProfile& wind, const std::vector<Upstream>& directions);

} // namespace atria
