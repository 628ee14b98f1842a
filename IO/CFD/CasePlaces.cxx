// SPDX-License-Identifier: GPL-3.0-or-later
#include "CasePlaces.h"

#include "FlowCase.h"
#include "PatchNames.h"
#include "Support/NamePattern.h"

namespace atria {

Places placesOf(const CaseMesh& mesh, const std::vector<PatchChoice>& choices)
{
  Places places;
  for (const CaseRoom& room : mesh.rooms)
  {
    places.zones[room.name] = room.volume;
  }
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    const CasePatch& patch = mesh.patches[i];
    if (choices[i].role != PatchRole::Constraint)
    {
      (letsAirThrough(choices[i].role) ? places.openings : places.surfaces)[patch.name] = patch.area;
    }
    if (choices[i].role == PatchRole::Slip)
    {
      places.slipping[patch.name] = patch.area;
    }
  }
  return places;
}

Sizes matching(const std::string& pattern, const Sizes& sizes)
{
  Sizes found = sizes;
  std::erase_if(found, [&](const auto& named) { return !matchesPatchName(pattern, named.first, openFOAMNames); });
  return found;
}

double sum(const Sizes& sizes)
{
  double total = 0.0;
  for (const auto& [name, size] : sizes)
  {
    total += size;
  }
  return total;
}

void divide(double amount, const Sizes& among, std::map<std::string, double>& shares)
{
  const double whole = sum(among);
  for (const auto& [name, size] : among)
  {
    if (size > 0.0)
    {
      shares[name] += amount * size / whole;
    }
  }
}

bool isKnown(const std::string& pattern, const Places& places)
{
  return !matching(pattern, places.zones).empty() || !matching(pattern, places.surfaces).empty() ||
         !matching(pattern, places.openings).empty();
}

std::string unmatched(const std::string& pattern, const Places& places)
{
  std::vector<std::string> names;
  for (const Sizes* sizes : {&places.zones, &places.surfaces, &places.openings})
  {
    for (const auto& [name, size] : *sizes)
    {
      names.push_back(name);
    }
  }
  return "no cell zone and no patch matches '" + pattern + "'; " + namesInstead(pattern, names);
}

} // namespace atria
