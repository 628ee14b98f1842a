// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace atria::model {

/// What can be read of JSON that a strict parser refuses. Brackets that are missing are added where one around them
/// closes, and at the end; what makes no sense in a list becomes null there, so that what follows keeps its number.
/// Texts that are no UTF-8 are taken as Latin-1. `complaint` says what was expected first, with line and column; it
/// stays empty where there was nothing else wrong than such texts.
nlohmann::json readDamagedJson(std::string_view text, std::string& complaint);

} // namespace atria::model
