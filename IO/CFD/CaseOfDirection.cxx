// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseOfDirection.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

/// Share of the domain's length from which a wall is a side of the domain.
constexpr double lengthOfDomain = 0.99;

} // namespace

std::vector<CaseField> fieldsOf(const CaseOfDirection& flow)
{
  std::vector<CaseField> fields(caseFields().begin(), caseFields().end());
  for (const CaseScalar& scalar : flow.scalars)
  {
    fields.push_back({scalar.name, "volScalarField", FieldKind::Scalar, "", "scalar"});
  }
  return fields;
}

const CaseScalar* scalarOf(const CaseOfDirection& flow, const CaseField& field)
{
  const auto found = std::ranges::find(flow.scalars, field.name, &CaseScalar::name);
  return found == flow.scalars.end() ? nullptr : &*found;
}

std::vector<std::string> CaseOfDirection::namesOf(PatchRole role) const
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    if (choices[i].role == role)
    {
      names.push_back(mesh.patches[i].name);
    }
  }
  return names;
}

std::vector<std::string> CaseOfDirection::walls() const
{
  std::vector<std::string> names = namesOf(PatchRole::Wall);
  std::ranges::copy(namesOf(PatchRole::RoughWall), std::back_inserter(names));
  return names;
}

std::vector<std::size_t> CaseOfDirection::buildings() const
{
  const auto lengthOf = [&](const Box3& box) { return box.size().cwiseAbs().dot(wind.cwiseAbs()); };
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    const bool isWallOfBuilding = isWall(choices[i].role) && choices[i].role != PatchRole::Ground;
    const Box3& bounds = mesh.patches[i].bounds;
    if (isWallOfBuilding && !bounds.empty() && lengthOf(bounds) < lengthOfDomain * lengthOf(mesh.bounds))
    {
      found.push_back(i);
    }
  }
  return found;
}

} // namespace atria
