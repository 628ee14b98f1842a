// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaGridAlgorithm.h"

#include <vtkDemandDrivenPipeline.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>

vtkAtriaGridAlgorithm::vtkAtriaGridAlgorithm()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

vtkAtriaGridAlgorithm::~vtkAtriaGridAlgorithm() = default;

void vtkAtriaGridAlgorithm::SetInputData(vtkDataObject* data) { this->SetInputDataInternal(0, data); }

void vtkAtriaGridAlgorithm::SetInputData(int port, vtkDataObject* data) { this->SetInputDataInternal(port, data); }

vtkTypeBool vtkAtriaGridAlgorithm::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, inputs, outputs);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->RequestData(request, inputs, outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkAtriaGridAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port != 0)
  {
    return 0;
  }
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

void vtkAtriaGridAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SizeMax: " << this->SizeMax << "\n";
  os << indent << "SizeMid: " << this->SizeMid << "\n";
  os << indent << "SizeMin: " << this->SizeMin << "\n";
  os << indent << "StartLevel: " << this->StartLevel << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "GapTolerance: " << this->GapTolerance << "\n";
  os << indent << "DomainMode: " << this->DomainMode << "\n";
  os << indent << "DomainBounds:";
  for (const double bound : this->DomainBounds)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "SiteName: " << this->SiteName << "\n";
}
