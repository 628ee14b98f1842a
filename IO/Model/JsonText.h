// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <string_view>

namespace atria::model {

/// JSON, whose texts that are no UTF-8 are taken as Latin-1. Throws Error where it is damaged, with line, column and
/// what is wrong, but without the file's name.
nlohmann::json parseJson(std::string_view text);

/// An entry of an object; null where there is none.
const nlohmann::json& entryOf(const nlohmann::json& object, const char* key);

/// Empty where the value is no text.
std::string textOf(const nlohmann::json& value);

} // namespace atria::model
