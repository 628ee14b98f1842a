// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/MeshReport.h"

#include "Dual/Zones/CellZones.h"
#include "Mesher/AuditReport.h"
#include "Mesher/LostModel.h"
#include "Mesher/OverlapWarnings.h"

namespace atria {

void reportMesh(const MeshSources& sources, const std::vector<char>& metCellZones, MeshedModel& out)
{
  const auto& [grounded, drawn, model, frame] = sources;
  const double sizeMin = frame.sizeOf(frame.featureLevel);
  for (const std::vector<std::string>& warnings :
       {warningsOfEmptyCellZones(metCellZones, model), warningsOfOverlaps(model, sizeMin),
        warningsOfLostModel(drawn.isGround, sizeMin, out.metSides)})
  {
    out.inputWarnings.insert(out.inputWarnings.end(), warnings.begin(), warnings.end());
  }
  completeAudit(drawn, out.zones, model, frame, grounded.options, out.audit);
  out.auditWarnings = warningsOf(out.audit, model.names, frame);
  out.ground = grounded.report;
  out.notes = grounded.report.notes;
  const std::vector<std::string> ofAudit = notesOf(out.audit, model.names, frame);
  out.notes.insert(out.notes.end(), ofAudit.begin(), ofAudit.end());
  if (!out.layers.thin.note.empty())
  {
    out.notes.push_back(out.layers.thin.note);
  }
  out.names = model.names;
  out.kinds = model.kinds;
  out.repair = model.repair;
}

} // namespace atria
