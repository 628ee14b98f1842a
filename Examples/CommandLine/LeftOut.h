// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Report.h"

#include <string>

class vtkPolyData;

namespace atria::tool {

class Console;

/// Tells which spaces of the model are not in the mesh, as nothing opens them: rooms as warnings with a seed for each,
/// spaces too narrow for the sizes as warnings where they are as large as a room; insides of solids and other narrow
/// spaces summed up as notes. `zones` is from zonesOf.
void tellLeftOut(const Json& zones, const std::string& model, Console& console);

/// The elements that are not in the mesh, as they could not be made valid, the largest first: place, and edge of a cube
/// of the same volume.
Json leftOutElementsOf(vtkPolyData* diagnostics);

/// Tells how many these are and where the largest are.
void tellLeftOutElements(const Json& elements, const std::string& mesh, Console& console);

} // namespace atria::tool
