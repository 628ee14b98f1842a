// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds charts, feature edges, curves and corners of a model.
#pragma once

#include "Surface/Model/SurfaceModel.h"
#include "Surface/Triangles/BoundaryEdges.h"

namespace atria {

/// Fills `charts`, `featureEdges`, `curves` and `corners` of a model whose points, triangles, surface ids, domain sides
/// and feature angle are set.
void findFeatures(SurfaceModel& model, const GridFrame& frame, const Executor& executor);

/// Returns the boundary edges of a model's walls, without those of triangles on sides of the domain.
BoundaryEdges boundaryOf(const SurfaceModel& model, const Executor& executor);

/// Returns, per curve, the surfaces of the charts that meet there, sorted, each once.
std::vector<std::vector<Index>> surfacesOfCurves(const SurfaceModel& model);

} // namespace atria
