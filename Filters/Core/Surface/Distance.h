// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

namespace atria {

/// The point of a triangle, or segment, nearest to p (Ericson 2005, 5.1).
Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
Vec3 nearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b);

} // namespace atria
