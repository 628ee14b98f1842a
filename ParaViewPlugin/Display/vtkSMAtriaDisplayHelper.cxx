// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSMAtriaDisplayHelper.h"

#include "vtkPVAtriaNamesInformation.h"

#include <vtkDataObject.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVDataSetAttributesInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMPVRepresentationProxy.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

#include <cmath>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMAtriaDisplayHelper);

namespace {

/// More names do not fit beside the view, and no palette tells so many colors apart.
constexpr int longestLegend = 40;

std::vector<std::string> namesIn(vtkSMSourceProxy* source, int port, const char* array)
{
  vtkNew<vtkPVAtriaNamesInformation> information;
  information->SetPortNumber(port);
  information->SetArrayName(array);
  source->GatherInformation(information);
  std::vector<std::string> names;
  for (int i = 0; i < information->GetNumberOfNames(); ++i)
  {
    names.push_back(information->GetName(i));
  }
  return names;
}

/// Hues by the golden angle, so that neighbors differ whatever their number is.
std::vector<double> paletteOf(std::size_t count)
{
  std::vector<double> colors;
  for (std::size_t i = 0; i < count; ++i)
  {
    double unused = 0.0;
    const double hue = std::modf(0.58 + 0.381966 * static_cast<double>(i), &unused);
    double rgb[3];
    vtkMath::HSVToRGB(hue, i % 2 ? 0.35 : 0.55, i % 3 ? 0.95 : 0.8, rgb, rgb + 1, rgb + 2);
    colors.insert(colors.end(), rgb, rgb + 3);
  }
  return colors;
}

void nameCategories(vtkSMProxy* colors, const std::vector<std::string>& names)
{
  const std::vector<double> palette = paletteOf(names.size());
  vtkSMPropertyHelper annotations(colors, "Annotations");
  annotations.SetNumberOfElements(static_cast<unsigned int>(2 * names.size()));
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    annotations.Set(static_cast<unsigned int>(2 * i), std::to_string(i).c_str());
    annotations.Set(static_cast<unsigned int>(2 * i + 1), names[i].c_str());
  }
  vtkSMPropertyHelper(colors, "IndexedColors").Set(palette.data(), static_cast<unsigned int>(palette.size()));
  vtkSMPropertyHelper(colors, "IndexedLookup").Set(1);
  const double nameless[3] = {0.85, 0.85, 0.85}; // such as bare sides of the domain
  vtkSMPropertyHelper(colors, "NanColor").Set(nameless, 3);
  colors->UpdateVTKObjects();
}

void colorByNames(vtkSMProxy* representation, vtkSMSourceProxy* source, int port, const char* array, const char* names)
{
  vtkPVDataInformation* data = source->GetDataInformation(port);
  if (data->GetNumberOfCells() == 0 || !data->GetArrayInformation(array, vtkDataObject::CELL))
  {
    return;
  }
  vtkSMPVRepresentationProxy::SetScalarColoring(representation, array, vtkDataObject::CELL);
  if (!names)
  {
    return;
  }
  const std::vector<std::string> found = namesIn(source, port, names);
  vtkSMProxy* colors = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  if (colors && !found.empty() && found.size() <= longestLegend)
  {
    nameCategories(colors, found);
  }
}

void showSeries(vtkSMProxy* representation, vtkSMSourceProxy* source, int port, const char* x, const char* series)
{
  vtkSMPropertyHelper(representation, "UseIndexForXAxis").Set(0);
  vtkSMPropertyHelper(representation, "XArrayName").Set(x);
  // All columns, as those that are not named are visible.
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
  const char* array = xml->GetAttribute("array");
  const char* names = xml->GetAttribute("names");
  if (array)
  {
    colorByNames(proxy, source, port, array, names);
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
