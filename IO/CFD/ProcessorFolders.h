// SPDX-License-Identifier: GPL-3.0-or-later
/// The folders processor0 and so on of a case, and its dictionary system/decomposeParDict.
#pragma once

#include "CaseTable.h"
#include "Support/Types.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace atria {

/// Returns the hidden folder in the case that holds the processors' folders until all are complete.
std::filesystem::path unfinishedProcessors(const std::filesystem::path& caseFolder);

/// Replaces all existing processor folders by the complete ones, and writes system/decomposeParDict for a mesh of that
/// size. Throws Error as refuseProcessorResults() does.
void placeProcessors(const std::filesystem::path& caseFolder, std::size_t parts, const Vec3& size,
                     const std::vector<std::string>& undivided = {});

/// Throws Error if the case has processor folders with results of a run: anything besides a mesh and the folder 0.
void refuseProcessorResults(const std::filesystem::path& caseFolder);

/// Removes the processor folders with all their content.
void removeProcessors(const std::filesystem::path& caseFolder);

/// Adds what the template of system/decomposeParDict names: the number of parts, and a grid of them over the ground
/// that is as square as their number allows. `size` is that of the mesh along the axes. Both halves of the patches
/// `undivided` stay on one processor.
void addDivision(Filling& filling, std::size_t parts, const Vec3& size, const std::vector<std::string>& undivided = {});

/// Writes system/decomposeParDict, which OpenFOAM's parallel runs need.
void writeDecomposition(const std::filesystem::path& caseFolder, std::size_t parts, const Vec3& size,
                        const std::vector<std::string>& undivided = {});

} // namespace atria
