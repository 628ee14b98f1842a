// SPDX-License-Identifier: GPL-3.0-or-later
/// Categories of cells in ParaView: a color and a name for each, and legends one can read.
#pragma once

class vtkSMProxy;

namespace atria {

/// Colors the cells of a representation as its hints say (see vtkSMAtriaDisplayHelper), now or as soon as the data has
/// cells with that array, and goes on to name the categories that occur in any data of these colors, unless a legend
/// could not hold them. Colors that a user has chosen stay, for the categories as for the whole.
/// The legend has dark letters on a light ground, which can be read before any mesh.
void showCategories(vtkSMProxy* representation);

} // namespace atria
