// SPDX-License-Identifier: GPL-3.0-or-later
/// The files of a flow case, except its mesh.
#pragma once

#include "CaseValues.h"

namespace atria {

/// Writes the folders 0, constant and system, Allrun and Allclean. Facts and values of `more` are added, and replace
/// others. Throws
/// Error if a condition rule names an unknown field or if a file cannot be written.
void writeCaseFiles(const std::filesystem::path& folder, const CaseOfDirection& flow, Filling more = {});
/// Returns the folder of surfaces within a case.
std::string surfaceFolder(OpenFOAMDialect dialect);
/// Writes Allrun and Allclean, which run those of the cases in `folders`.
void writeRoseScripts(const std::filesystem::path& folder, const std::vector<std::string>& folders);

} // namespace atria
