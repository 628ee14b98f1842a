// SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces tests are made of.
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

#include <string>

namespace atria::testing {

/// Appends a surface of its own; triangles index into `points`.
void addSurface(TriangleSurface& to, const std::string& name, const std::vector<Vec3>& points,
                const std::vector<std::array<Index, 3>>& triangles);

/// Returns a surface with its surfaces in another order.
TriangleSurface inOrder(const TriangleSurface& surface, const std::vector<Index>& order);

/// Two triangles over the parallelogram at `corner` spanned by `u` and `v`; the front is where u x v points.
void addSheet(TriangleSurface& to, const std::string& name, const Vec3& corner, const Vec3& u, const Vec3& v);

/// Closed box, normals outwards.
void addBox(TriangleSurface& to, const std::string& name, const Box3& box);

/// Solid over a polygon, upright from `bottom` to `top`, normals outwards. The polygon runs counter-clockwise, and its
/// first corner sees all others.
void addPrism(TriangleSurface& to, const std::string& name, const std::vector<Eigen::Vector2d>& polygon, double bottom,
              double top);

/// The first corner is on the x axis.
std::vector<Eigen::Vector2d> regularPolygon(int corners, double radius);

/// Open cylinder about the way from one point to another, normals outwards. With a multiple of four facets one of a
/// level way touches the planes below and above it.
void addTube(TriangleSurface& to, const std::string& name, const Vec3& begin, const Vec3& end, double radius,
             Index facets);

/// Subdivided icosahedron, normals outwards; 20 * 4^subdivisions triangles with all points at `radius`.
void addSphere(TriangleSurface& to, const std::string& name, const Vec3& center, double radius, int subdivisions);

/// Turns all points about the vertical through the origin.
void turn(TriangleSurface& surface, double degrees);

/// A box 10 m long with a sphere of radius 2 m in it.
TriangleSurface sphereInCube(int subdivisions);

/// Random sheets, boxes and spheres in the cube of 8 m about the origin, some of them on round coordinates, turned, or
/// repeated. The same for the same seed.
TriangleSurface randomSoup(unsigned seed);

} // namespace atria::testing
