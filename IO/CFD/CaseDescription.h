// SPDX-License-Identifier: GPL-3.0-or-later
/// Describes flow cases: in case.json for `atria report`, and in sentences for users.
#pragma once

#include "CaseValues.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace atria {

/// Returns the content of case.json, with an empty list of directions, and nothing that the incoming air carries.
nlohmann::ordered_json describeCase(const CaseOfDirection& flow);
/// Returns one entry of that list. `towards` is the direction the wind blows to; a room's entry leaves it out.
nlohmann::ordered_json describeDirection(const CaseOfDirection& flow, double towards, const std::string& folder);

/// Adds what the incoming air of a direction carries to the content of case.json.
void addIncoming(const CaseOfDirection& flow, nlohmann::ordered_json& report);

/// Returns texts one after the other, only the first of many.
std::string listed(const std::vector<std::string>& texts);

/// Returns one sentence on the openings through which air enters and leaves the room.
std::string summaryOfRoom(const CaseOfDirection& flow);

/// Returns a warning for each sheet that blows from both of its sides.
std::vector<std::string> warnOfSheets(const CaseOfDirection& flow);

/// Folders of the directions in which the wind does not enter an inlet, by the inlet's name.
using Windless = std::map<std::string, std::vector<std::string>>;
/// Returns a warning for each of these inlets. `folders` are those of all directions.
std::vector<std::string> warnOfWindless(const Windless& windless, const std::vector<std::string>& folders);

} // namespace atria
