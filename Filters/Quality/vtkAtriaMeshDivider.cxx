// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaMeshDivider.h"

#include "Ranks/Ranks.h"
#include "VtkFaceMesh.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkUnstructuredGrid.h>

vtkStandardNewMacro(vtkAtriaMeshDivider);

vtkAtriaMeshDivider::vtkAtriaMeshDivider()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkPartitionedDataSetCollection* vtkAtriaMeshDivider::GetPatches()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkAtriaMeshDivider::FillInputPortInformation(int port, vtkInformation* info)
{
  return atria::acceptMeshAndPatches(port, info);
}

int vtkAtriaMeshDivider::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkPartitionedDataSetCollection");
  return 1;
}

vtkTypeBool vtkAtriaMeshDivider::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                vtkInformationVector* outputs)
{
  return atria::processOnRanks(*this, request, inputs, outputs,
                               [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); },
                               {0, 1, true});
}

int vtkAtriaMeshDivider::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkUnstructuredGrid::GetData(outputs, 0)->ShallowCopy(vtkUnstructuredGrid::GetData(inputs[0], 0));
  if (auto* patches = vtkPartitionedDataSetCollection::GetData(inputs[1], 0))
  {
    vtkPartitionedDataSetCollection::GetData(outputs, 1)->ShallowCopy(patches);
  }
  return 1;
}
