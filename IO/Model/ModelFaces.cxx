// SPDX-License-Identifier: GPL-3.0-or-later
#include "ModelFaces.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace atria::model {

namespace {

/// Bits of an index into the points requested last.
constexpr int recentBits = 11;

} // namespace

std::uint64_t ModelFaces::hashOf(const std::array<double, 3>& p)
{
  const auto bits = [&](int axis) { return std::bit_cast<std::uint64_t>(p[axis]); };
  return mixed(bits(0) * 0x9e3779b97f4a7c15 + bits(1) * 0xc2b2ae3d27d4eb4f + bits(2) * 0x165667b19e3779f9);
}

/// Makes room for twice as many points once the table is full.
void ModelFaces::reserveTable()
{
  if (points.size() < room)
  {
    return;
  }
  room = std::max<std::size_t>(1024, 2 * points.size());
  places = IndexTable(room);
  recent.resize(std::size_t{1} << recentBits);
  for (Index i = 0; i < points.size(); ++i)
  {
    places.findOrAdd(hashOf(points[i]), i, [&](Index other) { return points[other] == points[i]; });
  }
}

std::size_t ModelFaces::pointAt(const std::array<double, 3>& p)
{
  reserveTable();
  const std::uint64_t hash = hashOf(p);
  Recent& last = recent[hash >> (64 - recentBits)];
  if (last.point == noIndex || last.place != p)
  {
    const auto next = static_cast<Index>(points.size());
    last = {p, places.findOrAdd(hash, next, [&](Index other) { return points[other] == p; })};
    if (last.point == next)
    {
      points.push_back(p);
    }
  }
  return last.point;
}

bool ModelFaces::add(std::span<const std::size_t> corners, int part)
{
  const bool good = corners.size() >= 3 && std::all_of(corners.begin(), corners.end(), [&](std::size_t id) {
                      return id < points.size() && std::all_of(points[id].begin(), points[id].end(),
                                                               [](double value) { return std::isfinite(value); });
                    });
  if (!good)
  {
    ++leftOut;
    return false;
  }
  ids.insert(ids.end(), corners.begin(), corners.end());
  offsets.push_back(ids.size());
  parts.push_back(part);
  return true;
}

void ModelFaces::scale(double factor)
{
  for (auto& p : points)
  {
    p = {factor * p[0], factor * p[1], factor * p[2]};
  }
}

void ModelFaces::giveTo(Model& model, const std::vector<std::string>& names, const char* kind) const
{
  vtkNew<vtkPoints> kept;
  kept->SetDataTypeToDouble();
  std::vector<vtkIdType> placeOf(points.size(), -1); // points that no face has are left out
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i)
  {
    cells->InsertNextCell(static_cast<int>(offsets[i + 1] - offsets[i]));
    for (std::size_t k = offsets[i]; k < offsets[i + 1]; ++k)
    {
      vtkIdType& place = placeOf[ids[k]];
      place = place < 0 ? kept->InsertNextPoint(points[ids[k]].data()) : place;
      cells->InsertCellPoint(place);
    }
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(kept);
  data->SetPolys(cells);
  setSurfaces(data, parts, names);
  model.data = data;
  if (leftOut > 0)
  {
    model.warnings.push_back(std::to_string(leftOut) + " " + kind + " are left out: they have fewer than three " +
                             "corners, or some that do not exist or are no numbers");
  }
}

} // namespace atria::model
