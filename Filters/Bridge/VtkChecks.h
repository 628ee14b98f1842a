// SPDX-License-Identifier: GPL-3.0-or-later
/// The verdict of the mesh checks as a table.
#pragma once

#include "Quality/Checks/MeshChecks.h"

class vtkTable;

namespace atria {

/// A row for each check, with the columns that docs/arrays.md lists. `table` is empty before.
void checksToVtk(const MeshVerdict& verdict, vtkTable* table);

} // namespace atria
