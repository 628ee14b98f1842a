// SPDX-License-Identifier: GPL-3.0-or-later
#include "AssimpTree.h"

#include "ChildProcess.h"
#include "ModelFaces.h"

#include "Support/Error.h"
#include "Support/Utf8.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

namespace atria::model::assimp {

namespace {

/// Returns a name without assimp's additions. Its names for unnamed objects begin with $ or <, and those of IFC end
/// with an identifier of 22 characters.
std::string ownName(const Json& group, bool isIfc)
{
  std::string name = toUtf8(group.at("name").get<std::string>());
  if (name.empty() || name[0] == '$' || name[0] == '<' || (isIfc && name == "IfcMappedItem"))
  {
    return {};
  }
  constexpr std::size_t behind = 23;
  const auto inIdentifier = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '$'; };
  if (isIfc && name.size() > behind && name[name.size() - behind] == '_' &&
      std::all_of(name.end() - behind, name.end(), inIdentifier))
  {
    name.resize(name.size() - behind);
  }
  return name;
}

/// Makes a model of the program's output.
class TreeModel
{
public:
  TreeModel(const Json& tree, const std::string& file)
      : stem(stemOf(file)), isIfc(lowerEnding(file) == ".ifc"),
        rootIsScene(lowerEnding(file) == ".dae" || lowerEnding(file) == ".fbx")
  {
    for (const Json& group : tree.at("groups"))
    {
      const auto parent = group.find("parent");
      model.groups.push_back(
          {ownName(group, isIfc), parent == group.end() ? std::optional<std::size_t>() : parent->get<std::size_t>()});
    }
    for (const Json& part : tree.at("parts"))
    {
      addPart(part);
    }
    if (const auto skipped = tree.at("skipped").get<std::size_t>(); skipped > 0)
    {
      model.warnings.push_back(std::to_string(skipped) + " points and lines make no surface");
    }
  }

  Model finish(const Placing& placing)
  {
    faces.scale(placing.scale);
    const std::vector<std::string> names = namesByMaterial(parts, stem);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      parts[i].name = names[i];
    }
    faces.giveTo(model, keepTree(model, parts), "faces");
    model.singlePrecision = true;
    model.upAxis = placing.upAxis;
    model.axisKnown = placing.axisKnown;
    model.unitKnown = model.unitConverted = placing.unitKnown;
    return std::move(model);
  }

private:
  /// Adds a mesh. Meshes of one node and material are one part.
  void addPart(const Json& mesh)
  {
    const auto group = mesh.at("group").get<std::size_t>();
    std::string material = toUtf8(mesh.at("material").get<std::string>());
    const bool isMadeUp = material == "DefaultMaterial" || material == "%%%DEFAULT" || material == "<IFCDefault>";
    material = isMadeUp ? "" : material;
    const auto [known, isNew] = partOf.try_emplace({group, material}, static_cast<int>(parts.size()));
    if (isNew)
    {
      parts.push_back({nameIn(group, mesh), material, group});
    }
    const std::size_t first = faces.numberOfPoints();
    const std::vector<double> points = numbersIn<double>(mesh.at("points"));
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    {
      faces.addPoint({points[i], points[i + 1], points[i + 2]});
    }
    const auto corners = numbersIn<std::uint32_t>(mesh.at("corners"));
    std::size_t at = 0;
    for (const std::size_t size : numbersIn<std::uint32_t>(mesh.at("sizes")))
    {
      std::vector<std::size_t> face;
      for (std::size_t end = std::min(at + size, corners.size()); at < end; ++at)
      {
        face.push_back(3 * std::size_t{corners[at]} < points.size() ? first + corners[at] : nowhere);
      }
      faces.add(face, known->second);
    }
  }

  /// Returns the name of the innermost node that has one, else of the mesh.
  std::string nameIn(std::size_t group, const Json& mesh) const
  {
    for (std::optional<std::size_t> at = group; at; at = model.groups.at(*at).parent)
    {
      const PartGroup& node = model.groups.at(*at);
      if (!node.name.empty() && (node.parent || !rootIsScene))
      {
        return node.name;
      }
    }
    return ownName(mesh, false);
  }

  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

  std::string stem;
  bool isIfc;
  bool rootIsScene; ///< and names no surface
  Model model;
  std::vector<Part> parts;
  ModelFaces faces;
  std::map<std::pair<std::size_t, std::string>, int> partOf;
};

} // namespace

Model modelOf(const Json& tree, const std::string& file, const Placing& placing)
{
  return TreeModel(tree, file).finish(placing);
}

Run run(const std::string& file, const std::string& path, const ProgressRange& progress)
{
  const std::string program = ownProgram("atria-assimp");
  if (program.empty())
  {
    throw Error("'" + file +
                "' is of a format that the program atria-assimp reads, which is not installed; install the "
                "package atria-assimp, or export the model as OBJ or VRML");
  }
  const ChildResult child = runChild({program, std::filesystem::absolute(path).string()}, progress);
  return {child.status, Json::from_cbor(child.output, true, false)};
}

void throwFailed(const std::string& file, const Run& run)
{
  if (run.status == 0 && run.tree.is_object())
  {
    throw Error("'" + file + "' cannot be read: " + toUtf8(run.tree.at("error").get<std::string>()) +
                "; export it again, or as OBJ or VRML");
  }
  throw Error("'" + file + "' is damaged, or beyond what assimp can read, which " +
              (run.tookTooLong() ? "takes far too long" : "fails") + " on it; export it again, or as OBJ or VRML");
}

} // namespace atria::model::assimp
