// SPDX-License-Identifier: GPL-3.0-or-later
/// Merges faces of a mesh and checks the effect on their cells.
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Quality/Unions/MergeFaces.h"

#include <map>
#include <span>
#include <vector>

namespace atria {

/// Faces of the same cells that are merged, with the outlines and centroids that result.
struct FaceUnion
{
  std::vector<Index> group;                  ///< faces to merge; the first one becomes the merged face
  std::map<Index, std::vector<Index>> loops; ///< one entry per changed face, the first of the group included: its new
                                             ///< outline
  std::map<Index, Vec3> centroids;           ///< one entry per cell that has one of these faces: its new centroid
};

/// The faces of a mesh, some of them merged. The mesh does not change until writeFaces().
class FaceUnions
{
public:
  FaceUnions(FaceMesh& faceMesh, const RunContext& context);

  /// True if the face did not become part of another one.
  bool isLeft(Index face) const { return into[face] == face; }
  std::span<const Index> loopOf(Index face) const;
  /// Returns the number of faces that have the point.
  Index usesOf(Index point) const { return uses[point]; }
  std::vector<Index> cellsOf(Index face) const;
  /// Returns the remaining faces of a cell.
  std::vector<Index> facesOf(Index cell) const { return facesIn({}, cell); }

  /// Computes the centroids from the outlines; `change` must not have any yet.
  void findCentroids(FaceUnion& change) const;
  /// True if each cell keeps at least four faces, changed outlines fit the other faces, no face loses its valid
  /// tetrahedra, and the union is star-shaped. It is seen from both sides, from the old and the new centroids.
  bool fits(const FaceUnion& change) const;
  /// True if the change lowers the number of faces that see another face of their cell from behind or from within its
  /// plane. No cell may get more of them.
  bool isLessConcave(const FaceUnion& change) const;
  void apply(FaceUnion change);

  /// Writes the new faces into the mesh. The unions must not be used afterwards.
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
  std::vector<Index> into; ///< the face that each one became part of, or itself
  CellFaces cellFaces;
  Buffer<Vec3> cellCentroids;
  std::vector<Index> uses;
  std::map<Index, std::vector<Index>> loops; ///< outlines of merged faces, and of faces that changed with them
};

} // namespace atria
