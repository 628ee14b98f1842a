// SPDX-License-Identifier: GPL-3.0-or-later
#include "CheckWritten.h"

#include "Support/TestPaths.h"
#include "VtkDualMesh.h"
#include "vtkAtriaOpenFOAMWriter.h"

#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkUnstructuredGrid.h>

#include <gtest/gtest.h>

namespace atria::testing {

CheckMeshReport checkAsWritten(const Meshed& meshed)
{
  vtkNew<vtkUnstructuredGrid> volume;
  volumeToVtk(meshed.mesh(), volume, SerialExecutor());
  vtkNew<vtkPartitionedDataSetCollection> patches;
  patchesToVtk(meshed.mesh(), meshed.result.metSides, meshed.model.names, meshed.model.kinds, meshed.result.layers,
               patches);
  const ScratchFolder scratch;
  vtkNew<vtkAtriaOpenFOAMWriter> writer;
  writer->SetInputDataObject(0, volume);
  writer->SetInputDataObject(1, patches);
  writer->SetCaseDirectory(scratch.path().c_str());
  EXPECT_EQ(writer->Write(), 1);
  CheckMeshReport report = runCheckMesh(scratch.path());
  EXPECT_TRUE(report.completed) << report.log;
  EXPECT_EQ(writer->GetNumberOfFailedChecks(), report.failedChecks) << report.log;
  return report;
}

} // namespace atria::testing
