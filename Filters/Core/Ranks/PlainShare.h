// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mesher/Blocks/ClassifiedMesh.h"
#include "Ranks/RankShare.h"
#include "Ranks/SharedNumbers.h"

namespace atria {

/// The plain mesh of a rank's octree, of which own elements and those beside them are as in the whole.
struct PlainShare
{
  ClassifiedMesh plain;
  /// By element, in rising order where they are own ones, the grid point it stands for; noKey for what is not of the
  /// whole.
  std::vector<PointKey> keys;
  /// Own elements are from `firstOwn` up to `endOwn`.
  Index firstOwn = 0;
  Index endOwn = 0;
  /// By point. Vertices, which come first, are in rising order.
  std::vector<SharedPoint> points;
  /// Elements of other ranks at own points, and those that share points with own elements; in order.
  std::vector<Index> beside;

  bool isOwn(Index element) const { return element >= firstOwn && element < endOwn; }
  std::size_t ownCount() const { return endOwn - firstOwn; }
  /// The own element of a grid point. Throws RanksDisagree if there is none.
  Index find(PointKey key) const { return findOwn(keys, firstOwn, endOwn, key); }
  /// The vertex of a leaf. Throws RanksDisagree if there is none.
  Index vertexOf(MortonKey leaf) const;
  /// Elements of other ranks that share points with some of those beside, in order. Throws RanksDisagree where the
  /// octree ends before them.
  std::vector<Index> besideThese(const std::vector<Index>& elements) const;
};

/// Throws RanksDisagree where the octree ends beside own elements.
PlainShare shareOf(ClassifiedMesh plain, std::vector<PointKey> keys, const Octree& octree, const RankShare& share);

/// Asks other ranks whether their elements in two rings about own ones are as here: at the same points, which belong to
/// the same of the model, with the same faces. A rank's octree is the whole's only so far about its share, so they may
/// not be. Throws RanksDisagree if any are not; what goes over is 16 bytes an element.
void expectSameElements(const PlainShare& own, const RankShare& share);

} // namespace atria
