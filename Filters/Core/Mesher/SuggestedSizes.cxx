// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/SuggestedSizes.h"

#include "Mesher/ModelStages.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Octants on the model's surfaces, and in the open: the mesh has some hundred thousand elements, at most a million.
constexpr double octantsAtMost = 50000.0;
constexpr double elementsEach = 20.0;

/// Returns fewer octants if the mesh may not have as many elements. Else it would lose the sizes at edges, and the
/// model would be repaired for sizes that the mesh does not have.
double octantsFor(const SizingOptions& sizing)
{
  const auto most = static_cast<double>(sizing.maxElements);
  return most > 0.0 ? std::min(octantsAtMost, most / elementsEach) : octantsAtMost;
}

/// Returns the nearest of 1, 2 and 5 times a power of ten, by ratio.
double roundNumber(double x)
{
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  const double digit = x / power;
  return power * (digit < std::sqrt(2.0) ? 1.0 : digit < std::sqrt(10.0) ? 2.0 : digit < std::sqrt(50.0) ? 5.0 : 10.0);
}

} // namespace

GridOptions completeSizes(const TriangleSurface& surface, const ModelOptions& options)
{
  const GridOptions standard;
  const double octants = octantsFor(options.sizing);
  GridOptions sizes = options.sizes;
  if (sizes.sizeMid == 0.0)
  {
    sizes.sizeMid = sizes.sizeMin != 0.0   ? sizes.sizeMin * standard.sizeMid / standard.sizeMin
                    : sizes.sizeMax != 0.0 ? sizes.sizeMax * standard.sizeMid / standard.sizeMax
                                           : roundNumber(std::sqrt(areaOf(surface) / octants));
    // A given SizeMax may lie between SizeMin and twice that.
    sizes.sizeMid = sizes.sizeMax != 0.0 ? std::min(sizes.sizeMid, sizes.sizeMax) : sizes.sizeMid;
  }
  if (sizes.sizeMin == 0.0)
  {
    sizes.sizeMin = sizes.sizeMid * standard.sizeMin / standard.sizeMid;
  }
  if (sizes.sizeMax == 0.0)
  {
    sizes.sizeMax = sizes.sizeMid * standard.sizeMax / standard.sizeMid;
    ModelOptions planned = options;
    planned.sizes = sizes;
    const GroundedInput grounded = groundModel(surface, planned);
    const double volume = planSite(grounded.surface, grounded.options).domain.volume();
    sizes.sizeMax = std::max(sizes.sizeMax, roundNumber(std::cbrt(volume / octants)));
  }
  return sizes;
}

} // namespace atria
