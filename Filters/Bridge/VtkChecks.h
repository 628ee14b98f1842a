// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts the verdict of the mesh checks to a table.
#pragma once

#include "Quality/Checks/MeshChecks.h"

class vtkTable;

namespace atria {

/// Fills `table`, which must be empty, with a row for each check and the columns that docs/arrays.md lists.
void checksToVtk(const MeshVerdict& verdict, vtkTable* table);

} // namespace atria
