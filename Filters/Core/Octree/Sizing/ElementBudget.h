// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the mesh of an octree fits the memory there is, asked while the octree grows.
#pragma once

#include "Octree/Sizing/OctantSample.h"
#include "Support/Error.h"

#include <span>
#include <string>

namespace atria {

/// Memory at the peak of the whole of `atria mesh`, quality and files included: 630 to 740 bytes were measured at 0.3
/// to 2 million elements.
inline constexpr std::size_t bytesPerElement = 700;

/// As people say it: 23400, or 1.2 million; and bytes as gigabytes.
std::string inWords(double count);
std::string inGigabytes(double bytes);

/// Thrown where the elements that sizes ask for do not fit the memory. The text names both and sizes that would do.
class TooManyElements : public Error
{
public:
  TooManyElements(const std::string& text, double leastElements, const OctantCounts& estimated)
      : Error(text), elements(leastElements), octants(estimated)
  {
  }

  /// At least, roughly.
  double elements;
  OctantCounts octants;
};

/// Keeps a reference to all it is given.
class ElementBudget
{
public:
  ElementBudget(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options);

  /// Throws TooManyElements where the mesh of refined octants, by level, to which more may be added, is too large
  /// already. From some number of them on it looks once how many there will be, so that hopeless sizes are refused
  /// within seconds.
  void check(std::span<const std::span<const MortonKey>> refined, const RunContext& context);

private:
  [[noreturn]] void refuse(double elements) const;
  std::string textFor(double elements) const;
  std::string adviceFor() const;

  const SurfaceModel& model_;
  const GridFrame& frame_;
  const SizingOptions& options_;
  /// Elements that fit; 0 is no limit.
  std::size_t most;
  bool hasLooked = false;
  OctantCounts ahead;
};

} // namespace atria
