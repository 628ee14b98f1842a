// SPDX-License-Identifier: GPL-3.0-or-later
#include "ModelSamples.h"

#include "Surface/Triangulation/PolygonTriangulation.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLMultiBlockDataWriter.h>
#include <vtkXMLPartitionedDataSetCollectionWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>
#include <cstdint>
#include <fstream>

namespace atria::testing {

namespace fs = std::filesystem;

SampleModel sampleHouse()
{
  SampleModel model;
  const auto add = [&](const std::string& name, const std::string& material,
                       const std::vector<std::vector<Vec3>>& polygons) {
    SampleModel::Surface surface{name, material, {}};
    for (const std::vector<Vec3>& polygon : polygons)
    {
      surface.faces.emplace_back();
      for (const Vec3& p : polygon)
      {
        const auto found = std::find(model.points.begin(), model.points.end(), p);
        surface.faces.back().push_back(static_cast<Index>(found - model.points.begin()));
        if (found == model.points.end())
        {
          model.points.push_back(p);
        }
      }
    }
    model.surfaces.push_back(surface);
  };
  add("Front", "Brick",
      {{{0, 0, 0}, {2, 0, 0}, {2, 0, 2.5}, {3.5, 0, 2.5}, {3.5, 0, 0}, {8, 0, 0}, {8, 0, 4}, {0, 0, 4}}});
  add("Back", "Brick", {{{8, 6, 0}, {0, 6, 0}, {0, 6, 4}, {8, 6, 4}}});
  add("Left", "Brick", {{{0, 6, 0}, {0, 0, 0}, {0, 0, 4}, {0, 3, 6}, {0, 6, 4}}});
  add("Right", "Brick", {{{8, 0, 0}, {8, 6, 0}, {8, 6, 4}, {8, 3, 6}, {8, 0, 4}}});
  add("Roof", "Tiles", {{{0, 0, 4}, {8, 0, 4}, {8, 3, 6}, {0, 3, 6}}, {{8, 6, 4}, {0, 6, 4}, {0, 3, 6}, {8, 3, 6}}});
  add("Floor", "", {{{0, 0, 0}, {0, 6, 0}, {8, 6, 0}, {8, 0, 0}}});
  return model;
}

std::vector<std::array<Vec3, 3>> trianglesOf(const SampleModel& model, const SampleModel::Surface& surface)
{
  std::vector<std::array<Vec3, 3>> triangles;
  for (const std::vector<Index>& face : surface.faces)
  {
    for (const auto& t : triangulatePolygon(model.points, face).triangles)
    {
      triangles.push_back({model.points[t[0]], model.points[t[1]], model.points[t[2]]});
    }
  }
  return triangles;
}

namespace {

std::ofstream textFile(const fs::path& file)
{
  std::ofstream out(file, std::ios::binary);
  out.precision(17);
  return out;
}

template <typename T> void append(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void writeVrml(const SampleModel& model, const fs::path& file)
{
  std::ofstream out = textFile(file);
  out << "#VRML V2.0 utf8\n";
  for (const auto& surface : model.surfaces)
  {
    out << "DEF " << surface.name << " Shape {\n";
    if (!surface.material.empty())
    {
      out << "appearance Appearance { material DEF " << surface.material << " Material {} }\n";
    }
    out << "geometry IndexedFaceSet { coord Coordinate { point [\n";
    for (const Vec3& p : model.points)
    {
      out << p.transpose() << ",\n";
    }
    out << "] } coordIndex [\n";
    for (const auto& face : surface.faces)
    {
      for (const Index i : face)
      {
        out << i << ' ';
      }
      out << "-1\n";
    }
    out << "] } }\n";
  }
}

/// Vertices with and without texture and normal, counted from the front and from the back, lines of three kinds.
void writeObj(const SampleModel& model, const fs::path& file)
{
  std::ofstream out = textFile(file);
  out << "# a house\nmtllib house.mtl\n";
  for (const Vec3& p : model.points)
  {
    out << "v " << p.transpose() << "\r\n";
  }
  out << "vt 0 0\nvn 0 0 1\n";
  const char* const endings[] = {"", "/1", "//1", "/1/1"};
  int kind = 0;
  for (const auto& surface : model.surfaces)
  {
    out << (kind % 2 ? "g " : "o ") << surface.name << "\n";
    out << (kind % 2 ? "" : "g\n"); // ends the group before
    out << "usemtl " << surface.material << "\n";
    for (const auto& face : surface.faces)
    {
      out << "f";
      for (const Index i : face)
      {
        const auto index = static_cast<long long>(i);
        out << (i % 3 ? " " : " \\\n  ") << (kind % 2 ? index + 1 : index - static_cast<long long>(model.points.size()))
            << endings[kind % 4];
      }
      out << "\n";
    }
    out << (kind % 2 ? "" : "o\n");
    ++kind;
  }
}

void writeStl(const SampleModel& model, const fs::path& file)
{
  std::ofstream out = textFile(file);
  for (const auto& surface : model.surfaces)
  {
    out << "solid " << surface.name << "\n";
    for (const auto& t : trianglesOf(model, surface))
    {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const Vec3& p : t)
      {
        out << "vertex " << p.transpose() << "\n";
      }
      out << "endloop\nendfacet\n";
    }
    out << "endsolid " << surface.name << "\n";
  }
}

/// A node for each surface, the JSON and the numbers apart. Y is up, as glTF has it.
struct Gltf
{
  std::string json;
  std::string binary;
};

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

Gltf gltfOf(const SampleModel& model, const std::string& uri)
{
  Gltf out;
  std::string nodes, meshes, accessors, views, materials, roots;
  const auto list = [](std::string& items, const std::string& item) { items += (items.empty() ? "" : ",") + item; };
  std::map<std::string, std::size_t> materialIds;
  for (std::size_t i = 0; i < model.surfaces.size(); ++i)
  {
    const auto& surface = model.surfaces[i];
    const auto triangles = trianglesOf(model, surface);
    Vec3 low = Vec3::Constant(1e30);
    Vec3 high = -low;
    const std::size_t start = out.binary.size();
    for (const auto& t : triangles)
    {
      for (const Vec3& corner : t)
      {
        const Vec3 p(corner.x(), corner.z(), -corner.y());
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
        for (int axis = 0; axis < 3; ++axis)
        {
          append(out.binary, static_cast<float>(p[axis]));
        }
      }
    }
    const auto vec = [](const Vec3& p) {
      return "[" + std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z()) + "]";
    };
    const std::string n = std::to_string(i);
    list(views, "{\"buffer\":0,\"byteOffset\":" + std::to_string(start) +
                    ",\"byteLength\":" + std::to_string(out.binary.size() - start) + "}");
    list(accessors, "{\"bufferView\":" + n + ",\"componentType\":5126,\"type\":\"VEC3\",\"count\":" +
                        std::to_string(3 * triangles.size()) + ",\"min\":" + vec(low) + ",\"max\":" + vec(high) + "}");
    std::string material;
    if (!surface.material.empty())
    {
      const auto [found, isNew] = materialIds.try_emplace(surface.material, materialIds.size());
      if (isNew)
      {
        list(materials, "{\"name\":" + quoted(surface.material) + "}");
      }
      material = ",\"material\":" + std::to_string(found->second);
    }
    list(meshes, "{\"primitives\":[{\"attributes\":{\"POSITION\":" + n + "}" + material + "}]}");
    list(nodes, "{\"name\":" + quoted(surface.name) + ",\"mesh\":" + n + "}");
    list(roots, n);
  }
  out.json = "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[" + roots + "]}],\"nodes\":[" +
             nodes + "],\"meshes\":[" + meshes + "],\"materials\":[" + materials + "],\"accessors\":[" + accessors +
             "],\"bufferViews\":[" + views + "],\"buffers\":[{" + uri +
             "\"byteLength\":" + std::to_string(out.binary.size()) + "}]}";
  return out;
}

void writeGltf(const SampleModel& model, const fs::path& file)
{
  const Gltf gltf = gltfOf(model, "\"uri\":\"house.bin\",");
  textFile(file.parent_path() / "house.bin") << gltf.binary;
  textFile(file) << gltf.json;
}

void writeGlb(const SampleModel& model, const fs::path& file)
{
  Gltf gltf = gltfOf(model, "");
  gltf.json.resize((gltf.json.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(28 + gltf.json.size() + gltf.binary.size()));
  append(bytes, static_cast<std::uint32_t>(gltf.json.size()));
  textFile(file) << (bytes + "JSON" + gltf.json);
  bytes.clear();
  append(bytes, static_cast<std::uint32_t>(gltf.binary.size()));
  std::ofstream(file, std::ios::binary | std::ios::app) << bytes << std::string("BIN\0", 4) << gltf.binary;
}

vtkNew<vtkPolyData> polyDataOf(const SampleModel& model, const std::vector<SampleModel::Surface>& surfaces)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : model.points)
  {
    points->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& surface : surfaces)
  {
    for (const auto& face : surface.faces)
    {
      const std::vector<vtkIdType> ids(face.begin(), face.end());
      cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

void writeVtp(const SampleModel& model, const fs::path& file)
{
  const vtkNew<vtkPolyData> data = polyDataOf(model, model.surfaces);
  vtkNew<vtkIntArray> ids;
  ids->SetName("SurfaceId");
  vtkNew<vtkStringArray> names;
  names->SetName("SurfaceName");
  vtkNew<vtkStringArray> materials;
  materials->SetName("MaterialName");
  for (const auto& surface : model.surfaces)
  {
    for (std::size_t i = 0; i < surface.faces.size(); ++i)
    {
      ids->InsertNextValue(static_cast<int>(names->GetNumberOfValues()));
    }
    names->InsertNextValue(surface.name);
    materials->InsertNextValue(surface.material);
  }
  data->GetCellData()->AddArray(ids);
  data->GetFieldData()->AddArray(names);
  data->GetFieldData()->AddArray(materials);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(data);
  writer->Write();
}

/// Walls are blocks within a block.
void writeVtm(const SampleModel& model, const fs::path& file)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkMultiBlockDataSet> walls;
  const auto add = [&](vtkMultiBlockDataSet* to, vtkDataObject* block, const std::string& name) {
    const unsigned index = to->GetNumberOfBlocks();
    to->SetBlock(index, block);
    to->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name);
  };
  for (const auto& surface : model.surfaces)
  {
    add(surface.material == "Brick" ? walls : blocks, polyDataOf(model, {surface}), surface.name);
  }
  add(blocks, walls, "Walls");
  vtkNew<vtkXMLMultiBlockDataWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(blocks);
  writer->Write();
}

void writeVtpc(const SampleModel& model, const fs::path& file)
{
  vtkNew<vtkPartitionedDataSetCollection> blocks;
  for (unsigned i = 0; i < model.surfaces.size(); ++i)
  {
    blocks->SetPartition(i, 0, polyDataOf(model, {model.surfaces[i]}));
    blocks->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), model.surfaces[i].name);
  }
  vtkNew<vtkXMLPartitionedDataSetCollectionWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(blocks);
  writer->Write();
}

} // namespace

const std::map<std::string, Writer>& writersWithNames()
{
  static const std::map<std::string, Writer> all{{"wrl", writeVrml},  {"obj", writeObj},  {"stl", writeStl},
                                                 {"gltf", writeGltf}, {"glb", writeGlb},  {"vtp", writeVtp},
                                                 {"vtm", writeVtm},   {"vtpc", writeVtpc}};
  return all;
}

void writeBinaryStl(const SampleModel& model, const fs::path& file)
{
  std::string facets;
  std::uint32_t count = 0;
  for (const auto& surface : model.surfaces)
  {
    for (const auto& t : trianglesOf(model, surface))
    {
      facets.append(12, '\0'); // normal
      for (const Vec3& p : t)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          append(facets, static_cast<float>(p[axis]));
        }
      }
      append(facets, std::uint16_t{0});
      ++count;
    }
  }
  std::string bytes(80, ' ');
  append(bytes, count);
  textFile(file) << bytes << facets;
}

void writePly(const SampleModel& model, const fs::path& file)
{
  std::ofstream out = textFile(file);
  std::string faces;
  std::size_t count = 0;
  for (const auto& surface : model.surfaces)
  {
    for (const auto& face : surface.faces)
    {
      faces += std::to_string(face.size());
      for (const Index i : face)
      {
        faces += " " + std::to_string(i);
      }
      faces += "\n";
      ++count;
    }
  }
  out << "ply\nformat ascii 1.0\nelement vertex " << model.points.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << count
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : model.points)
  {
    out << p.transpose() << "\n";
  }
  out << faces;
}

} // namespace atria::testing
