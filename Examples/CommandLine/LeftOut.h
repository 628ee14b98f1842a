// SPDX-License-Identifier: GPL-3.0-or-later
/// Reports spaces and elements that are not in the mesh.
#pragma once

#include "Report.h"

#include <string>

class vtkPolyData;

namespace atria::tool {

class Console;

/// Reports the spaces of the model that are not in the mesh, as nothing opens them. Rooms are warnings with a seed for
/// each. Spaces too narrow for the sizes are warnings if they are as large as a room. Insides of solids and other
/// narrow spaces are summed up in notes. `zones` is from zonesOf.
void tellLeftOut(const Json& zones, const std::string& model, Console& console);

/// Returns the elements left out because they could not be made valid, the largest first: place, and edge of a cube of
/// the same volume.
Json leftOutElementsOf(vtkPolyData* diagnostics);

/// Reports the number of these and the places of the largest.
void tellLeftOutElements(const Json& elements, const std::string& mesh, Console& console);

} // namespace atria::tool
