// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes a mesh as a CGNS file.
#pragma once

#include "SolverMesh.h"
#include "Support/RunContext.h"

#include <filesystem>

namespace atria {

/// CGNS accepts any character but a slash, up to 32 of them; ASCII is what all readers understand.
inline constexpr NameRules cgnsNames{
    .punctuation = " !\"#$%&'()*+,-.:;<=>?@[\\]^_`{|}~", .anyStart = true, .longest = 32};

/// True if Atria was built with libcgns.
bool cgnsIsAvailable();

/// Writes faces (NGON_n), cells (NFACE_n), patches with families, and zones as sub-regions. Throws Error for a file
/// that cannot be written, for a mesh too large for libcgns' 32-bit indices, and without libcgns.
void writeCgnsMesh(const std::filesystem::path& file, const SolverMesh& mesh, const RunContext& context);

} // namespace atria
