// SPDX-License-Identifier: GPL-3.0-or-later
/// Quality that elements at curved walls should have.
#pragma once

namespace atria {

/// Targets for hexahedra at curved walls, away from creases and boundary edges. Smaller values take longer.
struct CurvedWallTargets
{
  /// Largest non-orthogonality in degrees, greater than 0 and below 90.
  double nonOrthogonality = 20.0;
  /// Largest skewness by OpenFOAM's definition, greater than 0.
  double skewness = 0.5;
};

} // namespace atria
