// SPDX-License-Identifier: GPL-3.0-or-later
/// glTF: the nodes of a scene, and the primitives of their meshes. Atria has a reader of its own because VTK 9.1's
/// loader names its blocks by number, and reads beyond the ends of buffers in a damaged file.
#include "GltfFile.h"
#include "JsonText.h"
#include "ModelFaces.h"
#include "ModelFile.h"

#include "Support/Error.h"
#include "Support/Types.h"

#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include <map>
#include <numeric>
#include <set>

namespace atria::model {

namespace {

using gltf::File;
using gltf::Json;

using Transform = Eigen::Affine3d;

constexpr std::size_t trianglesMode = 4;
constexpr std::size_t stripMode = 5;
constexpr std::size_t fanMode = 6;

/// Calls `add` with the triangles of a primitive, as numbers of its corners.
template <typename Add> void forTriangles(std::size_t mode, const std::vector<std::size_t>& ids, const Add& add)
{
  for (std::size_t i = 2; i < ids.size(); i += mode == trianglesMode ? 3 : 1)
  {
    const bool odd = i % 2 != 0;
    if (mode == fanMode)
    {
      add(ids[0], ids[i - 1], ids[i]);
    }
    else if (mode == stripMode && odd)
    {
      add(ids[i - 1], ids[i - 2], ids[i]);
    }
    else
    {
      add(ids[i - 2], ids[i - 1], ids[i]);
    }
  }
}

class NodeWalk
{
public:
  explicit NodeWalk(const File& source) : file(source), nodes(file.list("nodes")), meshes(file.list("meshes")) {}

  Model run();

private:
  struct Visit
  {
    std::size_t node;
    std::string name; ///< name of the nearest node around it that has one
    Transform transform;
  };
  /// The points of an accessor, which many primitives may share.
  struct Points
  {
    gltf::Values<double> read;
    std::vector<std::size_t> placeOf; ///< among the faces' points, of those that a primitive uses; else `nowhere`
  };
  static constexpr auto nowhere = static_cast<std::size_t>(-1);

  void visit(const Visit& at);
  void addMesh(const Json& mesh, const Visit& at, const std::string& nodeName);
  void addPrimitive(const Json& primitive, const Visit& at, const std::string& name);
  void addTriangles(const Json& primitive, std::size_t mode, std::size_t position, const Visit& at,
                    const std::string& name);
  std::string materialOf(const Json& primitive, const std::string& name);
  Points& pointsOf(std::size_t accessor);
  std::vector<std::size_t> roots();
  std::vector<std::size_t> nodesIn(const Json& object, const char* key);
  Transform transformOf(const Json& node) const;
  void pushAll(const std::vector<std::size_t>& children, const Visit& around);
  void addWarnings(Model& model) const;

  const File& file;
  const Json& nodes;
  const Json& meshes;
  std::vector<Visit> open;
  std::set<std::size_t> seen;
  std::vector<Part> parts;
  ModelFaces faces;
  std::map<std::size_t, Points> pointsRead; ///< keyed by accessor
  std::size_t valuesRead = 0;               ///< in all of these
  std::size_t notSurfaces = 0;
  std::vector<std::string> complaints;
};

Transform NodeWalk::transformOf(const Json& node) const
{
  Transform transform = Transform::Identity();
  if (const std::vector<double> m = file.numbers(node, "matrix", 16); !m.empty())
  {
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data()); // both column by column
    transform.makeAffine();
    return transform;
  }
  const std::vector<double> t = file.numbers(node, "translation", 3);
  const std::vector<double> r = file.numbers(node, "rotation", 4);
  const std::vector<double> s = file.numbers(node, "scale", 3);
  if (!t.empty())
  {
    transform.translate(Vec3(t[0], t[1], t[2]));
  }
  if (!r.empty())
  {
    const Eigen::Quaterniond turn(r[3], r[0], r[1], r[2]);
    transform.rotate(turn.norm() > 0.0 ? turn.normalized() : Eigen::Quaterniond::Identity());
  }
  if (!s.empty())
  {
    transform.scale(Vec3(s[0], s[1], s[2]));
  }
  return transform;
}

void NodeWalk::addPrimitive(const Json& primitive, const Visit& at, const std::string& name)
{
  const std::size_t mode = file.index(primitive, "mode").value_or(trianglesMode);
  const auto position = file.index(entryOf(primitive, "attributes"), "POSITION");
  if (mode < trianglesMode || mode > fanMode || !position)
  {
    ++notSurfaces;
    return;
  }
  // The material comes first: if it is damaged, the triangles still have their place.
  const std::string material = materialOf(primitive, name);
  addTriangles(primitive, mode, *position, at, name);
  parts.push_back({name.empty() ? material : name, material, at.node});
}

std::string NodeWalk::materialOf(const Json& primitive, const std::string& name)
{
  try
  {
    return file.nameOf("materials", file.index(primitive, "material"));
  }
  catch (const gltf::Damaged& damage)
  {
    complaints.push_back("the material of a primitive of '" + name + "' is left out: " + damage.what());
    return {};
  }
}

/// Returns an accessor's points. They are kept for other primitives, so that each accessor is read once. All are
/// dropped when they exceed `mostKept`.
NodeWalk::Points& NodeWalk::pointsOf(std::size_t accessor)
{
  constexpr std::size_t mostKept = 30'000'000; // coordinates
  if (const auto found = pointsRead.find(accessor); found != pointsRead.end())
  {
    return found->second;
  }
  if (valuesRead > mostKept)
  {
    pointsRead.clear();
    valuesRead = 0;
  }
  Points points{file.floats(accessor, 3), {}};
  points.placeOf.assign(points.read.values.size() / 3, nowhere);
  valuesRead += points.read.values.size();
  return pointsRead.emplace(accessor, std::move(points)).first->second;
}

/// Adds triangles for the part added next. Points that no triangle uses are left out.
void NodeWalk::addTriangles(const Json& primitive, std::size_t mode, std::size_t position, const Visit& at,
                            const std::string& name)
{
  const auto complain = [&](const std::string& fault) {
    if (!fault.empty())
    {
      complaints.push_back("a primitive of '" + name + "' is read in part: " + fault);
    }
  };
  Points& points = pointsOf(position);
  complain(points.read.fault);
  std::vector<std::size_t> ids;
  if (const auto accessor = file.index(primitive, "indices"))
  {
    gltf::Values<std::size_t> read = file.indices(*accessor);
    complain(read.fault);
    ids = std::move(read.values);
  }
  else
  {
    ids.resize(points.placeOf.size());
    std::iota(ids.begin(), ids.end(), std::size_t{0});
  }
  // An index beyond the points of this primitive may be a point of another.
  const auto placeOf = [&](std::size_t id) {
    if (id >= points.placeOf.size())
    {
      return nowhere;
    }
    std::size_t& place = points.placeOf[id];
    if (place == nowhere)
    {
      place = faces.numberOfPoints();
      const Vec3 p = at.transform * Eigen::Map<const Vec3>(points.read.values.data() + 3 * id);
      faces.addPoint({p.x(), p.y(), p.z()});
    }
    return place;
  };
  // glTF requires mirrored triangles to be turned over.
  const bool mirrored = at.transform.linear().determinant() < 0.0;
  const int part = static_cast<int>(parts.size());
  forTriangles(mode, ids, [&](std::size_t a, std::size_t b, std::size_t c) {
    faces.add(std::array{placeOf(a), placeOf(mirrored ? c : b), placeOf(mirrored ? b : c)}, part);
  });
  for (const std::size_t id : ids)
  {
    if (id < points.placeOf.size())
    {
      points.placeOf[id] = nowhere; // the next use has another transform
    }
  }
}

void NodeWalk::addMesh(const Json& mesh, const Visit& at, const std::string& nodeName)
{
  const std::string meshName = file.text(mesh, "name");
  const std::string& name = !nodeName.empty() ? nodeName : !meshName.empty() ? meshName : at.name;
  const Json& primitives = entryOf(mesh, "primitives");
  for (std::size_t i = 0; primitives.is_array() && i < primitives.size(); ++i)
  {
    try
    {
      if (const Json& primitive = primitives[i]; primitive.is_object())
      {
        addPrimitive(primitive, at, name);
      }
    }
    catch (const gltf::Damaged& damage)
    {
      complaints.push_back("a primitive of '" + name + "' is left out: " + damage.what());
    }
  }
}

void NodeWalk::visit(const Visit& at)
{
  const Json* node = file.entry(nodes, at.node);
  if (!node)
  {
    complaints.push_back("node " + std::to_string(at.node) + " does not exist");
    return;
  }
  if (!seen.insert(at.node).second)
  {
    complaints.push_back("node " + std::to_string(at.node) + " has several parents and is read with the first alone");
    return;
  }
  Visit here = at;
  here.transform = at.transform * transformOf(*node);
  const std::string name = file.text(*node, "name");
  if (const auto mesh = file.index(*node, "mesh"))
  {
    if (const Json* found = file.entry(meshes, *mesh))
    {
      addMesh(*found, here, name);
    }
    else
    {
      complaints.push_back("mesh " + std::to_string(*mesh) + " does not exist");
    }
  }
  here.name = name.empty() ? at.name : name;
  pushAll(nodesIn(*node, "children"), here);
}

/// Returns the root nodes of the scene; without a scene, all nodes that are no children.
std::vector<std::size_t> NodeWalk::roots()
{
  const Json& scenes = file.list("scenes");
  const Json* scene = file.entry(scenes, 0);
  try
  {
    const Json* chosen = file.entry(scenes, file.index(file.root(), "scene").value_or(0));
    scene = chosen ? chosen : scene;
  }
  catch (const gltf::Damaged& damage)
  {
    complaints.push_back(std::string("the first scene is read: ") + damage.what());
  }
  std::vector<std::size_t> out = scene ? nodesIn(*scene, "nodes") : std::vector<std::size_t>();
  if (!out.empty() || nodes.empty())
  {
    return out;
  }
  complaints.push_back("it has no scene; all nodes are read");
  std::set<std::size_t> children;
  for (const Json& node : nodes)
  {
    if (node.is_object())
    {
      const std::vector<std::size_t> own = nodesIn(node, "children");
      children.insert(own.begin(), own.end());
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    if (children.count(i) == 0)
    {
      out.push_back(i);
    }
  }
  return out;
}

/// Returns the numbers of nodes in a list; other entries are left out.
std::vector<std::size_t> NodeWalk::nodesIn(const Json& object, const char* key)
{
  std::vector<std::size_t> out;
  const Json& found = entryOf(object, key);
  if (!found.is_null() && !found.is_array())
  {
    complaints.push_back(std::string("'") + key + "' is no list of numbers from 0");
    return out;
  }
  for (const Json& entry : found)
  {
    if (entry.is_number_unsigned())
    {
      out.push_back(entry.get<std::size_t>());
    }
    else
    {
      complaints.push_back(std::string("an entry of '") + key + "' is no number from 0");
    }
  }
  return out;
}

/// Pushes the last child first, so that the first one is taken from the stack next.
void NodeWalk::pushAll(const std::vector<std::size_t>& children, const Visit& around)
{
  for (auto child = children.rbegin(); child != children.rend(); ++child)
  {
    open.push_back({*child, around.name, around.transform});
  }
}

void NodeWalk::addWarnings(Model& model) const
{
  constexpr std::size_t most = 20;
  model.warnings.assign(complaints.begin(),
                        complaints.begin() + static_cast<std::ptrdiff_t>(std::min(complaints.size(), most)));
  if (complaints.size() > most)
  {
    model.warnings.push_back(std::to_string(complaints.size() - most) + " more parts of the file are damaged");
  }
  if (notSurfaces > 0)
  {
    model.warnings.push_back(std::to_string(notSurfaces) + " sets of lines and points make no surface");
  }
}

Model NodeWalk::run()
{
  pushAll(roots(), {0, "", Transform::Identity()});
  while (!open.empty())
  {
    const Visit next = open.back();
    open.pop_back();
    try
    {
      visit(next);
    }
    catch (const gltf::Damaged& damage)
    {
      complaints.push_back("node " + std::to_string(next.node) + " is left out: " + damage.what());
    }
  }
  if (faces.numberOfFaces() == 0 && !complaints.empty())
  {
    throw Error("'" + file.path() + "' cannot be read as glTF 2.0: " + complaints.front() + "; export it again");
  }
  const std::vector<std::string> names = uniqueNames(parts, stemOf(file.path()));
  Model result;
  result.singlePrecision = true;
  result.upAxis = 1;
  result.unitKnown = true;
  result.axisKnown = true;
  keepParts(result, parts, names);
  addWarnings(result);
  faces.giveTo(result, names, "triangles");
  return result;
}

} // namespace

Model readGltf(const std::string& file)
{
  const File source(file);
  return NodeWalk(source).run();
}

} // namespace atria::model
