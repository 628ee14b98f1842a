// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

namespace atria {

/// A patch's name as OpenFOAM takes it.
struct OpenFOAMName
{
  std::string word;  ///< unique; ASCII letters, digits and _ . - + only, not beginning with a digit or sign
  std::string group; ///< the name that both sides of a sheet share, else empty
};

/// Makes names valid. Two that begin alike and end in _front and _back are the sides of one sheet: they keep
/// a common stem, which is their group unless a patch has that very name.
std::vector<OpenFOAMName> makeOpenFOAMNames(std::span<const std::string> names);

} // namespace atria
