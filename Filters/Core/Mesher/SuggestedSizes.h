// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes that follow from the model and its domain.
#pragma once

#include "Mesher/ModelOptions.h"
#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// Returns the sizes of the options. Sizes that are 0 are replaced:
///
/// - SizeMid by 2 SizeMin, or else by a quarter of SizeMax, or else by a size at which the model's surfaces take some
///   fifty thousand octants, or a twentieth of MaxElements if that is less;
/// - SizeMin by half of SizeMid;
/// - SizeMax by 4 SizeMid, or more so that the domain takes no more octants than that.
///
/// Sizes that do not follow from another size are rounded to 1, 2 or 5 times a power of ten. Only the options for the
/// domain are used in addition. Throws Error if the area is needed and the model has none, or one that overflows, and
/// if SizeMax is to follow and there is no domain.
GridOptions completeSizes(const TriangleSurface& surface, const ModelOptions& options);

} // namespace atria
