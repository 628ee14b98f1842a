// SPDX-License-Identifier: GPL-3.0-or-later
/// The outlines and faces of DXF's entities, in the entities' own coordinates.
#pragma once

#include "DxfFile.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace atria::model::dxf {

using Polygon = std::vector<Vec3>;

/// A line of points that an entity with a thickness extrudes.
struct Outline
{
  Polygon points;
  bool isClosed = false;
  std::size_t damaged = 0; ///< points that are no numbers
};

/// Faces of a mesh. Damaged ones are left out.
struct Faces
{
  std::vector<Polygon> polygons;
  std::size_t damaged = 0;
};

/// Returns points of a CIRCLE or an ARC every 10 degrees, nothing if it is damaged.
std::optional<Outline> outlineOfCircle(const Entity& circle);

/// Returns the corners of an LWPOLYLINE, with points on its arcs.
Outline outlineOfLightPolyline(const Entity& polyline);

/// Returns the corners of a POLYLINE with these vertices, with points on its arcs.
Outline outlineOfPolyline(const Entity& polyline, std::span<const Entity> vertices);

/// Returns the corners of a 3DFACE, nothing if it is damaged.
std::optional<Polygon> cornersOfFace(const Entity& face);

/// Returns the corners of a SOLID or a TRACE in order around it, nothing if it is damaged.
std::optional<Polygon> cornersOfSolid(const Entity& solid);

/// Returns the faces of a POLYLINE that is a mesh of rows of points, closed in either direction or not.
Faces facesOfGrid(const Entity& polyline, std::span<const Entity> vertices);

/// Returns the faces of a MESH at its level 0.
Faces facesOfMesh(const Entity& mesh);

} // namespace atria::model::dxf
