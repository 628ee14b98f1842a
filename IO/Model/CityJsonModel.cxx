// SPDX-License-Identifier: GPL-3.0-or-later
/// CityJSON 1.0 to 2.0, one document or a text sequence of features.
#include "ClosedShell.h"
#include "JsonText.h"
#include "ModelFaces.h"
#include "ModelFile.h"
#include "ModelText.h"
#include "NameList.h"

#include "Support/Error.h"
#include "Support/Types.h"

#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <charconv>
#include <set>

namespace atria::model {

namespace {

using Json = nlohmann::json;
using Transform = Eigen::Affine3d;

/// Returns a level such as "2.2" as a number; numbers were allowed once.
double levelOf(const Json& geometry)
{
  const Json& lod = entryOf(geometry, "lod");
  double level = lod.is_number() ? lod.get<double>() : 0.0;
  const std::string text = textOf(lod);
  return parse(text, level) || !lod.is_string() ? level : 0.0;
}

Vec3 vectorOf(const Json& list, const Vec3& fallback)
{
  const bool good = list.is_array() && list.size() == 3 &&
                    std::all_of(list.begin(), list.end(), [](const Json& v) { return v.is_number(); });
  return good ? Vec3(list[0].get<double>(), list[1].get<double>(), list[2].get<double>()) : fallback;
}

/// Returns the depth of a geometry's surfaces within its boundaries; 0 for types without surfaces.
int depthOf(const std::string& type)
{
  static const std::map<std::string, int> depths{
      {"MultiSurface", 1}, {"CompositeSurface", 1}, {"Solid", 2}, {"MultiSolid", 3}, {"CompositeSolid", 3}};
  const auto found = depths.find(type);
  return found == depths.end() ? 0 : found->second;
}

/// Returns the major number of a version such as 2.0; 0 if there is none.
int majorOf(const std::string& version)
{
  int number = 0;
  std::from_chars(version.data(), version.data() + version.size(), number);
  return number;
}

class CityReader
{
public:
  explicit CityReader(std::string path) : file(std::move(path)) {}

  /// A document, or one of a sequence: the first states the transform and templates of all.
  void add(const Json& document);
  Model finish();

private:
  struct Place
  {
    std::size_t group; ///< group of the object
    std::string id;
    std::string type; ///< type of the object
  };
  /// Points of one list as the faces have them.
  struct Points
  {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  static constexpr int knownVersion = 2;

  Points addPoints(const Json& vertices, const Transform& transform);
  void addObjects(const Json& objects, const Points& points);
  std::size_t groupOf(const Json& objects, const std::string& id);
  void addObject(const Json& objects, const std::string& id, const Points& points);
  void addGeometry(const Json& geometry, const Points& points, const Place& place);
  void addInstance(const Json& geometry, const Points& points, const Place& place);
  bool isClosed(const Json& solid, const Points& points) const;
  void addSurfaces(const Json& boundaries, const Json& values, int depth, const Json& semantics, const Points& points,
                   const Place& place);
  void addSurface(const Json& rings, const std::string& semantic, const Points& points, const Place& place);
  double highestOf(const Json& objects, const std::string& id, std::set<std::string>& seen) const;

  std::string file;
  Model model;
  ModelFaces faces;
  std::vector<Part> parts;
  std::map<std::string, std::size_t> groups; ///< keyed by the object's identifier
  std::map<std::pair<std::size_t, std::string>, int> partOf;
  Transform transform = Transform::Identity();
  Json templates;
  std::size_t lowerLevels = 0;
  std::size_t noSurfaces = 0;
  NameList openSolids; ///< identifiers of objects
};

void CityReader::add(const Json& document)
{
  const std::string type = textOf(entryOf(document, "type"));
  if (type != "CityJSON" && type != "CityJSONFeature")
  {
    throw Error("'" + file +
                "' is no CityJSON: it has no \"type\": \"CityJSON\"; give a city model, or another format");
  }
  const std::string version = textOf(entryOf(document, "version"));
  if (!version.empty() && (majorOf(version) < 1 || majorOf(version) > knownVersion))
  {
    model.warnings.push_back("its version of CityJSON is " + version +
                             ", and 1 and 2 are known: what is new in it may be missing; export it as 2.0");
  }
  if (const Json& stated = entryOf(document, "transform"); stated.is_object())
  {
    transform = Eigen::Translation3d(vectorOf(entryOf(stated, "translate"), Vec3::Zero())) *
                Eigen::Scaling(vectorOf(entryOf(stated, "scale"), Vec3::Ones()));
  }
  if (const Json& stated = entryOf(document, "geometry-templates"); stated.is_object())
  {
    templates = stated;
  }
  const std::string system = textOf(entryOf(entryOf(document, "metadata"), "referenceSystem"));
  for (const char* degrees : {"/4326", "/4979", "::4326", "::4979"})
  {
    if (system.size() > 6 &&
        system.compare(system.size() - std::char_traits<char>::length(degrees), std::string::npos, degrees) == 0)
    {
      throw Error("'" + file + "' has coordinates in degrees (" + system + "); convert it to a system in meters");
    }
  }
  addObjects(entryOf(document, "CityObjects"), addPoints(entryOf(document, "vertices"), transform));
}

CityReader::Points CityReader::addPoints(const Json& vertices, const Transform& placed)
{
  const Points points{faces.numberOfPoints(), vertices.is_array() ? vertices.size() : 0};
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < points.count; ++i)
  {
    const Vec3 p = placed * vectorOf(vertices[i], nowhere);
    faces.addPoint({p.x(), p.y(), p.z()});
  }
  return points;
}

void CityReader::addObjects(const Json& objects, const Points& points)
{
  for (auto object = objects.is_object() ? objects.begin() : objects.end(); object != objects.end(); ++object)
  {
    addObject(objects, object.key(), points);
  }
}

/// Returns the object's group; adds parents before their children.
std::size_t CityReader::groupOf(const Json& objects, const std::string& id)
{
  std::vector<std::string> chain{id};
  while (groups.find(chain.back()) == groups.end())
  {
    const Json& parents = entryOf(entryOf(objects, chain.back().c_str()), "parents");
    const std::string parent = parents.is_array() && !parents.empty() ? textOf(parents[0]) : std::string();
    if (parent.empty() || std::find(chain.begin(), chain.end(), parent) != chain.end())
    {
      break;
    }
    chain.push_back(parent);
  }
  std::optional<std::size_t> around;
  for (auto name = chain.rbegin(); name != chain.rend(); ++name)
  {
    const auto [found, isNew] = groups.try_emplace(*name, model.groups.size());
    if (isNew)
    {
      model.groups.push_back({*name, around});
    }
    around = found->second;
  }
  return *around;
}

/// Returns the highest level of detail of an object and its children.
double CityReader::highestOf(const Json& objects, const std::string& id, std::set<std::string>& seen) const
{
  double highest = 0.0;
  std::vector<std::string> open{id};
  while (!open.empty())
  {
    const std::string next = open.back();
    open.pop_back();
    if (!seen.insert(next).second)
    {
      continue;
    }
    const Json& object = entryOf(objects, next.c_str());
    for (const Json& geometry : entryOf(object, "geometry"))
    {
      highest = std::max(highest, levelOf(geometry));
    }
    for (const Json& child : entryOf(object, "children"))
    {
      open.push_back(textOf(child));
    }
  }
  return highest;
}

/// Adds the highest of several levels of detail; none if a child has a higher one.
void CityReader::addObject(const Json& objects, const std::string& id, const Points& points)
{
  const Json& object = objects[id];
  const Place place{groupOf(objects, id), id, textOf(entryOf(object, "type"))};
  std::set<std::string> seen;
  const double highest = highestOf(objects, id, seen);
  for (const Json& geometry : entryOf(object, "geometry"))
  {
    if (levelOf(geometry) < highest)
    {
      ++lowerLevels;
    }
    else if (textOf(entryOf(geometry, "type")) == "GeometryInstance")
    {
      addInstance(geometry, points, place);
    }
    else
    {
      addGeometry(geometry, points, place);
    }
  }
}

void CityReader::addGeometry(const Json& geometry, const Points& points, const Place& place)
{
  const int depth = depthOf(textOf(entryOf(geometry, "type")));
  if (depth == 0)
  {
    ++noSurfaces;
    return;
  }
  const Json& semantics = entryOf(geometry, "semantics");
  const Json& boundaries = entryOf(geometry, "boundaries");
  addSurfaces(boundaries, entryOf(semantics, "values"), depth, entryOf(semantics, "surfaces"), points, place);
  const auto isOpen = [&](const Json& solid) { return !solid.empty() && !isClosed(solid, points); };
  const bool open = depth == 2   ? isOpen(boundaries)
                    : depth == 3 ? std::any_of(boundaries.begin(), boundaries.end(), isOpen)
                                 : false;
  if (open)
  {
    openSolids.add(place.id);
  }
}

/// True if the shells of a solid close it.
bool CityReader::isClosed(const Json& solid, const Points& points) const
{
  ClosedShell all;
  std::map<std::size_t, std::size_t> placeOf;
  const auto addRing = [&](const Json& ring) {
    std::vector<std::size_t> corners;
    for (const Json& corner : ring)
    {
      const std::size_t id = corner.is_number_unsigned() ? corner.get<std::size_t>() : points.count;
      if (id < points.count)
      {
        const auto [found, isNew] = placeOf.try_emplace(id, placeOf.size());
        const auto& p = faces.point(points.first + id);
        corners.push_back(isNew ? all.addPoint({p[0], p[1], p[2]}) : found->second);
      }
    }
    all.addPolygon(corners);
  };
  for (const Json& shell : solid)
  {
    for (const Json& surface : shell)
    {
      std::for_each(surface.begin(), surface.end(), addRing);
    }
  }
  return all.isClosed();
}

/// Adds a template at a place: a matrix, row by row, around one of the document's vertices.
void CityReader::addInstance(const Json& geometry, const Points& points, const Place& place)
{
  const Json& number = entryOf(geometry, "template");
  const Json& all = entryOf(templates, "templates");
  const Json& at = entryOf(geometry, "boundaries");
  const bool good = number.is_number_unsigned() && all.is_array() && number.get<std::size_t>() < all.size() &&
                    at.is_array() && at.size() == 1 && at[0].is_number_unsigned() &&
                    at[0].get<std::size_t>() < points.count;
  if (!good)
  {
    model.warnings.push_back("an instance in '" + place.id + "' is left out: its template or place does not exist");
    return;
  }
  Transform placed = Transform::Identity();
  const Json& matrix = entryOf(geometry, "transformationMatrix");
  for (int i = 0; matrix.is_array() && matrix.size() == 16 && i < 12; ++i)
  {
    placed.matrix()(i / 4, i % 4) = matrix[static_cast<std::size_t>(i)].is_number()
                                        ? matrix[static_cast<std::size_t>(i)].get<double>()
                                        : placed.matrix()(i / 4, i % 4);
  }
  const auto& origin = faces.point(points.first + at[0].get<std::size_t>());
  placed.pretranslate(Vec3(origin[0], origin[1], origin[2]));
  const Points own = addPoints(entryOf(templates, "vertices-templates"), placed);
  addGeometry(all[number.get<std::size_t>()], own, place);
}

void CityReader::addSurfaces(const Json& boundaries, const Json& values, int depth, const Json& semantics,
                             const Points& points, const Place& place)
{
  static const Json none;
  for (std::size_t i = 0; boundaries.is_array() && i < boundaries.size(); ++i)
  {
    const Json& value = values.is_array() && i < values.size() ? values[i] : none;
    if (depth > 1)
    {
      addSurfaces(boundaries[i], value, depth - 1, semantics, points, place);
      continue;
    }
    const bool isNamed =
        value.is_number_unsigned() && semantics.is_array() && value.get<std::size_t>() < semantics.size();
    addSurface(boundaries[i], isNamed ? textOf(entryOf(semantics[value.get<std::size_t>()], "type")) : "", points,
               place);
  }
}

/// The first ring is the outline, others are holes: bridges to them, walked both ways, cancel out.
void CityReader::addSurface(const Json& rings, const std::string& semantic, const Points& points, const Place& place)
{
  constexpr auto nowhere = static_cast<std::size_t>(-1);
  std::vector<std::size_t> corners;
  for (std::size_t r = 0; rings.is_array() && r < rings.size(); ++r)
  {
    const std::size_t start = corners.size();
    for (const Json& id : rings[r])
    {
      const bool good = id.is_number_unsigned() && id.get<std::size_t>() < points.count;
      corners.push_back(good ? points.first + id.get<std::size_t>() : nowhere);
    }
    if (rings.size() > 1 && corners.size() > start)
    {
      corners.push_back(corners[start]);
      corners.push_back(corners[0]);
    }
  }
  const std::string name = semantic.empty() ? place.id : semantic;
  const std::string kind = semantic.empty() ? place.type : semantic;
  const auto [known, isNew] = partOf.try_emplace({place.group, name}, static_cast<int>(parts.size()));
  if (isNew)
  {
    parts.push_back({name, kind, place.group});
  }
  faces.add(corners, known->second);
}

Model CityReader::finish()
{
  if (noSurfaces > 0)
  {
    model.warnings.push_back(std::to_string(noSurfaces) + " geometries of points or lines make no surface");
  }
  if (lowerLevels > 0)
  {
    model.notes.push_back(std::to_string(lowerLevels) +
                          " geometries are left out for those of a higher level of detail");
  }
  if (!openSolids.empty())
  {
    model.warnings.push_back(
        openSolids.counted("city object") +
        " not closed, though given as a solid, so that the inside may be taken for air: " + openSolids.text());
  }
  faces.giveTo(model, keepTree(model, parts), "surfaces");
  model.unitKnown = true; // the reference systems for buildings are in meters
  model.axisKnown = true;
  // Types of objects, and classes of their surfaces.
  model.groundMaterials = {"LandUse",
                           "Road",
                           "Railway",
                           "TransportSquare",
                           "Waterway",
                           "WaterBody",
                           "TINRelief",
                           "TrafficArea",
                           "AuxiliaryTrafficArea",
                           "WaterSurface",
                           "WaterGroundSurface",
                           "WaterClosureSurface"};
  return std::move(model);
}

Json parsed(std::string_view text, const std::string& file, const std::string& where)
{
  try
  {
    return parseJson(text);
  }
  catch (const Error& error)
  {
    throw Error("'" + file + "' cannot be read as CityJSON: " + where + error.what() + "; export it again");
  }
}

} // namespace

Model readCityJson(const std::string& file)
{
  const std::string bytes = readBytes(file);
  CityReader reader(file);
  if (lowerEnding(file) == ".jsonl")
  {
    std::size_t number = 0;
    for (std::size_t at = 0; at < bytes.size();)
    {
      const std::string_view line = nextLine(bytes, at);
      ++number;
      if (line.find_first_not_of(blanks) != line.npos)
      {
        reader.add(parsed(line, file, "line " + std::to_string(number) + ": "));
      }
    }
  }
  else
  {
    reader.add(parsed(bytes, file, ""));
  }
  return reader.finish();
}

} // namespace atria::model
