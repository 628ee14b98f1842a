// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Faces/CellShapes.h"
#include "Support/ProgressWatch.h"
#include "Support/SampleGrid.h"
#include "Support/VtkErrorGuard.h"
#include "VtkVersions.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVariant.h>

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <sstream>

namespace {

using atria::Vec3;
using atria::testing::beyond;
using atria::testing::ProgressWatch;
using atria::testing::SampleMesh;
using atria::testing::toGrid;
using atria::testing::toPatches;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<std::string> metricNames{"CellSquish",        "FaceSquish",       "AspectRatio", "InverseAspectRatio",
                                           "OrthogonalQuality", "NonOrthogonality", "Skewness",    "Volume",
                                           "FacePyramids",      "ScaledJacobian"};

const std::vector<std::string> checkNames{"Openness",   "AreaAspectRatio", "Determinant",  "Concavity",
                                          "FaceWeight", "VolumeRatio",     "FaceFlatness", "FaceConcaveAngle",
                                          "TetQuality", "EdgeLength"};

/// What the tables have of faces alone.
const std::vector<std::string> ofFacesOnly{"FaceNonOrthogonality", "FaceSkewness"};

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class MeshQuality : public atria::testing::VtkTest
{
protected:
  vtkUnstructuredGrid* run(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches = nullptr)
  {
    filter->SetInputData(volume);
    if (patches)
    {
      filter->SetPatchesData(patches);
    }
    filter->Update();
    return filter->GetOutput();
  }

  void expectNoOutput()
  {
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(filter->GetSummary()->GetNumberOfRows(), 0);
    EXPECT_EQ(filter->GetHistogram()->GetNumberOfRows(), 0);
    EXPECT_EQ(filter->GetChecks()->GetNumberOfRows(), 0);
    EXPECT_EQ(filter->GetNumberOfInvalidCells(), 0);
    EXPECT_EQ(filter->GetNumberOfFailedChecks(), 0);
  }

  /// The row of a metric in the summary.
  vtkIdType rowOf(const std::string& metric)
  {
    vtkIdType row = 0;
    while (filter->GetSummary()->GetValueByName(row, "Metric").ToString() != metric)
    {
      ++row;
    }
    return row;
  }

  double summary(const std::string& metric, const char* column)
  {
    return filter->GetSummary()->GetValueByName(rowOf(metric), column).ToDouble();
  }

  vtkNew<vtkAtriaMeshQuality> filter;
};

double valueOf(vtkUnstructuredGrid* grid, const std::string& array, vtkIdType cell)
{
  return grid->GetCellData()->GetArray(array.c_str())->GetComponent(cell, 0);
}

TEST_F(MeshQuality, AddsOneArrayAMetricAndKeepsTheMesh)
{
  const auto volume = toGrid(atria::testing::hexahedra({3, 2, 2}));
  vtkNew<vtkDoubleArray> own;
  own->SetName("Own");
  own->SetNumberOfValues(12);
  own->Fill(5);
  volume->GetCellData()->AddArray(own);
  const vtkMTimeType before = volume->GetMTime();
  vtkUnstructuredGrid* output = run(volume);
  EXPECT_EQ(volume->GetMTime(), before);
  EXPECT_EQ(volume->GetCellData()->GetNumberOfArrays(), 1);
  EXPECT_EQ(output->GetNumberOfCells(), 12);
  EXPECT_EQ(output->GetPoints(), volume->GetPoints());
  EXPECT_EQ(valueOf(output, "Own", 3), 5);
  for (const std::string& name : metricNames)
  {
    ASSERT_NE(vtkDoubleArray::SafeDownCast(output->GetCellData()->GetArray(name.c_str())), nullptr) << name;
  }
  EXPECT_EQ(output->GetCellData()->GetArray("Valid")->GetDataType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(output->GetCellData()->GetNumberOfArrays(), static_cast<int>(metricNames.size()) + 2);
  EXPECT_NEAR(valueOf(output, "AspectRatio", 0), std::sqrt(3.0), 1e-12);
  EXPECT_EQ(filter->GetNumberOfInvalidCells(), 0);
}

TEST_F(MeshQuality, ScaledJacobianIsVerdicts)
{
  const SampleMesh sample = atria::testing::mixedCells({5, 5, 5}, 12, 0.35);
  const auto volume = toGrid(sample);
  vtkUnstructuredGrid* output = run(volume);
  int compared = 0;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const int type = volume->GetCellType(c);
    if (type == VTK_HEXAHEDRON || type == VTK_TETRA)
    {
      const double theirs = type == VTK_TETRA ? vtkMeshQuality::TetScaledJacobian(volume->GetCell(c))
                                              : vtkMeshQuality::HexScaledJacobian(volume->GetCell(c));
      EXPECT_NEAR(valueOf(output, "ScaledJacobian", c), theirs, 1e-12) << "cell " << c;
      ++compared;
    }
    EXPECT_EQ(std::isnan(valueOf(output, "ScaledJacobian", c)), type == VTK_POLYHEDRON);
  }
  EXPECT_GT(compared, 50);
}

TEST_F(MeshQuality, VolumesAreVerdicts)
{
  // Verdict cuts hexahedra otherwise, which is the same where their faces are flat.
  for (const double distance : {0.0, 0.35})
  {
    const auto volume = toGrid(atria::testing::mixedCells({5, 5, 5}, 12, distance));
    vtkUnstructuredGrid* output = run(volume);
    int compared = 0;
    for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
    {
      const int type = volume->GetCellType(c);
      if (type == VTK_TETRA)
      {
        EXPECT_NEAR(valueOf(output, "Volume", c), vtkMeshQuality::TetVolume(volume->GetCell(c)), 1e-14);
        ++compared;
      }
      else if (type == VTK_HEXAHEDRON && distance == 0.0)
      {
        EXPECT_NEAR(valueOf(output, "Volume", c), vtkMeshQuality::HexVolume(volume->GetCell(c)), 1e-14);
        ++compared;
      }
    }
    EXPECT_GT(compared, 20);
  }
}

TEST_F(MeshQuality, SummaryDescribesTheArrays)
{
  vtkUnstructuredGrid* output = run(toGrid(atria::testing::mixedCells({4, 4, 4}, 2, 0.2)));
  vtkTable* table = filter->GetSummary();
  std::vector<std::string> columns;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    columns.emplace_back(table->GetColumnName(i));
  }
  EXPECT_THAT(columns, ElementsAre("Metric", "Of", "Minimum", "Maximum", "Mean", "StandardDeviation", "Count"));
  ASSERT_EQ(table->GetNumberOfRows(), static_cast<vtkIdType>(metricNames.size() + ofFacesOnly.size()));
  EXPECT_NEAR(summary("Volume", "Mean") * summary("Volume", "Count"), 64.0, 1e-10);
  for (const std::string& name : metricNames)
  {
    double range[2];
    output->GetCellData()->GetArray(name.c_str())->GetRange(range);
    EXPECT_EQ(summary(name, "Maximum"), range[1]) << name;
    if (name != "FaceSquish") // by face in the table: the least of all faces is below the least of the cells'
                              // greatest
    {
      EXPECT_EQ(summary(name, "Minimum"), range[0]) << name;
      EXPECT_EQ(summary(name, "Count"),
                name == "ScaledJacobian" ? output->GetNumberOfCells() - 8 : output->GetNumberOfCells());
    }
  }
  EXPECT_GT(summary("FaceSquish", "Count"), output->GetNumberOfCells());
  EXPECT_EQ(summary("FaceNonOrthogonality", "Maximum"), summary("NonOrthogonality", "Maximum"));
  EXPECT_EQ(summary("FaceNonOrthogonality", "Count"), summary("FaceSquish", "Count"));
  EXPECT_EQ(summary("FaceSkewness", "Maximum"), summary("Skewness", "Maximum"));
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const std::string metric = table->GetValueByName(row, "Metric").ToString();
    const bool ofFaces = metric == "FaceSquish" || metric == ofFacesOnly[0] || metric == ofFacesOnly[1];
    EXPECT_EQ(table->GetValueByName(row, "Of").ToString(), ofFaces ? "faces" : "cells") << metric;
  }
}

TEST_F(MeshQuality, HistogramsIntegrateToOne)
{
  filter->SetNumberOfBins(17);
  run(toGrid(atria::testing::mixedCells({4, 4, 4}, 2, 0.2)));
  vtkTable* table = filter->GetHistogram();
  ASSERT_EQ(table->GetNumberOfRows(), 17);
  const std::vector<std::string> names = joined(metricNames, ofFacesOnly);
  ASSERT_EQ(table->GetNumberOfColumns(), static_cast<vtkIdType>(3 + 3 * names.size()));
  for (const std::string& name : names)
  {
    const double width =
        table->GetValueByName(1, name.c_str()).ToDouble() - table->GetValueByName(0, name.c_str()).ToDouble();
    double sum = 0.0;
    for (vtkIdType row = 0; row < 17; ++row)
    {
      sum += table->GetValueByName(row, (name + "_PDF").c_str()).ToDouble() * width;
    }
    EXPECT_NEAR(sum, 1.0, 1e-9) << name;
    EXPECT_EQ(table->GetValueByName(16, (name + "_CDF").c_str()).ToDouble(), 1.0) << name;
  }
}

TEST_F(MeshQuality, HistogramBeginsWithTheMetricThatIsChosen)
{
  const auto volume = toGrid(atria::testing::mixedCells({4, 4, 4}, 2, 0.2));
  for (const std::string metric : {"CellSquish", "FaceSkewness"})
  {
    filter->SetHistogramMetric(metric);
    run(volume);
    vtkTable* table = filter->GetHistogram();
    const std::array names{metric, metric + "_PDF", metric + "_CDF"};
    const std::array shown{"Value", "PDF", "CDF"};
    for (vtkIdType column = 0; column < 3; ++column)
    {
      EXPECT_STREQ(table->GetColumnName(column), shown[column]);
      for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
      {
        EXPECT_EQ(table->GetValue(row, column), table->GetValueByName(row, names[column].c_str()));
      }
    }
  }
  filter->SetHistogramMetric("Determinant");
  run(volume);
  EXPECT_THAT(messages.takeErrors(),
              Contains(HasSubstr("HistogramMetric is 'Determinant', which was not measured; there are CellSquish, ")));
  expectNoOutput();
  filter->CheckMeshOn();
  run(volume);
  EXPECT_EQ(filter->GetHistogram()->GetNumberOfRows(), filter->GetNumberOfBins());
}

TEST_F(MeshQuality, HistogramsAreWhatBarAndLineChartsTake)
{
  // A chart takes any column of numbers as x and any others as its series, all of one length; x rises in equal steps.
  filter->CheckMeshOn();
  run(toGrid(atria::testing::mixedCells({4, 4, 4}, 2, 0.2)));
  vtkTable* table = filter->GetHistogram();
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    auto* column = vtkDoubleArray::SafeDownCast(table->GetColumn(i));
    ASSERT_NE(column, nullptr) << table->GetColumnName(i);
    ASSERT_EQ(column->GetNumberOfTuples(), filter->GetNumberOfBins());
    ASSERT_EQ(column->GetNumberOfComponents(), 1);
    const double step = column->GetValue(1) - column->GetValue(0);
    for (vtkIdType row = 0; row + 1 < column->GetNumberOfTuples(); ++row)
    {
      ASSERT_TRUE(std::isfinite(column->GetValue(row)));
      if (i % 3 == 0)
      {
        EXPECT_GT(step, 0.0);
        EXPECT_NEAR(column->GetValue(row + 1) - column->GetValue(row), step, 1e-9 * step + 1e-12);
      }
      else
      {
        EXPECT_GE(column->GetValue(row), i % 3 == 1 || row == 0 ? 0.0 : column->GetValue(row - 1));
      }
    }
  }
}

TEST_F(MeshQuality, JudgesAsCheckMeshDoesWhenAsked)
{
  EXPECT_FALSE(filter->GetCheckMesh());
  const auto volume = toGrid(atria::testing::mixedCells({4, 4, 4}, 2, 0.45));
  EXPECT_EQ(run(volume)->GetCellData()->GetArray("Determinant"), nullptr);
  EXPECT_EQ(filter->GetChecks()->GetNumberOfRows(), 0);
  filter->CheckMeshOn();
  vtkUnstructuredGrid* output = run(volume);
  vtkTable* checks = filter->GetChecks();
  ASSERT_GT(checks->GetNumberOfRows(), 10);
  int failed = 0;
  for (vtkIdType row = 0; row < checks->GetNumberOfRows(); ++row)
  {
    const std::string name = checks->GetValueByName(row, "Check").ToString();
    const vtkIdType failing = checks->GetValueByName(row, "Failing").ToLongLong();
    failed += failing > 0 && checks->GetValueByName(row, "IsError").ToInt() != 0 ? 1 : 0;
    vtkIdType cells = 0;
    for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
    {
      cells += static_cast<unsigned>(valueOf(output, "FailedChecks", c)) >> row & 1U;
    }
    const std::string of = checks->GetValueByName(row, "Of").ToString();
    EXPECT_TRUE(of != "cells" || cells == failing) << name;
    EXPECT_TRUE(of != "faces" || (cells <= 2 * failing && (cells > 0) == (failing > 0))) << name;
  }
  EXPECT_GT(failed, 0);
  EXPECT_EQ(filter->GetNumberOfFailedChecks(), failed);
  for (const std::string& name : checkNames)
  {
    double range[2];
    ASSERT_NE(output->GetCellData()->GetArray(name.c_str()), nullptr) << name;
    output->GetCellData()->GetArray(name.c_str())->GetRange(range);
    const bool oneIsWorst = range[0] == summary(name, "Minimum") || range[1] == summary(name, "Maximum");
    EXPECT_TRUE(oneIsWorst) << name;
  }
}

TEST_F(MeshQuality, TooFewOrTooManyBinsAreAnError)
{
  EXPECT_EQ(filter->GetNumberOfBins(), 50);
  for (const int bins : {1, 20000})
  {
    filter->SetNumberOfBins(bins);
    run(toGrid(atria::testing::hexahedra({1, 1, 1})));
    EXPECT_THAT(messages.takeErrors(),
                ::testing::Contains(::testing::HasSubstr("NumberOfBins is " + std::to_string(bins))));
  }
}

TEST_F(MeshQuality, PatchesKeepTheSidesOfASheetApart)
{
  // Leaning cubes: with the sheet between them they have no internal face any more.
  SampleMesh sample = atria::testing::hexahedra({2, 1, 1});
  for (Vec3& p : sample.points)
  {
    p[0] += p[1];
  }
  const auto sheet = [](const Vec3&) { return std::string("sheet"); };
  const auto none = [](const Vec3&) { return std::string(); };
  const auto patches = toPatches(makeFaceMesh(sample.points, sample.view()), none, sheet);
  EXPECT_NEAR(valueOf(run(toGrid(sample)), "NonOrthogonality", 0), 45.0, 1e-9);
  EXPECT_NEAR(valueOf(run(toGrid(sample), patches), "NonOrthogonality", 0), 0.0, 1e-9);
}

TEST_F(MeshQuality, CountsInvalidCells)
{
  SampleMesh sample = atria::testing::hexahedra({2, 2, 2});
  sample.points[13] = Vec3(-3, -3, -3); // the middle of all
  vtkUnstructuredGrid* output = run(toGrid(sample));
  vtkIdType invalid = 0;
  for (vtkIdType c = 0; c < 8; ++c)
  {
    invalid += valueOf(output, "Valid", c) == 0.0 ? 1 : 0;
  }
  EXPECT_GT(invalid, 0);
  EXPECT_EQ(filter->GetNumberOfInvalidCells(), invalid);
}

TEST_F(MeshQuality, ProgressRisesToOne)
{
  const ProgressWatch watch(filter);
  run(toGrid(atria::testing::hexahedra({4, 4, 4})));
  const std::vector<double>& seen = watch.fractions;
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.back(), 1.0);
}

TEST_F(MeshQuality, AbortLeavesNothing)
{
  const ProgressWatch watch(filter, beyond(0.5));
  run(toGrid(atria::testing::hexahedra({4, 4, 4})));
  expectNoOutput();
}

TEST_F(MeshQuality, PrintsItsSettings)
{
  std::ostringstream text;
  filter->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("NumberOfBins: 50"));
  EXPECT_THAT(text.str(), HasSubstr("NumberOfInvalidCells: 0"));
  EXPECT_THAT(text.str(), HasSubstr("CheckMesh: 0"));
  EXPECT_THAT(text.str(), HasSubstr("NumberOfFailedChecks: 0"));
}

using MeshQualityError = MeshQuality;

TEST_F(MeshQualityError, MeshWithoutCells)
{
  run(vtkNew<vtkUnstructuredGrid>());
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("the volume mesh has no cells")));
  expectNoOutput();
}

TEST_F(MeshQualityError, CellsThatAreNotVolumes)
{
  SampleMesh sample = atria::testing::hexahedra({1, 1, 1});
  sample.addCell(VTK_QUAD, {0, 1, 3, 2});
  run(toGrid(sample));
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("cell 1 (type 9)")));
  expectNoOutput();
}

/// As VTK's readers up to 9.3 make of files of VTK 9.4 and later.
TEST_F(MeshQualityError, PolyhedraWhoseFacesAReaderPassedOver)
{
  const auto grid = toGrid(atria::testing::hexahedra({1, 1, 1}));
  vtkNew<vtkUnsignedCharArray> types;
  types->InsertNextValue(VTK_POLYHEDRON);
  vtkNew<vtkCellArray> cells;
  cells->ShallowCopy(grid->GetCells());
  atria::setCells(grid, types, cells, std::vector<vtkDataArray*>(atria::faceArrayCount, nullptr));
  run(grid);
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("polyhedra without faces")));
  expectNoOutput();
}

TEST_F(MeshQualityError, FaceOfThreeCells)
{
  SampleMesh sample = atria::testing::hexahedra({2, 1, 1});
  sample.addCell(atria::hexahedronCell, {sample.connectivity.begin(), sample.connectivity.begin() + 8});
  run(toGrid(sample));
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("not a manifold")));
  expectNoOutput();
}

TEST_F(MeshQualityError, AFailedRunAfterAGoodOneLeavesNothing)
{
  run(toGrid(atria::testing::hexahedra({2, 1, 1})));
  run(vtkNew<vtkUnstructuredGrid>());
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("has no cells")));
  expectNoOutput();
}

TEST_F(MeshQualityError, PatchesOfAnotherMesh)
{
  const SampleMesh other = atria::testing::hexahedra({2, 2, 2});
  const auto patches = toPatches(makeFaceMesh(other.points, other.view()), atria::testing::sidesOfBox({2, 2, 2}));
  run(toGrid(atria::testing::hexahedra({1, 1, 1})), patches);
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("the volume mesh does not have")));
  expectNoOutput();
}

} // namespace
