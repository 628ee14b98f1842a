// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the connected parts of a soup.
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

#include <vector>

namespace atria {

/// Returns the part of each source of triangles. Parts are connected by common points; their numbers grow with the
/// greatest face of the part's box.
std::vector<Index> partsOf(const TriangleSoup& soup);

} // namespace atria
