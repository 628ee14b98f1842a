// SPDX-License-Identifier: GPL-3.0-or-later
/// Patches and diagnostics of VtkDualMesh.h.
#include "AddArray.h"
#include "Layer/LayerRules.h"
#include "VtkDualMesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <set>

namespace atria {

namespace {

struct Patch
{
  std::string name;
  std::vector<Index> faces;
};

/// Makes a name unique by a number, in case a surface is named like another's side or like a side of the domain.
std::string uniqueName(std::string name, std::set<std::string>& taken)
{
  const std::string base = name;
  for (int i = 2; !taken.insert(name).second; ++i)
  {
    name = base + "_" + std::to_string(i);
  }
  return name;
}

/// Sorts faces into two patches per tag, front and back; one-sided surfaces and domain sides use the first.
std::vector<Patch> sortFaces(const DualMesh& mesh, const std::vector<MetSides>& met,
                             const std::vector<std::string>& names, std::set<std::string>& taken)
{
  const auto isTwoSided = [&](std::size_t tag) { return tag < names.size() && met[tag].isTwoSided(); };
  std::vector<Patch> patches(2 * met.size());
  for (Index f = 0; f < mesh.boundaryFaces.size(); ++f)
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    const bool second = isTwoSided(face.tag) && face.side == SheetSide::back;
    patches[2 * face.tag + (second ? 1 : 0)].faces.push_back(f);
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    const std::size_t tag = i / 2;
    if (met[tag].hasBoundary() && (i % 2 == 0 || isTwoSided(tag)))
    {
      const std::string name = tagName(static_cast<Index>(tag), names);
      const char* side = isTwoSided(tag) ? (i % 2 == 0 ? "_front" : "_back") : "";
      patches[i].name = uniqueName(name + side, taken);
    }
  }
  std::erase_if(patches, [](const Patch& p) { return p.name.empty(); });
  return patches;
}

/// Collects the internal faces of each face zone, in the order of surfaces.
std::vector<Patch> sortZones(const DualMesh& mesh, const std::vector<MetSides>& met,
                             const std::vector<std::string>& names, const std::vector<SurfaceKind>& kinds,
                             std::set<std::string>& taken)
{
  std::vector<Patch> zones(names.size());
  for (Index f = 0; f < mesh.zoneFaces.size(); ++f)
  {
    const Index tag = mesh.zoneFaces[f].tag;
    if (kinds[tag] == SurfaceKind::faceZone)
    {
      zones[tag].faces.push_back(f);
    }
  }
  for (std::size_t tag = 0; tag < zones.size(); ++tag)
  {
    const bool isMet = !kinds.empty() && kinds[tag] == SurfaceKind::faceZone && met[tag].within;
    zones[tag].name = isMet ? uniqueName(names[tag], taken) : std::string();
  }
  std::erase_if(zones, [](const Patch& zone) { return zone.name.empty(); });
  return zones;
}

class PatchWriter
{
public:
  PatchWriter(const DualMesh& source, std::size_t surfaceCount, const LayerReport& report,
              const std::optional<NumbersOfAll>& all)
      : mesh(source), surfaces(surfaceCount), layers(report), numbers(all), local(source.points.size(), noIndex)
  {
  }

  void write(const Patch& patch, vtkPolyData* out)
  {
    writeFaces(patch, mesh.boundaryFaces, out);
    vtkCellData* data = out->GetCellData();
    addArrayOf<vtkIntArray>(data, "Side", patch.faces,
                            [&](Index f) { return static_cast<int>(mesh.boundaryFaces[f].side); });
    addArrayOf<vtkIntArray>(data, "LayerCount", patch.faces,
                            [&](Index f) { return f < layers.counts.size() ? layers.counts[f] : 0; });
    addArrayOf<vtkDoubleArray>(data, "LayerThickness", patch.faces,
                               [&](Index f) { return f < layers.thicknesses.size() ? layers.thicknesses[f] : 0.0; });
  }

  void writeZone(const Patch& zone, vtkPolyData* out)
  {
    writeFaces(zone, mesh.zoneFaces, out);
    addArrayOf<vtkIdTypeArray>(out->GetCellData(), "NeighborCellId", zone.faces, [&](Index f) {
      const ZoneFace& face = mesh.zoneFaces[f];
      return numberOf(static_cast<Index>(mesh.neighbors[face.element][face.direction]));
    });
  }

private:
  vtkIdType numberOf(Index element) const
  {
    return numbers ? static_cast<vtkIdType>(numbers->elements[element]) : vtkIdType{element};
  }

  /// Adds points, polygons and the arrays that patches and zones have in common.
  template <typename Faces> void writeFaces(const Patch& patch, const Faces& faces, vtkPolyData* out)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> polys;
    auto* ids = addArray<vtkIdTypeArray>(out->GetPointData(), "VolumePointId");
    auto* surfaceIds = addArray<vtkIntArray>(out->GetCellData(), "SurfaceId");
    auto* owners = addArray<vtkIdTypeArray>(out->GetCellData(), "OwnerCellId");
    for (const Index f : patch.faces)
    {
      const auto& face = faces[f];
      const ReducedFace corners = faceOf(mesh.corners[face.element], face.direction);
      polys->InsertNextCell(corners.count);
      for (int i = 0; i < corners.count; ++i)
      {
        polys->InsertCellPoint(localPoint(corners.points[i], points, ids));
      }
      surfaceIds->InsertNextValue(face.tag < surfaces ? static_cast<int>(face.tag) : -1);
      owners->InsertNextValue(numberOf(face.element));
    }
    for (const Index p : used)
    {
      local[p] = noIndex;
    }
    used.clear();
    out->SetPoints(points);
    out->SetPolys(polys);
  }

  vtkIdType localPoint(Index p, vtkPoints* points, vtkIdTypeArray* ids)
  {
    if (local[p] == noIndex)
    {
      local[p] = static_cast<Index>(points->InsertNextPoint(mesh.points[p].data()));
      used.push_back(p);
      ids->InsertNextValue(numbers ? static_cast<vtkIdType>(numbers->points[p]) : p);
    }
    return local[p];
  }

  const DualMesh& mesh;
  std::size_t surfaces;
  const LayerReport& layers;
  const std::optional<NumbersOfAll>& numbers;
  std::vector<Index> local;
  std::vector<Index> used; ///< points with a local number
};

} // namespace

void patchesToVtk(const DualMesh& mesh, const std::vector<MetSides>& met, const std::vector<std::string>& surfaceNames,
                  const std::vector<SurfaceKind>& kinds, const LayerReport& layers,
                  vtkPartitionedDataSetCollection* out, const std::optional<NumbersOfAll>& numbers)
{
  PatchWriter writer(mesh, surfaceNames.size(), layers, numbers);
  std::set<std::string> taken;
  const std::vector<Patch> patches = sortFaces(mesh, met, surfaceNames, taken);
  const std::vector<Patch> zones = sortZones(mesh, met, surfaceNames, kinds, taken);
  out->SetNumberOfPartitionedDataSets(static_cast<unsigned>(patches.size() + zones.size()));
  const auto add = [&](std::size_t i, const Patch& patch, auto&& write) {
    vtkNew<vtkPolyData> polyData;
    (writer.*write)(patch, polyData);
    out->SetPartition(static_cast<unsigned>(i), 0, polyData);
    out->GetMetaData(static_cast<unsigned>(i))->Set(vtkCompositeDataSet::NAME(), patch.name.c_str());
  };
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    add(i, patches[i], &PatchWriter::write);
  }
  for (std::size_t i = 0; i < zones.size(); ++i)
  {
    add(patches.size() + i, zones[i], &PatchWriter::writeZone);
  }
}

void layersToVtk(const LayerReport& layers, vtkPolyData* out)
{
  vtkFieldData* data = out->GetFieldData();
  addArrayOf<vtkStringArray>(data, "LayerSurface", layers.surfaces, &LayerCoverage::surface);
  addArrayOf<vtkIntArray>(data, "LayersAsked", layers.surfaces, &LayerCoverage::layers);
  addArrayOf<vtkDoubleArray>(data, "LayerArea", layers.surfaces, &LayerCoverage::area);
  addArrayOf<vtkDoubleArray>(data, "LayerCoverage", layers.surfaces,
                             [](const LayerCoverage& s) { return s.layered / s.area; });
  addArrayOf<vtkDoubleArray>(data, "LayerFullCoverage", layers.surfaces,
                             [](const LayerCoverage& s) { return s.full / s.area; });
  addArrayOf<vtkDoubleArray>(data, "LayerThicknessRatio", layers.surfaces, &LayerCoverage::thickness);
  addArrayOf<vtkDoubleArray>(data, "LayerFirstHeight", layers.surfaces, &LayerCoverage::firstHeight);
  addArrayOf<vtkStringArray>(data, "FailingByThinLayers", layers.thin.failingChecks);
}

void hiddenDetailToVtk(const std::vector<HiddenDetail>& hidden, const std::vector<std::string>& surfaceNames,
                       vtkFieldData* out)
{
  addArrayOf<vtkStringArray>(out, "HiddenDetailSurface", hidden, [&](const HiddenDetail& detail) {
    return detail.surface < surfaceNames.size() ? surfaceNames[detail.surface] : std::string();
  });
  addArrayOf<vtkDoubleArray>(out, "LeftOutTriangles", hidden, &HiddenDetail::leftOutTriangles);
  addArrayOf<vtkDoubleArray>(out, "LeftOutArea", hidden, &HiddenDetail::leftOutArea);
  addArrayOf<vtkDoubleArray>(out, "ClusteredTriangles", hidden, &HiddenDetail::clusteredTriangles);
  addArrayOf<vtkDoubleArray>(out, "ClusteredArea", hidden, &HiddenDetail::clusteredArea);
}

void repairToVtk(const SurfaceRepairReport& report, vtkPolyData* out)
{
  const std::pair<const char*, double> entries[] = {
      {"WeldedPoints", static_cast<double>(report.weldedPoints)},
      {"DegenerateTriangles", static_cast<double>(report.degenerateTriangles)},
      {"DuplicateTriangles", static_cast<double>(report.duplicateTriangles)},
      {"OverlappingTriangles", static_cast<double>(report.overlappingTriangles)},
      {"SplitTriangles", static_cast<double>(report.splitTriangles)},
      {"IntersectionEdges", static_cast<double>(report.intersectionEdges)},
      {"ClosedGaps", static_cast<double>(report.closedGaps)},
      {"LargestGap", report.largestGap},
      {"FlippedTriangles", static_cast<double>(report.flippedTriangles)},
      {"UnresolvedContacts", static_cast<double>(report.unresolvedContacts)}};
  addArrayOf<vtkStringArray>(out->GetFieldData(), "RepairName", entries, &std::pair<const char*, double>::first);
  addArrayOf<vtkDoubleArray>(out->GetFieldData(), "RepairValue", entries, &std::pair<const char*, double>::second);
}

void diagnosticsToVtk(const DualMeshResult& result, const std::vector<std::string>& surfaceNames, vtkPolyData* out)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkCellArray> lines;
  auto* kinds = addArray<vtkIntArray>(out->GetCellData(), "Diagnostic");
  auto* elements = addArray<vtkIdTypeArray>(out->GetCellData(), "CellId");
  auto* widths = addArray<vtkDoubleArray>(out->GetCellData(), "Width");
  // Polydata keeps the data of vertices before those of lines.
  for (const bool asLines : {false, true})
  {
    for (const Diagnostic& diagnostic : result.diagnostics)
    {
      if ((diagnostic.begin != diagnostic.end) != asLines)
      {
        continue;
      }
      vtkCellArray* cells = asLines ? lines.Get() : vertices.Get();
      cells->InsertNextCell(asLines ? static_cast<int>(diagnostic.between.size()) + 2 : 1);
      cells->InsertCellPoint(points->InsertNextPoint(diagnostic.begin.data()));
      for (const Vec3& p : diagnostic.between)
      {
        cells->InsertCellPoint(points->InsertNextPoint(p.data()));
      }
      if (asLines)
      {
        cells->InsertCellPoint(points->InsertNextPoint(diagnostic.end.data()));
      }
      kinds->InsertNextValue(diagnostic.kind);
      elements->InsertNextValue(diagnostic.element == noIndex ? -1 : static_cast<vtkIdType>(diagnostic.element));
      widths->InsertNextValue(diagnostic.width);
    }
  }
  out->SetPoints(points);
  out->SetVerts(vertices);
  out->SetLines(lines);
  out->GetCellData()->SetActiveScalars("Diagnostic"); // programs color by this array by default
  addArrayOf<vtkStringArray>(out->GetFieldData(), "DiagnosticName", diagnosticNames);
  auto* lost = addArray<vtkStringArray>(out->GetFieldData(), "SurfaceWithoutFaces");
  for (std::size_t i = 0; i + result.rooms.found < surfaceNames.size(); ++i)
  {
    if (!result.metSides[i].hasBoundary() && !result.metSides[i].within)
    {
      lost->InsertNextValue(surfaceNames[i]);
    }
  }
  zonesToVtk(result.zones, surfaceNames, out->GetFieldData());
  leaksToVtk(result.leaks, surfaceNames, out->GetFieldData());
}

} // namespace atria
