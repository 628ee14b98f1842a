// SPDX-License-Identifier: GPL-3.0-or-later
/// The wind that comes to a site: its profile over the height, and its direction.
#pragma once

#include "Support/Types.h"

#include <string>
#include <vector>

namespace atria {

/// Constants of the k-epsilon model as OpenFOAM's atmospheric conditions have them.
inline constexpr double vonKarman = 0.41;
inline constexpr double turbulenceCmu = 0.09;

/// The neutral atmospheric boundary layer of Richards and Hoxey (1993), "Appropriate boundary conditions for
/// computational wind engineering models using the k-epsilon turbulence model". Lengths in meters, above the ground;
/// speeds in m/s.
struct WindProfile
{
  double speed = 5.0; ///< at referenceHeight
  double referenceHeight = 10.0;
  double roughness = 0.1; ///< the roughness length z0

  /// u* = kappa U / ln((h + z0) / z0).
  double frictionVelocity() const;
  /// u* / kappa ln((z + z0) / z0).
  double velocity(double z) const;
  /// u*^2 / sqrt(Cmu), m2/s2, at all heights.
  double kineticEnergy() const;
  /// u*^3 / (kappa (z + z0)), m2/s3.
  double dissipation(double z) const;
  /// u* / (kappa sqrt(Cmu) (z + z0)), 1/s.
  double specificDissipation(double z) const;
};

/// Angles in degrees. `towards` is where the wind blows to, counterclockwise from x as seen from above; `from` is where
/// it comes from, clockwise from north, as weather services have it, in [0, 360); `north` is where north lies,
/// counterclockwise from y.
double windTowards(double from, double north);
double windFrom(double towards, double north);
/// Returns `towards` for so many directions at equal steps, the first with wind from north.
std::vector<double> windRose(int directions, double north);
/// Returns a vector of length 1.
Vec3 windVector(double towards);
/// Returns three digits before the point, and after it only those needed: "270", "022.5".
std::string windLabel(double from);

} // namespace atria
