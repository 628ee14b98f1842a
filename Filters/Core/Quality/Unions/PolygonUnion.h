// SPDX-License-Identifier: GPL-3.0-or-later
/// Unions of polygons that share edges, and what may be said of them. Polygons are loops of distinct points.
#pragma once

#include "Support/Types.h"

#include <optional>
#include <span>
#include <vector>

namespace atria {

bool contains(std::span<const Index> list, Index number);

/// Whether an edge of one polygon is, run through the other way, an edge of the other.
bool shareAnEdge(std::span<const Index> a, std::span<const Index> b);

/// The union of two polygons of the same sense; nothing where they do not share exactly one run of edges, or where the
/// union would have a point twice.
std::optional<std::vector<Index>> unite(std::span<const Index> a, std::span<const Index> b);

/// Whether the points that both polygons have follow each other in both, and each has others too. Also true of polygons
/// that share fewer than two points.
bool shareOneRun(std::span<const Index> a, std::span<const Index> b);

/// Whether the sine of the angle between the normals is below `sine`, and no point is further from the common plane
/// than `sine` times the longest edge.
bool coplanar(std::span<const Vec3> points, std::span<const Index> a, std::span<const Index> b, double sine);

/// Whether triangles from the polygon's centroid to its edges, and those from one of its points, all look away from
/// `center`, with an angle at the centroid or point of a greater sine than `sine`; and whether `center` is further from
/// the polygon's plane than `sine` times the root of its area.
bool isStarShaped(std::span<const Vec3> points, std::span<const Index> loop, const Vec3& center, double sine);

/// The least volume, over the cube of the root of the polygon's area, of the tetrahedra of `center` with triangles from
/// the polygon's centroid to its edges and with those from one of its points, the best one, as OpenFOAM takes cells
/// apart. Above 0 where all look away from `center`. `beyond`, if not null, is a center on the other side, whose
/// tetrahedra with the same triangles count as well.
double leastTetrahedron(std::span<const Vec3> points, std::span<const Index> loop, const Vec3& center,
                        const Vec3* beyond);

} // namespace atria
