// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds edges of walls at which zones end.
#pragma once

#include "Layer/LayerWalls.h"

namespace atria {

/// An edge between two walls at which faces of a zone end.
struct ZoneEdge
{
  Index face; ///< a boundary face that has the edge
  int edge;   ///< the edge's number there
  Index tag;
  SheetSide side; ///< side of the zone's surface on which the element of `face` lies
};

/// Returns the edges between walls at which faces of zones end, each once, sorted by face and edge. Layers on either
/// side of such an edge meet in faces of the zone. Several faces of a zone that end in one edge continue as one if
/// their number is odd.
std::vector<ZoneEdge> findZoneEdges(const DualMesh& mesh, const LayerWalls& walls);

} // namespace atria
