// SPDX-License-Identifier: GPL-3.0-or-later
/// Says what became of the bodies of a model: which are solid, hollow or open in the mesh.
#pragma once

#include "Audit/AuditResult.h"
#include "Dual/Zones/ZoneEnclosures.h"
#include "Grid/Prism.h"

namespace atria {

/// Returns what became of the bodies of a model.
/// \param domain   Along the model's axes.
/// \param zones    Zones of the mesh, along the model's axes.
/// \param sizeMin  Edge length of the finest octants; smaller bodies are ignored.
/// The overlap is sampled and right to some hundredths, except of bodies that lie in others, where it is exact. The
/// result depends neither on threads nor on ranks.
BodyAudit auditBodies(const DrawnModel& drawn, const PlacedPrism& domain, const std::vector<ZoneSummary>& zones,
                      double sizeMin);

} // namespace atria
