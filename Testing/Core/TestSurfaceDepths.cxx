// SPDX-License-Identifier: GPL-3.0-or-later
/// What is outside of a surface, from parts of the grid that edges join.
#include "Dual/Zones/SurfaceDepths.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <vector>

namespace {

using namespace atria;
using ::testing::ElementsAre;
using ::testing::Optional;

DepthPart beyond(int depth)
{
  DepthPart part;
  part.beyond = depth;
  part.least = std::min(0, depth);
  return part;
}

TEST(SurfaceDepths, BeyondTheBoundsAreOutside)
{
  EXPECT_THAT(depthsOutside({beyond(-1), beyond(0)}, {}), Optional(ElementsAre(-1, 0)));
  EXPECT_THAT(depthsOutside({beyond(-1), beyond(0)}, {{0, 1, 1, true}}), Optional(ElementsAre(-1, 0)));
  EXPECT_EQ(depthsOutside({beyond(-1), beyond(0)}, {{0, 1, 0, true}}), std::nullopt) << "a hole";
  EXPECT_EQ(depthsOutside({{}, {}}, {{0, 1, 0, true}, {0, 1, 1, true}}), std::nullopt) << "two ways";
}

TEST(SurfaceDepths, OfWhatDoesNotLeadThereAreThoseBehindOtherSurfaces)
{
  DepthPart pocket;
  EXPECT_THAT(depthsOutside({pocket}, {}), Optional(ElementsAre(0)));
  EXPECT_THAT(depthsOutside({beyond(-1), pocket}, {{0, 1, 0, false}}), Optional(ElementsAre(-1, -1)));
  // The least counts, as a face that is another surface's may be on the other way.
  EXPECT_THAT(depthsOutside({beyond(-1), beyond(0), pocket}, {{0, 2, 0, false}, {2, 1, 0, false}}),
              Optional(ElementsAre(-1, 0, -1)));
  EXPECT_THAT(depthsOutside({pocket, pocket, beyond(-1)}, {{0, 1, 2, false}, {2, 1, 0, false}}),
              Optional(ElementsAre(-3, -1, -1)))
      << "one after the other";
  pocket.beyondOthers = -2;
  EXPECT_THAT(depthsOutside({beyond(-1), pocket}, {{0, 1, 0, false}}), Optional(ElementsAre(-1, -2)));
}

struct Scene
{
  std::vector<DepthPart> parts;
  std::vector<DepthLink> links;
};

Scene randomScene(std::mt19937& random)
{
  const auto drawn = [&](int least, int most) { return std::uniform_int_distribution(least, most)(random); };
  Scene scene;
  const int count = drawn(1, 12);
  for (int i = 0; i < count; ++i)
  {
    DepthPart part = drawn(0, 2) == 0 ? beyond(drawn(-2, 2)) : DepthPart();
    part.beyondOthers = drawn(0, 3) == 0 ? drawn(-2, 2) : DepthPart::none;
    part.least = std::min(part.least, drawn(-2, 0));
    scene.parts.push_back(part);
  }
  const auto any = [&] { return static_cast<Index>(drawn(0, count - 1)); };
  for (int i = drawn(0, 2 * count); i > 0; --i)
  {
    scene.links.push_back({any(), any(), drawn(-2, 2), false});
  }
  return scene;
}

/// A scene of which each part is in pieces, as ranks have them, whose depths begin elsewhere.
struct Pieces
{
  Scene scene;
  std::vector<Index> partOf;
  std::vector<int> more; ///< what depths of a piece are above those of the part
};

Pieces cutUp(const Scene& whole, std::mt19937& random)
{
  const auto drawn = [&](int least, int most) { return std::uniform_int_distribution(least, most)(random); };
  Pieces out;
  std::vector<std::vector<Index>> piecesOf(whole.parts.size());
  const auto moved = [](int depth, int more) { return depth == DepthPart::none ? depth : depth + more; };
  for (Index part = 0; part < whole.parts.size(); ++part)
  {
    const int count = drawn(1, 3);
    const int holder = drawn(0, count - 1); // of what is known of the part
    for (int i = 0; i < count; ++i)
    {
      const auto piece = static_cast<Index>(out.partOf.size());
      const int more = drawn(-3, 3);
      DepthPart& made = out.scene.parts.emplace_back();
      made.least = more;
      if (i == holder)
      {
        const DepthPart& all = whole.parts[part];
        made = {moved(all.beyond, more), moved(all.beyondOthers, more), moved(all.least, more)};
      }
      if (i > 0)
      {
        out.scene.links.push_back({piece - 1, piece, more - out.more.back(), true});
      }
      out.partOf.push_back(part);
      out.more.push_back(more);
      piecesOf[part].push_back(piece);
    }
  }
  const auto anyOf = [&](Index part) {
    return piecesOf[part][static_cast<std::size_t>(drawn(0, static_cast<int>(piecesOf[part].size()) - 1))];
  };
  for (const DepthLink& link : whole.links)
  {
    const Index one = anyOf(link.part);
    const Index other = anyOf(link.other);
    out.scene.links.push_back({one, other, link.depth + out.more[other] - out.more[one], false});
  }
  std::ranges::shuffle(out.scene.links, random);
  return out;
}

TEST(SurfaceDepths, OfPartsInPiecesAreThoseOfTheWhole)
{
  std::mt19937 random(7);
  for (int i = 0; i < 500; ++i)
  {
    SCOPED_TRACE(i);
    const Scene whole = randomScene(random);
    const Pieces pieces = cutUp(whole, random);
    const auto outside = depthsOutside(whole.parts, whole.links);
    const auto found = depthsOutside(pieces.scene.parts, pieces.scene.links);
    ASSERT_TRUE(outside && found);
    for (Index piece = 0; piece < found->size(); ++piece)
    {
      EXPECT_EQ((*found)[piece], (*outside)[pieces.partOf[piece]] + pieces.more[piece]);
    }
  }
}

} // namespace
