// SPDX-License-Identifier: GPL-3.0-or-later
/// Advice on files of programs whose own format no other program reads.
#pragma once

#include <string>

namespace atria::model {

/// Returns what to do instead of reading the file, by its ending: the end of a sentence that begins with the file's
/// name. Empty for an unknown ending.
std::string adviceOnForeignFile(const std::string& file);

} // namespace atria::model
