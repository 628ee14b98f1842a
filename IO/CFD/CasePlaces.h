// SPDX-License-Identifier: GPL-3.0-or-later
/// Places of a case that rules name: cell zones, surfaces, and patches that air passes.
#pragma once

#include "CaseMesh.h"

#include <map>
#include <string>
#include <vector>

namespace atria {

struct PatchChoice;

/// Volumes of cell zones (m3) or areas of patches (m2) by name.
using Sizes = std::map<std::string, double>;

struct Places
{
  Sizes zones;
  Sizes surfaces; ///< walls, grounds and sides that slip
  Sizes slipping; ///< surfaces along which air slips
  Sizes openings; ///< patches that let air in or out
};

/// Returns all places of a mesh, without patches of a constraint type.
Places placesOf(const CaseMesh& mesh, const std::vector<PatchChoice>& choices);

/// Returns the places whose name matches.
Sizes matching(const std::string& pattern, const Sizes& sizes);
/// Returns the sum of all sizes.
double sum(const Sizes& sizes);
/// Adds the shares of an amount in proportion to the sizes.
void divide(double amount, const Sizes& among, std::map<std::string, double>& shares);

/// True if the name of any place matches.
bool isKnown(const std::string& pattern, const Places& places);
/// Returns a message that names the places there are instead of the pattern.
std::string unmatched(const std::string& pattern, const Places& places);

} // namespace atria
