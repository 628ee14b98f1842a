// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

/// Whether two triangles are seen, in double precision, to come nowhere within `reach` lattice units of each other but
/// at common points: one lies on one side of the other's plane. False where that is uncertain. Most pairs whose boxes
/// touch are told apart so, before exact signs.
bool areApart(const TriangleSoup& soup, Index first, Index second, double reach);

} // namespace atria
