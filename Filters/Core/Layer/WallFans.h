// SPDX-License-Identifier: GPL-3.0-or-later
/// Lets walls that share only a vertex move apart.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Layer/EdgeTubes.h"

namespace atria {

/// Gives points with the same vertex (splitSheets) vertices of their own unless they are on two sides of a sheet or of
/// a tube, or connected through such points: fans of walls that meet in a point only need not stay together. Appends
/// vertices to `classification` so that there is one for each point; `vertexOf` has one entry per point, the first of
/// those that move as one. O(n) in boundary faces.
void separateFans(const DualMesh& mesh, const EdgeTubes& tubes, VertexClassification& classification,
                  std::vector<Index>& vertexOf);

} // namespace atria
