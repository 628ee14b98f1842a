// SPDX-License-Identifier: GPL-3.0-or-later
/// Completes the audit of a mesh, and says what a user should know of it.
#pragma once

#include "Audit/MeshAudit.h"
#include "Mesher/ModelOptions.h"

namespace atria {

/// Adds to an audit what was drawn, what became of its bodies, and which sizes were requested.
/// \param drawn  The model as it stands on its ground.
/// \param zones  The zones of the mesh, along the model's axes.
/// \param model  The same model, repaired, in the grid of `frame`.
void completeAudit(const DrawnModel& drawn, const std::vector<ZoneSummary>& zones, const SurfaceModel& model,
                   const GridFrame& frame, const ModelOptions& options, MeshAudit& audit);

/// Returns a sentence for each kind of difference between a mesh and its model that a user should know of:
/// - surfaces without a face in the mesh, among them those outside of the domain;
/// - surfaces of which more than a twentieth is missing, and is neither hidden from the air nor another surface's;
/// - surfaces with more than a twentieth too much area in the mesh;
/// - a volume that differs by more than a hundredth from what the model encloses, or is that much less than the volume
///   of its closed bodies;
/// - surfaces that are farther from their faces, or faces from their surface, than half an element or a fiftieth of the
///   surface's extent.
/// Each sentence says what to do. Sentences on surfaces name them, the worst first.
std::vector<std::string> warningsOf(const MeshAudit& audit, const std::vector<std::string>& names,
                                    const GridFrame& frame);

/// Returns a sentence for each of these, if there are any:
/// - bodies that are open, with air that is meshed inside of them;
/// - surfaces whose area differs by more than 0.5 % from what air sees of them, and that no warning names for it.
/// Each sentence names surfaces, the worst first, and says what to do.
std::vector<std::string> notesOf(const MeshAudit& audit, const std::vector<std::string>& names, const GridFrame& frame);

} // namespace atria
