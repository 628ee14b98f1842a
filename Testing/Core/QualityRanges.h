// SPDX-License-Identifier: GPL-3.0-or-later
/// All ranges of the targets of quality, one after the other.
#pragma once

#include "Optimize/Kernel/QualityTargets.h"

#include <array>

namespace atria::testing {

inline constexpr std::array<QualityRange QualityTargets::*, 9> allRanges{
    &QualityTargets::pyramidCosine, &QualityTargets::convexity,     &QualityTargets::faceCosine,
    &QualityTargets::skewness,      &QualityTargets::weight,        &QualityTargets::volumeRatio,
    &QualityTargets::cornerVolume,  &QualityTargets::boundaryShape, &QualityTargets::determinantRoot};

} // namespace atria::testing
