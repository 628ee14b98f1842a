// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/QualityTargets.h"

namespace atria {

QualityTargets QualityTargets::beyond(double share) const
{
  QualityTargets out = *this;
  for (QualityRange* range : {&out.pyramidCosine, &out.convexity, &out.faceCosine, &out.skewness, &out.weight,
                              &out.volumeRatio, &out.cornerVolume, &out.boundaryShape, &out.determinantRoot})
  {
    *range = range->beyond(share);
  }
  out.scaledJacobian *= 1.0 + share;
  return out;
}

} // namespace atria
