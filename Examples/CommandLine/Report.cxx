// SPDX-License-Identifier: GPL-3.0-or-later
#include "Report.h"

#include "Words.h"

#include <vtkAtriaDualMesher.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>
#include <string>

namespace atria::tool {

namespace {

vtkStringArray* stringsOf(vtkDataObject* data, const char* name)
{
  return vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
}

Json tupleOf(vtkDataArray* array, vtkIdType i)
{
  Json values = Json::array();
  for (int component = 0; component < array->GetNumberOfComponents(); ++component)
  {
    values.push_back(array->GetComponent(i, component));
  }
  return values;
}

Json linesOf(const std::string& text)
{
  Json lines = Json::array();
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

} // namespace

Json zonesOf(const Json& volumes, vtkPolyData* diagnostics)
{
  vtkFieldData* zones = diagnostics->GetFieldData();
  vtkDataArray* elements = zones->GetArray("ZoneElements");
  Json list = Json::array();
  for (int i = 0; i < elements->GetNumberOfTuples(); ++i)
  {
    const bool kept = zones->GetArray("ZoneKept")->GetTuple1(i) != 0.0;
    list.push_back({{"id", i},
                    {"elements", static_cast<vtkIdType>(elements->GetTuple1(i))},
                    {"kept", kept},
                    {"kind", stringsOf(diagnostics, "ZoneKind")->GetValue(i)},
                    {"volume", kept && !volumes.is_null() ? Json(volumes.value(std::to_string(i), 0.0)) : Json()},
                    {"rough_volume", zones->GetArray("ZoneVolume")->GetTuple1(i)},
                    {"inside", tupleOf(zones->GetArray("ZonePoint"), i)},
                    {"sides", linesOf(stringsOf(diagnostics, "ZoneSides")->GetValue(i))},
                    {"surfaces", linesOf(stringsOf(diagnostics, "ZoneSurfaces")->GetValue(i))}});
  }
  return list;
}

Json roomsOf(vtkPolyData* diagnostics)
{
  vtkFieldData* fields = diagnostics->GetFieldData();
  vtkStringArray* names = stringsOf(diagnostics, "RoomName");
  Json list = Json::array();
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    list.push_back({{"name", names->GetValue(i)},
                    {"volume", fields->GetArray("RoomVolume")->GetTuple1(i)},
                    {"floor_area", fields->GetArray("RoomFloorArea")->GetTuple1(i)},
                    {"openings", linesOf(stringsOf(diagnostics, "RoomOpenings")->GetValue(i))}});
  }
  return list;
}

Json openingsOf(vtkPolyData* diagnostics)
{
  vtkFieldData* fields = diagnostics->GetFieldData();
  vtkStringArray* names = stringsOf(diagnostics, "OpeningName");
  vtkStringArray* rooms = stringsOf(diagnostics, "RoomName");
  Json list = Json::array();
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    const auto room = [&](int side) {
      const auto id = static_cast<vtkIdType>(fields->GetArray("OpeningRooms")->GetComponent(i, side));
      return id < 0 ? Json() : Json(rooms->GetValue(id));
    };
    list.push_back({{"name", names->GetValue(i)},
                    {"surface", stringsOf(diagnostics, "OpeningSurface")->GetValue(i)},
                    {"area", fields->GetArray("OpeningArea")->GetTuple1(i)},
                    {"rooms", {room(0), room(1)}}});
  }
  return list;
}

Json leaksOf(vtkPolyData* diagnostics)
{
  vtkStringArray* kinds = stringsOf(diagnostics, "DiagnosticName");
  vtkDataArray* kindOf = diagnostics->GetCellData()->GetArray("Diagnostic");
  vtkDataArray* widths = diagnostics->GetCellData()->GetArray("Width");
  vtkFieldData* fields = diagnostics->GetFieldData();
  Json list = Json::array();
  for (vtkIdType cell = 0; cell < diagnostics->GetNumberOfCells(); ++cell)
  {
    if (kinds->GetValue(static_cast<vtkIdType>(kindOf->GetTuple1(cell))) != "LeakPath")
    {
      continue;
    }
    const auto i = static_cast<vtkIdType>(list.size());
    list.push_back({{"seed", tupleOf(fields->GetArray("LeakSeed"), i)},
                    {"side", stringsOf(diagnostics, "LeakSide")->GetValue(i)},
                    {"place", tupleOf(fields->GetArray("LeakPlace"), i)},
                    {"width", widths->GetTuple1(cell)},
                    {"surfaces", linesOf(stringsOf(diagnostics, "LeakSurfaces")->GetValue(i))},
                    {"message", inOptions(stringsOf(diagnostics, "LeakMessage")->GetValue(i))}});
  }
  return list;
}

Json qualityOf(vtkTable* summary)
{
  Json metrics = Json::object();
  for (vtkIdType row = 0; row < summary->GetNumberOfRows(); ++row)
  {
    const auto number = [&](const char* column) { return summary->GetValueByName(row, column).ToDouble(); };
    metrics[summary->GetValueByName(row, "Metric").ToString()] = {{"min", number("Minimum")},
                                                                  {"max", number("Maximum")},
                                                                  {"mean", number("Mean")},
                                                                  {"std", number("StandardDeviation")}};
  }
  return metrics;
}

Json checksOf(vtkTable* checks)
{
  Json list = Json::object();
  for (vtkIdType row = 0; row < checks->GetNumberOfRows(); ++row)
  {
    const auto value = [&](const char* column) { return checks->GetValueByName(row, column); };
    list[value("Check").ToString()] = {{"of", value("Of").ToString()},
                                       {"limit", value("Limit").ToDouble()},
                                       {"worst", value("Worst").ToDouble()},
                                       {"mean", value("Mean").ToDouble()},
                                       {"failing", value("Failing").ToLongLong()},
                                       {"is_error", value("IsError").ToInt() != 0},
                                       {"set", value("Set").ToString()},
                                       {"advice", inOptions(value("Advice").ToString())}};
  }
  return list;
}

Json textsOf(vtkPolyData* diagnostics, const char* name)
{
  Json out = Json::array();
  vtkStringArray* texts = stringsOf(diagnostics, name);
  for (vtkIdType i = 0; texts && i < texts->GetNumberOfValues(); ++i)
  {
    out.push_back(inOptions(texts->GetValue(i)));
  }
  return out;
}

std::vector<std::string> failedIn(const Json& checks)
{
  std::vector<std::string> names;
  for (const auto& [name, check] : checks.items())
  {
    if (check["is_error"].get<bool>() && check["failing"].get<long long>() > 0)
    {
      names.push_back(name);
    }
  }
  return names;
}

Json stageSecondsOf(vtkAtriaDualMesher* mesher)
{
  Json stages = Json::object();
  for (int i = 0; i < mesher->GetNumberOfStages(); ++i)
  {
    stages[mesher->GetStageName(i)] = mesher->GetStageSeconds(i);
  }
  return stages;
}

Json diagnosticsOf(vtkPolyData* diagnostics)
{
  Json counts = Json::object();
  vtkStringArray* names = stringsOf(diagnostics, "DiagnosticName");
  vtkDataArray* values = diagnostics->GetCellData()->GetArray("Diagnostic");
  std::map<int, vtkIdType> cells;
  for (vtkIdType i = 0; values && i < values->GetNumberOfTuples(); ++i)
  {
    ++cells[static_cast<int>(values->GetTuple1(i))];
  }
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    counts[names->GetValue(i)] = cells[static_cast<int>(i)];
  }
  Json missing = Json::array();
  vtkStringArray* without = stringsOf(diagnostics, "SurfaceWithoutFaces");
  for (vtkIdType i = 0; without && i < without->GetNumberOfValues(); ++i)
  {
    missing.push_back(without->GetValue(i));
  }
  counts["SurfaceWithoutFaces"] = missing;
  for (const char* name : {"InputWarning", "SizingWarning", "InputNote"})
  {
    counts[name] = textsOf(diagnostics, name);
  }
  return counts;
}

Json repairOf(vtkPolyData* diagnostics)
{
  Json repair = Json::object();
  vtkStringArray* names = stringsOf(diagnostics, "RepairName");
  vtkDataArray* values = diagnostics->GetFieldData()->GetArray("RepairValue");
  for (vtkIdType i = 0; names && values && i < names->GetNumberOfValues(); ++i)
  {
    // Counts are numbers without a fraction; the largest gap is a length.
    const double value = values->GetTuple1(i);
    const bool isCount = names->GetValue(i) != "LargestGap";
    repair[names->GetValue(i)] = isCount ? Json(static_cast<long long>(value)) : Json(value);
  }
  return repair;
}

Json hiddenDetailOf(vtkDataObject* data)
{
  vtkFieldData* fields = data->GetFieldData();
  vtkStringArray* names = stringsOf(data, "HiddenDetailSurface");
  std::vector<HiddenDetail> hidden;
  std::vector<std::string> surfaceNames;
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    const auto number = [&](const char* name) { return fields->GetArray(name)->GetTuple1(i); };
    hidden.push_back({static_cast<Index>(i), static_cast<std::size_t>(number("ClusteredTriangles")),
                      number("ClusteredArea"), static_cast<std::size_t>(number("LeftOutTriangles")),
                      number("LeftOutArea")});
    surfaceNames.push_back(names->GetValue(i));
  }
  return hiddenDetailOf(hidden, surfaceNames);
}

Json hiddenDetailOf(const std::vector<HiddenDetail>& hidden, const std::vector<std::string>& surfaceNames)
{
  Json list = Json::array();
  for (const HiddenDetail& detail : hidden)
  {
    list.push_back({{"surface", detail.surface < surfaceNames.size() ? surfaceNames[detail.surface] : ""},
                    {"left_out", {{"triangles", detail.leftOutTriangles}, {"area", detail.leftOutArea}}},
                    {"clustered", {{"triangles", detail.clusteredTriangles}, {"area", detail.clusteredArea}}}});
  }
  return list;
}

std::string hiddenDetailText(const Json& hidden, const std::string& before)
{
  constexpr std::size_t most = 8;
  const auto count = [](const Json& detail, const char* what) { return detail[what]["triangles"].get<long long>(); };
  const auto all = [&](const Json& detail) { return count(detail, "left_out") + count(detail, "clustered"); };
  std::vector<Json> sorted(hidden.begin(), hidden.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Json& a, const Json& b) { return all(a) > all(b); });
  std::string text;
  for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i)
  {
    text += before + sorted[i]["surface"].get<std::string>() + ": triangles in small parts left out " +
            std::to_string(count(sorted[i], "left_out")) + ", in clusters " +
            std::to_string(count(sorted[i], "clustered")) + '\n';
  }
  return text +
         (sorted.size() > most ? before + "and " + std::to_string(sorted.size() - most) + " surfaces more\n" : "");
}

Json layersOf(vtkPolyData* diagnostics, double speed)
{
  vtkFieldData* fields = diagnostics->GetFieldData();
  vtkStringArray* names = stringsOf(diagnostics, "LayerSurface");
  Json list = Json::array();
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    const auto number = [&](const char* name) { return fields->GetArray(name)->GetTuple1(i); };
    list.push_back({{"surface", names->GetValue(i)},
                    {"layers", static_cast<int>(number("LayersAsked"))},
                    {"area", number("LayerArea")},
                    {"covered", number("LayerCoverage")},
                    {"covered_in_full", number("LayerFullCoverage")},
                    {"thickness", number("LayerThicknessRatio")},
                    {"first_height", number("LayerFirstHeight")}});
    if (speed > 0.0)
    {
      list.back()["y_plus"] = vtkAtriaDualMesher::ComputeYPlus(number("LayerFirstHeight"), speed);
    }
  }
  return list;
}

namespace {

Json bodiesOf(vtkPolyData* diagnostics)
{
  vtkFieldData* fields = diagnostics->GetFieldData();
  Json bodies = Json::array();
  vtkStringArray* names = stringsOf(diagnostics, "AuditBody");
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    bodies.push_back({{"body", names->GetValue(i)},
                      {"state", stringsOf(diagnostics, "AuditBodyState")->GetValue(i)},
                      {"distance", fields->GetArray("AuditBodyDistance")->GetTuple1(i)},
                      {"volume", fields->GetArray("AuditBodyVolume")->GetTuple1(i)},
                      {"place", tupleOf(fields->GetArray("AuditBodyPlace"), i)}});
  }
  return bodies;
}

} // namespace

Json auditOf(vtkPolyData* diagnostics)
{
  vtkFieldData* fields = diagnostics->GetFieldData();
  vtkStringArray* names = stringsOf(diagnostics, "AuditSurface");
  Json surfaces = Json::array();
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    const auto number = [&](const std::string& name) {
      return fields->GetArray(("Audit" + name).c_str())->GetTuple1(i);
    };
    const auto distance = [&](const std::string& name) {
      return Json{{"distance", number(name + "Distance")},
                  {"in_elements", number(name + "DistanceInElements")},
                  {"place", tupleOf(fields->GetArray(("Audit" + name + "Place").c_str()), i)}};
    };
    surfaces.push_back({{"surface", names->GetValue(i)},
                        {"drawn_area", number("DrawnArea")},
                        {"outside", number("Outside")},
                        {"mesh_area", number("MeshArea")},
                        {"under_ground", number("UnderGround")},
                        {"in_solid", number("InSolid")},
                        {"in_room", number("InRoom")},
                        {"shared", number("Shared")},
                        {"left_out", number("LeftOut")},
                        {"lost", number("Lost")},
                        {"mean_size", number("MeanSize")},
                        {"largest_size", number("LargestSize")},
                        {"requested_size", number("RequestedSize")},
                        {"faces_from_model", distance("Faces")},
                        {"model_from_faces", distance("Model")}});
  }
  Json volumes = Json::object();
  vtkStringArray* kinds = stringsOf(diagnostics, "AuditVolumeName");
  for (vtkIdType i = 0; kinds && i < kinds->GetNumberOfValues(); ++i)
  {
    volumes[kinds->GetValue(i)] = fields->GetArray("AuditVolume")->GetTuple1(i);
  }
  const auto count = [&](const char* name) {
    vtkDataArray* array = fields->GetArray(name);
    return array ? static_cast<long long>(array->GetTuple1(0)) : 0;
  };
  Json warnings = Json::array();
  vtkStringArray* texts = stringsOf(diagnostics, "AuditWarning");
  for (vtkIdType i = 0; texts && i < texts->GetNumberOfValues(); ++i)
  {
    warnings.push_back(inOptions(texts->GetValue(i)));
  }
  return {{"surfaces", surfaces},
          {"volumes", volumes},
          {"closed_bodies", count("AuditClosedBodies")},
          {"standing_bodies", count("AuditStandingBodies")},
          {"bodies", bodiesOf(diagnostics)},
          {"warnings", warnings}};
}

void printLayers(const Json& layers)
{
  if (layers.empty())
  {
    return;
  }
  const bool hasYPlus = layers[0].contains("y_plus");
  std::printf("%-24s %6s %12s %9s %9s %9s%s\n", "surface", "layers", "area/m2", "covered", "in full", "thickness",
              hasYPlus ? "       y+" : "");
  for (const Json& entry : layers)
  {
    const auto percent = [&](const char* key) { return 100.0 * entry[key].get<double>(); };
    std::printf("%-24s %6d %12.2f %8.2f%% %8.2f%% %8.1f%%", entry["surface"].get<std::string>().c_str(),
                entry["layers"].get<int>(), entry["area"].get<double>(), percent("covered"), percent("covered_in_full"),
                percent("thickness"));
    hasYPlus ? std::printf(" %8.4g\n", entry["y_plus"].get<double>()) : std::printf("\n");
  }
}

Json maxLevelOf(vtkUnstructuredGrid* mesh)
{
  vtkDataArray* level = mesh->GetFieldData()->GetArray("MaxLevel");
  return level && level->GetNumberOfTuples() > 0 ? Json(static_cast<int>(level->GetTuple1(0))) : Json();
}

Json preflightOf(vtkTable* table)
{
  Json report = Json::object();
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    report[table->GetValueByName(row, "Quantity").ToString()] = table->GetValueByName(row, "Value").ToDouble();
  }
  const auto strings = [&](const char* name) {
    Json list = Json::array();
    vtkStringArray* texts = stringsOf(table, name);
    for (vtkIdType i = 0; texts && i < texts->GetNumberOfValues(); ++i)
    {
      list.push_back(texts->GetValue(i));
    }
    return list;
  };
  const auto messages = [&](const char* name) {
    Json list = strings(name);
    std::transform(list.begin(), list.end(), list.begin(), [](const Json& text) { return inOptions(text); });
    return list;
  };
  report["hidden_detail"] = hiddenDetailOf(table);
  report["opening_surfaces"] = strings("OpeningSurface");
  report["gap_surfaces"] = strings("GapSurface");
  report["warnings"] = messages("Warning");
  return report;
}

void printPreflight(vtkTable* table)
{
  constexpr double nothing = 1e-9; // beside the largest length
  const auto unit = [&](vtkIdType row) { return table->GetValueByName(row, "Unit").ToString(); };
  const auto value = [&](vtkIdType row) { return table->GetValueByName(row, "Value").ToDouble(); };
  double largest = 0.0;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    largest = unit(row) == "m" ? std::max(largest, std::abs(value(row))) : largest;
  }
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const bool isNothing = unit(row) == "m" && std::abs(value(row)) < nothing * largest;
    std::printf("%-22s %14.6g %s\n", table->GetValueByName(row, "Quantity").ToString().c_str(),
                isNothing ? 0.0 : value(row), unit(row).c_str());
  }
  std::printf("%s", hiddenDetailText(hiddenDetailOf(table), "HiddenDetail           ").c_str());
}

} // namespace atria::tool
