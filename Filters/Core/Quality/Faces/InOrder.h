// SPDX-License-Identifier: GPL-3.0-or-later
/// Products of vectors, added from the first component to the last as OpenFOAM does. Eigen adds in another order, which
/// differs in the last digit; this decides for values on a limit of checkMesh.
#pragma once

#include "Support/Types.h"

#include <cmath>

namespace atria {

/// OpenFOAM's VSMALL and ROOTVSMALL, which keep divisors off 0.
inline constexpr double vSmall = 1e-300;
inline constexpr double rootVSmall = 1e-150;

inline double dotInOrder(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline double lengthInOrder(const Vec3& a) { return std::sqrt(dotInOrder(a, a)); }

} // namespace atria
