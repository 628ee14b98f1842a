// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkFeatureGraph.h"

#include "AddArray.h"
#include "Support/Text.h"
#include "Surface/Model/FeatureGraph.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <vector>

namespace atria {

namespace {

constexpr std::array<const char*, 5> curveKindNames{"boundary", "crease", "junction", "border", "corner"};
constexpr int cornerKind = 4;

/// Used points of the model, with VTK's numbers.
class PointNumbers
{
public:
  PointNumbers(const SurfaceModel& model, const GridFrame& frame)
      : model_(model), frame_(frame), numbers_(model.points.size(), -1)
  {
    points_->SetDataTypeToDouble();
  }
  vtkIdType operator()(Index p)
  {
    if (numbers_[p] < 0)
    {
      numbers_[p] = points_->InsertNextPoint(frame_.placement.toModel(frame_.toModel(model_.points[p])).data());
    }
    return numbers_[p];
  }
  vtkPoints* points() { return points_; }

private:
  const SurfaceModel& model_;
  const GridFrame& frame_;
  std::vector<vtkIdType> numbers_;
  vtkNew<vtkPoints> points_;
};

/// Returns the name of a surface; numbers after those of surfaces are domain sides.
std::string nameOf(const SurfaceModel& model, Index surface)
{
  const auto count = static_cast<Index>(model.names.size());
  return surface < count ? model.names[surface] : sideName(surface - count);
}

std::string namesOf(const SurfaceModel& model, const std::vector<Index>& surfaces)
{
  std::vector<std::string> names;
  std::ranges::transform(surfaces, std::back_inserter(names), [&](Index surface) { return nameOf(model, surface); });
  return joined(names, " + ");
}

/// Number of feature edges that end at a point, and the surfaces along them.
struct Meeting
{
  int edges = 0;
  std::vector<Index> surfaces;
};

std::vector<Meeting> meetingsOf(const SurfaceModel& model, const std::vector<std::vector<Index>>& surfacesOf)
{
  std::vector<Meeting> out(model.points.size());
  for (const FeatureEdge& edge : model.featureEdges)
  {
    const std::vector<Index>& along = surfacesOf[edge.curve];
    for (const Index p : {edge.a, edge.b})
    {
      ++out[p].edges;
      out[p].surfaces.insert(out[p].surfaces.end(), along.begin(), along.end());
    }
  }
  for (const Index p : model.corners)
  {
    std::sort(out[p].surfaces.begin(), out[p].surfaces.end());
    out[p].surfaces.erase(std::unique(out[p].surfaces.begin(), out[p].surfaces.end()), out[p].surfaces.end());
  }
  return out;
}

} // namespace

void featureCurvesToVtk(const SurfaceModel& model, const GridFrame& frame, vtkPolyData* out)
{
  const std::vector<std::vector<Index>> surfacesOf = surfacesOfCurves(model);
  const std::vector<Meeting> meetings = meetingsOf(model, surfacesOf);
  PointNumbers numbers(model, frame);
  auto* kinds = addArray<vtkIntArray>(out->GetCellData(), "CurveKind");
  auto* ids = addArray<vtkIntArray>(out->GetCellData(), "CurveId");
  auto* charts = addArray<vtkIntArray>(out->GetCellData(), "ChartId", 2);
  auto* degrees = addArray<vtkIntArray>(out->GetCellData(), "EdgeCount");
  auto* surfaces = addArray<vtkStringArray>(out->GetCellData(), "Surfaces");
  const auto addCell = [&](int kind, int curve, int chart, int otherChart, int degree,
                           const std::vector<Index>& names) {
    kinds->InsertNextValue(kind);
    ids->InsertNextValue(curve);
    charts->InsertNextValue(chart);
    charts->InsertNextValue(otherChart);
    degrees->InsertNextValue(degree);
    surfaces->InsertNextValue(namesOf(model, names));
  };
  vtkNew<vtkCellArray> corners;
  for (const Index p : model.corners)
  {
    corners->InsertNextCell({numbers(p)});
    addCell(cornerKind, -1, -1, -1, meetings[p].edges, meetings[p].surfaces);
  }
  vtkNew<vtkCellArray> lines;
  for (const FeatureEdge& edge : model.featureEdges)
  {
    const FeatureCurve& curve = model.curves[edge.curve];
    lines->InsertNextCell({numbers(edge.a), numbers(edge.b)});
    addCell(static_cast<int>(curve.kind), static_cast<int>(edge.curve), static_cast<int>(curve.charts.front()),
            static_cast<int>(curve.charts.back()), 1, surfacesOf[edge.curve]);
  }
  out->SetPoints(numbers.points());
  out->SetVerts(corners);
  out->SetLines(lines);
  addArrayOf<vtkStringArray>(out->GetFieldData(), "CurveKindName", curveKindNames);
}

void modelToVtk(const SurfaceModel& model, const GridFrame& frame, vtkPolyData* out)
{
  PointNumbers numbers(model, frame);
  addArrayOf<vtkIntArray>(out->GetCellData(), "SurfaceId", model.surfaceIds);
  addArrayOf<vtkIntArray>(out->GetCellData(), "ChartId", model.charts);
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : model.triangles)
  {
    triangles->InsertNextCell({numbers(a), numbers(b), numbers(c)});
  }
  out->SetPoints(numbers.points());
  out->SetPolys(triangles);
  std::vector<std::string> names = model.names;
  // Sides of a turned domain follow the surfaces, in order of their numbers.
  const auto count = model.surfaceIds.empty() ? 0 : *std::ranges::max_element(model.surfaceIds) + 1;
  for (auto id = static_cast<Index>(names.size()); id < count; ++id)
  {
    names.push_back(nameOf(model, id));
  }
  addArrayOf<vtkStringArray>(out->GetFieldData(), "SurfaceName", names);
}

} // namespace atria
