// SPDX-License-Identifier: GPL-3.0-or-later
/// Charts of the quality tables of vtkAtriaMeshQuality: PDF as bars, CDF as a line, and the table of extremes and
/// means.
#pragma once

#include <string>

class vtkTable;

namespace atria::tool {

/// Writes a page of HTML that needs no other file, or a PNG image, by the ending of `file`. `title` stands above all.
/// Throws Failure(Failed) if it cannot be written.
void writeQualityPlot(const std::string& file, const std::string& title, vtkTable* summary, vtkTable* histogram);

} // namespace atria::tool
