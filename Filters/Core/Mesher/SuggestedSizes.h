// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mesher/ModelOptions.h"

namespace atria {

/// Sizes for a first mesh of a model of which nothing is known: SizeMid so that the model's surfaces take some fifty
/// thousand octants, or a twentieth of MaxElements where that is less; SizeMin half of it, SizeMax four times as large,
/// or more so that the domain takes no more octants; all rounded to 1, 2 or 5 times a power of ten, or such a number
/// times 2 or 4. Of the other options those of the domain count. Throws Error for a model without area, or whose area
/// overflows, and where there is no domain.
GridOptions suggestSizes(const TriangleSurface& surface, const ModelOptions& options);

} // namespace atria
