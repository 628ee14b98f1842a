// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the winding of triangles consistent.
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

#include <cstddef>

namespace atria {

/// Turns triangles so that those that meet along edges of two triangles are wound consistently, whatever surface they
/// belong to. A piece without open or shared edges is turned outward. Any other piece keeps the winding of the greater
/// area, or that of the first triangle if areas are equal. A piece with only one side (a Moebius strip) stays as it is.
/// Returns the number of turned triangles. O(n log n).
std::size_t orientTriangles(TriangleSoup& soup, const Executor& executor);
/// The same with known uses of edges, which are kept up to date.
std::size_t orientTriangles(TriangleSoup& soup, std::span<SoupEdgeUse> uses);

} // namespace atria
