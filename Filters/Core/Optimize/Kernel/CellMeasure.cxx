// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/CellMeasure.h"

#include <algorithm>
#include <cmath>

namespace atria {

double weightOf(const FaceMeasure& face, const CellMeasure& own, const CellMeasure& other)
{
  const double nearer = std::abs(face.normal.dot(face.centroid - own.centroid));
  const double farther = std::abs(face.normal.dot(other.centroid - face.centroid));
  return std::min(nearer, farther) / (nearer + farther + rootVSmall);
}

double volumeRatioOf(const CellMeasure& own, const CellMeasure& other)
{
  const double larger = std::max(std::abs(own.volume), std::abs(other.volume));
  return std::min(own.volume, other.volume) / (larger + rootVSmall);
}

SizedCell measureCell(const CellSource& source, Index cell, CellSource::Scratch& scratch,
                      std::vector<FaceMeasure>& faces)
{
  source.facesOf(cell, scratch);
  const std::vector<Vec3>& points = source.points();
  faces.clear();
  double length = 0.0;
  std::size_t count = 0;
  for (const CellFace& face : scratch.faces)
  {
    const auto pointOf = [&](std::size_t i) -> const Vec3& { return points[face.points[i]]; };
    faces.push_back(measureAnyFace(face.points.size(), pointOf));
    length += perimeterOf(face.points.size(), pointOf);
    count += face.points.size();
  }
  const CellMeasure measure = measureCell([&](auto&& visit) {
    for (const FaceMeasure& face : faces)
    {
      visit(face.centroid, face.area);
    }
  });
  return {measure, length / std::max(static_cast<double>(count), 1.0)};
}

} // namespace atria
