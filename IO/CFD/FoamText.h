// SPDX-License-Identifier: GPL-3.0-or-later
/// Values and files of OpenFOAM's dictionaries.
#pragma once

#include "FoamTemplate.h"
#include "Support/Types.h"

#include <filesystem>
#include <span>

namespace atria {

/// Returns the shortest digits that read back to the same value; a zero without sign.
std::string foamNumber(double value);
/// Returns `(x y z)`.
std::string foamVector(const Vec3& v);
/// Returns `(a b c)`.
std::string foamList(std::span<const std::string> words);

/// Writes a file of a case with OpenFOAM's header; `path` is its folder and name within the case. Makes the folder.
/// Throws Error naming the file.
void writeFoamFile(const std::filesystem::path& caseFolder, const std::filesystem::path& path,
                   std::string_view className, const Lines& content);
/// Writes a file beside its place and moves it there. Throws Error naming the file.
void writePlainFile(const std::filesystem::path& path, std::string_view content);
/// Writes a plain file of lines that can be executed. Throws Error naming the file.
void writeScript(const std::filesystem::path& path, const Lines& content);

} // namespace atria
