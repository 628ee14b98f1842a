// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Octree/Sizing/Sizing.h"
#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// Sizes for a first mesh of a model of which nothing is known: SizeMid so that the model's surfaces take some fifty
/// thousand octants, rounded to 1, 2 or 5 times a power of ten; the others in the ratio of the defaults. Throws Error for a model
/// without area, or whose area overflows.
GridOptions suggestSizes(const TriangleSurface& surface);

} // namespace atria
