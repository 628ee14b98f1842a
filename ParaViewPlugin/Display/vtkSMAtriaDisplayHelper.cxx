// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMAtriaDisplayHelper.h"

#include "AtriaLegend.h"

#include <vtkDataObject.h>
#include <vtkObjectFactory.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVDataSetAttributesInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

#include <string>

vtkStandardNewMacro(vtkSMAtriaDisplayHelper);

namespace {

void showSeries(vtkSMProxy* representation, vtkSMSourceProxy* source, int port, const char* x, const char* series)
{
  vtkSMPropertyHelper(representation, "UseIndexForXAxis").Set(0);
  vtkSMPropertyHelper(representation, "XArrayName").Set(x);
  // Lists all columns, as unnamed ones are visible.
  vtkPVDataSetAttributesInformation* columns =
      source->GetDataInformation(port)->GetAttributeInformation(vtkDataObject::ROW);
  const auto count = static_cast<unsigned int>(columns->GetNumberOfArrays());
  vtkSMPropertyHelper visible(representation, "SeriesVisibility");
  visible.SetNumberOfElements(2 * count);
  for (unsigned int i = 0; i < count; ++i)
  {
    const char* name = columns->GetArrayInformation(static_cast<int>(i))->GetName();
    visible.Set(2 * i, name);
    visible.Set(2 * i + 1, std::string(name) == series ? "1" : "0");
  }
}

} // namespace

vtkSMAtriaDisplayHelper::vtkSMAtriaDisplayHelper() = default;

vtkSMAtriaDisplayHelper::~vtkSMAtriaDisplayHelper() = default;

void vtkSMAtriaDisplayHelper::PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType)
{
  vtkSMPropertyHelper input(proxy, "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  if (!source)
  {
    return;
  }
  const int port = static_cast<int>(input.GetOutputPort());
  if (xml->GetAttribute("cull_front"))
  {
    vtkSMPropertyHelper(proxy, "BackfaceRepresentation").Set("Cull Frontface");
  }
  if (const char* width = xml->GetAttribute("line_width"))
  {
    const double pixels = std::stod(width);
    vtkSMPropertyHelper(proxy, "LineWidth").Set(pixels);
    vtkSMPropertyHelper(proxy, "PointSize").Set(2.0 * pixels);
  }
  if (xml->GetAttribute("array"))
  {
    atria::showCategories(proxy);
  }
  const char* x = xml->GetAttribute("x");
  const char* series = xml->GetAttribute("series");
  if (x && series)
  {
    showSeries(proxy, source, port, x, series);
  }
  proxy->UpdateVTKObjects();
}

void vtkSMAtriaDisplayHelper::PrintSelf(ostream& os, vtkIndent indent) { this->Superclass::PrintSelf(os, indent); }
