// SPDX-License-Identifier: GPL-3.0-or-later
/// Sends elements to the ranks that have them in their windows, and joins those received.
#pragma once

#include "Ranks/SharedWindow.h"

namespace atria {

/// Elements that one rank has in the window of another, or in its own.
struct WindowPart
{
  /// Ends in faces with a tag of their own where neighbors are missing.
  ClassifiedMesh plain;
  std::vector<PointKey> elementKeys;
  std::vector<SharedPoint> points;
  NearBoundary near;
  /// One entry per boundary face: the element beyond the part's end, or on the other side of the sheet; noKey if none.
  std::vector<PointKey> beyond;
};

/// Sends each other rank the own elements that it needs, in order. Returns the part received from each; from this one,
/// `own`.
std::vector<WindowPart> exchangeParts(WindowPart own, const std::vector<std::vector<Index>>& elements, Index cutTag,
                                      RankExchange& exchange);

/// Joins parts from all ranks to a window, with elements in the order of the whole. Its leaves have no numbers yet.
SharedWindow joinParts(std::vector<WindowPart> parts, Index cutTag);

} // namespace atria
