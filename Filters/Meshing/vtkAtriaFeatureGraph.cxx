// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaFeatureGraph.h"

#include "AlgorithmProgress.h"
#include "GridInput.h"
#include "VtkFeatureGraph.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkAtriaFeatureGraph);

vtkAtriaFeatureGraph::vtkAtriaFeatureGraph() { this->SetNumberOfOutputPorts(2); }

vtkAtriaFeatureGraph::~vtkAtriaFeatureGraph() = default;

int vtkAtriaFeatureGraph::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

int vtkAtriaFeatureGraph::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    if (!vtkPolyData::SafeDownCast(vtkDataObject::GetData(info)))
    {
      info->Set(vtkDataObject::DATA_OBJECT(), vtkNew<vtkPolyData>());
    }
  }
  return 1;
}

int vtkAtriaFeatureGraph::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  atria::clearOutputs(outputs);
  return atria::runFilter(*this, outputs, "", [&](const atria::RunContext& context) {
    const atria::ProgressRange& range = context.progress;
    range.report(0.0, "Reading surfaces");
    // The domain is not checked: features do not depend on it.
    std::vector<std::string> warnings; // not shown: the mesher reports them
    const atria::TriangleSurface surface = atria::readSurfaces(vtkDataObject::GetData(inputs[0]), warnings);
    const atria::ModelOptions options = atria::modelOptionsOf(*this, vtkDataObject::GetData(inputs[0]), surface);
    const atria::PlacedModel placed = atria::placeModel(surface, options);
    range.report(0.3, "Finding features");
    const atria::SurfaceModel model = atria::makeSurfaceModel(placed, options, context.part(0.3, 0.8));
    range.report(0.8, "Converting");
    atria::featureCurvesToVtk(model, placed.frame, vtkPolyData::GetData(outputs, 0));
    atria::modelToVtk(model, placed.frame, vtkPolyData::GetData(outputs, 1));
    range.report(1.0, "Found features");
  });
}

void vtkAtriaFeatureGraph::PrintSelf(ostream& os, vtkIndent indent) { this->Superclass::PrintSelf(os, indent); }
