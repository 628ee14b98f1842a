// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces of a mesh that are made one, and what becomes of their cells.
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Quality/Unions/MergeFaces.h"

#include <map>
#include <span>
#include <vector>

namespace atria {

/// Faces of the same cells that are made one, and the outlines and centroids that come with it.
struct FaceUnion
{
  std::vector<Index> group;                  ///< the first of them is what they become
  std::map<Index, std::vector<Index>> loops; ///< by face, of the first of the group and of others that change
  std::map<Index, Vec3> centroids;           ///< by cell, of all that have one of these faces
};

/// The faces of a mesh, of which some were made one. The mesh is as it was until writeFaces().
class FaceUnions
{
public:
  FaceUnions(FaceMesh& faceMesh, const RunContext& context);

  /// Whether the face did not become a part of another one.
  bool isLeft(Index face) const { return into[face] == face; }
  std::span<const Index> loopOf(Index face) const;
  /// How many faces have the point.
  Index usesOf(Index point) const { return uses[point]; }
  std::vector<Index> cellsOf(Index face) const;
  /// Those that are left.
  std::vector<Index> facesOf(Index cell) const { return facesIn({}, cell); }

  /// Sets the centroids by the outlines; there are none before.
  void findCentroids(FaceUnion& change) const;
  /// Whether all cells stay closed and no face loses its sound tetrahedra, and the union is star-shaped seen from both
  /// sides, from the centroids as they are and as they would be.
  bool fits(const FaceUnion& change) const;
  /// Whether fewer faces look at another one of their cell from behind or from within its plane, and of no cell more.
  bool isLessConcave(const FaceUnion& change) const;
  void apply(FaceUnion change);

  /// Gives the mesh its new faces. The unions are of no use then.
  MergedFaces writeFaces();

private:
  std::span<const Index> loopIn(const FaceUnion& change, Index face) const;
  const Vec3& centroidIn(const FaceUnion& change, Index cell) const;
  std::vector<Index> facesIn(const FaceUnion& change, Index cell) const;
  std::vector<Index> outwardLoopIn(const FaceUnion& change, Index face, Index cell) const;
  std::vector<PolygonMeasure> measuresIn(const FaceUnion& change, Index cell) const;
  double leastIn(const FaceUnion& change, Index face) const;
  bool staysSound(const FaceUnion& change, Index face) const;
  bool outlinesFit(const FaceUnion& change, const std::vector<Index>& faces) const;
  void count(std::span<const Index> loop, int change);
  bool isInternal(Index face) const { return face < mesh.internalFaceCount(); }

  FaceMesh& mesh;
  std::vector<Index> into; ///< the face each became a part of, itself where none
  CellFaces cellFaces;
  Buffer<Vec3> cellCentroids;
  std::vector<Index> uses;
  std::map<Index, std::vector<Index>> loops; ///< of faces that others became a part of, or that changed with them
};

} // namespace atria
