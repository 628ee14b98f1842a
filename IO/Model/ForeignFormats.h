// SPDX-License-Identifier: GPL-3.0-or-later
/// Files of programs whose own format nobody else reads.
#pragma once

#include <string>

namespace atria::model {

/// What to do instead of reading the file, by its ending: the end of a sentence that begins with its name. Empty where
/// nothing is known of it.
std::string adviceOnForeignFile(const std::string& file);

} // namespace atria::model
