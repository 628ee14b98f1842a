// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes a mesh as a Fluent file.
#pragma once

#include "SolverMesh.h"
#include "Support/RunContext.h"

#include <filesystem>

namespace atria {

/// Zone names in Fluent are compared without regard to capitals. The sides of a sheet are a wall and its shadow.
inline constexpr NameRules fluentNames{.punctuation = "_.-", .caseMatters = false, .sides = {"", "-shadow"}};

/// Writes Fluent's mesh format as text: points, cells with their types, faces zone by zone, names of zones. Walls are
/// of type `wall`, all other patches of type `pressure-outlet`. Cells are numbered zone by zone where there are
/// several. Patches without faces are left out. Throws Error for a file that cannot be written.
void writeFluentMesh(const std::filesystem::path& file, const SolverMesh& mesh, const RunContext& context);

} // namespace atria
