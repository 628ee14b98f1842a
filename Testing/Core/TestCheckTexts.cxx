// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the texts about failing checks, their limits, and the search for the worst elements.
#include "Quality/Checks/CheckLimits.h"
#include "Quality/Checks/CheckQuantities.h"
#include "Quality/Checks/CheckTexts.h"
#include "Quality/Checks/WorstElements.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/Error.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::hexahedra;
using atria::testing::mixedCells;
using atria::testing::quietContext;
using atria::testing::SampleMesh;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A check without values.
MeshCheck checkOf(const char* name, MeshPart part, bool isError, std::size_t failing)
{
  return {name, "", part, isError, true, 0.0, 0.0, 0.0, {}, failing, Vec3(1.5, -2, 30)};
}

/// Boxes in a row along x, all 1 by 1, of the given lengths.
SampleMesh rowOfBoxes(const std::vector<double>& lengths)
{
  SampleMesh row = hexahedra({static_cast<int>(lengths.size()), 1, 1});
  for (Vec3& p : row.points)
  {
    const auto before = static_cast<std::ptrdiff_t>(std::lround(p[0]));
    p[0] = 0.0;
    std::for_each(lengths.begin(), lengths.begin() + before, [&](double length) { p[0] += length; });
  }
  return row;
}

MeshVerdict verdictOf(const SampleMesh& sample)
{
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  return checkMesh(measureMesh(mesh, quietContext()), quietContext());
}

// Limits.

TEST(CheckLimits, AreThoseOfTheChecks)
{
  const MeshVerdict verdict = verdictOf(hexahedra({1, 1, 1}));
  EXPECT_EQ(verdict["Determinant"].limit, checkLimits::determinant);
  EXPECT_EQ(verdict["FaceWeight"].limit, checkLimits::faceWeight);
  EXPECT_EQ(verdict["VolumeRatio"].limit, checkLimits::volumeRatio);
  EXPECT_EQ(verdict["Skewness"].limit, checkLimits::skewness);
  EXPECT_EQ(verdict["Concavity"].limit, -checkLimits::concaveSine);
}

TEST(CheckLimits, AreThoseOfOpenFOAM)
{
  EXPECT_EQ(checkLimits::determinant, 0.001);
  EXPECT_EQ(checkLimits::faceWeight, 0.05);
  EXPECT_EQ(checkLimits::volumeRatio, 0.01);
  EXPECT_EQ(checkLimits::skewness, 4.0);
  EXPECT_EQ(checkLimits::concaveSine, 1e-6);
}

TEST(CheckLimits, FailBeyondThemOnly)
{
  for (const double factor : {1.0 - 1e-6, 1.0 + 1e-6})
  {
    const bool fails = factor < 1.0;
    const double ratio = factor * checkLimits::volumeRatio;
    const double weight = factor * checkLimits::faceWeight;
    EXPECT_EQ(verdictOf(rowOfBoxes({1, ratio}))["VolumeRatio"].failingCount, fails ? 1U : 0U);
    EXPECT_EQ(verdictOf(rowOfBoxes({1, weight / (1 - weight)}))["FaceWeight"].failingCount, fails ? 1U : 0U);
  }
}

// Verdicts.

TEST(MeshVerdict, CountsErrorsThatFailAndOpenAndLongCellsOnce)
{
  const auto verdict = [](std::size_t open, std::size_t longCells, std::size_t skew, std::size_t note) {
    return MeshVerdict{
        {checkOf("Openness", MeshPart::Cells, true, open), checkOf("AreaAspectRatio", MeshPart::Cells, true, longCells),
         checkOf("Skewness", MeshPart::Faces, true, skew), checkOf("FaceFlatness", MeshPart::Faces, false, note)}};
  };
  EXPECT_EQ(verdict(0, 0, 0, 0).failedChecks(), 0);
  EXPECT_TRUE(verdict(0, 0, 0, 9).ok()) << "a note is no error";
  EXPECT_EQ(verdict(2, 0, 0, 0).failedChecks(), 1);
  EXPECT_EQ(verdict(0, 1, 0, 0).failedChecks(), 1);
  EXPECT_EQ(verdict(2, 1, 0, 0).failedChecks(), 1);
  EXPECT_EQ(verdict(2, 1, 7, 1).failedChecks(), 2);
  EXPECT_FALSE(verdict(0, 0, 1, 0).ok());
}

TEST(MeshVerdict, FindsChecksByName)
{
  const MeshVerdict verdict{{checkOf("First", MeshPart::Cells, true, 3), checkOf("Second", MeshPart::Faces, true, 4)}};
  EXPECT_EQ(verdict["First"].failingCount, 3U);
  EXPECT_EQ(verdict["Second"].failingCount, 4U);
  EXPECT_THROW(verdict["Fir"], Error);
}

TEST(MeshVerdict, TellsWhichCellsFailWhat)
{
  // Three cubes in a row: faces 0 and 1 lie between them, and each point belongs to one or two cells.
  const SampleMesh sample = hexahedra({3, 1, 1});
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  const MeasuredMesh measured = measureMesh(mesh, quietContext());
  MeshVerdict verdict;
  const auto add = [&](MeshPart part, bool isError, std::vector<Index> failing) {
    verdict.checks.push_back(checkOf("Check", part, isError, failing.size()));
    verdict.checks.back().failing = std::move(failing);
  };
  add(MeshPart::Mesh, true, {0});
  add(MeshPart::Cells, true, {0, 2});
  add(MeshPart::Faces, false, {1});
  add(MeshPart::Points, true, {1});  // at x = 1
  add(MeshPart::Points, false, {3}); // at x = 3
  add(MeshPart::Faces, true, {static_cast<Index>(mesh.faceCount() - 1)});
  EXPECT_THAT(failedChecksOfCells(measured, verdict), ElementsAre(0b1010U, 0b1100U, 0b110110U));
  EXPECT_THAT(failedErrorsOfCells(measured, verdict), ElementsAre(0b1010U, 0b1000U, 0b100010U));
}

// Texts.

TEST(CheckTexts, NameTheParts)
{
  EXPECT_STREQ(nameOf(MeshPart::Mesh), "mesh");
  EXPECT_STREQ(nameOf(MeshPart::Cells), "cells");
  EXPECT_STREQ(nameOf(MeshPart::Faces), "faces");
  EXPECT_STREQ(nameOf(MeshPart::Points), "points");
}

TEST(CheckTexts, AdviseOnEachCheckThatIsAnError)
{
  for (const MeshCheck& check : verdictOf(hexahedra({2, 2, 2})).checks)
  {
    EXPECT_EQ(std::string(adviceFor(check)).empty(), !check.isError) << check.name;
  }
}

TEST(CheckTexts, AdviseOnTheReason)
{
  const std::vector<std::pair<const char*, const char*>> words{
      {"BoundaryOpenness", "not closed"}, {"Openness", "not closed"},       {"AreaAspectRatio", "layers thicker"},
      {"FaceArea", "solvers fail"},       {"Volume", "solvers fail"},       {"NonOrthogonalityError", "solvers fail"},
      {"FacePyramids", "solvers fail"},   {"Skewness", "lose accuracy"},    {"TetQuality", "particles"},
      {"Determinant", "gradient"},        {"Concavity", "walls that bend"}, {"FaceWeight", "layers thicker"},
      {"VolumeRatio", "layers thicker"}};
  for (const auto& [name, word] : words)
  {
    EXPECT_THAT(adviceFor(checkOf(name, MeshPart::Cells, true, 1)), HasSubstr(word)) << name;
    EXPECT_STREQ(adviceFor(checkOf(name, MeshPart::Cells, false, 1)), "") << name;
  }
  EXPECT_STREQ(adviceFor(checkOf("Open", MeshPart::Cells, true, 1)), "");
}

TEST(CheckTexts, SayWhatFailsWhereAndWhatToDo)
{
  const MeshVerdict verdict{
      {checkOf("Openness", MeshPart::Cells, true, 0), checkOf("Volume", MeshPart::Cells, true, 2),
       checkOf("FaceFlatness", MeshPart::Faces, false, 5), checkOf("BoundaryOpenness", MeshPart::Mesh, true, 1),
       checkOf("Skewness", MeshPart::Faces, true, 1), checkOf("Determinant", MeshPart::Points, true, 4)}};
  const auto adviceOf = [&](std::size_t i) { return std::string(": ") + adviceFor(verdict.checks[i]); };
  EXPECT_THAT(failureTexts(verdict),
              ElementsAre("check Volume fails at 2 cells, the first at (1.5 -2 30)" + adviceOf(1),
                          "check BoundaryOpenness fails" + adviceOf(3),
                          "check Skewness fails at 1 faces, the first at (1.5 -2 30)" + adviceOf(4),
                          "check Determinant fails" + adviceOf(5)));
  EXPECT_THAT(failureTexts({}), IsEmpty());
}

TEST(CheckTexts, OfAMeshGiveTheFirstFailingFace)
{
  const std::vector<std::string> texts = failureTexts(verdictOf(rowOfBoxes({1, 1e-3, 1, 1e-3})));
  EXPECT_THAT(texts,
              ::testing::Contains(AllOf(StartsWith("check VolumeRatio fails at 3 faces, the first at (1 0.5 0.5)"),
                                        EndsWith("beside them smaller"))));
}

// Worst elements.

TEST(WorstElements, KnowWhichEndOfAnArrayIsWorst)
{
  for (const char* name :
       {"InverseAspectRatio", "OrthogonalQuality", "Volume", "FacePyramids", "ScaledJacobian", "Valid"})
  {
    EXPECT_FALSE(greatestIsWorst(name)) << name;
  }
  for (const char* name :
       {"CellSquish", "FaceSquish", "AspectRatio", "NonOrthogonality", "Skewness", "Temperature", ""})
  {
    EXPECT_TRUE(greatestIsWorst(name)) << name;
  }
  for (const CheckQuantityInfo& info : checkQuantities())
  {
    EXPECT_EQ(greatestIsWorst(info.name), info.greaterIsWorse) << info.name;
  }
}

/// Returns the elements among the worst by repeated search for the worst one left.
std::vector<Index> naiveWorst(const std::vector<double>& values, const WorstElementsOptions& options)
{
  std::vector<char> isLeft(values.size(), 1);
  const auto sign = [&](double value) { return options.greatestIsWorst ? value : -value; };
  std::vector<Index> out;
  for (;;)
  {
    Index worst = noIndex;
    for (Index i = 0; i < values.size(); ++i)
    {
      const bool isWanted =
          isLeft[i] && !std::isnan(values[i]) && (!options.limit || sign(values[i]) > sign(*options.limit));
      if (isWanted && (worst == noIndex || sign(values[i]) > sign(values[worst])))
      {
        worst = i;
      }
    }
    if (worst == noIndex || (options.count && out.size() == *options.count))
    {
      return out;
    }
    isLeft[worst] = 0;
    out.push_back(worst);
  }
}

/// Returns by element the ring that it lies in around the first ones; -1 if it is farther away.
std::vector<int> naiveRings(const SampleMesh& mesh, const std::vector<Index>& first, int rings)
{
  std::vector<int> ringOf(mesh.types.size(), -1);
  std::ranges::for_each(first, [&](Index e) { ringOf[e] = 0; });
  const auto pointsOf = [&](std::size_t e) {
    return std::span(mesh.connectivity).subspan(mesh.offsets[e], mesh.offsets[e + 1] - mesh.offsets[e]);
  };
  for (int ring = 1; ring <= rings; ++ring)
  {
    for (std::size_t a = 0; a < ringOf.size(); ++a)
    {
      for (std::size_t b = 0; b < ringOf.size(); ++b)
      {
        const bool touch = ringOf[a] < 0 && ringOf[b] == ring - 1 &&
                           std::ranges::find_first_of(pointsOf(a), pointsOf(b)) != pointsOf(a).end();
        ringOf[a] = touch ? ring : ringOf[a];
      }
    }
  }
  return ringOf;
}

void expectWorst(const SampleMesh& mesh, const std::vector<double>& values, const WorstElementsOptions& options)
{
  const WorstElements found = findWorstElements(values, mesh.view(), mesh.points.size(), options, quietContext());
  std::vector<Index> elements = naiveWorst(values, options);
  const std::vector<int> ringOf = naiveRings(mesh, elements, options.rings);
  EXPECT_EQ(found.worstCount, elements.size());
  for (int ring = 1; ring <= options.rings; ++ring)
  {
    for (Index e = 0; e < ringOf.size(); ++e)
    {
      elements.insert(elements.end(), ringOf[e] == ring ? 1 : 0, e);
    }
  }
  ASSERT_EQ(found.elements, elements);
  ASSERT_EQ(found.ranks.size(), elements.size());
  ASSERT_EQ(found.rings.size(), elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i)
  {
    EXPECT_EQ(found.ranks[i], i < found.worstCount ? static_cast<std::int32_t>(i + 1) : 0);
    EXPECT_EQ(found.rings[i], ringOf[elements[i]]);
  }
}

/// Few different values, so that some are equal, and some that are no numbers.
std::vector<double> someValues(std::size_t count, std::mt19937& random)
{
  const std::vector<double> choice{-1.0,
                                   0.0,
                                   0.5,
                                   0.5,
                                   2.0,
                                   3.0,
                                   4.0,
                                   std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::quiet_NaN()};
  std::vector<double> values(count);
  std::ranges::generate(values, [&] { return choice[random() % choice.size()]; });
  return values;
}

TEST(WorstElements, AreWorstFirstThenRingByRing)
{
  std::mt19937 random(3);
  const SampleMesh mesh = mixedCells({4, 3, 3}, 1);
  const std::size_t elements = mesh.types.size();
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{4}, elements, elements + 1})
  {
    for (int round = 0; round < 8; ++round)
    {
      WorstElementsOptions options;
      options.greatestIsWorst = round % 2 == 0;
      options.count = count;
      options.rings = round % 4;
      options.limit = round < 4 ? std::nullopt : std::optional(0.5);
      expectWorst(mesh, someValues(elements, random), options);
    }
  }
}

TEST(WorstElements, AreAllIfNoCountIsSet)
{
  std::mt19937 random(5);
  const SampleMesh mesh = mixedCells({3, 3, 3}, 2);
  for (const bool greatest : {true, false})
  {
    expectWorst(mesh, someValues(mesh.types.size(), random), {greatest, std::nullopt, std::nullopt, 1});
    expectWorst(mesh, std::vector<double>(mesh.types.size(), 1.0), {greatest, 3, std::nullopt, 1});
    expectWorst(mesh, std::vector<double>(mesh.types.size(), 1.0), {greatest, std::nullopt, 1.0, 2});
  }
}

TEST(WorstElements, AreBeyondTheLimitNotOnIt)
{
  const SampleMesh row = hexahedra({4, 1, 1});
  const std::vector<double> values{1.0, std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0), 1.0};
  const auto worst = [&](bool greatest) {
    return findWorstElements(values, row.view(), row.points.size(), {greatest, std::nullopt, 1.0, 0}, quietContext())
        .elements;
  };
  EXPECT_THAT(worst(true), ElementsAre(1U));
  EXPECT_THAT(worst(false), ElementsAre(2U));
}

TEST(WorstElements, HaveRingsThatEachShareAPointWithTheOneBefore)
{
  const SampleMesh row = hexahedra({7, 1, 1});
  const WorstElements found = findWorstElements(std::vector<double>{0, 0, 9, 0, 0, 0, 0}, row.view(), row.points.size(),
                                                {true, 1, std::nullopt, 2}, quietContext());
  EXPECT_THAT(found.elements, ElementsAre(2U, 1U, 3U, 0U, 4U));
  EXPECT_THAT(found.rings, ElementsAre(0, 1, 1, 2, 2));
  EXPECT_THAT(found.ranks, ElementsAre(1, 0, 0, 0, 0));
}

TEST(WorstElementsError, NeedAValueForEachElement)
{
  const SampleMesh row = hexahedra({3, 1, 1});
  for (const std::size_t count : {0U, 2U, 4U})
  {
    EXPECT_THROW(findWorstElements(std::vector<double>(count), row.view(), row.points.size(), {}, quietContext()),
                 Error);
  }
}

/// Says to stop at a given report.
class StopAt : public ProgressMonitor
{
public:
  explicit StopAt(int report) : left(report) {}
  void report(double, const char*) override { --left; }
  bool aborted() const override { return left <= 0; }

private:
  int left;
};

TEST(WorstElements, StopWhenAsked)
{
  const SampleMesh row = hexahedra({3, 1, 1});
  const SerialExecutor serial;
  for (int report = 1; report <= 3; ++report)
  {
    StopAt monitor(report);
    const RunContext context{serial, ProgressRange(monitor)};
    EXPECT_THROW(findWorstElements(std::vector<double>{1, 2, 3}, row.view(), row.points.size(),
                                   {true, 1, std::nullopt, 1}, context),
                 Aborted)
        << report;
  }
}

} // namespace
