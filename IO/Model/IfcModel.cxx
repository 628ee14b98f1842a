// SPDX-License-Identifier: GPL-3.0-or-later
/// IFC by assimp: prepares files so that assimp can read them, and names the elements left out.
#include "AssimpTree.h"
#include "ClosedShell.h"
#include "IfcDocument.h"
#include "IfcOpenings.h"
#include "ModelFile.h"
#include "TemporaryFile.h"

#include "Support/Error.h"
#include "Support/Progress.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>

namespace atria::model {

namespace {

using assimp::Json;
using assimp::Run;
using ifc::Document;
using ifc::Product;
using Ids = std::set<std::uint64_t>;

/// The shape that assimp made of an element.
struct Shape
{
  bool hasFaces = false;
  bool isClosed = true;  ///< each of its meshes
  std::size_t group = 0; ///< node of its first mesh that is not closed, else of the first
};

constexpr std::size_t guidLength = 22; ///< length of a global identifier

bool isClosed(const Json& mesh)
{
  ClosedShell shell;
  const auto points = assimp::numbersIn<double>(mesh.at("points"));
  for (std::size_t i = 0; i + 2 < points.size(); i += 3)
  {
    shell.addPoint({points[i], points[i + 1], points[i + 2]});
  }
  const auto corners = assimp::numbersIn<std::uint32_t>(mesh.at("corners"));
  std::size_t at = 0;
  for (const std::size_t size : assimp::numbersIn<std::uint32_t>(mesh.at("sizes")))
  {
    const std::size_t end = std::min(at + size, corners.size());
    shell.addPolygon(
        {corners.begin() + static_cast<std::ptrdiff_t>(at), corners.begin() + static_cast<std::ptrdiff_t>(end)});
    at = end;
  }
  return shell.isClosed();
}

/// Returns assimp's name for an element: its class and its name, without blanks.
std::string nameOf(const Product& product)
{
  std::string name = product.name.empty() ? "Unnamed" : product.name;
  std::erase(name, ' ');
  return product.type + "_" + name;
}

class IfcReader
{
public:
  IfcReader(std::string path, const std::string& bytes, const ProgressRange& monitor)
      : file(std::move(path)), progress(monitor), document(bytes)
  {
  }

  Model read();

private:
  Run runWithout(const Ids& left) const;
  /// Returns all elements except some.
  Ids others(const Ids& kept) const;
  Ids findCulprits() const;
  std::vector<const Product*> productsOfGroups(const Json& tree) const;
  std::map<std::uint64_t, Shape> shapesIn(const Json& tree) const;
  void nameLaterProducts(Json& tree) const;
  Ids openSolids(const Json& tree) const;
  bool turnOpenings(const Ids& elements);
  void warnOf(Model& model, const Json& tree) const;

  std::string file;
  const ProgressRange& progress;
  Document document;
  Ids culprits; ///< elements on which assimp fails
};

Run IfcReader::runWithout(const Ids& left) const
{
  const TemporaryFile text(document.textWithout(left), ".ifc");
  return assimp::run(file, text.path(), progress);
}

Ids IfcReader::others(const Ids& kept) const
{
  Ids out;
  for (const Product& product : document.products())
  {
    if (kept.count(product.id) == 0)
    {
      out.insert(product.id);
    }
  }
  return out;
}

/// Finds the elements that assimp fails on, by halving them until single ones are left. After too many runs, all that
/// are not known to be good count as bad. Empty if assimp fails also without all elements.
Ids IfcReader::findCulprits() const
{
  constexpr int mostRuns = 80;
  Ids all;
  for (const Product& product : document.products())
  {
    all.insert(product.id);
  }
  if (all.empty() || runWithout(all).failed())
  {
    return {};
  }
  Ids found;
  std::vector<Ids> bad{all};
  for (int runs = 1; !bad.empty();)
  {
    const Ids group = std::move(bad.back());
    bad.pop_back();
    if (group.size() == 1 || runs + 2 > mostRuns)
    {
      found.insert(group.begin(), group.end());
      continue;
    }
    const auto middle = std::next(group.begin(), static_cast<std::ptrdiff_t>(group.size() / 2));
    for (Ids half : {Ids(group.begin(), middle), Ids(middle, group.end())})
    {
      ++runs;
      if (runWithout(others(half)).failed())
      {
        bad.push_back(std::move(half));
      }
    }
  }
  return found;
}

/// Returns the element of each node, null for nodes of none. Nodes have its global identifier at the end of their
/// names, or are below one that has it.
std::vector<const Product*> IfcReader::productsOfGroups(const Json& tree) const
{
  std::unordered_map<std::string, const Product*> byGuid;
  for (const Product& product : document.products())
  {
    byGuid.emplace(product.guid, &product);
  }
  std::vector<const Product*> productOf;
  for (const Json& group : tree.at("groups"))
  {
    const std::string& name = group.at("name").get_ref<const std::string&>();
    const auto found = name.size() > guidLength ? byGuid.find(name.substr(name.size() - guidLength)) : byGuid.end();
    const auto parent = group.find("parent");
    productOf.push_back(found != byGuid.end()   ? found->second
                        : parent != group.end() ? productOf.at(parent->get<std::size_t>())
                                                : nullptr);
  }
  return productOf;
}

std::map<std::uint64_t, Shape> IfcReader::shapesIn(const Json& tree) const
{
  const std::vector<const Product*> productOf = productsOfGroups(tree);
  std::map<std::uint64_t, Shape> shapes;
  for (const Json& mesh : tree.at("parts"))
  {
    const Product* product = productOf.at(mesh.at("group").get<std::size_t>());
    if (product && !mesh.at("sizes").get_binary().empty())
    {
      Shape& shape = shapes[product->id];
      const bool opens = shape.isClosed && product->isSolid && !isClosed(mesh);
      shape.group = opens || !shape.hasFaces ? mesh.at("group").get<std::size_t>() : shape.group;
      shape.hasFaces = true;
      shape.isClosed = shape.isClosed && !opens;
    }
  }
  return shapes;
}

/// Names nodes of elements that assimp takes for proxies after their classes.
void IfcReader::nameLaterProducts(Json& tree) const
{
  const std::string proxy = "IfcBuildingElementProxy_";
  const std::vector<const Product*> productOf = productsOfGroups(tree);
  for (std::size_t i = 0; i < productOf.size(); ++i)
  {
    const std::string name = tree.at("groups")[i].at("name").get<std::string>();
    if (productOf[i] && name.starts_with(proxy) && name.ends_with(productOf[i]->guid))
    {
      tree.at("groups")[i]["name"] = productOf[i]->type + name.substr(proxy.size() - 1);
    }
  }
}

Ids IfcReader::openSolids(const Json& tree) const
{
  Ids out;
  for (const auto& [id, shape] : shapesIn(tree))
  {
    if (!shape.isClosed)
    {
      out.insert(id);
    }
  }
  return out;
}

/// Extrudes boxes that are cut from elements in whichever direction closes the elements. Returns false if nothing
/// changed.
bool IfcReader::turnOpenings(const Ids& elements)
{
  Ids open = elements;
  bool changed = false;
  for (const ifc::BoxSide side : {ifc::BoxSide::shorter, ifc::BoxSide::longer})
  {
    const step::File kept = document.file();
    Ids turned;
    for (const std::uint64_t element : open)
    {
      const auto [first, last] = document.openings().equal_range(element);
      std::for_each(first, last, [&](const auto& pair) {
        if (ifc::extrudeAlong(document.file(), pair.second, side))
        {
          turned.insert(element);
        }
      });
    }
    const Run run = turned.empty() ? Run{} : runWithout(others(turned));
    const Ids stillOpen = turned.empty() || run.failed() ? turned : openSolids(run.tree);
    // Repeats the change for those elements alone that it closes.
    document.file() = kept;
    Ids left;
    for (const std::uint64_t element : turned)
    {
      if (stillOpen.count(element) > 0)
      {
        left.insert(element);
        continue;
      }
      const auto [first, last] = document.openings().equal_range(element);
      std::for_each(first, last, [&](const auto& pair) { extrudeAlong(document.file(), pair.second, side); });
      changed = true;
    }
    open = left;
  }
  return changed;
}

void IfcReader::warnOf(Model& model, const Json& tree) const
{
  const std::map<std::uint64_t, Shape> shapes = shapesIn(tree);
  using Members = std::vector<PartsWarning::Member>;
  Members later;
  Members partly;
  Members failed;
  Members empty;
  Members open;
  for (const Product& product : document.products())
  {
    const auto found = shapes.find(product.id);
    const bool hasFaces = found != shapes.end();
    Members* list = culprits.count(product.id) > 0                        ? &failed
                    : !hasFaces && (product.isLossy || product.isDropped) ? &later
                    : !hasFaces                                           ? &empty
                    : product.isLossy                                     ? &partly
                    : !found->second.isClosed                             ? &open
                                                                          : nullptr;
    if (list)
    {
      list->push_back({hasFaces ? std::optional(found->second.group) : std::nullopt, nameOf(product)});
    }
  }
  const std::string schema = document.schema();
  const auto warn = [&](const Members& list, const std::string& text) {
    if (!list.empty())
    {
      model.partsWarnings.push_back(
          {std::to_string(list.size()) + (list.size() == 1 ? " element is" : " elements are") + text, list});
    }
  };
  if (!schema.empty() && schema != "IFC2X3" && later.empty() && partly.empty())
  {
    model.warnings.push_back("its schema is " + schema + ", and assimp reads IFC2X3: shapes that are new in " + schema +
                             " are left out; export it as IFC2X3 if some are missing");
  }
  warn(later, " left out, as assimp reads IFC2X3 and their kinds or shapes are new in " + schema +
                  "; export the model as IFC2X3");
  warn(partly, " read in part, as assimp reads IFC2X3 and some of their shapes are new in " + schema +
                   "; export the model as IFC2X3");
  warn(failed, " left out, as assimp fails on them (the schema is " + schema + "); export them again, or as OBJ");
  warn(empty, " left out, as assimp makes no faces of their shapes");
  warn(open, " not closed as assimp reads them, though they are solids in the file, so that their insides may be "
             "taken for air; export them as OBJ, or leave them out");
}

Model IfcReader::read()
{
  Run run = runWithout({});
  if (run.failed() && !run.tookTooLong())
  {
    culprits = findCulprits();
    run = culprits.empty() ? std::move(run) : runWithout(culprits);
  }
  if (run.failed())
  {
    assimp::throwFailed(file, run);
  }
  Ids open = openSolids(run.tree);
  if (!open.empty() && turnOpenings(open))
  {
    run = runWithout(culprits);
  }
  nameLaterProducts(run.tree);
  assimp::Placing placing;
  placing.scale = document.lengthScale();
  Model model = assimp::modelOf(run.tree, file, placing);
  warnOf(model, run.tree);
  return model;
}

} // namespace

Model readIfc(const std::string& file, const ProgressRange& progress)
{
  const std::string bytes = readBytes(file);
  IfcReader reader(file, bytes, progress);
  Model model = reader.read();
  model.head = headOf(bytes);
  model.groundNames = {"IfcSite"};
  return model;
}

} // namespace atria::model
