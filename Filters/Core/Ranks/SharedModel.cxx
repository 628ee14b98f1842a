// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/SharedModel.h"

#include "Mesher/MeshStages.h"
#include "Ranks/RankMesh.h"
#include "Support/FreedMemory.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

/// Share of the run's progress that is over when octants have their sizes.
constexpr double sizingShare = 0.25;

/// Returns nullopt, on all ranks, if one process has to make the whole mesh.
std::optional<SharedModel> makeShared(const SizedModel& sized, const MesherOptions& options, const RankShare& share,
                                      const ShareRows& rows, int ghostLevels, StageClock& clock,
                                      const RunContext& context)
{
  RankMesh port(share, share.makeOctree(sized.model, rows, context.part(0.0, 0.25)), ghostLevels);
  clock.lap("octree");
  SharedModel out;
  try
  {
    out.meshed = meshOctree(sized, port.octree(), options, nullptr, port, clock, context.part(0.25, 1.0));
  }
  catch (const WholeNeeded&)
  {
    return std::nullopt;
  }
  giveBackFreedMemory();
  out.piece = port.takePiece();
  out.piece.mesh = std::move(out.meshed.mesh);
  return out;
}

} // namespace

std::optional<SharedModel> meshSharedModel(const TriangleSurface& surface, const MesherOptions& options,
                                           int ghostLevels, RankExchange& exchange, const RunContext& run,
                                           const ShareRows& rows)
{
  constexpr int mostTries = 3;
  if (options.mesh.blockSize == 0 || options.sizing.hexahedra)
  {
    return std::nullopt;
  }
  StageClock clock;
  const RunContext sizing = run.part(0.0, sizingShare);
  const SizedModel sized = sizeModel(surface, options, clock, sizing);
  const RankShare share(sized.octants.refined, sized.model, sized.frame, options.mesh.blockSize, exchange, sizing);
  if (share.blocks().count() < static_cast<std::size_t>(std::max(2, exchange.ranks())))
  {
    return std::nullopt;
  }
  std::optional<SharedModel> made;
  ShareRows tried = rows;
  for (int tries = 1; tries < mostTries; ++tries)
  {
    StageClock clockOfTry = clock;
    if (exchange.agreeOn([&] {
          made = makeShared(sized, options, share, tried, ghostLevels, clockOfTry, run.part(sizingShare, 1.0));
        }))
    {
      return made;
    }
    tried = tried.times(2);
  }
  return makeShared(sized, options, share, tried, ghostLevels, clock, run.part(sizingShare, 1.0));
}

} // namespace atria
