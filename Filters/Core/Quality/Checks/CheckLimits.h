// SPDX-License-Identifier: GPL-3.0-or-later
/// Limits of OpenFOAM's checkMesh.
#pragma once

/// Limits of checkMesh that code outside its checks uses too. Values beyond a limit fail.
namespace atria::checkLimits {

/// Sine of the angle by which a cell's faces must lie inside the planes of its other faces.
inline constexpr double concaveSine = 1e-6;
inline constexpr double determinant = 1e-3;
inline constexpr double faceWeight = 0.05;
inline constexpr double volumeRatio = 0.01;
inline constexpr double skewness = 4.0;

} // namespace atria::checkLimits
