// SPDX-License-Identifier: GPL-3.0-or-later
/// The worst elements of a mesh with those about them.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Support/RunContext.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace atria {

/// Whether the greatest value of an array is the worst: not so of those metrics and quantities of Metrics.h and
/// CheckQuantities.h whose smallest is, known by their names in docs/arrays.md; so of any other.
bool greatestIsWorst(std::string_view arrayName);

struct WorstElementsOptions
{
  bool greatestIsWorst = true;
  std::optional<std::size_t> count; ///< at most so many; without it all
  std::optional<double> limit;      ///< only those beyond: above where the greatest is worst, else below
  int rings = 1;                    ///< of elements about them; each ring shares points with the one before
};

struct WorstElements
{
  /// Element ids: the worst, worst first and lower ids first where equal; then ring after ring, each rising.
  std::vector<Index> elements;
  std::vector<std::int32_t> ranks; ///< per element from 1, the worst; 0 in the rings
  std::vector<std::int32_t> rings; ///< per element 0 for the worst, 1 for the elements that touch them …
  std::size_t worstCount = 0;
};

/// One value for each element; elements whose value is not a number are never among the worst. Throws Error where the
/// values are not as many as the elements, Aborted when asked to.
WorstElements findWorstElements(std::span<const double> values, const CellArrays& cells, std::size_t pointCount,
                                const WorstElementsOptions& options, const RunContext& context);

} // namespace atria
