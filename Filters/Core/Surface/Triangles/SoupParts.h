// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

#include <vector>

namespace atria {

/// The parts of a soup that are connected by common points, by the source of their triangles: numbers that grow with
/// the greatest face of the part's box.
std::vector<Index> partsOf(const TriangleSoup& soup);

} // namespace atria
