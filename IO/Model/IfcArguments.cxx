// SPDX-License-Identifier: GPL-3.0-or-later
#include "IfcArguments.h"

#include <algorithm>
#include <unordered_map>

namespace atria::model::ifc {

namespace {

using namespace step;

/// Arguments that assimp converts for some entities, one letter each: text, enumeration, integer, real, # reference,
/// anything; ( is a list of the kind that follows. Small letters, + and [ mark optional ones. Entities have more
/// arguments at the end, which assimp does not read.
struct Declaration
{
  std::string_view arguments;
  std::string_view entities; ///< without IFC, each followed by a blank
};

constexpr Declaration declarations[] = {
    {"T#ttt++t",
     "BEAM BUILDINGELEMENTPART BUILDINGELEMENTPROXY CHAMFEREDGEFEATURE COLUMN COVERING CURTAINWALL DISCRETEACCESSORY "
     "DISTRIBUTIONCHAMBERELEMENT DISTRIBUTIONCONTROLELEMENT DISTRIBUTIONELEMENT DISTRIBUTIONFLOWELEMENT "
     "ELECTRICALELEMENT ELECTRICDISTRIBUTIONPOINT ELEMENTASSEMBLY ENERGYCONVERSIONDEVICE EQUIPMENTELEMENT FASTENER "
     "FLOWCONTROLLER FLOWFITTING FLOWMOVINGDEVICE FLOWSEGMENT FLOWSTORAGEDEVICE FLOWTERMINAL FLOWTREATMENTDEVICE "
     "FOOTING FURNISHINGELEMENT MECHANICALFASTENER MEMBER OPENINGELEMENT PILE PLATE PROJECTIONELEMENT RAILING RAMP "
     "RAMPFLIGHT REINFORCINGBAR REINFORCINGMESH ROOF ROUNDEDEDGEFEATURE SLAB STAIR STAIRFLIGHT TENDON TENDONANCHOR "
     "TRANSPORTELEMENT VIRTUALELEMENT WALL WALLSTANDARDCASE WINDOW "},
    {"T#ttt++trr", "DOOR "},
    {"T#ttt++", "ANNOTATION DISTRIBUTIONPORT GRID PROXY "},
    {"T#ttt++tE", "BUILDINGSTOREY "},
    {"T#ttt++tErr+", "BUILDING "},
    {"T#ttt++tEEr", "SPACE "},
    {"T#ttt++tE[i[irt+", "SITE "},
    {"T#ttttt(##", "PROJECT "},
    {"T#tt##", "RELFILLSELEMENT RELVOIDSELEMENT "},
    {"T#tt#(#", "RELAGGREGATES "},
    {"T#tt(##", "RELCONTAINEDINSPATIALSTRUCTURE "},
    {"tt(#", "PRODUCTDEFINITIONSHAPE "},
    {"#tt(#", "SHAPEREPRESENTATION STYLEDREPRESENTATION TOPOLOGYREPRESENTATION "},
    {"ttIrA+", "GEOMETRICREPRESENTATIONCONTEXT GEOMETRICREPRESENTATIONSUBCONTEXT "},
    {"A#", "REPRESENTATIONMAP "},
    {"##", "MAPPEDITEM "},
    {"++#r", "CARTESIANTRANSFORMATIONOPERATOR2D "},
    {"++#r+", "CARTESIANTRANSFORMATIONOPERATOR3D "},
    {"++#r+rr", "CARTESIANTRANSFORMATIONOPERATOR3DNONUNIFORM "},
    {"(R", "CARTESIANPOINT DIRECTION "},
    {"#++", "AXIS2PLACEMENT3D "},
    {"#+", "AXIS1PLACEMENT AXIS2PLACEMENT2D "},
    {"+A", "LOCALPLACEMENT "},
    {"#R", "VECTOR "},
    {"AR", "CIRCLE "},
    {"ARR", "ELLIPSE "},
    {"#(A(AEE", "TRIMMEDCURVE "},
    {"EE#", "COMPOSITECURVESEGMENT "},
    {"#", "PLANE "},
    {"#E", "FACEBOUND FACEOUTERBOUND HALFSPACESOLID "},
    {"#E##", "POLYGONALBOUNDEDHALFSPACE "},
    {"EAA", "BOOLEANCLIPPINGRESULT BOOLEANRESULT "},
    {"###R", "EXTRUDEDAREASOLID REVOLVEDAREASOLID "},
    {"#RrRR", "SWEPTDISKSOLID "},
    {"#RRR", "BOUNDINGBOX "},
    {"Et#", "ARBITRARYCLOSEDPROFILEDEF ARBITRARYOPENPROFILEDEF ARBITRARYPROFILEDEFWITHVOIDS "},
    {"Et#R", "CIRCLEPROFILEDEF "},
    {"Et#RR", "CIRCLEHOLLOWPROFILEDEF RECTANGLEHOLLOWPROFILEDEF RECTANGLEPROFILEDEF ROUNDEDRECTANGLEPROFILEDEF "},
    {"Et#RRRRr", "ISHAPEPROFILEDEF "},
    {"+(#t", "STYLEDITEM "},
    {"tE(A", "SURFACESTYLE "},
    {"#raaaaaaE", "SURFACESTYLERENDERING "},
    {"tRRR", "COLOURRGB "},
    {"+E", "CONTEXTDEPENDENTUNIT "},
    {"+EeE", "SIUNIT "},
    {"+ET#", "CONVERSIONBASEDUNIT "},
    {"AA", "MEASUREWITHUNIT "},
};

/// True if assimp takes a number for an integer: it checks for a point alone.
bool isInteger(std::string_view value)
{
  return !value.empty() && value.find_first_of("(.") == value.npos && step::numberIn(value);
}

/// A type of argument: a capital letter, # or (, and the type of members.
struct Type
{
  char kind = 'A';
  char member = 'A';
  bool isOptional = false;
};

/// Returns the types that a declaration lists.
std::vector<Type> typesIn(std::string_view text)
{
  std::vector<Type> out;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const char c = text[i];
    const bool isSmall = c >= 'a' && c <= 'z';
    Type type{c == '+' ? '#' : c == '[' ? '(' : isSmall ? static_cast<char>(c - 'a' + 'A') : c};
    type.isOptional = isSmall || c == '+' || c == '[';
    if (type.kind == '(')
    {
      const char member = text[++i];
      type.member = member >= 'a' && member <= 'z' ? static_cast<char>(member - 'a' + 'A') : member;
    }
    out.push_back(type);
  }
  return out;
}

/// Returns the types of arguments by entity.
std::unordered_map<std::string, std::vector<Type>> declared()
{
  std::unordered_map<std::string, std::vector<Type>> out;
  for (const Declaration& declaration : declarations)
  {
    const std::vector<Type> types = typesIn(declaration.arguments);
    const std::string_view names = declaration.entities;
    for (std::size_t at = 0; at < names.size();)
    {
      const std::size_t end = names.find(' ', at);
      out.emplace("IFC" + std::string(names.substr(at, end - at)), types);
      at = end + 1;
    }
  }
  return out;
}

/// True if a value is of a kind; lists may have any members.
bool isOf(char kind, std::string_view value)
{
  switch (kind)
  {
    case 'T':
      return value.starts_with("'");
    case 'E':
      return value.starts_with(".") && !step::numberIn(value);
    case 'I':
      return isInteger(value);
    case 'R':
      return step::numberIn(value) && !isInteger(value);
    case '#':
      return value.starts_with("#");
    case '(':
      return value.starts_with("(");
    default:
      return value != "$";
  }
}

/// Returns a real that was written as an integer in the form of a real; any other value unchanged.
std::string asReal(std::string_view value)
{
  std::string out(value);
  return isInteger(value) ? out.insert(std::min(out.find_first_of("eE"), out.size()), ".") : out;
}

/// Returns a list with all reals in the form of reals.
std::string asReals(std::string_view list)
{
  std::string out;
  for (const std::string_view value : argumentsOf(insideOf(list)))
  {
    out.append(out.empty() ? "" : ",").append(asReal(value));
  }
  return "(" + out + ")";
}

/// Returns a substitute for a missing mandatory value if an entity makes sense without it; else empty.
std::string_view standIn(const std::string& entity, char kind)
{
  const bool isSpatial =
      entity == "IFCSITE" || entity == "IFCBUILDING" || entity == "IFCBUILDINGSTOREY" || entity == "IFCSPACE";
  return kind == 'T'                                    ? "''"
         : kind == 'E' && isSpatial                     ? ".NOTDEFINED."
         : kind == 'E' && entity.ends_with("FILEDEF")   ? ".AREA."
         : kind == 'E' && entity == "IFCSURFACESTYLE"   ? ".BOTH."
         : kind == 'E' && entity.ends_with("RENDERING") ? ".NOTDEFINED."
         : kind == 'E' && entity.ends_with("BOUND")     ? ".T."
         : kind == 'I'                                  ? "3"
         : kind == '(' && entity == "IFCPROJECT"        ? "()"
                                                        : "";
}

/// Returns the value in the form that assimp takes.
std::string fitted(const std::string& entity, const Type& type, std::string_view value)
{
  if (value == "*")
  {
    return "*";
  }
  if (type.kind == 'R' && isInteger(value))
  {
    return asReal(value);
  }
  if (isOf(type.kind, value))
  {
    return type.member == 'R' ? asReals(value) : std::string(value);
  }
  const std::string_view other = type.isOptional ? "$" : standIn(entity, type.kind);
  return std::string(other.empty() ? value : other);
}

/// Returns the number of segments of a polyline, in which assimp measures the end of a swept disk.
std::string endOf(const step::File& content, std::string_view curve)
{
  const Instance* line = content.find(curve);
  const bool isPolyline = line && line->type == "IFCPOLYLINE";
  const std::size_t points = isPolyline ? argumentsOf(insideOf(line->arguments)).size() : 0;
  return points > 1 ? std::to_string(points - 1) + "." : "$";
}

} // namespace

void fitArguments(step::File& content)
{
  static const std::unordered_map<std::string, std::vector<Type>> known = declared();
  std::string units;
  for (std::size_t i = 0; i < content.instances().size(); ++i)
  {
    const auto found = known.find(content.instances()[i].type);
    if (found == known.end())
    {
      continue;
    }
    const Instance instance = content.instances()[i];
    const std::vector<std::string_view> values = argumentsOf(instance.arguments);
    const std::vector<Type>& types = found->second;
    std::string fit;
    for (std::size_t k = 0; k < std::max(values.size(), types.size()); ++k)
    {
      const std::string_view value = k < values.size() ? values[k] : "$";
      std::string written = k < types.size() ? fitted(instance.type, types[k], value) : std::string(value);
      if (written == "$" && instance.type == "IFCPROJECT" && k == 8)
      {
        units = units.empty() ? reference(content.add("IFCUNITASSIGNMENT", "()")) : units;
        written = units;
      }
      if (written == "$" && instance.type == "IFCSWEPTDISKSOLID" && (k == 3 || k == 4))
      {
        written = k == 3 ? "0." : endOf(content, values.front());
      }
      fit.append(k == 0 ? "" : ",").append(written);
    }
    content.instances()[i].arguments = fit;
  }
}

} // namespace atria::model::ifc
