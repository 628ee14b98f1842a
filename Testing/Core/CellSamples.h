// SPDX-License-Identifier: GPL-3.0-or-later
/// The corners of the cells of a sample mesh.
#pragma once

#include "Support/SampleMesh.h"

#include <vector>

namespace atria::testing {

using Ids = std::vector<std::int64_t>;

/// Returns the points of a cell as written.
inline Ids cornersOf(const SampleMesh& mesh, std::size_t cell)
{
  return {mesh.connectivity.begin() + mesh.offsets[cell], mesh.connectivity.begin() + mesh.offsets[cell + 1]};
}

} // namespace atria::testing
