// SPDX-License-Identifier: GPL-3.0-or-later
/// COLLADA, 3DS, FBX, DXF and IFC by assimp, which AssimpProgram.cxx runs in a process of its own.
#include "ChildProcess.h"
#include "ModelFaces.h"
#include "ModelFile.h"

#include "Support/Error.h"
#include "Support/Utf8.h"

#include <vtkPolyData.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <regex>

#include <signal.h>

namespace atria::model {

namespace {

using Json = nlohmann::json;

template <typename T> std::vector<T> numbersIn(const Json& value)
{
  const auto& bytes = value.get_binary();
  std::vector<T> numbers(bytes.size() / sizeof(T));
  if (!numbers.empty())
  {
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(T));
  }
  return numbers;
}

/// assimp's names for what has none begin with $ or <, and those of IFC end with an identifier of 22 characters.
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

/// What `pattern` finds first, in its first group.
std::string foundIn(const std::string& head, const char* pattern)
{
  std::smatch match;
  return std::regex_search(head, match, std::regex(pattern)) ? match[1].str() : std::string();
}

/// What assimp, or the file, says of unit and axis. Models whose format says that z is up are turned by assimp.
struct Placing
{
  double scale = 1.0; ///< to meters, where assimp has not converted lengths itself
  bool unitKnown = true;
  int upAxis = 1;
  bool axisKnown = true;
};

Placing placingOf(const std::string& ending, const std::string& head, const Json& metadata)
{
  if (ending == ".dae") // assimp converts lengths
  {
    const std::string up = foundIn(head, "<up_axis>\\s*([XYZ])_UP");
    return {1.0, true, up == "Z" ? 2 : 1, up != "X"};
  }
  if (ending == ".fbx") // in centimeters times a factor
  {
    return {0.01 * metadata.value("UnitScaleFactor", 1.0), true, metadata.value("UpAxis", 1) == 2 ? 2 : 1, true};
  }
  if (ending == ".dxf")
  {
    static const std::map<std::string, double> units{{"1", 0.0254}, {"2", 0.3048}, {"4", 0.001},
                                                     {"5", 0.01},   {"6", 1.0},    {"14", 0.1}};
    const auto unit = units.find(foundIn(head, "\\$INSUNITS\\s+70\\s+(\\d+)"));
    return {unit == units.end() ? 1.0 : unit->second, unit != units.end()};
  }
  return {1.0, ending == ".ifc"}; // which assimp converts; 3DS has no unit
}

/// From what the program wrote to a model.
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
  /// Meshes of one node and material are one.
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

  /// Of the innermost node that has one, else of the mesh.
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

[[noreturn]] void throwEnded(const std::string& file, int status)
{
  const std::string what = status == -SIGXCPU || status == -SIGKILL ? "takes far too long" : "fails";
  throw Error("'" + file + "' is damaged, or beyond what assimp can read, which " + what +
              " on it; export it again, or as OBJ or VRML");
}

} // namespace

Model readAssimp(const std::string& file, const ProgressRange& progress)
{
  const std::string ending = lowerEnding(file);
  const std::string program = ownProgram("atria-assimp");
  if (program.empty())
  {
    throw Error("'" + file +
                "' is of a format that the program atria-assimp reads, which is not installed; install the "
                "package atria-assimp, or export the model as OBJ or VRML");
  }
  const std::string bytes = readBytes(file);
  const ChildResult child = runChild({program, std::filesystem::absolute(file).string()}, progress);
  const Json tree = Json::from_cbor(child.output, true, false);
  if (child.status != 0 || !tree.is_object())
  {
    throwEnded(file, child.status);
  }
  if (const auto error = tree.find("error"); error != tree.end())
  {
    throw Error("'" + file + "' cannot be read: " + toUtf8(error->get<std::string>()) +
                "; export it again, or as OBJ or VRML");
  }
  constexpr std::size_t headLength = 1 << 16; // of what stands before the geometry
  const std::string head = bytes.substr(0, headLength);
  const Placing placing = placingOf(ending, head, tree.at("metadata"));
  Model model = TreeModel(tree, file).finish(placing);
  const std::string schema = ending == ".ifc" ? foundIn(head, "FILE_SCHEMA\\s*\\(\\s*\\(\\s*'([^']*)'") : "";
  if (!schema.empty() && schema != "IFC2X3")
  {
    model.warnings.push_back("its schema is " + schema + ", and assimp reads IFC2X3: shapes that are new in " + schema +
                             " are left out; export it as IFC2X3 if some are missing");
  }
  model.head = headOf(bytes);
  model.groundNames = ending == ".ifc" ? std::vector<std::string>{"IfcSite"} : std::vector<std::string>();
  return model;
}

} // namespace atria::model
