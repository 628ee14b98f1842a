// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/CheckWarnings.h"
#include "Support/SampleGrid.h"
#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"
#include "vtkAtriaOpenFOAMWriter.h"

#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkUnstructuredGrid.h>

#include <gmock/gmock.h>

#include <filesystem>
#include <string>

namespace atria::testing {

/// Writes small meshes as cases of OpenFOAM.
class OpenFOAMWriter : public VtkTest
{
protected:
  /// Both formats write the same mesh, so all is asked of both.
  int write(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches, bool binary,
            const std::filesystem::path& folder)
  {
    vtkNew<vtkAtriaOpenFOAMWriter> writer;
    writer->SetInputDataObject(volume);
    if (patches)
    {
      writer->SetPatchesData(patches);
    }
    writer->SetCaseDirectory(folder.c_str());
    writer->SetWriteBinary(binary);
    writer->SetMergeCoplanarFaces(mergeFaces);
    writer->SetMergeUnderdeterminedCells(mergeCells);
    const int written = writer->Write();
    if (written)
    {
      expectWarnings(writer, !patches);
    }
    mergedCells = writer->GetNumberOfMergedCells();
    addedCells = writer->GetNumberOfAddedCells();
    mergedFaces = writer->GetNumberOfMergedFaces();
    return written;
  }

  std::filesystem::path folder(const std::string& name) const { return scratch.path() / name; }

  /// One for each check that fails, and no other.
  void expectWarnings(vtkAtriaOpenFOAMWriter* writer, bool lacksPatches)
  {
    EXPECT_EQ(messages.takeWarnings("No patches were given").size(), lacksPatches ? 1u : 0u);
    failedChecks = expectCheckWarnings(messages, writer->GetChecks());
    EXPECT_EQ(writer->GetNumberOfFailedChecks() > 0, failedChecks > 0);
  }

  ScratchFolder scratch;
  /// Most tests ask for the cells and faces of the input, one by one.
  bool mergeCells = false;
  bool mergeFaces = false;
  vtkIdType mergedCells = 0;
  vtkIdType addedCells = 0;
  vtkIdType mergedFaces = 0;
  int failedChecks = 0; ///< of what was written last
};

inline FaceMesh facesOf(const SampleMesh& mesh) { return makeFaceMesh(mesh.points, mesh.view()); }

} // namespace atria::testing
