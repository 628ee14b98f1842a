// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

#include <cstddef>

namespace atria {

/// Makes the winding of triangles that meet along edges of two triangles consistent, whatever surface they belong to. A
/// piece without open or shared edges is turned outwards; of any other piece the winding of the greater area stays, of
/// equal ones that of the first triangle. A piece that has but one side (a Moebius strip) stays as it is. Returns how
/// many triangles were turned. O(n log n).
std::size_t orientTriangles(TriangleSoup& soup, const Executor& executor);
/// The same where the uses of edges are known; they are kept up to date.
std::size_t orientTriangles(TriangleSoup& soup, std::span<SoupEdgeUse> uses);

} // namespace atria
