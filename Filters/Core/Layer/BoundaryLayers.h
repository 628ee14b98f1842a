// SPDX-License-Identifier: GPL-3.0-or-later
/// Division of the conforming layer into boundary layers.
#pragma once

#include "Layer/ConformingLayer.h"

namespace atria {

/// Returns the number of layers for each point of the plain mesh: `walls.counts`, or what a settled point keeps; 0 if
/// `one` has no layer there.
std::vector<Index> layersWanted(const LayerWalls& walls, const LayerMesh& one);

/// Divides the conforming layer: the line from each wall point to its copy becomes a chain of `counts` layers. Its
/// heights are those of layersOfPoints(). Points of `one` are kept, also those that moved since it was grown. New
/// points lie on the straight line between wall point and copy.
///
/// The layers fill the line (divideWay); first heights are heights above the wall (heightsAbove). Without one, layers
/// grow as requested, but have equal heights beside points with fewer layers.
LayerMesh divideLayer(const DualMesh& plain, const LayerWalls& walls, const LayerMesh& one, const LayerOptions& options,
                      const std::vector<Index>& counts);

/// Calls `use(p, first, count)` for each point p of a wall with layers: its chain is the `count` points from `first` to
/// the copy.
template <typename Use> void forChains(const LayerMesh& layer, Use&& use)
{
  for (Index p = 0; p < layer.plainPoints; ++p)
  {
    if (const Index copy = layer.copies[p]; copy != noIndex)
    {
      const Index count = layer.places[copy - layer.plainPoints];
      use(p, copy + 1 - count, count);
    }
  }
}

/// Returns the height of the layers at each point of the plain mesh: that of its copy above the lowest of its walls,
/// but no less than half of the way to the copy; 0 for points without a copy.
std::vector<double> heightsAbove(const LayerWalls& walls, const LayerMesh& layer);

/// Returns the layers of each point: as requested (layersAskedAt), as many as it may have.
std::vector<WallLayers> layersOfPoints(const DualMesh& mesh, const LayerWalls& walls, const LayerOptions& options);

} // namespace atria
