// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/CellMeasure.h"

namespace atria {

CellMeasure measureCell(const CellSource& source, Index cell, CellSource::Scratch& scratch)
{
  source.facesOf(cell, scratch);
  std::vector<FaceMeasure> faces;
  faces.reserve(scratch.faces.size());
  for (const CellFace& face : scratch.faces)
  {
    faces.push_back(
        measureFace(face.points.size(), [&](std::size_t i) -> const Vec3& { return source.points()[face.points[i]]; }));
  }
  return measureCell([&](auto&& visit) {
    for (const FaceMeasure& face : faces)
    {
      visit(face.centroid, face.area);
    }
  });
}

} // namespace atria
