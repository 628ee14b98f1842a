// SPDX-License-Identifier: GPL-3.0-or-later
#include "IfcDocument.h"

#include "IfcArguments.h"
#include "IfcLater.h"
#include "IfcSchema.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace atria::model::ifc {

namespace {

using namespace step;

constexpr std::size_t shapeOf = 6; // among the arguments of a product

/// True for relations that assimp reads. Others, and properties, are of no use and often newer than assimp.
bool isOfUse(const std::string& type)
{
  static const std::unordered_set<std::string_view> relations{"IFCRELAGGREGATES", "IFCRELCONTAINEDINSPATIALSTRUCTURE",
                                                              "IFCRELVOIDSELEMENT", "IFCRELFILLSELEMENT"};
  return type.starts_with("IFCREL")
             ? relations.count(type) > 0
             : !type.starts_with("IFCPROPERTY") && !type.starts_with("IFCQUANTITY") && type != "IFCELEMENTQUANTITY";
}

/// True if the rest of an entity still makes sense when members of its lists are missing.
bool losesOne(const std::string& type)
{
  static const std::unordered_set<std::string_view> types{"IFCSHAPEREPRESENTATION",
                                                          "IFCTOPOLOGYREPRESENTATION",
                                                          "IFCSTYLEDREPRESENTATION",
                                                          "IFCPRODUCTDEFINITIONSHAPE",
                                                          "IFCUNITASSIGNMENT",
                                                          "IFCPROJECT",
                                                          "IFCPRESENTATIONLAYERASSIGNMENT",
                                                          "IFCPRESENTATIONLAYERWITHSTYLE",
                                                          "IFCPRESENTATIONSTYLEASSIGNMENT",
                                                          "IFCSURFACESTYLE",
                                                          "IFCSTYLEDITEM"};
  return type.starts_with("IFCREL") || types.count(type) > 0;
}

bool standsInModel(const std::string& type)
{
  static const std::unordered_set<std::string_view> others{"IFCOPENINGELEMENT",
                                                           "IFCOPENINGSTANDARDCASE",
                                                           "IFCVOIDINGFEATURE",
                                                           "IFCSPACE",
                                                           "IFCSPATIALZONE",
                                                           "IFCANNOTATION",
                                                           "IFCGRID",
                                                           "IFCVIRTUALELEMENT",
                                                           "IFCDISTRIBUTIONPORT",
                                                           "IFCALIGNMENT",
                                                           "IFCREFERENT",
                                                           "IFCEXTERNALSPATIALELEMENT",
                                                           "IFCPOSITIONINGELEMENT",
                                                           "IFCLINEARPOSITIONINGELEMENT",
                                                           "IFCPROXY"};
  return others.count(type) == 0 && !type.starts_with("IFCSTRUCTURAL");
}

bool isSolidType(const std::string& type)
{
  static const std::unordered_set<std::string_view> types{
      "IFCEXTRUDEDAREASOLID",    "IFCREVOLVEDAREASOLID", "IFCSWEPTDISKSOLID",        "IFCFACETEDBREP",
      "IFCFACETEDBREPWITHVOIDS", "IFCBOOLEANRESULT",     "IFCBOOLEANCLIPPINGRESULT", "IFCCSGSOLID",
      "IFCADVANCEDBREP"};
  return types.count(type) > 0;
}

} // namespace

Document::Document(std::string_view text) : content(text)
{
  const std::size_t at = text.find("FILE_SCHEMA");
  const std::size_t start = at == text.npos ? text.npos : text.find('\'', at);
  if (start != text.npos)
  {
    schemaName = std::string(text.substr(start + 1, text.find('\'', start + 1) - start - 1));
  }
  readUnits();
  writeAs2x3(content);
  content.setSchema("IFC2X3"); // later versions of assimp take no other
  readLaterProducts();
  findProducts();
  dropOthers();
  dropUnknown();
  fitArguments(content);
  markLossy();
  putUnderOneSite();
}

/// Reads the unit. assimp converts SI units, and takes feet and inches for meters.
void Document::readUnits()
{
  for (const Instance& instance : content.instances())
  {
    if (instance.type != "IFCCONVERSIONBASEDUNIT" || argument(instance, 1) != ".LENGTHUNIT.")
    {
      continue;
    }
    const auto isUsed = [&](const Instance& other) {
      return other.type == "IFCUNITASSIGNMENT" && other.arguments.find(reference(instance.id)) != std::string::npos;
    };
    const Instance* factor = content.find(argument(instance, 3));
    const Instance* unit = factor ? content.find(argument(*factor, 1)) : nullptr;
    const auto value = factor ? step::numberIn(argument(*factor, 0)) : std::nullopt;
    if (!value || !unit || unit->type != "IFCSIUNIT" || std::ranges::none_of(content.instances(), isUsed))
    {
      continue;
    }
    const std::string_view prefix = argument(*unit, 2);
    unitScale = *value * (prefix == ".MILLI." ? 1e-3 : prefix == ".CENTI." ? 1e-2 : prefix == ".DECI." ? 1e-1 : 1.0);
    return;
  }
}

/// Calls `visit` with the items of an element's bodies, also of those used in several places.
void Document::visitItems(const Instance& shape, const std::function<void(const Instance&)>& visit) const
{
  std::vector<const Instance*> open{&shape};
  std::set<std::uint64_t> seen;
  const auto push = [&](std::string_view list) {
    step::forReferences(list, [&](std::uint64_t id) {
      if (const Instance* next = content.find(id); next && seen.insert(id).second)
      {
        open.push_back(next);
      }
    });
  };
  while (!open.empty())
  {
    const Instance& next = *open.back();
    open.pop_back();
    if (next.type == "IFCPRODUCTDEFINITIONSHAPE")
    {
      push(argument(next, 2));
    }
    else if (next.type == "IFCSHAPEREPRESENTATION")
    {
      if (isBody(argument(next, 1)))
      {
        visit(next);
        push(argument(next, 3));
      }
    }
    else if (next.type == "IFCMAPPEDITEM")
    {
      push(argument(next, 0));
    }
    else if (next.type == "IFCREPRESENTATIONMAP")
    {
      push(argument(next, 1));
    }
    else
    {
      visit(next);
    }
  }
}

bool Document::hasSolidsAlone(const Instance& shape) const
{
  bool any = false;
  bool all = true;
  visitItems(shape, [&](const Instance& item) {
    const bool isItem = item.type != "IFCSHAPEREPRESENTATION";
    any = any || isItem;
    all = all && (!isItem || isSolidType(item.type));
  });
  return any && all;
}

/// Turns products that 2x3 does not know into proxies, into openings if they void an element, or into storeys if they
/// contain one. Their first arguments are the same.
void Document::readLaterProducts()
{
  constexpr std::size_t count = 8;
  std::unordered_map<std::uint64_t, const char*> uses;
  for (const Instance& relation : content.instances())
  {
    const bool voids = relation.type == "IFCRELVOIDSELEMENT";
    if (voids || relation.type == "IFCRELCONTAINEDINSPATIALSTRUCTURE")
    {
      uses.emplace(referenceIn(argument(relation, 5)).value_or(0), voids ? "IFCOPENINGELEMENT" : "IFCBUILDINGSTOREY");
    }
  }
  for (Instance& instance : content.instances())
  {
    if (isIn2x3(instance.type) || !isRoot(instance) || instance.type.starts_with("IFCREL"))
    {
      continue;
    }
    std::vector<std::string_view> arguments = argumentsOf(instance.arguments);
    const Instance* placement = arguments.size() > shapeOf ? content.find(arguments[shapeOf - 1]) : nullptr;
    const auto use = uses.find(instance.id);
    if ((placement && placement->type == "IFCLOCALPLACEMENT" && standsInModel(instance.type)) || use != uses.end())
    {
      laterTypes[instance.id] = instance.type;
      instance.type = use == uses.end() ? "IFCBUILDINGELEMENTPROXY" : use->second;
      arguments.resize(std::min(count, arguments.size()));
      instance.arguments = std::string(step::joinedArguments(arguments));
    }
  }
}

void Document::findProducts()
{
  for (const Instance& instance : content.instances())
  {
    if (instance.type == "IFCRELVOIDSELEMENT")
    {
      const auto element = referenceIn(argument(instance, 4));
      const auto opening = referenceIn(argument(instance, 5));
      if (element && opening)
      {
        openingsOf.emplace(*element, *opening);
      }
      continue;
    }
    const Instance* shape = isRoot(instance) ? content.find(argument(instance, shapeOf)) : nullptr;
    if (!shape || shape->type != "IFCPRODUCTDEFINITIONSHAPE" || !standsInModel(instance.type))
    {
      continue;
    }
    bool hasBody = false;
    visitItems(*shape, [&](const Instance&) { hasBody = true; });
    if (hasBody)
    {
      const auto later = laterTypes.find(instance.id);
      Product product{instance.id, classNameOf(later == laterTypes.end() ? instance.type : later->second),
                      step::stringIn(argument(instance, 0)), step::stringIn(argument(instance, 2))};
      product.isSolid = hasSolidsAlone(*shape);
      found.push_back(product);
    }
  }
}

void Document::dropOthers()
{
  for (const Instance& instance : content.instances())
  {
    if (!content.isRemoved(instance) && !isOfUse(instance.type))
    {
      content.remove(instance.id);
    }
  }
}

/// Removes a reference to a removed instance, and `from` as well if it makes no sense without the reference.
void Document::dropReferences(Instance& from, std::uint64_t to, std::vector<std::uint64_t>& removed)
{
  const std::string kept = from.arguments;
  const std::string gone = reference(to);
  std::vector<std::string_view> arguments = argumentsOf(kept);
  std::vector<std::string> lists;
  lists.reserve(arguments.size());
  bool remains = true;
  for (std::string_view& value : arguments)
  {
    if (value == gone)
    {
      remains = remains && isRoot(from) && !from.type.starts_with("IFCREL");
      value = "$";
      continue;
    }
    std::vector<std::string_view> members = argumentsOf(insideOf(value));
    const std::size_t before = members.size();
    std::erase(members, gone);
    if (members.size() < before)
    {
      lists.push_back("(" + step::joinedArguments(members) + ")");
      value = lists.back();
      remains = remains && losesOne(from.type) && (!members.empty() || from.type == "IFCPROJECT");
    }
  }
  if (from.type == "IFCSHAPEREPRESENTATION" && isBody(argument(from, 1)))
  {
    lossyRepresentations.insert(from.id);
  }
  if (remains)
  {
    from.arguments = step::joinedArguments(arguments);
  }
  else
  {
    removed.push_back(from.id);
  }
}

/// Removes instances that 2x3 does not know, references to missing ones, and all that depends on them.
void Document::dropUnknown()
{
  std::vector<std::uint64_t> removed;
  std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> users;
  for (const Instance& instance : content.instances())
  {
    if (content.isRemoved(instance))
    {
      continue;
    }
    if (!isIn2x3(instance.type))
    {
      removed.push_back(instance.id);
    }
    step::forReferences(instance.arguments, [&](std::uint64_t id) {
      const bool isNew = users.find(id) == users.end();
      users[id].push_back(instance.id);
      if (isNew && !content.find(id))
      {
        removed.push_back(id);
      }
    });
  }
  std::unordered_set<std::uint64_t> done;
  while (!removed.empty())
  {
    const std::uint64_t id = removed.back();
    removed.pop_back();
    if (!done.insert(id).second)
    {
      continue;
    }
    content.remove(id);
    for (const std::uint64_t user : users[id])
    {
      if (Instance* from = content.find(user))
      {
        dropReferences(*from, id, removed);
      }
    }
  }
}

void Document::markLossy()
{
  for (Product& product : found)
  {
    const Instance* instance = content.find(product.id);
    product.isDropped = !instance;
    const Instance* shape = instance ? content.find(argument(*instance, shapeOf)) : nullptr;
    product.isLossy = !shape;
    if (shape)
    {
      visitItems(*shape, [&](const Instance& item) {
        product.isLossy = product.isLossy || lossyRepresentations.count(item.id) > 0;
      });
    }
  }
}

/// Returns the sites of the project, else its buildings; all in the file if the project has none.
std::vector<std::uint64_t> Document::rootsOfAssimp(std::uint64_t project) const
{
  std::vector<std::uint64_t> all;
  for (const char* type : {"IFCSITE", "IFCBUILDING"})
  {
    for (const Instance& instance : content.instances())
    {
      if (instance.type == type)
      {
        all.push_back(instance.id);
      }
    }
    if (!all.empty())
    {
      break;
    }
  }
  std::vector<std::uint64_t> ofProject;
  for (const Instance& relation : content.instances())
  {
    if (relation.type == "IFCRELAGGREGATES" && argument(relation, 4) == reference(project))
    {
      step::forReferences(argument(relation, 5), [&](std::uint64_t id) {
        if (std::ranges::find(all, id) != all.end())
        {
          ofProject.push_back(id);
        }
      });
    }
  }
  return ofProject.empty() ? all : ofProject;
}

/// Puts all spatial elements below one new site if assimp would miss any, such as a building beside the site.
void Document::putUnderOneSite()
{
  const auto project = std::ranges::find(content.instances(), "IFCPROJECT", &Instance::type);
  if (project == content.instances().end())
  {
    return;
  }
  const std::uint64_t projectId = project->id;
  std::unordered_map<std::uint64_t, std::uint64_t> parentOf;
  for (const Instance& relation : content.instances())
  {
    const bool aggregates = relation.type == "IFCRELAGGREGATES";
    if (aggregates || relation.type == "IFCRELCONTAINEDINSPATIALSTRUCTURE")
    {
      const auto parent = referenceIn(argument(relation, aggregates ? 4 : 5));
      step::forReferences(argument(relation, aggregates ? 5 : 4),
                          [&](std::uint64_t id) { parent ? void(parentOf.try_emplace(id, *parent)) : void(); });
    }
  }
  std::vector<std::uint64_t> roots = rootsOfAssimp(projectId);
  const std::size_t known = roots.size();
  for (const Product& product : found)
  {
    std::uint64_t top = product.id;
    std::set<std::uint64_t> seen;
    for (auto parent = parentOf.find(top); parent != parentOf.end() && parent->second != projectId &&
                                           seen.insert(top).second && std::ranges::find(roots, top) == roots.end();
         parent = parentOf.find(top))
    {
      top = parent->second;
    }
    if (!product.isDropped && content.find(top) && std::ranges::find(roots, top) == roots.end())
    {
      roots.push_back(top);
    }
  }
  if (roots.size() == known)
  {
    return;
  }
  std::vector<std::uint64_t> relations;
  for (const Instance& relation : content.instances())
  {
    if (relation.type == "IFCRELAGGREGATES" && argument(relation, 4) == reference(projectId))
    {
      relations.push_back(relation.id);
    }
  }
  std::ranges::for_each(relations, [&](std::uint64_t id) { content.remove(id); });
  const std::string owner = reference(content.add("IFCOWNERHISTORY", "$,$,$,.ADDED.,$,$,$,0"));
  std::string members;
  for (const std::uint64_t id : roots)
  {
    members += (members.empty() ? "" : ",") + reference(id);
  }
  const std::string site =
      reference(content.add("IFCSITE", "'0000000000000000000000'," + owner + ",'Site',$,$,$,$,$,.COMPLEX.,$,$,$,$,$"));
  content.add("IFCRELAGGREGATES",
              "'0000000000000000000001'," + owner + ",$,$," + reference(projectId) + ",(" + site + ")");
  content.add("IFCRELAGGREGATES", "'0000000000000000000002'," + owner + ",$,$," + site + ",(" + members + ")");
}

std::string Document::textWithout(const std::set<std::uint64_t>& left) const
{
  if (left.empty())
  {
    return content.text();
  }
  step::File copy = content;
  const auto dropShape = [&](std::uint64_t id) {
    if (Instance* instance = copy.find(id))
    {
      setArgument(*instance, shapeOf, "$");
    }
  };
  for (const std::uint64_t id : left)
  {
    dropShape(id);
    const auto [first, last] = openingsOf.equal_range(id);
    std::for_each(first, last, [&](const auto& pair) { dropShape(pair.second); });
  }
  return copy.text();
}

} // namespace atria::model::ifc
