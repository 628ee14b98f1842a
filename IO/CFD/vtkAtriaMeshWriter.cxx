// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaMeshWriter.h"

#include "AlgorithmProgress.h"
#include "OutputFolders.h"
#include "Ranks/Ranks.h"
#include "VtkFaceMesh.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnstructuredGrid.h>

#include <exception>

namespace {

/// Returns a warning if the names of patches are lost; else an empty string.
std::string lossOf(atria::PatchOrigin origin)
{
  if (origin == atria::PatchOrigin::None)
  {
    return "No patches were given, and none are recorded in the mesh: all of its boundary goes to the patch "
           "defaultFaces. "
           "Give the patches on the second input, such as the mesher's second output; in ParaView choose them in the "
           "dialog of Save Data.";
  }
  if (origin == atria::PatchOrigin::Lost)
  {
    return "The names of the patches are lost, as a filter such as Clip or Threshold has changed the mesh's cells: all "
           "of "
           "its boundary goes to the patch defaultFaces. Write the mesh as the mesher made it, or give the patches of "
           "this mesh on the second input.";
  }
  return {};
}

} // namespace

vtkAtriaMeshWriter::vtkAtriaMeshWriter() { this->SetNumberOfInputPorts(2); }

void vtkAtriaMeshWriter::SetPatchesConnection(vtkAlgorithmOutput* patches) { this->SetInputConnection(1, patches); }

void vtkAtriaMeshWriter::SetPatchesData(vtkPartitionedDataSetCollection* patches)
{
  this->SetInputDataInternal(1, patches);
}

int vtkAtriaMeshWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  return atria::acceptMeshAndPatches(port, info);
}

vtkPartitionedDataSetCollection* vtkAtriaMeshWriter::GetPatches()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(
      this->GetNumberOfInputConnections(1) > 0 ? this->GetInputDataObject(1, 0) : nullptr);
}

vtkTypeBool vtkAtriaMeshWriter::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                               vtkInformationVector* outputs)
{
  const auto process = [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); };
  const atria::Ranks ranks(this->Piece, this->NumberOfPieces);
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    ranks.askFor(inputs, this->GetNumberOfInputPorts());
  }
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return process();
  }
  bool isInPieces = false;
  const auto writeWhole = [&](std::span<const atria::Index> rankOf) {
    if (ranks)
    {
      this->TakeRanks(*ranks.getController(), rankOf);
    }
    return process();
  };
  const auto writePieces = [&](vtkMultiProcessController& controller) {
    const std::optional<int> written = this->WritePieces(controller);
    isInPieces = written.has_value();
    return written;
  };
  const int result = ranks.run(*this, inputs, outputs, writeWhole, {}, writePieces);
  if (isInPieces)
  {
    return result;
  }
  double code = static_cast<double>(this->GetErrorCode());
  ranks.share({&code, 1});
  this->SetErrorCode(static_cast<unsigned long>(code));
  if (ranks && result && this->GetErrorCode() == vtkErrorCode::NoError)
  {
    this->WriteAndTell([&] {
      if (!this->WriteOnRanks(*ranks.getController()))
      {
        this->SetErrorCode(vtkErrorCode::UnknownError);
      }
    });
  }
  this->LeaveRanks();
  return result;
}

void vtkAtriaMeshWriter::WriteAll()
{
  auto* volume = vtkUnstructuredGrid::SafeDownCast(this->GetInputDataObject(0, 0));
  if (this->GetTarget().empty())
  {
    vtkErrorMacro("No " << this->GetTargetProperty() << " was given.");
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    return;
  }
  this->WriteAndTell([&] { this->WriteTarget(volume, this->GetPatches()); });
}

void vtkAtriaMeshWriter::WriteAndTell(const std::function<void()>& write)
{
  try
  {
    write();
  }
  catch (const atria::Aborted&)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Cannot write " << this->GetFormatName() << " to '" << this->GetTarget() << "': " << error.what());
    this->SetErrorCode(ErrorCodeFor(error));
  }
}

unsigned long vtkAtriaMeshWriter::ErrorCodeFor(const std::exception& error)
{
  return dynamic_cast<const atria::OutputError*>(&error) ? vtkErrorCode::CannotOpenFileError
                                                         : vtkErrorCode::UnknownError;
}

void vtkAtriaMeshWriter::WriteTarget(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches)
{
  const atria::AlgorithmRun run(*this);
  const atria::ProgressRange& progress = run.context.progress;
  progress.report(0.0, "Finding faces");
  atria::VtkFaceMesh source = atria::faceMeshFromVtk(volume, patches, run.context.executor);
  this->WriteMesh(volume, source, run.context.part(0.3, 1.0));
  progress.report(1.0, "Mesh written");
  if (const std::string loss = lossOf(source.origin); !loss.empty())
  {
    vtkWarningMacro("'" << this->GetTarget() << "': " << loss);
  }
}

void vtkAtriaMeshWriter::Place(vtkUnstructuredGrid* volume, atria::FaceMesh& mesh) const
{
  vtkDataArray* offset = volume->GetFieldData()->GetArray("ModelOffset");
  if (this->RestoreOffset && offset && offset->GetNumberOfValues() == 3)
  {
    const atria::Vec3 moved(offset->GetTuple3(0));
    for (atria::Vec3& p : mesh.points)
    {
      p += moved;
    }
  }
}

void vtkAtriaMeshWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << this->GetTargetProperty() << ": " << (this->GetTarget().empty() ? "(none)" : this->GetTarget())
     << "\n";
  os << indent << "RestoreOffset: " << (this->RestoreOffset ? "on" : "off") << "\n";
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "Piece: " << this->Piece << "\n";
}
