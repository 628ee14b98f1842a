// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes a mesh as an SU2 file.
#pragma once

#include "Quality/Faces/NativeCells.h"
#include "SolverMesh.h"
#include "Support/RunContext.h"

#include <filesystem>

namespace atria {

/// Markers are listed in SU2's settings between commas and brackets.
inline constexpr NameRules su2Names{.punctuation = "_.-+:/"};

/// Writes SU2's mesh format as text: elements, points and markers. Patches without faces are left out; a comment at
/// each marker records the patch's name. Throws Error for a file that cannot be written.
void writeSU2Mesh(const std::filesystem::path& file, const SolverMesh& mesh, const NativeCells& cells,
                  const RunContext& context);

} // namespace atria
