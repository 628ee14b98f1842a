// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Layer/LayerWalls.h"

namespace atria {

/// An edge between two walls at which faces of a zone end.
struct ZoneEdge
{
  Index face; ///< a boundary face that has it
  int edge;   ///< the edge's number there
  Index tag;
  SheetSide side; ///< of the zone's surface, on which the element of `face` lies
};

/// The edges between walls at which faces of zones end, by face and edge, each once: layers on either side of them meet
/// in faces of the zone. Where several faces of a zone end in one edge, they go on as one if their number is odd.
std::vector<ZoneEdge> findZoneEdges(const DualMesh& mesh, const LayerWalls& walls);

} // namespace atria
