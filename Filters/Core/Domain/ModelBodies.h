// SPDX-License-Identifier: GPL-3.0-or-later
/// The connected parts of a model, and what they stand on.
#pragma once

#include "Domain/Ground.h"
#include "Domain/PlumbLines.h"
#include "Grid/Prism.h"

namespace atria {

/// Triangles connected by common points are a body.
struct ModelBodies
{
  /// By point the first point in the same place.
  std::vector<Index> placeOf;
  /// By triangle; noIndex where its surface belongs to none.
  std::vector<Index> ofTriangle;
  std::vector<Box3> boxes;

  double height(Index body) const { return boxes[body].size()[2]; }
};

/// Bodies of the surfaces that are not left out, numbered by their first triangles. O(n).
ModelBodies findBodies(const TriangleSurface& surface, const SurfaceFlags& leftOut);

/// An edge, between places, that one triangle alone of its body uses.
struct FreeEdge
{
  Index a;
  Index b;
  Index triangle;
};

/// In the order of places. O(n log n).
std::vector<FreeEdge> findFreeEdges(const TriangleSurface& surface, const ModelBodies& bodies);

/// What a convex outline encloses.
struct Outline2
{
  double area = 0.0;
  double width = 0.0; ///< between the closest two parallel lines with the outline between them
  Vec2 middle = Vec2::Zero();
  std::vector<Vec2> corners; ///< counterclockwise
};

/// Of the convex hull of points as seen from above.
Outline2 hullOf(std::vector<Vec2> points);

/// Connected faces that look down with a body above them, or the lower ends of walls that stand on nothing.
struct BodyBase
{
  Index body = noIndex;
  Index surface = noIndex;      ///< that has most of it
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
  Index base = noIndex; ///< that it is part of
};

struct BodyBases
{
  std::vector<BodyBase> bases;
  /// What the model as a whole stands on: faces, and bases without faces.
  std::vector<LowestFace> lowest;
};

/// Finds bases in the lower halves of bodies that are larger than `leastSize`. Heights within `tolerance` are equal.
BodyBases findBases(const TriangleSurface& surface, const ModelBodies& bodies, const PlumbLines& lines,
                    double leastSize, double tolerance);

} // namespace atria
