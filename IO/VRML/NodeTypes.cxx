// SPDX-License-Identifier: GPL-3.0-or-later
#include "NodeTypes.h"

#include <unordered_map>

namespace atria::vrml {

namespace {

using enum FieldType;

std::vector<NodeType> groups()
{
  return {
      {"Anchor",
       NodeKind::group,
       {{"children", mfNode}},
       {"bboxCenter", "bboxSize", "description", "parameter", "url"}},
      {"Billboard", NodeKind::group, {{"children", mfNode}}, {"axisOfRotation", "bboxCenter", "bboxSize"}},
      {"Collision", NodeKind::group, {{"children", mfNode}}, {"bboxCenter", "bboxSize", "collide", "proxy"}},
      {"Group", NodeKind::group, {{"children", mfNode}}, {"bboxCenter", "bboxSize"}},
      {"Inline", NodeKind::group, {{"url", mfString}}, {"bboxCenter", "bboxSize", "load"}},            // load is of X3D
      {"InlineLoadControl", NodeKind::group, {{"url", mfString}}, {"bboxCenter", "bboxSize", "load"}}, // amendment 1
      {"LOD", NodeKind::group, {{"level", mfNode}, {"children", mfNode}}, {"center", "range"}},
      {"Switch", NodeKind::group, {{"choice", mfNode}, {"children", mfNode}, {"whichChoice", sfInt32}}, {}},
      {"Transform",
       NodeKind::group,
       {{"children", mfNode},
        {"center", sfVec3f},
        {"rotation", sfRotation},
        {"scale", sfVec3f},
        {"scaleOrientation", sfRotation},
        {"translation", sfVec3f}},
       {"bboxCenter", "bboxSize"}},
  };
}

std::vector<NodeType> shapes()
{
  return {
      {"Shape", NodeKind::shape, {{"appearance", sfNode}, {"geometry", sfNode}}, {}},
      {"Box", NodeKind::surface, {{"size", sfVec3f}}, {"solid"}}, // solid, here and below, is of X3D
      {"Cone",
       NodeKind::surface,
       {{"bottomRadius", sfFloat}, {"height", sfFloat}, {"side", sfBool}, {"bottom", sfBool}},
       {"solid"}},
      {"Cylinder",
       NodeKind::surface,
       {{"radius", sfFloat}, {"height", sfFloat}, {"side", sfBool}, {"bottom", sfBool}, {"top", sfBool}},
       {"solid"}},
      {"Sphere", NodeKind::surface, {{"radius", sfFloat}}, {"solid"}},
      {"ElevationGrid",
       NodeKind::surface,
       {{"height", mfFloat},
        {"ccw", sfBool},
        {"xDimension", sfInt32},
        {"xSpacing", sfFloat},
        {"zDimension", sfInt32},
        {"zSpacing", sfFloat}},
       {"color", "normal", "texCoord", "colorPerVertex", "creaseAngle", "normalPerVertex", "solid"}},
      {"Extrusion",
       NodeKind::surface,
       {{"crossSection", mfVec2f},
        {"spine", mfVec3f},
        {"scale", mfVec2f},
        {"orientation", mfRotation},
        {"beginCap", sfBool},
        {"endCap", sfBool},
        {"ccw", sfBool}},
       {"convex", "creaseAngle", "solid"}},
      {"IndexedFaceSet",
       NodeKind::surface,
       {{"coord", sfNode}, {"coordIndex", mfInt32}, {"ccw", sfBool}},
       {"color", "normal", "texCoord", "colorIndex", "colorPerVertex", "convex", "creaseAngle", "normalIndex",
        "normalPerVertex", "solid", "texCoordIndex"}},
      {"IndexedLineSet", NodeKind::drawing, {}, {}, true},
      {"PointSet", NodeKind::drawing, {}, {}, true},
      {"Text", NodeKind::drawing, {}, {}, true},
      {"Coordinate", NodeKind::property, {{"point", mfPoint}}, {}},
      {"Appearance", NodeKind::property, {{"material", sfNode}}, {"texture", "textureTransform"}},
      {"Material", NodeKind::property, {{"diffuseColor", sfVec3f}, {"transparency", sfFloat}}, {}, true},
  };
}

/// Children of VRML 1.0's groups stand between the braces; they are kept as if a field `children` held them.
std::vector<NodeType> groups1()
{
  return {
      {"Group", NodeKind::group, {{"children", mfNode}}, {}},
      {"LOD", NodeKind::group, {{"children", mfNode}}, {"center", "range"}},
      {"Separator", NodeKind::group, {{"children", mfNode}}, {"renderCulling"}},
      {"Switch", NodeKind::group, {{"children", mfNode}, {"whichChild", sfInt32}}, {}},
      {"TransformSeparator", NodeKind::group, {{"children", mfNode}}, {}},
      {"WWWAnchor", NodeKind::group, {{"children", mfNode}}, {"name", "description", "map"}},
      {"WWWInline", NodeKind::group, {{"name", mfString}}, {"bboxCenter", "bboxSize"}},
  };
}

std::vector<NodeType> states1()
{
  return {
      {"Coordinate3", NodeKind::state, {{"point", mfPoint}}, {}},
      {"Material", NodeKind::state, {{"diffuseColor", mfVec3f}, {"transparency", mfFloat}}, {}, true},
      {"MatrixTransform", NodeKind::state, {{"matrix", sfMatrix}}, {}},
      {"Rotation", NodeKind::state, {{"rotation", sfRotation}}, {}},
      {"RotationXYZ", NodeKind::state, {{"axis", sfWord}, {"angle", sfFloat}}, {}}, // from Inventor
      {"Scale", NodeKind::state, {{"scaleFactor", sfVec3f}}, {}},
      {"ShapeHints", NodeKind::state, {{"vertexOrdering", sfWord}}, {"shapeType", "faceType", "creaseAngle"}},
      {"Transform",
       NodeKind::state,
       {{"center", sfVec3f},
        {"rotation", sfRotation},
        {"scaleFactor", sfVec3f},
        {"scaleOrientation", sfRotation},
        {"translation", sfVec3f}},
       {}},
      {"Translation", NodeKind::state, {{"translation", sfVec3f}}, {}},
  };
}

std::vector<NodeType> shapes1()
{
  return {
      {"Cone", NodeKind::surface, {{"parts", sfWord}, {"bottomRadius", sfFloat}, {"height", sfFloat}}, {}},
      {"Cube", NodeKind::surface, {{"width", sfFloat}, {"height", sfFloat}, {"depth", sfFloat}}, {}},
      {"Cylinder", NodeKind::surface, {{"parts", sfWord}, {"radius", sfFloat}, {"height", sfFloat}}, {}},
      {"IndexedFaceSet",
       NodeKind::surface,
       {{"coordIndex", mfInt32}},
       {"materialIndex", "normalIndex", "textureCoordIndex"}},
      {"Sphere", NodeKind::surface, {{"radius", sfFloat}}, {}},
      {"AsciiText", NodeKind::drawing, {}, {}, true},
      {"IndexedLineSet", NodeKind::drawing, {}, {}, true},
      {"PointSet", NodeKind::drawing, {}, {}, true},
  };
}

using Table = std::unordered_map<std::string_view, NodeType>;
using Names = std::initializer_list<std::string_view>;

/// Returns a table of types, and of names of nodes whose fields are not read.
Table tableOf(std::initializer_list<std::vector<NodeType>> parts, Names properties, Names others)
{
  Table types;
  for (const std::vector<NodeType>& part : parts)
  {
    for (const NodeType& type : part)
    {
      types.emplace(type.name, type);
    }
  }
  for (const auto& [kind, names] : {std::pair(NodeKind::property, properties), {NodeKind::other, others}})
  {
    for (const std::string_view name : names)
    {
      types.emplace(name, NodeType{name, kind, {}, {}, true});
    }
  }
  return types;
}

const Table& table1()
{
  static const Table all =
      tableOf({groups1(), states1(), shapes1()},
              {"FontStyle", "Info", "MaterialBinding", "Normal", "NormalBinding", "Texture2", "Texture2Transform",
               "TextureCoordinate2"},
              {"DirectionalLight", "OrthographicCamera", "PerspectiveCamera", "PointLight", "SpotLight"});
  return all;
}

const Table& table97()
{
  static const Table all = tableOf({groups(), shapes()},
                                   {"ImageTexture", "PixelTexture", "MovieTexture", "TextureTransform",
                                    "TextureCoordinate", "Normal", "Color", "FontStyle"},
                                   {"AudioClip",
                                    "Background",
                                    "ColorInterpolator",
                                    "CoordinateInterpolator",
                                    "CylinderSensor",
                                    "DirectionalLight",
                                    "Fog",
                                    "NavigationInfo",
                                    "NormalInterpolator",
                                    "OrientationInterpolator",
                                    "PlaneSensor",
                                    "PointLight",
                                    "PositionInterpolator",
                                    "ProximitySensor",
                                    "ScalarInterpolator",
                                    "Script",
                                    "Sound",
                                    "SphereSensor",
                                    "SpotLight",
                                    "TimeSensor",
                                    "TouchSensor",
                                    "Viewpoint",
                                    "VisibilitySensor",
                                    "WorldInfo"});
  return all;
}

} // namespace

std::optional<FieldType> NodeType::fieldType(std::string_view field) const
{
  for (const auto& [known, fieldType] : fields)
  {
    if (isSame(known, field))
    {
      return fieldType;
    }
  }
  for (const std::string_view known : ignored)
  {
    if (isSame(known, field))
    {
      return FieldType::unknown;
    }
  }
  return anyField ? std::optional(FieldType::unknown) : std::nullopt;
}

const NodeType* findNodeType(std::string_view name, Version version)
{
  const Table& table = version == Version::vrml1 ? table1() : table97();
  const auto found = table.find(name);
  return found == table.end() ? nullptr : &found->second;
}

std::optional<FieldType> findFieldType(std::string_view name)
{
  static const std::unordered_map<std::string_view, FieldType> names{
      {"SFBool", sfBool},     {"SFInt32", sfInt32},       {"SFFloat", sfFloat},   {"SFTime", sfFloat},
      {"SFVec2f", sfVec2f},   {"SFVec3f", sfVec3f},       {"SFColor", sfVec3f},   {"SFRotation", sfRotation},
      {"SFString", sfString}, {"SFNode", sfNode},         {"SFImage", unknown},   {"MFInt32", mfInt32},
      {"MFFloat", mfFloat},   {"MFTime", mfFloat},        {"MFVec2f", mfVec2f},   {"MFVec3f", mfVec3f},
      {"MFColor", mfVec3f},   {"MFRotation", mfRotation}, {"MFString", mfString}, {"MFNode", mfNode},
      {"MFBool", unknown},    {"SFDouble", sfFloat},      {"MFDouble", mfFloat},  {"SFVec3d", sfVec3f},
      {"MFVec3d", mfVec3f}};
  const auto found = names.find(name);
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

} // namespace atria::vrml
