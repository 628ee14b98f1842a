// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/Domain.h"

#include "Support/Error.h"
#include "Support/NamePattern.h"

#include <algorithm>

namespace atria {

Box3 boundsOf(const TriangleSurface& surface, const Placement& axes)
{
  Box3 box;
  for (const auto& t : surface.triangles)
  {
    for (const Index p : t)
    {
      box.extend(axes.fromModel(surface.points[p]));
    }
  }
  return box;
}

Box3 siteDomain(const TriangleSurface& surface, std::string_view site, const Placement& axes)
{
  const auto found = std::find(surface.names.begin(), surface.names.end(), site);
  if (found == surface.names.end())
  {
    throw Error("there is no surface '" + std::string(site) + "' to be the site; " + namesInstead(site, surface.names));
  }
  const auto id = static_cast<Index>(found - surface.names.begin());
  Box3 box;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    for (const Index p : surface.triangles[i])
    {
      if (surface.surfaceIds[i] == id)
      {
        box.extend(axes.fromModel(surface.points[p]));
      }
    }
  }
  if (box.empty() || !(box.size()[0] > 0.0) || !(box.size()[1] > 0.0))
  {
    throw Error("the site '" + std::string(site) + "' has no extent in x and y");
  }
  constexpr double heightRatio = 0.3;
  box.max[2] += heightRatio * std::max(box.size()[0], box.size()[1]);
  return box;
}

} // namespace atria
