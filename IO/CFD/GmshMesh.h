// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes a mesh as a Gmsh file.
#pragma once

#include "ElementMesh.h"
#include "Support/RunContext.h"

#include <filesystem>

namespace atria {

/// Gmsh accepts any character but a quote, up to 127 of them. Many readers of its files end a name at a blank.
inline constexpr NameRules gmshNames{.punctuation = "_.-+:/", .longest = 127};

/// Writes Gmsh's format 4.1 as text. Patches are physical surfaces, zones of cells physical volumes; cells in no zone
/// are the volume `fluid`. Patches without faces are left out. Comments at the end of the file list the original names
/// that had to be changed. Throws Error for a file that cannot be written.
void writeGmshMesh(const std::filesystem::path& file, const ElementMesh& mesh, const RunContext& context);

} // namespace atria
