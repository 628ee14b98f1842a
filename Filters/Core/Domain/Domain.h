// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/TriangleSurface.h"

#include <string_view>

namespace atria {

/// Bounds of all points that triangles use; empty if there are none.
Box3 boundsOf(const TriangleSurface& surface);

/// The domain above a site: the bounds of the surface named `site`, from its lowest point to 0.3 times its longer side
/// above its highest. Throws Error where there is no such surface (naming those there are), or where it has no extent.
Box3 siteDomain(const TriangleSurface& surface, std::string_view site);

} // namespace atria
