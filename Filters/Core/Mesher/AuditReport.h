// SPDX-License-Identifier: GPL-3.0-or-later
/// Completes the audit of a mesh, and says what a user should know of it.
#pragma once

#include "Audit/MeshAudit.h"
#include "Mesher/ModelOptions.h"

namespace atria {

/// Adds to an audit what was drawn, what became of its bodies, and which sizes were requested.
/// \param drawn  The model as it stands on its ground.
/// \param zones  Of the mesh, in the model.
/// \param model  The same, repaired, in the grid of `frame`.
void completeAudit(const DrawnModel& drawn, const std::vector<ZoneSummary>& zones, const SurfaceModel& model,
                   const GridFrame& frame, const ModelOptions& options, MeshAudit& audit);

/// Returns a sentence for each kind of difference between a mesh and its model that a user should know of:
/// - surfaces without a face in the mesh;
/// - surfaces of which more than a twentieth is missing, and is neither hidden from the air nor another surface's;
/// - a volume that differs by more than a hundredth from what the model encloses, or from its closed bodies;
/// - surfaces that are farther from their faces, or faces from their surface, than half an element or a fiftieth of the
///   surface's extent.
/// Each names surfaces, the worst first, and says what to do.
std::vector<std::string> warningsOf(const MeshAudit& audit, const std::vector<std::string>& names,
                                    const GridFrame& frame);

/// Returns a sentence that names the bodies that are open, with air that is meshed inside of them, if there are any.
std::vector<std::string> notesOf(const BodyAudit& bodies, const std::vector<std::string>& names);

} // namespace atria
