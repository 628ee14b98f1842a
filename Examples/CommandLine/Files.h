// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks names of files and folders, and turns VTK's errors into failures that name the file.
#pragma once

#include "Commands.h"

#include <string>

class vtkAlgorithm;

namespace atria::tool {

class Console;

/// True if a file holds a mesh in pieces, by its name.
bool isInPieces(const std::string& file);

/// Throws Failure(BadInput) unless `file` is a file that can be opened.
void checkReadable(const std::string& file);
/// Throw Failure(Usage) unless `file` ends in `ending`, such as ".vtu", and its folder exists. A folder to write need
/// not exist, but the one that contains it must.
void checkFolder(const std::string& option, const std::string& folder);
void checkOutput(const std::string& option, const std::string& file, const std::string& ending);

/// If VTK reported errors, throws Failure with them, prefixed by `about`.
void throwIfErrors(Console& console, ExitStatus status, const std::string& about);

/// Updates an algorithm. If VTK reported errors, throws Failure with them, prefixed by `about`.
void updateOrFail(vtkAlgorithm* algorithm, const std::string& about, Console& console);

} // namespace atria::tool
