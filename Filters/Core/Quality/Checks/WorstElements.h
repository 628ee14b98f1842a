// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the worst elements of a mesh and the elements around them.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Support/RunContext.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace atria {

/// True if the greatest value of an array is the worst. False for the metrics and quantities of Metrics.h and
/// CheckQuantities.h whose smallest value is the worst, by their names in docs/arrays.md.
bool greatestIsWorst(std::string_view arrayName);

struct WorstElementsOptions
{
  bool greatestIsWorst = true;
  std::optional<std::size_t> count; ///< greatest number of worst elements; all if not set
  std::optional<double> limit;      ///< only elements beyond it: above if the greatest is worst, else below
  int rings = 1;                    ///< number of rings of elements around them; each ring shares points with the one
                                    ///< before
};

struct WorstElements
{
  /// Element ids: the worst, worst first and lower ids first where equal; then ring after ring, each rising.
  std::vector<Index> elements;
  std::vector<std::int32_t> ranks; ///< one entry per element: 1 for the worst and so on; 0 in the rings
  std::vector<std::int32_t> rings; ///< one entry per element: 0 for the worst, 1 for the elements that touch them …
  std::size_t worstCount = 0;
};

/// Finds the worst elements. `values` has one entry per element; elements whose value is not a number are never among
/// the worst. Throws Error if the number of values differs from that of elements, Aborted when asked to.
WorstElements findWorstElements(std::span<const double> values, const CellArrays& cells, std::size_t pointCount,
                                const WorstElementsOptions& options, const RunContext& context);

} // namespace atria
