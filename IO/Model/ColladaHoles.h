// SPDX-License-Identifier: GPL-3.0-or-later
/// Rewrites COLLADA's polygons with holes, which assimp does not read.
#pragma once

#include <string>

namespace atria::model {

/// Returns a COLLADA file in which polygons with holes (`<ph>`) are polygons without: bridges lead to the holes and
/// back, which cancel out in triangulation. Empty if the file has none.
std::string withoutHoles(const std::string& file);

} // namespace atria::model
