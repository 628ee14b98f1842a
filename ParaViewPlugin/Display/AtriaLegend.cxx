// SPDX-License-Identifier: GPL-3.0-or-later
#include "AtriaLegend.h"

#include "vtkPVAtriaNamesInformation.h"

#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPVDataInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMPVRepresentationProxy.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkWeakPointer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace atria {
namespace {

/// More names do not fit beside the view, and no palette has so many distinct colors.
constexpr int longestLegend = 40;

/// Hints of a representation on its categories. Pointers are null for missing hints.
struct CategoryHints
{
  const char* array = nullptr; ///< cell array of integers
  const char* names = nullptr; ///< array of strings that they are indices into
  bool strong = false;         ///< colors for lines and points, not for areas
};

CategoryHints categoryHintsOf(vtkSMProxy* representation)
{
  vtkPVXMLElement* hints = representation->GetHints();
  vtkPVXMLElement* helper = hints ? hints->FindNestedElementByName("InitializationHelper") : nullptr;
  if (!helper || !helper->GetAttribute("array"))
  {
    return {};
  }
  return {helper->GetAttribute("array"), helper->GetAttribute("names"), helper->GetAttribute("strong") != nullptr};
}

using Categories = std::map<int, std::string>;
using Color = std::array<double, 3>;

vtkSMSourceProxy* sourceOf(vtkSMProxy* representation, int& port)
{
  vtkSMPropertyHelper input(representation, "Input", true);
  port = static_cast<int>(input.GetOutputPort());
  return vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
}

bool hasArray(vtkSMSourceProxy* source, int port, const char* array)
{
  vtkPVDataInformation* data = source->GetDataInformation(port);
  return data->GetNumberOfCells() > 0 && data->GetArrayInformation(array, vtkDataObject::CELL);
}

bool isColoredBy(vtkSMProxy* representation, const char* array)
{
  const char* shown = vtkSMPropertyHelper(representation, "ColorArrayName").GetInputArrayNameToProcess();
  return shown && std::strcmp(shown, array) == 0;
}

/// Returns the categories that occur in the data of one representation.
Categories categoriesOf(vtkSMProxy* representation)
{
  const CategoryHints hints = categoryHintsOf(representation);
  int port = 0;
  vtkSMSourceProxy* source = hints.names ? sourceOf(representation, port) : nullptr;
  if (!source || !hasArray(source, port, hints.array))
  {
    return {};
  }
  vtkNew<vtkPVAtriaNamesInformation> information;
  information->SetPortNumber(port);
  information->SetArrayName(hints.names);
  information->SetIndexArrayName(hints.array);
  source->GatherInformation(information);
  Categories categories;
  for (int i = 0; i < information->GetNumberOfIndices(); ++i)
  {
    const int index = information->GetIndex(i);
    categories[index] = information->GetName(index);
  }
  return categories;
}

/// Returns the representations that use the colors. The colors' consumers are proxies within them.
std::vector<vtkSMProxy*> representationsIn(vtkSMProxy* colors)
{
  std::vector<vtkSMProxy*> found;
  for (unsigned int i = 0; i < colors->GetNumberOfConsumers(); ++i)
  {
    vtkSMProxy* whole = colors->GetConsumerProxy(i)->GetTrueParentProxy();
    if (vtkSMPVRepresentationProxy::SafeDownCast(whole))
    {
      found.push_back(whole);
    }
  }
  return found;
}

/// Returns the categories of all data in the same colors. If two representations name one differently, `representation`
/// decides.
Categories categoriesIn(vtkSMProxy* colors, vtkSMProxy* representation)
{
  Categories categories = categoriesOf(representation);
  for (vtkSMProxy* other : representationsIn(colors))
  {
    if (other != representation && isColoredBy(other, categoryHintsOf(representation).array))
    {
      categories.merge(categoriesOf(other));
    }
  }
  return categories;
}

/// Returns a color whose hue advances by the golden angle, so that neighbors differ whatever their number is.
Color paletteColor(int index, bool strong)
{
  double unused = 0.0;
  const double hue = std::modf(0.58 + 0.381966 * index, &unused);
  Color rgb;
  const double paleness = index % 2 ? 0.35 : 0.55;
  const double brightness = index % 3 ? 0.95 : 0.8;
  vtkMath::HSVToRGB(hue, strong ? 1.0 : paleness, strong ? 0.85 * brightness : brightness, &rgb[0], &rgb[1], &rgb[2]);
  return rgb;
}

/// Returns the colors of named categories, including a user's changes.
std::map<std::string, Color> colorsByText(vtkSMProxy* colors)
{
  vtkSMPropertyHelper annotations(colors, "Annotations");
  vtkSMPropertyHelper indexed(colors, "IndexedColors");
  std::map<std::string, Color> found;
  for (unsigned int i = 0; 2 * i + 1 < annotations.GetNumberOfElements() && 3 * i + 2 < indexed.GetNumberOfElements();
       ++i)
  {
    found[std::string(annotations.GetAsString(2 * i)) + ' ' + annotations.GetAsString(2 * i + 1)] = {
        indexed.GetAsDouble(3 * i), indexed.GetAsDouble(3 * i + 1), indexed.GetAsDouble(3 * i + 2)};
  }
  return found;
}

void nameCategories(vtkSMProxy* colors, const Categories& categories, bool strong)
{
  const std::map<std::string, Color> before = colorsByText(colors);
  std::vector<double> palette;
  vtkSMPropertyHelper annotations(colors, "Annotations");
  annotations.SetNumberOfElements(static_cast<unsigned int>(2 * categories.size()));
  unsigned int element = 0;
  for (const auto& [index, name] : categories)
  {
    const std::string value = std::to_string(index);
    const auto known = before.find(value + ' ' + name);
    const Color color = known == before.end() ? paletteColor(index, strong) : known->second;
    palette.insert(palette.end(), color.begin(), color.end());
    annotations.Set(element++, value.c_str());
    annotations.Set(element++, name.c_str());
  }
  vtkSMPropertyHelper(colors, "IndexedColors").Set(palette.data(), static_cast<unsigned int>(palette.size()));
  vtkSMPropertyHelper(colors, "IndexedLookup").Set(categories.empty() ? 0 : 1);
  const double nameless[3] = {0.85, 0.85, 0.85}; // such as bare sides of the domain
  vtkSMPropertyHelper(colors, "NanColor").Set(nameless, 3);
  colors->UpdateVTKObjects();
}

void nameCategoriesOf(vtkSMProxy* representation)
{
  const CategoryHints hints = categoryHintsOf(representation);
  vtkSMProxy* colors = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  if (!hints.names || !colors || !isColoredBy(representation, hints.array))
  {
    return;
  }
  Categories categories = categoriesIn(colors, representation);
  if (categories.size() > longestLegend)
  {
    categories.clear();
  }
  else if (categories.empty())
  {
    return; // the data has no cells
  }
  nameCategories(colors, categories, hints.strong);
}

/// Colors the cells by the hinted array. Returns false if there is nothing to color.
bool colorCategories(vtkSMProxy* representation)
{
  const CategoryHints hints = categoryHintsOf(representation);
  int port = 0;
  vtkSMSourceProxy* source = sourceOf(representation, port);
  auto* shown = vtkSMPVRepresentationProxy::SafeDownCast(representation);
  if (!source || !shown || !hasArray(source, port, hints.array))
  {
    return false;
  }
  if (!shown->GetUsingScalarColoring())
  {
    shown->SetScalarColoring(hints.array, vtkDataObject::CELL);
  }
  return true;
}

/// Checks the data whenever it is new.
class FollowData : public vtkCommand
{
public:
  static FollowData* New() { return new FollowData; }

  void Execute(vtkObject* source, unsigned long, void*) override
  {
    if (this->Representation)
    {
      this->Look();
    }
    else
    {
      source->RemoveObserver(this);
    }
  }

  void Look()
  {
    // Colors once only: a user may choose another array, or none.
    this->Colored = this->Colored || colorCategories(this->Representation);
    if (this->Colored)
    {
      nameCategoriesOf(this->Representation);
    }
  }

  vtkWeakPointer<vtkSMProxy> Representation;
  bool Colored = false;
};

/// Makes a legend's ground light, so that it suits white views as well.
void makeLegible(vtkSMProxy* legend)
{
  const double ground[4] = {1.0, 1.0, 1.0, 1.0};
  const double letters[3] = {0.1, 0.1, 0.1};
  vtkSMPropertyHelper(legend, "DrawBackground").Set(1);
  vtkSMPropertyHelper(legend, "BackgroundColor").Set(ground, 4);
  vtkSMPropertyHelper(legend, "BackgroundPadding").Set(6.0);
  for (const char* text : {"TitleColor", "LabelColor", "ScalarBarOutlineColor"})
  {
    vtkSMPropertyHelper(legend, text).Set(letters, 3);
  }
  legend->UpdateVTKObjects();
}

bool hasOurColors(vtkSMProxy* legend)
{
  vtkSMProxy* colors = vtkSMPropertyHelper(legend, "LookupTable").GetAsProxy();
  const std::vector<vtkSMProxy*> shown = colors ? representationsIn(colors) : std::vector<vtkSMProxy*>();
  return std::ranges::any_of(shown, [](vtkSMProxy* representation) { return categoryHintsOf(representation).array; });
}

/// Observes each legend that is made.
class FollowLegends : public vtkCommand
{
public:
  static FollowLegends* New() { return new FollowLegends; }

  void Execute(vtkObject*, unsigned long, void* data) override
  {
    const auto* registered = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data);
    if (registered->Proxy && registered->GroupName && std::strcmp(registered->GroupName, "scalar_bars") == 0 &&
        hasOurColors(registered->Proxy))
    {
      makeLegible(registered->Proxy);
    }
  }
};

} // namespace

void showCategories(vtkSMProxy* representation)
{
  static const vtkNew<FollowLegends> legends;
  vtkSMSessionProxyManager* proxies = representation->GetSessionProxyManager();
  if (!proxies->HasObserver(vtkCommand::RegisterEvent, legends.Get()))
  {
    proxies->AddObserver(vtkCommand::RegisterEvent, legends.Get());
  }
  int port = 0;
  if (vtkSMSourceProxy* source = sourceOf(representation, port))
  {
    vtkNew<FollowData> data;
    data->Representation = representation;
    data->Look();
    source->AddObserver(vtkCommand::UpdateDataEvent, data);
  }
}

} // namespace atria
