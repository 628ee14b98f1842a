// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Ranks/SharedWindow.h"

namespace atria {

/// Elements that one rank has in the window of another, or in its own.
struct WindowPart
{
  /// Ends in faces with a tag of their own where elements are not in it.
  ClassifiedMesh plain;
  std::vector<PointKey> elementKeys;
  std::vector<SharedPoint> points;
  NearBoundary near;
  /// By boundary face, the element where the part ends, or on the other side of the sheet; noKey where there is none.
  std::vector<PointKey> beyond;
};

/// Sends each other rank those of the own elements that are for it, in order, and returns what came from each; with
/// `own` from this one.
std::vector<WindowPart> exchangeParts(WindowPart own, const std::vector<std::vector<Index>>& elements, Index cutTag,
                                      RankExchange& exchange);

/// Of parts from all ranks, with elements in the order of the whole. Its leaves have no numbers yet.
SharedWindow joinParts(std::vector<WindowPart> parts, Index cutTag);

} // namespace atria
