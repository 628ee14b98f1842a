// SPDX-License-Identifier: GPL-3.0-or-later
#include "Audit/SurfaceSamples.h"

#include "Support/Pieces.h"
#include "Surface/Search/Distance.h"

#include <algorithm>

namespace atria {

namespace {

class Sampler
{
public:
  Sampler(const std::vector<TriangleViews>& v, const std::vector<float>& a, const MeshingContext& c)
      : views(v), airParts(a), context(c)
  {
  }

  void sample(Index leaf, std::vector<SurfaceSample>& out)
  {
    const SurfaceModel& model = context.model;
    const GridFrame& frame = context.octree.frame();
    const LatticePoint low = context.octree.lowCorner(leaf);
    const LatticePoint high = context.octree.highCorner(leaf);
    const Vec3 center = 0.5 * (toVector(low) + toVector(high));
    nearest.clear();
    for (const ModelItem piece : context.octree.items(leaf, ModelItem::triangle))
    {
      const Index t = piece.index;
      if (isWanted(t))
      {
        const Vec3 at = nearestOnTriangle(center, toVector(model.corner(t, 0)), toVector(model.corner(t, 1)),
                                          toVector(model.corner(t, 2)));
        placeOf(model.surfaceIds[t], center).offer(at);
      }
    }
    const auto size = static_cast<float>(frame.sizeOf(context.octree.level(leaf)));
    std::ranges::sort(nearest, {}, &Nearest::surface);
    for (const Nearest& one : nearest)
    {
      const Vec3 at = frame.toModel(one.place.at);
      if ((at.array() >= frame.domain.min.array()).all() && (at.array() <= frame.domain.max.array()).all())
      {
        out.push_back({at, one.surface, size});
      }
    }
  }

private:
  struct Nearest
  {
    Index surface;
    NearestPlace place;
  };

  bool isWanted(Index t) const
  {
    constexpr TriangleViews unseen{View::nothing, View::nothing};
    const bool isInGap = !airParts.empty() && airParts[t] < 1.0F;
    return !context.model.isTurnedSide(t) && ((seesAir(views[t]) && !isInGap) || views[t] == unseen);
  }

  NearestPlace& placeOf(Index surface, const Vec3& center)
  {
    const auto found = std::ranges::find(nearest, surface, &Nearest::surface);
    return found != nearest.end() ? found->place : nearest.emplace_back(surface, NearestPlace{center}).place;
  }

  const std::vector<TriangleViews>& views;
  const std::vector<float>& airParts;
  const MeshingContext& context;
  std::vector<Nearest> nearest;
};

} // namespace

std::vector<SurfaceSample> sampleSurfaces(const std::vector<TriangleViews>& views, const std::vector<float>& airParts,
                                          const std::function<bool(Index leaf)>& isAsked, const MeshingContext& context)
{
  const Octree& octree = context.octree;
  const Pieces pieces(octree.leafCount());
  std::vector<std::vector<SurfaceSample>> found(pieces.count);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    context.progress.check();
    Sampler sampler(views, airParts, context);
    for (std::size_t i = pieces.begin(piece); i < pieces.end(piece); ++i)
    {
      const auto leaf = static_cast<Index>(i);
      if (!octree.items(leaf).empty() && octree.featureType(leaf) != FeatureType::cluster &&
          (!isAsked || isAsked(leaf)))
      {
        sampler.sample(leaf, found[piece]);
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
