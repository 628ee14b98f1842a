// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds where two triangles touch and cut each other.
#pragma once

#include "Surface/Repair/Contacts.h"
#include "Surface/Repair/PlaneSides.h"

namespace atria {

/// Collects the contacts of triangles, one pair at a time. Each search has its own object.
class ContactFinder
{
public:
  ContactFinder(const TriangleSoup& soup_, double reach_) : soup(soup_), reach(reach_) {}

  /// Adds the corner that lies on the long edge of a triangle without width.
  void look(Index t);
  /// Adds the contacts of two pieces of different sources.
  void look(Index first, Index second);
  /// Adds the contacts that another search has found.
  void append(const ContactFinder& other);
  FoundContacts take() { return std::move(out); }

private:
  const LatticePoint& point(Index p) const { return soup.points[p]; }

  bool liesOn(const LatticePoint& p, const EdgeKey& edge) const;
  /// True if a triangle lies so far beyond an edge of another, seen along the other's normal, that they do not touch.
  bool isBeyondAnEdge(Index t, Index of) const;
  /// True if p, which lies on the triangle's plane but for rounding, lies inside of it.
  bool isInside(const LatticePoint& p, Index t, const LatticeNormal& normal) const;
  /// Adds the corners of `of` that lie on edges or the face of `on`, and returns flags for them.
  std::array<bool, 3> touchCorners(Index of, Index on, const PlaneSides& side);
  /// True if the boxes of two edges are as near as these must be to cut each other. Most are not.
  bool areNear(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) const;
  Index addPoint(const LatticePoint& p);
  /// True if edge i of a triangle passes through the plane of another in a definite point.
  bool isSteep(Index t, int i, const PlaneSides& side) const;
  /// Adds the points where edges cut each other: within the reach if the triangles lie in one plane. Elsewhere cutFace
  /// finds where they meet: near the line in which two planes meet at a small angle, all edges are close to each other
  /// but do not cut.
  void cutEdges(Index first, Index second, const PlaneSides& a, const PlaneSides& b);
  void cutEdge(const EdgeKey& e, const EdgeKey& f, double apart);
  /// Adds the edges of `of` that pass through the face of `through`.
  void cutFace(Index of, Index through, const PlaneSides& side, const std::array<bool, 3>& touches);
  /// True if a place is too far from the box of a triangle to lie on it.
  bool isBeside(const PlaneSides::Passage& passage, Index t) const;
  void cutAt(const LatticePoint& p, const EdgeKey& edge, Index through, const PlaneSides& side);

  const TriangleSoup& soup;
  double reach;
  FoundContacts out;
};

} // namespace atria
