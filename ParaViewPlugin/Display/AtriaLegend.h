// SPDX-License-Identifier: GPL-3.0-or-later
/// Colors and names categories of cells in ParaView, with readable legends.
#pragma once

class vtkSMProxy;

namespace atria {

/// Colors the cells of a representation by its hints (see vtkSMAtriaDisplayHelper), now or as soon as the data has
/// cells with that array. Goes on to name the categories that occur in any data of these colors, unless a legend could
/// not hold them. Colors that a user has chosen stay, for the categories as for the whole. The legend has dark letters
/// on a light ground, which can be read before any mesh.
void showCategories(vtkSMProxy* representation);

} // namespace atria
