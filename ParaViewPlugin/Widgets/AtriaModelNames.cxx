// SPDX-License-Identifier: GPL-3.0-or-later
#include "AtriaModelNames.h"

#include "vtkPVAtriaNamesInformation.h"

#include <vtkNew.h>
#include <vtkPVDataInformation.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

#include <utility>

namespace atria {

namespace {

std::pair<vtkSMSourceProxy*, int> modelOf(vtkSMProxy* proxy)
{
  if (!proxy->GetProperty("Input"))
  {
    return {vtkSMSourceProxy::SafeDownCast(proxy), 0};
  }
  vtkSMPropertyHelper input(proxy, "Input");
  auto* source = input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy()) : nullptr;
  return {source, source ? static_cast<int>(input.GetOutputPort()) : 0};
}

} // namespace

QStringList surfaceNamesOf(vtkSMProxy* proxy)
{
  QStringList names;
  if (const auto [source, port] = modelOf(proxy); source && source->GetObjectsCreated())
  {
    vtkNew<vtkPVAtriaNamesInformation> information;
    information->SetPortNumber(port);
    source->GatherInformation(information);
    for (int i = 0; i < information->GetNumberOfNames(); ++i)
    {
      names << QString::fromStdString(information->GetName(i));
    }
  }
  return names;
}

vtkBoundingBox modelBoundsOf(vtkSMProxy* proxy)
{
  const auto [source, port] = modelOf(proxy);
  vtkBoundingBox box;
  if (source && source->GetOutputPortsCreated())
  {
    box.SetBounds(source->GetDataInformation(port)->GetBounds());
  }
  return box;
}

} // namespace atria
