// SPDX-License-Identifier: GPL-3.0-or-later
/// Parses JSON of files that may be damaged.
#pragma once

#include <nlohmann/json.hpp>

#include <string_view>

namespace atria::model {

/// Parses JSON; texts that are no UTF-8 are taken as Latin-1. Throws Error if it is damaged, with line, column and the
/// problem, but without the file's name.
nlohmann::json parseJson(std::string_view text);

/// Returns an entry of an object; null if there is none.
const nlohmann::json& entryOf(const nlohmann::json& object, const char* key);

/// Returns a text; empty if the value is none.
std::string textOf(const nlohmann::json& value);

} // namespace atria::model
