// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/CheckTexts.h"

#include <array>
#include <sstream>
#include <string_view>

namespace atria {

namespace {

constexpr const char* notClosed = "the mesh is not closed; write it as the mesher made it";
constexpr const char* notValid = "solvers fail on such cells; make elements smaller there (SizeMin, SurfaceSizeRules), "
                                 "or have no layers on that surface (LayerRules)";
constexpr const char* distorted = "solvers lose accuracy there; make elements smaller where walls come close to each "
                                  "other or meet at sharp angles (SizeMin, SurfaceSizeRules)";
constexpr const char* thin = "cells differ too much from their neighbors; make layers thicker (FirstLayerHeight), or "
                             "elements beside them smaller";

struct Advice
{
  std::string_view check;
  const char* text;
};

constexpr std::array advices{
    Advice{"BoundaryOpenness", notClosed},
    Advice{"Openness", notClosed},
    Advice{"AreaAspectRatio", thin},
    Advice{"FaceArea", notValid},
    Advice{"Volume", notValid},
    Advice{"NonOrthogonalityError", notValid},
    Advice{"FacePyramids", notValid},
    Advice{"Skewness", distorted},
    Advice{"TetQuality",
           "solvers run, but particles cannot be tracked through such faces; make elements smaller there"},
    Advice{"Determinant",
           "no gradient can be determined from so few neighbors; make elements smaller in narrow corners, "
           "or have a layer on the walls (NumberOfLayers)"},
    Advice{"Concavity", "most solvers run on such cells; they are usual at walls that bend where there are no layers; "
                        "have a layer (NumberOfLayers), or make elements smaller there"},
    Advice{"FaceWeight", thin},
    Advice{"VolumeRatio", thin},
};

} // namespace

const char* nameOf(MeshPart part)
{
  switch (part)
  {
    case MeshPart::Cells:
      return "cells";
    case MeshPart::Faces:
      return "faces";
    case MeshPart::Points:
      return "points";
    default:
      return "mesh";
  }
}

const char* adviceFor(const MeshCheck& check)
{
  for (const Advice& advice : advices)
  {
    if (check.isError && advice.check == check.name)
    {
      return advice.text;
    }
  }
  return "";
}

std::vector<std::string> failureTexts(const MeshVerdict& verdict)
{
  std::vector<std::string> texts;
  for (const MeshCheck& check : verdict.checks)
  {
    if (!check.isError || check.failingCount == 0)
    {
      continue;
    }
    std::ostringstream text;
    text << "check " << check.name << " fails";
    if (check.part == MeshPart::Cells || check.part == MeshPart::Faces)
    {
      text << " at " << check.failingCount << ' ' << nameOf(check.part) << ", the first at (" << check.first[0] << ' '
           << check.first[1] << ' ' << check.first[2] << ')';
    }
    text << ": " << adviceFor(check);
    texts.push_back(text.str());
  }
  return texts;
}

} // namespace atria
