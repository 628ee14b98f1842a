// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/Straightening.h"

namespace atria {

void straighten(ImproverState& state, VertexDetachment& detachment)
{
  const std::vector<ImproverStage> stages = straighteningStages(state.traits);
  const auto runAll = [&] { std::ranges::for_each(stages, [&](const ImproverStage& stage) { state.run(stage); }); };
  runAll();
  for (const double reach : reachesForAngles)
  {
    const std::vector<ShortCell> beyond = state.findShort(targetsOfLargestAngle(state.traits), 0.0F);
    if (beyond.empty())
    {
      break;
    }
    detachment.detach(beyond, reach);
    runAll();
  }
  detachment.keepThoseAway();
}

void straightenWhereNeeded(ImproverState& state, VertexDetachment& detachment)
{
  if (!state.traits.divided && !state.findShort(targetsOfLargestAngle(state.traits), 0.0F).empty())
  {
    straighten(state, detachment);
  }
}

} // namespace atria
