// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes a mesh as an input file of Abaqus and CalculiX.
#pragma once

#include "ElementMesh.h"
#include "Support/RunContext.h"

#include <filesystem>
#include <span>
#include <string>

namespace atria {

/// Abaqus' names begin with a letter, have up to 80 characters, and differ by more than capitals.
inline constexpr NameRules abaqusNames{.punctuation = "_-", .letterStart = true, .caseMatters = false, .longest = 80};

/// Returns the number as Abaqus and CalculiX read it: they take 20 characters at most. These are the shortest digits
/// that read back to the same value, or 13 digits if they do not fit.
std::string abaqusNumber(double value);

/// Returns 1 to 6, the number of the face (S1 to S6) of an element that has these points, or 0. `corners` are in VTK's
/// order.
int abaqusFace(unsigned char type, std::span<const Index> corners, std::span<const Index> face);

/// Writes nodes (set NALL), elements (set EALL), sets of elements for zones, and a surface for each patch. Elements are
/// C3D8, C3D6 and C3D4; there must be no pyramids. Patches without faces are left out. Comments record the original
/// names. Throws Error for a file that cannot be written.
void writeAbaqusMesh(const std::filesystem::path& file, const ElementMesh& mesh, const RunContext& context);

} // namespace atria
