// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes that ranks make together, in blocks.
#include "OnRanks.h"
#include "Ranks/ControllerExchange.h"
#include "Support/ProgressWatch.h"

#include <vtkExecutive.h>
#include <vtkUnsignedCharArray.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>

namespace {

using namespace atria::testing;
using atria::Vec3;
using ::testing::HasSubstr;

class TogetherOnRanks : public OnRanks
{
protected:
  TogetherOnRanks() { mesher->SetBlockSize(blockSize); }

  /// So that there are more blocks than ranks.
  static constexpr int blockSize = 200;

  /// Whether the last mesh was made by all ranks: the last of their stages numbers its elements.
  bool isMadeTogether() const
  {
    bool isMade = false;
    for (int i = 0; i < mesher->GetNumberOfStages(); ++i)
    {
      isMade = isMade || mesher->GetStageName(i) == "numbers";
    }
    return isMade;
  }

  void expectThatOfOneProcess(bool isTogether = true)
  {
    const auto alone = whole();
    update(mesher);
    if (ranks() > 1 && (rank() == 0 || isTogether))
    {
      EXPECT_EQ(isMadeTogether(), isTogether);
    }
    expectPiecesOf(alone);
  }
};

TEST_F(TogetherOnRanks, PiecesMakeTheMeshOfOneProcess)
{
  for (const int layers : {0, 1, 2})
  {
    SCOPED_TRACE(layers);
    setSceneEverywhere();
    mesher->SetNumberOfLayers(layers);
    expectThatOfOneProcess();
  }
}

TEST_F(TogetherOnRanks, TheFirstHasItAllWhereThatIsAskedFor)
{
  for (const int layers : {0, 2})
  {
    SCOPED_TRACE(layers);
    mesher->SetNumberOfLayers(layers);
    const auto alone = whole();
    mesher->DistributeOutputOff();
    update(mesher);
    if (ranks() > 1)
    {
      EXPECT_TRUE(isMadeTogether());
    }
    if (rank() == 0)
    {
      EXPECT_TRUE(identical(alone[0], volume()));
      EXPECT_TRUE(identical(alone[1], patches()));
      EXPECT_TRUE(identical(alone[2], diagnostics()));
    }
    else
    {
      EXPECT_EQ(volume()->GetNumberOfCells(), 0);
      EXPECT_EQ(patches()->GetNumberOfPartitionedDataSets(),
                vtkPartitionedDataSetCollection::SafeDownCast(alone[1])->GetNumberOfPartitionedDataSets());
    }
    mesher->DistributeOutputOn();
    setSceneEverywhere();
  }
}

TEST_F(TogetherOnRanks, EveryCellAndPointIsOfOneRank)
{
  const auto alone = whole();
  update(mesher, 2);
  vtkUnsignedCharArray* ghosts = volume()->GetPointGhostArray();
  const vtkIdType own = ghosts ? std::count(ghosts->Begin(), ghosts->End(), 0) : volume()->GetNumberOfPoints();
  EXPECT_EQ(sumOverRanks(own), alone[0]->GetNumberOfElements(vtkDataObject::POINT));
  EXPECT_EQ(sumOverRanks(static_cast<vtkIdType>(ownCells().size())),
            alone[0]->GetNumberOfElements(vtkDataObject::CELL));
}

TEST_F(TogetherOnRanks, DomainsMayBeTurnedAndHaveSeeds)
{
  mesher->SetDomainAngle(20.0);
  mesher->SetZoneRuleToSeeds();
  mesher->AddSeed(2.1, -2.7, 3.3);
  expectThatOfOneProcess();
}

TEST_F(TogetherOnRanks, SizesThatFollowAndABudgetAreThoseOfOneProcess)
{
  mesher->SetSizeMax(0.0);
  mesher->SetSizeMid(0.0);
  mesher->SetMaxElements(5000);
  expectThatOfOneProcess();
  messages.takeWarnings();
}

TEST_F(TogetherOnRanks, TheFirstMakesWhatNeedsTheWhole)
{
  mesher->SetBlockSize(1000000); // one block
  expectThatOfOneProcess(false);
}

TEST_F(TogetherOnRanks, FaceZonesAndCellZonesMayReachOverRanks)
{
  mesher->AddFaceZone("Canopy");
  mesher->AddCellZone("Dome");
  for (const int layers : {0, 1})
  {
    SCOPED_TRACE(layers);
    setSceneEverywhere();
    mesher->SetNumberOfLayers(layers);
    expectThatOfOneProcess();
  }
}

TEST_F(TogetherOnRanks, AnErrorOfAllIsToldOnce)
{
  update(mesher);
  mesher->SetZoneRuleToSeeds();
  mesher->AddSeed(100.0, 0.0, 0.0);
  update(mesher);
  expectEmpty();
  const auto errors = messages.takeErrors();
  EXPECT_THAT(firstOf(errors), HasSubstr(rank() == 0 ? "outside the domain" : "returned failure"));
}

TEST_F(TogetherOnRanks, AnErrorOfTheFirstEndsAll)
{
  mesher->AddLayerRule("Nothing:2");
  update(mesher);
  expectEmpty();
  const auto errors = messages.takeErrors();
  EXPECT_THAT(firstOf(errors), HasSubstr(rank() == 0 ? "Nothing" : "returned failure"));
}

TEST_F(TogetherOnRanks, AnAbortOfTheFirstEndsAll)
{
  const auto alone = whole();
  for (const double when : {0.05, 0.5, 0.8})
  {
    SCOPED_TRACE(when);
    mesher->Modified();
    {
      const auto watch = rank() == 0 ? std::make_unique<ProgressWatch>(mesher, beyond(when)) : nullptr;
      update(mesher);
    }
    expectEmpty();
    update(mesher);
    expectGathered(volume(), alone[0]);
    expectGathered(patches(), alone[1]);
  }
}

/// That one text was told, by the first rank.
void expectOnFirst(const std::vector<std::string>& told, const char* part)
{
  ASSERT_EQ(told.size(), rank() == 0 ? 1U : 0U);
  EXPECT_THAT(firstOf(told), HasSubstr(rank() == 0 ? part : ""));
}

/// Where work on all ranks ends as the last one says.
TEST_F(TogetherOnRanks, WhatOneRankThrowsEndsAll)
{
  if (ranks() == 1)
  {
    return;
  }
  update(mesher);
  const auto run = [&](const std::function<void()>& end) {
    return atria::runOnRanks(*mesher, mesher->GetExecutive()->GetOutputInformation(), *controller(),
                             [&](atria::RankExchange& exchange, const atria::RunContext&) {
                               atria::gatherAll(exchange, rank());
                               if (rank() == ranks() - 1)
                               {
                                 end();
                               }
                               atria::gatherAll(exchange, rank());
                               return true;
                             });
  };
  EXPECT_EQ(run([] {}), 1);
  EXPECT_EQ(run([] { throw atria::Error("the last one cannot"); }), 0);
  expectOnFirst(messages.takeErrors(), "the last one cannot");
  EXPECT_EQ(run([] { throw atria::RanksDisagree("ranks have two of it"); }), std::nullopt);
  expectOnFirst(messages.takeWarnings(), "the first one makes the whole");
  EXPECT_EQ(run([] { throw atria::Aborted(); }), 1);
}

TEST_F(TogetherOnRanks, AfterADisagreementAllGoOn)
{
  update(mesher);
  std::vector<bool> agreed;
  const auto result =
      atria::runOnRanks(*mesher, mesher->GetExecutive()->GetOutputInformation(), *controller(),
                        [&](atria::RankExchange& exchange, const atria::RunContext&) {
                          for (const bool isTwoOfIt : {true, false})
                          {
                            agreed.push_back(exchange.agreeOn([&] {
                              if (isTwoOfIt && rank() == ranks() - 1)
                              {
                                throw atria::RanksDisagree("ranks have two of it");
                              }
                              EXPECT_EQ(atria::gatherAll(exchange, rank()).size(), static_cast<std::size_t>(ranks()));
                            }));
                          }
                          return true;
                        });
  EXPECT_EQ(result, 1);
  EXPECT_EQ(agreed, (std::vector<bool>{false, true}));
}

} // namespace
