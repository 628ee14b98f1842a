// SPDX-License-Identifier: GPL-3.0-or-later
/// Lets layers go round the boundary edges of sheets.
#pragma once

#include "Layer/LayerWalls.h"
#include "Support/UnionFind.h"

namespace atria {

/// Tubes of elements in front of the boundary edges of sheets. Two hexahedra of a layer that goes round such an
/// edge alone share the full angle. If the layer goes round the sheet and a tube in front of its edge, four hexahedra
/// of the layer and two of the tube share it.
///
/// Use: cut the tubes out, split points (splitSheets), find walls, keep tubes, grow layers, and join tubes.
struct EdgeTubes
{
  /// Elements of all tubes, in rising order.
  std::vector<Index> elements;
  /// Faces of the cut: pairs of boundary faces, first the one outside of the tube, then the one inside. They
  /// follow each other from here on.
  Index firstFace = 0;
  Index faceCount = 0;

  bool isEmpty() const { return elements.empty(); }
  bool has(Index face) const { return face >= firstFace && face - firstFace < faceCount; }
  /// Returns the face on the other side of the cut.
  Index across(Index face) const { return firstFace + ((face - firstFace) ^ 1U); }
};

/// Joins the points of two boundary faces that have the same vertex.
void joinSame(const DualMesh& mesh, Index face, Index other, const std::vector<Index>& vertexOf, UnionFind& points);

/// Finds tubes in a mesh whose sheets are split: the elements that have a boundary edge of a sheet but no wall along
/// it, and those with a point of such an edge and no other edge of a wall there; then further elements at walls, until
/// the faces around each point of the rest are one fan. O(n) in elements.
EdgeTubes findEdgeTubes(const DualMesh& mesh, const RunContext& context);

/// Number of tags that cutTubes() inserts.
inline constexpr Index tagsOfTubes = 2;

/// Cuts the tubes out. Faces of the cut get the tag `surfaceCount` outside of tubes and the next one inside; tags of
/// the domain's sides grow by two. Faces of zones on the cut become faces of tubes.
void cutTubes(DualMesh& mesh, Index surfaceCount, EdgeTubes& tubes);

/// Inserts the tags of tubes: as many layers outside as on the wall with most, none inside.
void addTubes(LayerOptions& options);

/// Makes faces of tubes such, and takes all layers away within tubes.
void keepTubes(const DualMesh& mesh, const EdgeTubes& tubes, LayerWalls& walls);

/// Numbers of points and boundary faces once tubes are joined; noIndex for faces that are gone. Points that became one
/// have the same number.
struct JoinedTubes
{
  std::vector<Index> points;
  std::vector<Index> faces;
};

/// Removes the cut from a mesh with layers (buildLayer joins its elements). Points on its two sides become one if they
/// have the same vertex. One entry of `vertexOf` per point that the mesh had before it got layers.
JoinedTubes joinTubes(DualMesh& mesh, const EdgeTubes& tubes, const std::vector<Index>& vertexOf, Index surfaceCount);

} // namespace atria
