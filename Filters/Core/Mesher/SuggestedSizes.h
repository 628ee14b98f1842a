// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes that follow from the model and its domain.
#pragma once

#include "Mesher/ModelOptions.h"
#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// The sizes of the options; those that are 0 are replaced:
///
/// - SizeMid by 2 SizeMin, or else by a quarter of SizeMax, or else by a size of which the model's surfaces take some
///   fifty thousand octants, or a twentieth of MaxElements where that is less;
/// - SizeMin by half of SizeMid;
/// - SizeMax by 4 SizeMid, or more so that the domain takes no more octants than that.
///
/// What does not follow from another size is rounded to 1, 2 or 5 times a power of ten. Of the other options those of
/// the domain count. Throws Error where the area is needed and the model has none, or one that overflows, and where
/// SizeMax is to follow and there is no domain.
GridOptions completeSizes(const TriangleSurface& surface, const ModelOptions& options);

} // namespace atria
