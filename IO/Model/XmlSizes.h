// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks the sizes that VTK's XML files state before VTK reads them.
#pragma once

#include <string>

namespace atria::model {

/// Throws Error if a file, or one of the files it consists of, states more than it can hold. VTK's readers trust the
/// stated sizes, and request that much memory or read for hours.
void checkXmlSizes(const std::string& file);

} // namespace atria::model
