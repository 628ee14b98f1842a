// SPDX-License-Identifier: GPL-3.0-or-later
#include "Audit/SurfaceSamples.h"

#include "Support/Pieces.h"

#include <algorithm>

namespace atria {

namespace {

class Sampler
{
public:
  Sampler(const Crossings& c, const Zones& z, const std::vector<View>& o, const MeshingContext& m)
      : crossings(c), zones(z), ofZone(o), context(m), frame(m.octree.frame())
  {
  }

  void sample(const CrossedEdge& edge, std::vector<SurfaceSample>& out) const
  {
    const Octree& octree = context.octree;
    if (std::ranges::any_of(edge.segment.about, [&](Index leaf) {
          return leaf != noIndex && octree.featureType(leaf) == FeatureType::cluster;
        }))
    {
      return;
    }
    const std::span<const SurfaceCrossing> cuts = crossings.of(edge);
    std::size_t seen = 0; // from the start
    if (isAir(edge.point))
    {
      eachSeen(cuts.begin(), cuts.end(), context.model, [&](const SurfaceCrossing& cut) {
        take(edge, cut, out);
        ++seen;
      });
    }
    if (isAir(edge.other))
    {
      const std::span<const SurfaceCrossing> unseen = cuts.subspan(seen);
      eachSeen(unseen.rbegin(), unseen.rend(), context.model,
               [&](const SurfaceCrossing& cut) { take(edge, cut, out); });
    }
  }

private:
  bool isAir(Index point) const { return viewAt(point, zones, ofZone) == View::air; }

  void take(const CrossedEdge& edge, const SurfaceCrossing& cut, std::vector<SurfaceSample>& out) const
  {
    if (context.model.isTurnedSide(cut.triangle))
    {
      return;
    }
    const Vec3 start = toVector(edge.segment.start);
    const Vec3 at = start + cut.parameter * (toVector(edge.segment.end) - start);
    const double size = static_cast<double>(edge.segment.size) * frame.latticeUnit();
    out.push_back({frame.toModel(at), context.model.surfaceIds[cut.triangle], static_cast<float>(size)});
  }

  const Crossings& crossings;
  const Zones& zones;
  const std::vector<View>& ofZone;
  const MeshingContext& context;
  const GridFrame& frame;
};

} // namespace

std::vector<SurfaceSample> sampleSurfaces(const Crossings& crossings, const Zones& zones,
                                          const std::vector<View>& ofZone, const GridPart& part,
                                          const MeshingContext& context)
{
  const Sampler sampler(crossings, zones, ofZone, context);
  const Pieces pieces(crossings.crossedEdges.size());
  std::vector<std::vector<SurfaceSample>> found(pieces.count);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    context.progress.check();
    for (std::size_t e = pieces.begin(piece); e < pieces.end(piece); ++e)
    {
      const CrossedEdge& edge = crossings.crossedEdges[e];
      if (part.owns(edge.point))
      {
        sampler.sample(edge, found[piece]);
      }
    }
  });
  std::vector<SurfaceSample> all;
  for (const std::vector<SurfaceSample>& some : found)
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

} // namespace atria
