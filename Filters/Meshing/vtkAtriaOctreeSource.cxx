// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaOctreeSource.h"

#include "AlgorithmProgress.h"
#include "GridInput.h"
#include "Octree/Refinement.h"
#include "SmpExecutor.h"
#include "VtkOctree.h"

#include <vtkHyperTreeGrid.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkUnstructuredGrid.h>

vtkStandardNewMacro(vtkAtriaOctreeSource);

vtkAtriaOctreeSource::vtkAtriaOctreeSource() = default;
vtkAtriaOctreeSource::~vtkAtriaOctreeSource() = default;

int vtkAtriaOctreeSource::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}

int vtkAtriaOctreeSource::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

int vtkAtriaOctreeSource::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const char* wanted = this->OutputType == HyperTreeGrid ? "vtkHyperTreeGrid" : "vtkUnstructuredGrid";
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkDataObject* present = vtkDataObject::GetData(info);
  if (!present || !present->IsA(wanted))
  {
    vtkSmartPointer<vtkDataObject> fresh;
    if (this->OutputType == HyperTreeGrid)
    {
      fresh = vtkSmartPointer<vtkHyperTreeGrid>::New();
    }
    else
    {
      fresh = vtkSmartPointer<vtkUnstructuredGrid>::New();
    }
    info->Set(vtkDataObject::DATA_OBJECT(), fresh);
    this->GetOutputPortInformation(0)->Set(vtkDataObject::DATA_EXTENT_TYPE(), fresh->GetExtentType());
  }
  return 1;
}

int vtkAtriaOctreeSource::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  output->Initialize();
  atria::AlgorithmProgress progress(*this);
  const atria::SmpExecutor executor;
  const atria::RunContext context{executor, atria::ProgressRange(progress)};
  try
  {
    const atria::GridInput input = atria::readGridInput(vtkDataObject::GetData(inputs[0]));
    const atria::PlacedModel placed = input.placed(*this);
    const atria::SurfaceModel model = atria::surfaceModelOf(*this, placed);
    const atria::Octree octree = atria::buildOctree(model, placed.frame, context.part(0.1, 0.8));
    if (auto* trees = vtkHyperTreeGrid::SafeDownCast(output))
    {
      atria::octreeToVtk(octree, trees);
    }
    else
    {
      atria::octreeToVtk(octree, vtkUnstructuredGrid::SafeDownCast(output));
    }
  }
  catch (const atria::Aborted&)
  {
    output->Initialize();
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkAtriaOctreeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OutputType: " << this->OutputType << "\n";
}
