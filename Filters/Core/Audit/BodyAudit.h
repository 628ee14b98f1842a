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
  /// Of the air in a closed body, and of the space about an open one; cubic model units.
  double volume;
  /// Along the model's axes.
  Vec3 place;
};

struct BodyAudit
{
  /// Closed bodies that reach into the domain, and the volume within it, where they overlap once. Those of surfaces
  /// that are ground are not among them.
  std::size_t closed = 0;
  double volume = 0.0;
  /// What bodies have in common, and the two that have most of it.
  double overlap = 0.0;
  std::array<Index, 2> overlapping{noIndex, noIndex};
  /// Whether solids alone are left out of the domain: there is no ground but its bottom.
  bool isOnFlatGround = false;
  /// Closed bodies around a zone that is meshed.
  std::vector<AiredBody> hollow;
  /// Bodies that are open, but enclose most directions seen from their middles, and hold no zone that is left out.
  std::vector<AiredBody> open;
};

/// \param domain   Along the model's axes.
/// \param zones    Of the mesh, along the model's axes.
/// \param sizeMin  Of the finest octants: smaller bodies are not looked at.
/// The overlap is sampled: it is right to some hundredths. The result depends neither on threads nor on ranks.
BodyAudit auditBodies(const DrawnModel& drawn, const PlacedPrism& domain, const std::vector<ZoneSummary>& zones,
                      double sizeMin);

} // namespace atria
