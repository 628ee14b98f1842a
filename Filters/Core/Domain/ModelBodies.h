// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the connected parts of a model and what they stand on.
#pragma once

#include "Domain/Ground.h"
#include "Domain/PlumbLines.h"
#include "Grid/Prism.h"

namespace atria {

/// The bodies of a model. A body is a set of triangles connected by common points.
struct ModelBodies
{
  /// One entry per point: the first point in the same place.
  std::vector<Index> placeOf;
  /// One entry per triangle: its body, or noIndex if its surface belongs to none.
  std::vector<Index> ofTriangle;
  std::vector<Box3> boxes;

  double height(Index body) const { return boxes[body].size()[2]; }
};

/// Returns the bodies of the surfaces that are not left out, numbered by their first triangles. O(n).
ModelBodies findBodies(const TriangleSurface& surface, const SurfaceFlags& leftOut);

/// An edge between places that only one triangle of its body uses.
struct FreeEdge
{
  Index a;
  Index b;
  Index triangle;
};

/// Returns the free edges in the order of places. O(n log n).
std::vector<FreeEdge> findFreeEdges(const TriangleSurface& surface, const ModelBodies& bodies);

/// A convex outline with its measures.
struct Outline2
{
  double area = 0.0;
  double width = 0.0; ///< between the closest two parallel lines with the outline between them
  Vec2 middle = Vec2::Zero();
  std::vector<Vec2> corners; ///< counterclockwise
};

/// Returns the convex hull of points as seen from above.
Outline2 hullOf(std::vector<Vec2> points);

/// Connected faces that look down with a body above them, or the lower ends of walls that stand on nothing.
struct BodyBase
{
  Index body = noIndex;
  Index surface = noIndex;      ///< the surface that has most of it
  std::vector<Index> places;    ///< sorted
  std::vector<Index> triangles; ///< none of a body without a bottom
  double low = 0.0;
  double high = 0.0;
  double top = 0.0; ///< highest point of the body above it
  Vec3 lowest = Vec3::Zero();
  Outline2 outline;
};

/// A face with nothing of the model below it.
struct LowestFace
{
  double height;
  double area;          ///< as seen from above
  double rise = 0.0;    ///< to the highest point of the model over it
  Index base = noIndex; ///< the base it is part of
};

struct BodyBases
{
  std::vector<BodyBase> bases;
  /// Faces that the model as a whole stands on, and bases without faces.
  std::vector<LowestFace> lowest;
};

/// Finds bases in the lower halves of bodies that are larger than `leastSize`. Heights within `tolerance` are equal.
BodyBases findBases(const TriangleSurface& surface, const ModelBodies& bodies, const PlumbLines& lines,
                    double leastSize, double tolerance);

} // namespace atria
