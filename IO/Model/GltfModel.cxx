// SPDX-License-Identifier: GPL-3.0-or-later
/// glTF. vtkGLTFReader names its blocks by number, so the nodes are walked here in what vtkGLTFDocumentLoader has read.
#include "ModelFile.h"

#include "Support/Error.h"
#include "Support/Utf8.h"

#include <vtkCellArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkGLTFDocumentLoader.h>
#include <vtkInformation.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <set>

namespace atria::model {

namespace {

bool isBinary(const std::string& file) { return std::filesystem::path(file).extension() == ".glb"; }

/// Throws Error unless a binary file consists of a header and chunks of the lengths they state: the loader reads on for
/// ever in one that was cut off.
void checkChunks(const std::string& file, const std::string& bytes)
{
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return static_cast<std::size_t>(value);
  };
  constexpr std::size_t header = 12;
  constexpr std::size_t chunkHeader = 8;
  bool good = bytes.size() >= header && bytes.compare(0, 4, "glTF") == 0 && number(8) == bytes.size();
  std::size_t at = header;
  while (good && at < bytes.size())
  {
    good = bytes.size() - at >= chunkHeader && number(at) <= bytes.size() - at - chunkHeader;
    at += good ? chunkHeader + number(at) : 0;
  }
  if (!good)
  {
    throw Error("'" + file + "' cannot be read as glTF 2.0: it is cut off or damaged; export it again");
  }
}

/// Throws Error where nodes have several parents or go round in a circle, in which the loader would not come to an end.
void checkTree(const vtkGLTFDocumentLoader::Model& model, const std::string& file)
{
  std::vector<int> parents(model.Nodes.size(), -1);
  bool good = true;
  for (std::size_t i = 0; i < model.Nodes.size(); ++i)
  {
    for (const int child : model.Nodes[i].Children)
    {
      const bool exists = child >= 0 && child < static_cast<int>(parents.size());
      good = good && exists && parents[child] < 0;
      if (exists)
      {
        parents[child] = static_cast<int>(i);
      }
    }
  }
  for (const auto& scene : model.Scenes)
  {
    for (const unsigned root : scene.Nodes)
    {
      good = good && root < parents.size() && parents[root] < 0;
    }
  }
  if (!good)
  {
    throw Error("'" + file + "': its nodes are no tree: one has several parents, or does not exist; export it again");
  }
}

/// Whether an extension the loader does not know changes what surfaces there are.
bool hidesGeometry(const std::string& warning)
{
  for (const char* extension : {"draco", "meshopt", "mesh_gpu_instancing"})
  {
    if (warning.find(extension) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

void load(vtkGLTFDocumentLoader* loader, const std::string& file)
{
  const Messages messages(loader);
  const auto check = [&](bool good) {
    if (!good)
    {
      throw Error("'" + file + "' cannot be read as glTF 2.0" +
                  (messages.error().empty() ? "" : ": " + messages.error()) + "; export it again");
    }
  };
  check(loader->LoadModelMetaDataFromFile(file));
  for (const std::string& warning : messages.warnings())
  {
    if (hidesGeometry(warning))
    {
      throw Error("'" + file + "': " + warning + " Export the model without compression and instancing extensions.");
    }
  }
  checkTree(*loader->GetInternalModel(), file);
  loader->GetInternalModel()->Images.clear(); // textures are no part of a surface, and may be missing
  std::vector<char> buffer;
  check(!isBinary(file) || loader->LoadFileBuffer(file, buffer));
  check(loader->LoadModelData(buffer));
  check(loader->BuildModelVTKGeometry());
}

/// `points` moved by a node's transform.
vtkNew<vtkPoints> placed(vtkPoints* points, vtkMatrix4x4* transform)
{
  vtkNew<vtkPoints> out;
  out->SetDataTypeToDouble();
  out->SetNumberOfPoints(points->GetNumberOfPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    std::array<double, 4> p{0, 0, 0, 1};
    points->GetPoint(i, p.data());
    transform->MultiplyPoint(p.data(), p.data());
    out->SetPoint(i, p.data());
  }
  return out;
}

/// Triangles of a primitive; turned over where its transform mirrors it, as glTF asks for.
vtkNew<vtkCellArray> trianglesOf(vtkPolyData* geometry, bool mirrored)
{
  vtkNew<vtkCellArray> triangles;
  const auto add = [&](vtkIdType a, vtkIdType b, vtkIdType c) {
    const std::array<vtkIdType, 3> corners{a, mirrored ? c : b, mirrored ? b : c};
    triangles->InsertNextCell(3, corners.data());
  };
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  vtkCellArray* fans = geometry->GetPolys();
  for (fans->InitTraversal(); fans->GetNextCell(count, ids);)
  {
    for (vtkIdType i = 2; i < count; ++i)
    {
      add(ids[0], ids[i - 1], ids[i]);
    }
  }
  vtkCellArray* strips = geometry->GetStrips();
  for (strips->InitTraversal(); strips->GetNextCell(count, ids);)
  {
    for (vtkIdType i = 2; i < count; ++i)
    {
      const bool odd = i % 2 != 0;
      add(ids[i - 2], ids[odd ? i : i - 1], ids[odd ? i - 1 : i]);
    }
  }
  return triangles;
}

class NodeWalk
{
public:
  NodeWalk(vtkGLTFDocumentLoader::Model& source, const std::string& path) : model(source), file(path) {}

  Model run();

private:
  struct Visit
  {
    int node;
    std::string name; ///< of the nearest node around it that has one
  };

  void visit(const Visit& at);
  void addPrimitive(const vtkGLTFDocumentLoader::Primitive& primitive, const Visit& at, const std::string& meshName);

  vtkGLTFDocumentLoader::Model& model;
  std::string file;
  std::vector<Visit> open;
  std::set<int> seen; ///< a node has one parent; others are an error of the file
  std::vector<Part> parts;
  std::vector<vtkSmartPointer<vtkPolyData>> pieces;
  std::size_t notSurfaces = 0;
};

void NodeWalk::addPrimitive(const vtkGLTFDocumentLoader::Primitive& primitive, const Visit& at,
                            const std::string& meshName)
{
  vtkPolyData* geometry = primitive.Geometry;
  if (!geometry || !geometry->GetPoints() || geometry->GetNumberOfPolys() + geometry->GetNumberOfStrips() == 0)
  {
    ++notSurfaces;
    return;
  }
  const vtkGLTFDocumentLoader::Node& node = model.Nodes[at.node];
  vtkNew<vtkPolyData> data;
  data->SetPoints(placed(geometry->GetPoints(), node.GlobalTransform));
  data->SetPolys(trianglesOf(geometry, node.GlobalTransform->Determinant() < 0.0));
  const bool hasMaterial = primitive.Material >= 0 && primitive.Material < static_cast<int>(model.Materials.size());
  const std::string material = hasMaterial ? toUtf8(model.Materials[primitive.Material].Name) : std::string();
  const std::string& name = !node.Name.empty() ? node.Name : !meshName.empty() ? meshName : at.name;
  parts.push_back({name.empty() ? material : toUtf8(name), material, static_cast<std::size_t>(at.node)});
  pieces.push_back(data);
}

void NodeWalk::visit(const Visit& at)
{
  if (at.node < 0 || at.node >= static_cast<int>(model.Nodes.size()) || !seen.insert(at.node).second)
  {
    return;
  }
  const vtkGLTFDocumentLoader::Node& node = model.Nodes[at.node];
  if (node.Mesh >= 0 && node.Mesh < static_cast<int>(model.Meshes.size()) && node.GlobalTransform)
  {
    const vtkGLTFDocumentLoader::Mesh& mesh = model.Meshes[node.Mesh];
    for (const auto& primitive : mesh.Primitives)
    {
      addPrimitive(primitive, at, mesh.Name);
    }
  }
  // Last first, so that the first child is taken from the stack next.
  for (auto child = node.Children.rbegin(); child != node.Children.rend(); ++child)
  {
    open.push_back({*child, node.Name.empty() ? at.name : node.Name});
  }
}

Model NodeWalk::run()
{
  const bool chosen = model.DefaultScene >= 0 && model.DefaultScene < static_cast<int>(model.Scenes.size());
  if (model.Scenes.empty())
  {
    throw Error("'" + file + "' has no scene; export one");
  }
  const auto& roots = model.Scenes[chosen ? model.DefaultScene : 0].Nodes;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root)
  {
    open.push_back({static_cast<int>(*root), ""});
  }
  while (!open.empty())
  {
    const Visit next = open.back();
    open.pop_back();
    visit(next);
  }
  const std::vector<std::string> names = uniqueNames(parts, stemOf(file));
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const auto block = static_cast<unsigned>(i);
    blocks->SetBlock(block, pieces[i]);
    blocks->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), names[i]);
  }
  Model result;
  result.data = blocks;
  result.singlePrecision = true;
  result.upAxis = 1;
  result.defined = true;
  keepParts(result, parts, names);
  if (notSurfaces > 0)
  {
    result.warnings.push_back(std::to_string(notSurfaces) + " sets of lines and points make no surface");
  }
  return result;
}

} // namespace

Model readGltf(const std::string& file)
{
  const std::string bytes = readBytes(file);
  if (isBinary(file))
  {
    checkChunks(file, bytes);
  }
  vtkNew<vtkGLTFDocumentLoader> loader;
  load(loader, file);
  return NodeWalk(*loader->GetInternalModel(), file).run();
}

} // namespace atria::model
