// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones of a mesh as solvers have them: parts of it under one name.
#pragma once

#include "Support/Types.h"

#include <string>
#include <vector>

namespace atria {

/// Internal faces.
struct FaceZone
{
  std::string name;
  std::vector<Index> faces;
  std::vector<char> flips; ///< per face, whether the zone's normal points into its owner
};

struct CellZone
{
  std::string name;
  std::vector<Index> cells;
};

} // namespace atria
