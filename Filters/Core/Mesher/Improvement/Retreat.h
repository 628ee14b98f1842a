// SPDX-License-Identifier: GPL-3.0-or-later
/// Elements that are not valid in spite of all room begin anew.
#pragma once

#include "Mesher/Improvement/VertexDetachment.h"

namespace atria {

/// Elements that checkMesh would object to, and those about them, begin anew from the centers of their octants, where
/// the plain mesh is valid, in the attempts of ImproverStages.h. Each attempt is made at all places at once, so that
/// its time does not depend on how many there are; a place at which no fewer elements fail then stays as it was.
void retreat(ImproverState& state, VertexDetachment& detachment);

/// Elements that fall short of targets, and, where there may be layers, those that are concave at walls, in order.
std::vector<ShortCell> findFailing(ImproverState& state, const QualityTargets& targets);

} // namespace atria
