// SPDX-License-Identifier: GPL-3.0-or-later
/// The options of `atria mesh` for layers of elements along walls.
#pragma once

#include <string>
#include <vector>

class vtkAtriaDualMesher;

namespace CLI {
class App;
}

namespace atria::tool {

struct LayerOptions
{
  std::vector<std::string> layers; ///< N or PATTERN=N[:FIRST[:GROWTH]]
  bool withoutSupport = false;
  double firstHeight = 0.0;
  double yPlus = 0.0; ///< y+ of the middle of the first layer, which sets its height; 0 for none
  double speed = 0.0; ///< speed of the air that passes the walls, m/s; 0 if not given
  double growth = 0.0;
  double nonOrthogonality = 0.0;
  double skewness = 0.0;
  int blockSize = 0;
};

void declareLayerOptions(CLI::App& command, LayerOptions& options);

/// Throws Failure(Usage) for a --layers that has neither form.
void configureLayers(vtkAtriaDualMesher* mesher, const LayerOptions& options);

} // namespace atria::tool
