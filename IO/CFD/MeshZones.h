// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones of a mesh as solvers have them: parts of it under one name.
#pragma once

#include "Support/Types.h"

#include <string>
#include <vector>

namespace atria {

/// A set of internal faces under one name.
struct FaceZone
{
  std::string name;
  std::vector<Index> faces;
  std::vector<char> flips; ///< per face, true if the zone's normal points into the face's owner
};

struct CellZone
{
  std::string name;
  std::vector<Index> cells;
};

} // namespace atria
