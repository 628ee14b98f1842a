// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/OverlapWarnings.h"

#include <algorithm>
#include <sstream>

namespace atria {

namespace {

constexpr double leastFaces = 0.1;

std::string squareMeters(double area)
{
  std::ostringstream text;
  text.precision(4);
  text << area << " square meters";
  return text.str();
}

/// Returns one sentence for all pairs, which names the pair with the largest common area.
std::string textOfEqual(std::vector<SharedArea> equal, const std::vector<std::string>& names)
{
  std::ranges::stable_sort(equal, std::ranges::greater(), &SharedArea::equalArea);
  const SharedArea& first = equal.front();
  std::ostringstream text;
  text << "'" << names[first.keeps] << "' and '" << names[first.gives] << "' lie upon each other in "
       << squareMeters(first.equalArea)
       << " and neither is smaller: the first of them keeps its faces there, the other "
       << "has none";
  if (equal.size() > 1)
  {
    double area = 0.0;
    std::ranges::for_each(equal, [&](const SharedArea& shared) { area += shared.equalArea; });
    text << "; so it is with " << equal.size() - 1 << " more pairs of surfaces, " << squareMeters(area) << " in all";
  }
  text << ". Delete one of two that are the same, or cut it out of the other";
  return text.str();
}

std::string textOfOpened(const SharedArea& shared, const std::vector<std::string>& names)
{
  return "the face zone '" + names[shared.keeps] + "' opens the wall '" + names[shared.gives] +
         "', on which it lies, in " + squareMeters(shared.openedArea) +
         ": air passes there. Take it out of FaceZones if it should not";
}

std::string textOfClosed(const SharedArea& shared, const std::vector<std::string>& names)
{
  return "the face zone '" + names[shared.gives] + "' lies on the wall '" + names[shared.keeps] + "' in " +
         squareMeters(shared.area) +
         " and is not smaller: the wall stays closed there. Cut a hole into it if air should pass";
}

} // namespace

std::vector<std::string> warningsOfOverlaps(const SurfaceModel& model, double size)
{
  const double least = leastFaces * size * size;
  const auto isKind = [&](Index surface, SurfaceKind kind) {
    return (model.kinds.empty() ? SurfaceKind::wall : model.kinds[surface]) == kind;
  };
  std::vector<SharedArea> equal;
  std::vector<std::string> warnings;
  for (const SharedArea& shared : model.repair.shared)
  {
    if (shared.equalArea >= least && !isKind(shared.keeps, SurfaceKind::cellZone))
    {
      equal.push_back(shared);
    }
    if (shared.openedArea >= least)
    {
      warnings.push_back(textOfOpened(shared, model.names));
    }
    if (shared.area >= least && isKind(shared.gives, SurfaceKind::faceZone) && isKind(shared.keeps, SurfaceKind::wall))
    {
      warnings.push_back(textOfClosed(shared, model.names));
    }
  }
  if (!equal.empty())
  {
    warnings.push_back(textOfEqual(std::move(equal), model.names));
  }
  return warnings;
}

} // namespace atria
