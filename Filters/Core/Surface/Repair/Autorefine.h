// SPDX-License-Identifier: GPL-3.0-or-later
/// Cuts triangles until they meet in common edges and points only.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Repair/ClusterCells.h"
#include "Surface/Repair/Contacts.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <cstddef>
#include <set>
#include <span>

namespace atria {

class Overlaps;

struct AutorefineOptions
{
  /// A point this close to an edge or a triangle, in lattice units, lies on it. At least 3, as points are rounded.
  std::int64_t reach = 4;
  /// Largest distance, in lattice units, up to which points are merged at contacts that cuts do not remove.
  std::int64_t widestWeld = 0;
  /// Number of rounds after which contacts that are still found are left and counted.
  int maximumRounds = 16;
  /// Chooses among triangles with the same points, and records the others; without it the first one stays.
  Overlaps* overlaps = nullptr;
};

struct AutorefineReport
{
  /// Points that were merged with an earlier one within four times the reach.
  std::size_t mergedPoints = 0;
  /// Triangles that fell together with another one, after both were cut, and were dropped.
  std::size_t overlappingTriangles = 0;
  /// Triangles without area that were dropped.
  std::size_t degenerateTriangles = 0;
  /// Triangles that were cut.
  std::size_t splitTriangles = 0;
  /// Edges on which triangles now meet that only touched or cut each other before.
  std::size_t intersectionEdges = 0;
  /// Contacts left after the last round, and those among triangles that are left, as they were then.
  std::size_t unresolvedContacts = 0;
  std::size_t leftContacts = 0;
  /// Items behind the counts. Per source: nonzero if it was cut, and nonzero if its contacts with others so marked are
  /// left because cuts only made more of them. Then the edges on which triangles now meet.
  std::vector<char> isSplit;
  std::vector<char> isLeft;
  std::set<EdgeKey> meetings;
};

/// Cuts the triangles of a soup along each other, and returns what was done.
///
/// Each round takes these steps:
/// - Points on edges and faces are found, and points where edges cut edges or faces are added.
/// - The triangles they lie on are triangulated anew with these points. Segments that two triangles have in common
///   become edges.
/// - Points closer than the reach allows are merged.
/// - One of several triangles with the same points is kept.
///
/// New points are rounded to the lattice, which can make new contacts. The next round compares each piece with the
/// pieces of triangles that its own triangle has touched. From the second round on, points at contacts are merged
/// within a distance that grows to the widest weld, as contacts that are left then lie closer together than cuts can
/// separate. A triangle that has four times the contacts of two rounds before, or no fewer once that distance no longer
/// grows, is left: its contacts with others that are left are only counted. Pieces take the place of their triangle,
/// with its winding, surface and source. Pieces of one triangle are not compared with each other. Nothing is cut in
/// clusters. Triangles that touch too many others are hidden as if they were in one. Triangles in `isLone` are known to
/// meet no others; it may be empty. O(n log n) if little is cut.
AutorefineReport autorefine(TriangleSoup& soup, const AutorefineOptions& options, ClusterCells& clusters,
                            const RunContext& context, std::span<const char> isLone = {});

/// Cuts a soup that was cut before and in which triangles changed since; adds to the report.
void refineAgain(TriangleSoup& soup, const AutorefineOptions& options, ClusterCells& clusters,
                 std::vector<Change> changes, AutorefineReport& report, const RunContext& context);

/// Drops triangles with repeated points, and all but one of those with the same points: the one that `overlaps`
/// chooses, else the first. Returns the number of the second sort.
std::size_t dropRepeated(TriangleSoup& soup, Overlaps* overlaps = nullptr);

} // namespace atria
