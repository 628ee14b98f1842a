// SPDX-License-Identifier: GPL-3.0-or-later
/// Templates of OpenFOAM's dictionaries: texts with named values, such as `nu {{airViscosity}};`.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace atria {

using Lines = std::vector<std::string>;

/// Returns the lines of a template with each `{{name}}` replaced by the value that `valueOf` returns for it:
/// - Alone on a line, it stands for all lines of the value, with its own indentation. Without any the line disappears.
/// - Within a line, it stands for a value of one line. If it is part of a key, the entry's value keeps its column.
/// Throws Error for a name that is not closed, and for a value within a line that has not one line.
Lines fillTemplate(std::string_view text, const std::function<Lines(const std::string& name)>& valueOf);

/// Returns the text of a file in the folder Templates, such as `system/fvSchemes`. Throws Error if there is none.
std::string_view foamTemplate(std::string_view name);
/// Returns all templates by name.
const std::map<std::string, std::string_view, std::less<>>& foamTemplates();

} // namespace atria
