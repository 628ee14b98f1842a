// SPDX-License-Identifier: GPL-3.0-or-later
/// Says what became of the bodies of a model: which are solid, hollow or open in the mesh.
#pragma once

#include "Dual/Zones/ZoneEnclosures.h"
#include "Grid/Prism.h"

namespace atria {

/// A body with air inside of it.
struct AiredBody
{
  Index surface;
  /// Volume of the air in a closed body or of the box around an open one, in cubic model units.
  double volume;
  /// Along the model's axes.
  Vec3 place;
};

struct BodyAudit
{
  /// Number of closed bodies that reach into the domain, and their volume within it, where overlaps count once. Bodies
  /// of ground surfaces are not counted.
  std::size_t closed = 0;
  double volume = 0.0;
  /// Volume of all overlaps of two bodies, and the surfaces of the two that overlap most.
  double overlap = 0.0;
  std::array<Index, 2> overlapping{noIndex, noIndex};
  /// True if no ground surface rises above the domain's bottom by more than half of `sizeMin`: solids alone are left
  /// out of the domain.
  bool isOnFlatGround = false;
  /// Closed bodies around a zone that is meshed.
  std::vector<AiredBody> hollow;
  /// Bodies that are open, but enclose most directions seen from their middles, and hold no zone that is left out.
  std::vector<AiredBody> open;
};

/// Returns what became of the bodies of a model.
/// \param domain   Along the model's axes.
/// \param zones    Zones of the mesh, along the model's axes.
/// \param sizeMin  Edge length of the finest octants; smaller bodies are ignored.
/// The overlap is sampled and right to some hundredths. The result depends neither on threads nor on ranks.
BodyAudit auditBodies(const DrawnModel& drawn, const PlacedPrism& domain, const std::vector<ZoneSummary>& zones,
                      double sizeMin);

} // namespace atria
