// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks while an octree grows that its mesh fits the memory.
#pragma once

#include "Octree/Sizing/OctantSample.h"
#include "Support/Error.h"

#include <optional>
#include <span>
#include <string>

namespace atria {

/// Memory at the peak of all that `atria mesh` does, quality and files included. 630 to 740 bytes were measured for 0.3
/// to 2 million elements.
inline constexpr std::size_t bytesPerElement = 700;

/// Return a count as text, such as 23400 or 1.2 million, and bytes as text in gigabytes.
std::string inWords(double count);
std::string inGigabytes(double bytes);

/// Thrown if the requested elements do not fit the memory. The text names both, and sizes that would fit.
class TooManyElements : public Error
{
public:
  TooManyElements(const std::string& text, double leastElements, const OctantCounts& estimated)
      : Error(text), elements(leastElements), octants(estimated)
  {
  }

  /// Rough lower bound of the number of elements.
  double elements;
  OctantCounts octants;
};

/// Refuses sizes whose mesh does not fit the memory, or has more elements than numbers. Keeps references to all
/// arguments.
class ElementBudget
{
public:
  ElementBudget(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options);

  /// Throws TooManyElements if the mesh of the octants refined so far, by level, is already too large. Estimates the
  /// final number once when there are many octants, so that hopeless sizes are refused within seconds.
  void check(std::span<const std::span<const MortonKey>> refined, const RunContext& context);

private:
  [[noreturn]] void refuse(double elements) const;
  std::string textFor(double elements) const;
  std::string adviceFor() const;

  const SurfaceModel& model_;
  const GridFrame& frame_;
  const SizingOptions& options_;
  /// Elements that fit the memory, if there is a limit, and numbers; nullopt if MaxElements is no higher.
  std::optional<std::size_t> most;
  bool hasLooked = false;
  OctantCounts ahead;
};

} // namespace atria
