// SPDX-License-Identifier: GPL-3.0-or-later
/// What the fuzzers of readers have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

class vtkAtriaSurfaceReader;

namespace atria::fuzzing {

/// Writes the bytes to a file of that name, alone in a folder, and runs the reader on it with settings that depend on
/// the number of bytes, so that all get their share. Aborts unless the reader either keeps the promises of its output
/// or reports an error and gives none.
void readAndJudge(vtkAtriaSurfaceReader* reader, const std::string& name, const std::uint8_t* data, std::size_t size);

} // namespace atria::fuzzing
