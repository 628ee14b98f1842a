// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Limits of OpenFOAM's checkMesh that others than its checks look at, too: what is beyond one fails.
namespace atria::checkLimits {

/// Of the sine by which a cell's face is to lie within the planes of its others.
inline constexpr double concaveSine = 1e-6;
inline constexpr double determinant = 1e-3;
inline constexpr double faceWeight = 0.05;
inline constexpr double volumeRatio = 0.01;
inline constexpr double skewness = 4.0;

} // namespace atria::checkLimits
