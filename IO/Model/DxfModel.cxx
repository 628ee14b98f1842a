// SPDX-License-Identifier: GPL-3.0-or-later
/// DXF: faces, meshes and entities with a thickness, in blocks too. Atria has a reader of its own because assimp takes
/// a text that begins with a brace for a group to skip, and ignores rotation and nesting of blocks.
#include "DxfFile.h"
#include "DxfGeometry.h"
#include "ModelFaces.h"
#include "ModelFile.h"

#include "Support/Error.h"
#include "Support/Utf8.h"

#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace atria::model {

namespace {

using dxf::Block;
using dxf::Corner;
using dxf::Entity;
using Transform = Eigen::Affine3d;
using Entities = std::span<const Entity>;

constexpr int deepest = 32;
constexpr std::size_t mostFaces = 100'000'000;

class DrawingReader
{
public:
  explicit DrawingReader(const std::string& path) : file(path), drawing(path) {}

  Model run();

private:
  /// The placement of a block's entities.
  struct Place
  {
    Transform transform = Transform::Identity();
    std::string layer; ///< layer of entities on layer 0 in a block
    int depth = 0;
  };

  void addAll(Entities entities, const Place& place);
  void add(const Entity& entity, const Place& place);
  void addInsert(const Entity& insert, const Place& place);
  void addFace(const Entity& face, const Place& place);
  void addSolid(const Entity& solid, const Place& place);
  void addThick(const Entity& entity, const Place& place);
  void addCircle(const Entity& circle, const Place& place);
  void addLightPolyline(const Entity& polyline, const Place& place);
  void addPolyline(const Entity& polyline, Entities vertices, const Place& place);
  void addPolyface(const Entity& polyline, Entities vertices, const Place& place);
  void addGrid(const Entity& polyline, Entities vertices, const Place& place);
  void addMesh(const Entity& mesh, const Place& place);
  void addSides(const Entity& entity, const std::vector<Vec3>& outline, bool isClosed, bool hasCaps,
                const Place& place);
  void addPolygon(const std::vector<Vec3>& corners, const Entity& entity, const Place& place);
  int partOf(const Entity& entity, const Place& place);
  void addWarnings(Model& model) const;

  std::string file;
  dxf::File drawing;
  ModelFaces faces;
  std::vector<Part> parts;
  std::map<std::string, int> partByLayer;
  std::map<std::string, std::size_t> skipped; ///< entities that make no surface, by type
  std::map<std::string, std::size_t> missing; ///< uses of blocks that are not in the file
  std::size_t damaged = 0;
};

int DrawingReader::partOf(const Entity& entity, const Place& place)
{
  std::string layer = dxf::nameOf(entity.text(8));
  layer = (layer.empty() || layer == "0") && !place.layer.empty() ? place.layer : layer;
  const auto [found, isNew] = partByLayer.try_emplace(layer, static_cast<int>(parts.size()));
  if (isNew)
  {
    parts.push_back({layer, "", parts.size()});
  }
  return found->second;
}

void DrawingReader::addPolygon(const std::vector<Vec3>& corners, const Entity& entity, const Place& place)
{
  if (faces.numberOfFaces() >= mostFaces)
  {
    throw Error("'" + file + "' repeats its blocks to more than " + std::to_string(mostFaces) +
                " faces; export what is needed of it");
  }
  std::vector<std::size_t> ids;
  for (const Vec3& corner : corners)
  {
    const Vec3 p = place.transform * corner;
    ids.push_back(faces.pointAt({p.x(), p.y(), p.z()}));
  }
  faces.add(ids, partOf(entity, place));
}

void DrawingReader::addFace(const Entity& face, const Place& place)
{
  std::vector<Vec3> corners;
  for (const int code : {10, 11, 12, 13})
  {
    const auto corner = face.has(code)    ? face.point(code)
                        : corners.empty() ? std::nullopt
                                          : std::optional(corners.back());
    if (!corner)
    {
      ++damaged;
      return;
    }
    corners.push_back(*corner);
  }
  addPolygon(corners, face, place);
}

/// Adds the sides of an extruded outline, and the faces at both ends.
void DrawingReader::addSides(const Entity& entity, const std::vector<Vec3>& outline, bool isClosed, bool hasCaps,
                             const Place& place)
{
  const Place own{place.transform * dxf::objectSystem(entity), place.layer, place.depth};
  const Vec3 up(0.0, 0.0, entity.number(39, 0.0).value_or(0.0));
  std::vector<Vec3> upper;
  for (const Vec3& p : outline)
  {
    upper.emplace_back(p + up);
  }
  for (std::size_t i = 0; i + (isClosed ? 0 : 1) < outline.size(); ++i)
  {
    const std::size_t next = (i + 1) % outline.size();
    addPolygon({outline[i], outline[next], upper[next], upper[i]}, entity, own);
  }
  if (hasCaps)
  {
    addPolygon(upper, entity, own);
    addPolygon({outline.rbegin(), outline.rend()}, entity, own);
  }
}

/// Adds SOLID or TRACE, whose last two corners are in the other order.
void DrawingReader::addSolid(const Entity& solid, const Place& place)
{
  std::vector<Vec3> corners;
  for (const int code : {10, 11, 13, 12})
  {
    const auto corner = solid.point(solid.has(code) ? code : 12);
    if (!corner)
    {
      ++damaged;
      return;
    }
    corners.push_back(*corner);
  }
  addSides(solid, corners, true, true, place);
}

void DrawingReader::addCircle(const Entity& circle, const Place& place)
{
  constexpr double step = 10.0;
  const auto center = circle.point(10);
  const double radius = circle.number(40, 0.0).value_or(0.0);
  const bool isWhole = circle.type == "CIRCLE";
  const double from = isWhole ? 0.0 : circle.number(50, 0.0).value_or(0.0);
  double to = isWhole ? 360.0 : circle.number(51, 360.0).value_or(360.0);
  to += to <= from ? 360.0 : 0.0;
  if (!center || !(radius > 0.0) || !(to - from <= 360.0))
  {
    ++damaged;
    return;
  }
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from) / step - 1e-9)));
  std::vector<Vec3> outline;
  for (int i = 0; i < pieces + (isWhole ? 0 : 1); ++i)
  {
    const double angle = dxf::radians * (from + (to - from) * i / pieces);
    outline.emplace_back(*center + radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
  addSides(circle, outline, isWhole, isWhole, place);
}

void DrawingReader::addLightPolyline(const Entity& polyline, const Place& place)
{
  std::vector<Corner> corners;
  const double elevation = polyline.number(38, 0.0).value_or(0.0);
  for (std::size_t i = 0; i < polyline.groups.size(); ++i)
  {
    const Entity rest{polyline.type, polyline.groups.subspan(i)};
    const int code = polyline.groups[i].code;
    if (code == 10)
    {
      const auto x = rest.number(10, 0.0);
      const auto y = rest.number(20, 0.0);
      damaged += x && y ? 0 : 1;
      corners.push_back({Vec3(x.value_or(0.0), y.value_or(0.0), elevation)});
    }
    else if (code == 42 && !corners.empty())
    {
      corners.back().bulge = rest.number(42, 0.0).value_or(0.0);
    }
  }
  const bool isClosed = (polyline.integer(70, 0).value_or(0) & 1) != 0;
  addSides(polyline, dxf::withArcs(corners, isClosed), isClosed, false, place);
}

/// Extrudes an entity by its thickness. Lines without a thickness make no surface.
void DrawingReader::addThick(const Entity& entity, const Place& place)
{
  if (entity.number(39, 0.0).value_or(0.0) == 0.0)
  {
    ++skipped[std::string(entity.type)];
  }
  else if (entity.type == "LINE")
  {
    const auto from = entity.point(10);
    const auto to = entity.point(11);
    // Ends of lines, unlike those of all other entities, are in world coordinates.
    const Transform toObject = dxf::objectSystem(entity).inverse();
    from&& to ? addSides(entity, {toObject * *from, toObject * *to}, false, false, place) : void(++damaged);
  }
  else if (entity.type == "LWPOLYLINE")
  {
    addLightPolyline(entity, place);
  }
  else if (entity.type == "CIRCLE" || entity.type == "ARC")
  {
    addCircle(entity, place);
  }
  else
  {
    addSolid(entity, place);
  }
}

void DrawingReader::addPolyface(const Entity& polyline, Entities vertices, const Place& place)
{
  constexpr int isPoint = 64;
  std::vector<std::optional<Vec3>> points;
  for (const Entity& vertex : vertices)
  {
    if ((vertex.integer(70, 0).value_or(0) & isPoint) != 0)
    {
      points.push_back(vertex.point(10));
      continue;
    }
    std::vector<Vec3> corners;
    bool good = true;
    for (const int code : {71, 72, 73, 74})
    {
      const int number = std::abs(std::max(vertex.integer(code, 0).value_or(0), -std::numeric_limits<int>::max()));
      const bool exists = number > 0 && static_cast<std::size_t>(number) <= points.size() && points[number - 1];
      good = good && (number == 0 || exists);
      if (exists)
      {
        corners.push_back(*points[number - 1]);
      }
    }
    if (!good || corners.size() < 2)
    {
      ++damaged;
    }
    else if (corners.size() > 2)
    {
      const Entity face{vertex.type, vertex.has(8) ? vertex.groups : polyline.groups};
      addPolygon(corners, face, place);
    }
  }
}

/// Adds a mesh of rows of points, closed in either direction or not.
void DrawingReader::addGrid(const Entity& polyline, Entities vertices, const Place& place)
{
  constexpr int isSmooth = 4;
  constexpr int isControlPoint = 16;
  const int flags = polyline.integer(70, 0).value_or(0);
  const bool smooth = (flags & isSmooth) != 0;
  std::vector<Vec3> points;
  for (const Entity& vertex : vertices)
  {
    const bool isControl = (vertex.integer(70, 0).value_or(0) & isControlPoint) != 0;
    const auto point = vertex.point(10);
    if (point && !(smooth && isControl))
    {
      points.push_back(*point);
    }
  }
  const int rows = polyline.integer(smooth ? 73 : 71, 0).value_or(0);
  const int columns = polyline.integer(smooth ? 74 : 72, 0).value_or(0);
  if (rows < 2 || columns < 2 || points.size() != std::size_t(rows) * std::size_t(columns))
  {
    ++damaged;
    return;
  }
  const auto at = [&](int row, int column) { return points[std::size_t(row % rows) * columns + column % columns]; };
  const int rowEnd = (flags & 1) != 0 ? rows : rows - 1;
  const int columnEnd = (flags & 32) != 0 ? columns : columns - 1;
  for (int row = 0; row < rowEnd; ++row)
  {
    for (int column = 0; column < columnEnd; ++column)
    {
      addPolygon({at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)}, polyline, place);
    }
  }
}

void DrawingReader::addPolyline(const Entity& polyline, Entities vertices, const Place& place)
{
  constexpr int grid = 16;
  constexpr int polyface = 64;
  constexpr int isLine3D = 8;
  const int flags = polyline.integer(70, 0).value_or(0);
  if ((flags & polyface) != 0)
  {
    return addPolyface(polyline, vertices, place);
  }
  if ((flags & grid) != 0)
  {
    return addGrid(polyline, vertices, place);
  }
  if ((flags & isLine3D) != 0 || polyline.number(39, 0.0).value_or(0.0) == 0.0)
  {
    ++skipped["POLYLINE"];
    return;
  }
  std::vector<Corner> corners;
  for (const Entity& vertex : vertices)
  {
    const auto point = vertex.point(10);
    damaged += point ? 0 : 1;
    corners.push_back({point.value_or(Vec3::Zero()), vertex.number(42, 0.0).value_or(0.0)});
  }
  addSides(polyline, dxf::withArcs(corners, (flags & 1) != 0), (flags & 1) != 0, false, place);
}

/// Adds a MESH at its level 0: points, then a list of faces, each behind the number of its corners.
void DrawingReader::addMesh(const Entity& mesh, const Place& place)
{
  std::vector<Vec3> points;
  std::vector<int> list;
  std::size_t wanted = 0;
  for (std::size_t i = 0; i < mesh.groups.size(); ++i)
  {
    const Entity rest{mesh.type, mesh.groups.subspan(i)};
    const int code = mesh.groups[i].code;
    if (code == 10)
    {
      points.push_back(rest.point(10).value_or(Vec3::Constant(std::numeric_limits<double>::quiet_NaN())));
    }
    else if (code == 93)
    {
      wanted = static_cast<std::size_t>(std::max(0, rest.integer(93, 0).value_or(0)));
    }
    else if (code == 90 && list.size() < wanted)
    {
      list.push_back(rest.integer(90, -1).value_or(-1));
    }
  }
  for (std::size_t at = 0; at < list.size();)
  {
    const auto size = static_cast<std::size_t>(std::max(0, list[at]));
    const std::size_t end = std::min(at + 1 + size, list.size());
    std::vector<Vec3> corners;
    for (std::size_t k = at + 1; k < end; ++k)
    {
      if (const int id = list[k]; id >= 0 && static_cast<std::size_t>(id) < points.size())
      {
        corners.push_back(points[static_cast<std::size_t>(id)]);
      }
    }
    at = end;
    corners.size() == size ? addPolygon(corners, mesh, place) : void(++damaged);
  }
}

void DrawingReader::addInsert(const Entity& insert, const Place& place)
{
  const Block* block = drawing.block(insert.text(2));
  const auto at = insert.point(10);
  if (!block || block->isElsewhere || !at || place.depth >= deepest)
  {
    ++missing[dxf::nameOf(insert.text(2))];
    return;
  }
  const auto number = [&](int code, double fallback) { return insert.number(code, fallback).value_or(fallback); };
  const auto count = [&](int code) { return std::clamp(insert.integer(code, 1).value_or(1), 1, 1000); };
  const Vec3 scale(number(41, 1.0), number(42, 1.0), number(43, 1.0));
  std::string layer = dxf::nameOf(insert.text(8));
  layer = (layer.empty() || layer == "0") && !place.layer.empty() ? place.layer : layer;
  for (int row = 0; row < count(71); ++row)
  {
    for (int column = 0; column < count(70); ++column)
    {
      Transform own = dxf::objectSystem(insert);
      own.translate(*at).rotate(Eigen::AngleAxisd(dxf::radians * number(50, 0.0), Vec3::UnitZ()));
      own.translate(Vec3(column * number(44, 0.0), row * number(45, 0.0), 0.0));
      own.scale(scale).translate(-block->base);
      addAll(block->entities, {place.transform * own, layer, place.depth + 1});
    }
  }
}

void DrawingReader::add(const Entity& entity, const Place& place)
{
  if (entity.type == "3DFACE")
  {
    addFace(entity, place);
  }
  else if (entity.type == "INSERT")
  {
    addInsert(entity, place);
  }
  else if (entity.type == "MESH")
  {
    addMesh(entity, place);
  }
  else if (entity.type == "LINE" || entity.type == "LWPOLYLINE" || entity.type == "CIRCLE" || entity.type == "ARC" ||
           entity.type == "SOLID" || entity.type == "TRACE")
  {
    addThick(entity, place);
  }
  else if (entity.type != "SEQEND" && entity.type != "ATTRIB" && entity.type != "VERTEX")
  {
    ++skipped[toUtf8(entity.type)];
  }
}

void DrawingReader::addAll(Entities entities, const Place& place)
{
  for (std::size_t i = 0; i < entities.size(); ++i)
  {
    const Entity& entity = entities[i];
    if (entity.integer(67, 0).value_or(0) == 1)
    {
      continue; // on a sheet of paper
    }
    if (entity.type != "POLYLINE")
    {
      add(entity, place);
      continue;
    }
    std::size_t end = i + 1;
    while (end < entities.size() && entities[end].type == "VERTEX")
    {
      ++end;
    }
    addPolyline(entity, entities.subspan(i + 1, end - i - 1), place);
    i = end - 1;
  }
}

void DrawingReader::addWarnings(Model& model) const
{
  const auto listed = [](const std::map<std::string, std::size_t>& counts) {
    std::string text;
    for (const auto& [what, count] : counts)
    {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    }
    return text;
  };
  std::map<std::string, std::size_t> solids;
  std::map<std::string, std::size_t> flat;
  for (const auto& [type, count] : skipped)
  {
    const bool isSolid = type == "3DSOLID" || type == "BODY" || type == "REGION" || type.ends_with("SURFACE");
    (isSolid ? solids : flat)[type] = count;
  }
  if (!solids.empty())
  {
    model.warnings.push_back("solids are not read: " + listed(solids) + "; convert them to meshes before exporting");
  }
  if (!missing.empty())
  {
    model.warnings.push_back("blocks are left out, as they are not in the file or contain themselves: " +
                             listed(missing) + "; insert them before exporting");
  }
  if (damaged > 0 || drawing.linesLeftOut() > 0)
  {
    model.warnings.push_back(std::to_string(damaged) + " entities and " + std::to_string(drawing.linesLeftOut()) +
                             " lines are left out: they are damaged");
  }
  if (!flat.empty())
  {
    model.warnings.push_back("lines, texts and the like make no surface: " + listed(flat));
  }
}

Model DrawingReader::run()
{
  addAll(drawing.entities(), {});
  Model model;
  const double meters = dxf::metersOf(drawing.variable("$INSUNITS"));
  model.unitKnown = model.unitConverted = meters > 0.0;
  model.axisKnown = true;
  model.head = headOf(drawing.bytes());
  faces.scale(meters > 0.0 ? meters : 1.0);
  const std::vector<std::string> names = uniqueNames(parts, stemOf(file));
  keepParts(model, parts, names);
  faces.giveTo(model, names, "faces");
  addWarnings(model);
  return model;
}

} // namespace

Model readDxf(const std::string& file) { return DrawingReader(file).run(); }

} // namespace atria::model
