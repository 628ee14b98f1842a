// SPDX-License-Identifier: GPL-3.0-or-later
/// DXF: faces, meshes and entities with a thickness, in blocks too. Atria has a reader of its own because assimp takes
/// a text that begins with a brace for a group to skip, and ignores rotation and nesting of blocks.
#include "DxfFile.h"
#include "DxfGeometry.h"
#include "DxfPolygons.h"
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
using dxf::Entity;
using dxf::Polygon;
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
  void addThick(const Entity& entity, const Place& place);
  void addPolyline(const Entity& polyline, Entities vertices, const Place& place);
  void addPolyface(const Entity& polyline, Entities vertices, const Place& place);
  void addFaces(const dxf::Faces& found, const Entity& entity, const Place& place);
  void addSides(const Entity& entity, const dxf::Outline& outline, bool hasCaps, const Place& place);
  void addPolygon(const Polygon& corners, const Entity& entity, const Place& place);
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

void DrawingReader::addPolygon(const Polygon& corners, const Entity& entity, const Place& place)
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

void DrawingReader::addFaces(const dxf::Faces& found, const Entity& entity, const Place& place)
{
  damaged += found.damaged;
  for (const Polygon& polygon : found.polygons)
  {
    addPolygon(polygon, entity, place);
  }
}

/// Adds the sides of an extruded outline, and the faces at both ends.
void DrawingReader::addSides(const Entity& entity, const dxf::Outline& outline, bool hasCaps, const Place& place)
{
  damaged += outline.damaged;
  const Place own{place.transform * dxf::objectSystem(entity), place.layer, place.depth};
  const Vec3 up(0.0, 0.0, entity.number(39, 0.0).value_or(0.0));
  const Polygon& lower = outline.points;
  Polygon upper;
  for (const Vec3& p : lower)
  {
    upper.emplace_back(p + up);
  }
  for (std::size_t i = 0; i + (outline.isClosed ? 0 : 1) < lower.size(); ++i)
  {
    const std::size_t next = (i + 1) % lower.size();
    addPolygon({lower[i], lower[next], upper[next], upper[i]}, entity, own);
  }
  if (hasCaps)
  {
    addPolygon(upper, entity, own);
    addPolygon({lower.rbegin(), lower.rend()}, entity, own);
  }
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
    from&& to ? addSides(entity, dxf::Outline{{toObject * *from, toObject * *to}}, false, place) : void(++damaged);
  }
  else if (entity.type == "LWPOLYLINE")
  {
    addSides(entity, dxf::outlineOfLightPolyline(entity), false, place);
  }
  else if (entity.type == "CIRCLE" || entity.type == "ARC")
  {
    const auto outline = dxf::outlineOfCircle(entity);
    outline ? addSides(entity, *outline, outline->isClosed, place) : void(++damaged);
  }
  else
  {
    const auto corners = dxf::cornersOfSolid(entity);
    corners ? addSides(entity, dxf::Outline{*corners, true}, true, place) : void(++damaged);
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
    return addFaces(dxf::facesOfGrid(polyline, vertices), polyline, place);
  }
  if ((flags & isLine3D) != 0 || polyline.number(39, 0.0).value_or(0.0) == 0.0)
  {
    ++skipped["POLYLINE"];
    return;
  }
  addSides(polyline, dxf::outlineOfPolyline(polyline, vertices), false, place);
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
    const auto corners = dxf::cornersOfFace(entity);
    corners ? addPolygon(*corners, entity, place) : void(++damaged);
  }
  else if (entity.type == "INSERT")
  {
    addInsert(entity, place);
  }
  else if (entity.type == "MESH")
  {
    addFaces(dxf::facesOfMesh(entity), entity, place);
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
