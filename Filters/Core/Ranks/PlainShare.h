// SPDX-License-Identifier: GPL-3.0-or-later
/// The plain mesh that a rank makes: its own elements and those beside them.
#pragma once

#include "Mesher/Blocks/ClassifiedMesh.h"
#include "Ranks/RankShare.h"
#include "Ranks/SharedNumbers.h"

namespace atria {

/// The plain mesh of a rank's octree. Own elements and those beside them are as in the whole.
struct PlainShare
{
  ClassifiedMesh plain;
  /// One entry per element: the grid point it stands for; noKey for elements that are not part of the whole. Rises over
  /// own elements.
  std::vector<PointKey> keys;
  /// Own elements are from `firstOwn` up to `endOwn`.
  Index firstOwn = 0;
  Index endOwn = 0;
  /// One entry per point. Vertices, which come first, are in rising order.
  std::vector<SharedPoint> points;
  /// Elements of other ranks at own points, and those that share points with own elements; sorted.
  std::vector<Index> beside;

  bool isOwn(Index element) const { return element >= firstOwn && element < endOwn; }
  std::size_t ownCount() const { return endOwn - firstOwn; }
  /// Returns the own element of a grid point. Throws RanksDisagree if there is none.
  Index find(PointKey key) const { return findOwn(keys, firstOwn, endOwn, key); }
  /// Returns the vertex of a leaf. Throws RanksDisagree if there is none.
  Index vertexOf(MortonKey leaf) const;
  /// Returns the elements of other ranks that share points with `elements`, sorted. Throws RanksDisagree if the octree
  /// ends before them.
  std::vector<Index> besideThese(const std::vector<Index>& elements) const;
};

/// Makes the share of a plain mesh. Throws RanksDisagree if the octree ends beside own elements.
PlainShare shareOf(ClassifiedMesh plain, std::vector<PointKey> keys, const Octree& octree, const RankShare& share);

/// Compares the elements in two rings around own ones with those of other ranks: their points, the pieces of the model
/// to which these belong, and their faces. They may differ, as a rank's octree is that of the whole only within some
/// rows around its share. Throws RanksDisagree if any differ. Sends 16 bytes an element.
void expectSameElements(const PlainShare& own, const RankShare& share);

} // namespace atria
