// SPDX-License-Identifier: GPL-3.0-or-later
/// Polygons with holes of COLLADA, which assimp does not read.
#pragma once

#include <string>

namespace atria::model {

/// A COLLADA file in which polygons with holes (`<ph>`) are polygons without: bridges lead to the holes and back, which
/// cancel out when they are triangulated. Empty where the file has none.
std::string withoutHoles(const std::string& file);

} // namespace atria::model
