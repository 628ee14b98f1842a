// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace atria::model {

/// VTK's readers of XML files believe what a file says of its sizes, and ask for that much memory or read for hours.
/// Throws Error where a file, or one of the files it consists of, states more than it can hold.
void checkXmlSizes(const std::string& file);

} // namespace atria::model
