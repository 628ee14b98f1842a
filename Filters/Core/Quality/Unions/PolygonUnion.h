// SPDX-License-Identifier: GPL-3.0-or-later
/// Unions of polygons that share edges, and tests of their shape. Polygons are loops of distinct points.
#pragma once

#include "Support/Types.h"

#include <optional>
#include <span>
#include <vector>

namespace atria {

bool contains(std::span<const Index> list, Index number);

/// True if an edge of one polygon is an edge of the other in the opposite direction.
bool shareAnEdge(std::span<const Index> a, std::span<const Index> b);

/// Returns the union of two polygons of the same orientation. Returns nullopt if they do not share exactly one run of
/// edges, or if the union would have a point twice.
std::optional<std::vector<Index>> unite(std::span<const Index> a, std::span<const Index> b);

/// True if the points that both polygons have are consecutive in both, and each has other points too. Also true if they
/// share fewer than two points.
bool shareOneRun(std::span<const Index> a, std::span<const Index> b);

/// True if the sine of the angle between the normals is below `sine`, and no point is further from the common plane
/// than `sine` times the longest edge.
bool coplanar(std::span<const Vec3> points, std::span<const Index> a, std::span<const Index> b, double sine);

/// True if triangles from the polygon's centroid to its edges, and those from one of its points, all point away from
/// `center`, and `center` is far enough from the polygon's plane. The angles at the centroid or point must have a sine
/// above `sine`; the distance must be above `sine` times the root of the area.
bool isStarShaped(std::span<const Vec3> points, std::span<const Index> loop, const Vec3& center, double sine);

/// Returns the smallest volume of the tetrahedra of `center` with triangles from the polygon's centroid to its edges
/// and with those from its best point, over the cube of the root of the polygon's area. OpenFOAM divides cells in this
/// way. Above 0 if all triangles point away from `center`. `beyond`, if not null, is a center on the other side, whose
/// tetrahedra with the same triangles count too.
double leastTetrahedron(std::span<const Vec3> points, std::span<const Index> loop, const Vec3& center,
                        const Vec3* beyond);

} // namespace atria
