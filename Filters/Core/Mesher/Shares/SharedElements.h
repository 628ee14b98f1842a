// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mesher/Shares/SharedWindow.h"

namespace atria {

/// Asks other ranks whether their own elements in this one's window are as here: at the same points, which belong to
/// the same of the model, with the same faces. A rank's octree is the whole's only so far about its share, so they may
/// not be. Faces with the tag `cutTag` are where the window ends. Throws RanksDisagree if any are not; what goes over
/// is 16 bytes an element.
void expectSameElements(const SharedWindow& window, Index cutTag, const RankShare& share);

} // namespace atria
