// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the bounds of a model and the domain above its site.
#pragma once

#include "Grid/Placement.h"
#include "Surface/Triangles/TriangleSurface.h"

#include <string_view>

namespace atria {

/// Returns the bounds, along `axes`, of all points that triangles use; empty if there are none.
Box3 boundsOf(const TriangleSurface& surface, const Placement& axes = {});

/// Returns the domain above a site: the bounds, along `axes`, of the surface named `site`, from its lowest point to 0.3
/// times its longer side above its highest. Throws Error if there is no such surface (the message names those there
/// are), or if it has no extent.
Box3 siteDomain(const TriangleSurface& surface, std::string_view site, const Placement& axes = {});

} // namespace atria
