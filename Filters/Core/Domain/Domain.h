// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Grid/Placement.h"
#include "Surface/Triangles/TriangleSurface.h"

#include <string_view>

namespace atria {

/// Bounds, along `axes`, of all points that triangles use; empty if there are none.
Box3 boundsOf(const TriangleSurface& surface, const Placement& axes = {});

/// The domain above a site: the bounds, along `axes`, of the surface named `site`, from its lowest point to 0.3 times
/// its longer side above its highest. Throws Error where there is no such surface (naming those there are), or where it
/// has no extent.
Box3 siteDomain(const TriangleSurface& surface, std::string_view site, const Placement& axes = {});

} // namespace atria
