// SPDX-License-Identifier: GPL-3.0-or-later
#include "IfcLater.h"

#include "IfcProfiles.h"
#include "IfcSchema.h"
#include "IfcTessellation.h"

#include <unordered_map>

namespace atria::model::ifc {

namespace {

using namespace step;

/// Renames special cases of elements that IFC 4 has under other names.
void nameAs2x3(step::File& content)
{
  static const std::unordered_map<std::string_view, const char*> names{
      {"IFCBEAMSTANDARDCASE", "IFCBEAM"},     {"IFCCOLUMNSTANDARDCASE", "IFCCOLUMN"},
      {"IFCDOORSTANDARDCASE", "IFCDOOR"},     {"IFCMEMBERSTANDARDCASE", "IFCMEMBER"},
      {"IFCPLATESTANDARDCASE", "IFCPLATE"},   {"IFCSLABELEMENTEDCASE", "IFCSLAB"},
      {"IFCSLABSTANDARDCASE", "IFCSLAB"},     {"IFCWALLELEMENTEDCASE", "IFCWALL"},
      {"IFCWINDOWSTANDARDCASE", "IFCWINDOW"}, {"IFCOPENINGSTANDARDCASE", "IFCOPENINGELEMENT"}};
  for (Instance& instance : content.instances())
  {
    if (const auto found = names.find(instance.type); found != names.end())
    {
      instance.type = found->second;
    }
  }
}

/// Adds owners, which IFC 4 may leave out, and without which assimp ends.
void giveOwners(step::File& content)
{
  std::string owner;
  for (std::size_t i = 0; i < content.instances().size(); ++i)
  {
    const Instance& instance = content.instances()[i];
    if (!content.isRemoved(instance) && isRoot(instance) && argument(instance, 1) == "$")
    {
      owner = owner.empty() ? reference(content.add("IFCOWNERHISTORY", "$,$,$,.ADDED.,$,$,$,0")) : owner;
      setArgument(content.instances()[i], 1, owner);
    }
  }
}

/// Wraps styles, which IFC 4 gives to items without the assignment that 2x3 has between.
void wrapStyles(step::File& content)
{
  for (std::size_t i = 0; i < content.instances().size(); ++i)
  {
    const Instance item = content.instances()[i];
    if (item.type != "IFCSTYLEDITEM")
    {
      continue;
    }
    const std::vector<std::string_view> styles = argumentsOf(insideOf(argument(item, 1)));
    const Instance* first = styles.empty() ? nullptr : content.find(styles.front());
    if (first && first->type != "IFCPRESENTATIONSTYLEASSIGNMENT")
    {
      const std::string list = "(" + step::joinedArguments(styles) + ")";
      const std::string assignment = reference(content.add("IFCPRESENTATIONSTYLEASSIGNMENT", list));
      setArgument(content.instances()[i], 1, "(" + assignment + ")");
    }
  }
}

/// Adds placements to profiles and solids without one, which stands for the origin.
void givePlacements(step::File& content)
{
  static const std::unordered_map<std::string_view, std::size_t> places{
      {"IFCEXTRUDEDAREASOLID", 1},  {"IFCREVOLVEDAREASOLID", 1},          {"IFCRECTANGLEPROFILEDEF", 2},
      {"IFCCIRCLEPROFILEDEF", 2},   {"IFCRECTANGLEHOLLOWPROFILEDEF", 2},  {"IFCCIRCLEHOLLOWPROFILEDEF", 2},
      {"IFCISHAPEPROFILEDEF", 2},   {"IFCROUNDEDRECTANGLEPROFILEDEF", 2}, {"IFCELLIPSEPROFILEDEF", 2},
      {"IFCTRAPEZIUMPROFILEDEF", 2}};
  std::string inPlane;
  std::string inSpace;
  for (std::size_t i = 0; i < content.instances().size(); ++i)
  {
    const auto found = places.find(content.instances()[i].type);
    if (found == places.end() || argument(content.instances()[i], found->second) != "$")
    {
      continue;
    }
    const bool isProfile = found->second == 2;
    const std::size_t place = found->second;
    std::string& placement = isProfile ? inPlane : inSpace;
    if (placement.empty())
    {
      const std::string origin = reference(content.add("IFCCARTESIANPOINT", isProfile ? "(0.,0.)" : "(0.,0.,0.)"));
      placement = reference(isProfile ? content.add("IFCAXIS2PLACEMENT2D", origin + ",$")
                                      : content.add("IFCAXIS2PLACEMENT3D", origin + ",$,$"));
    }
    setArgument(content.instances()[i], place, placement);
  }
}

} // namespace

void writeAs2x3(step::File& content)
{
  writeTessellationsAs2x3(content);
  nameAs2x3(content);
  giveOwners(content);
  wrapStyles(content);
  givePlacements(content);
  writeProfilesAsOutlines(content);
}

} // namespace atria::model::ifc
