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
      {"Inline", NodeKind::group, {{"url", mfString}}, {"bboxCenter", "bboxSize"}},
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
      {"Box", NodeKind::surface, {{"size", sfVec3f}}, {}},
      {"Cone",
       NodeKind::surface,
       {{"bottomRadius", sfFloat}, {"height", sfFloat}, {"side", sfBool}, {"bottom", sfBool}},
       {}},
      {"Cylinder",
       NodeKind::surface,
       {{"radius", sfFloat}, {"height", sfFloat}, {"side", sfBool}, {"bottom", sfBool}, {"top", sfBool}},
       {}},
      {"Sphere", NodeKind::surface, {{"radius", sfFloat}}, {}},
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
      {"Coordinate", NodeKind::property, {{"point", mfVec3f}}, {}},
      {"Appearance", NodeKind::property, {{"material", sfNode}}, {"texture", "textureTransform"}},
  };
}

const std::unordered_map<std::string_view, NodeType>& table()
{
  static const std::unordered_map<std::string_view, NodeType> all = [] {
    std::unordered_map<std::string_view, NodeType> types;
    for (const auto& part : {groups(), shapes()})
    {
      for (const NodeType& type : part)
      {
        types.emplace(type.name, type);
      }
    }
    for (const std::string_view name : {"Material", "ImageTexture", "PixelTexture", "MovieTexture", "TextureTransform",
                                        "TextureCoordinate", "Normal", "Color", "FontStyle"})
    {
      types.emplace(name, NodeType{name, NodeKind::property, {}, {}, true});
    }
    for (const std::string_view name : {"AudioClip",
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
                                        "WorldInfo"})
    {
      types.emplace(name, NodeType{name, NodeKind::other, {}, {}, true});
    }
    return types;
  }();
  return all;
}

} // namespace

std::optional<FieldType> NodeType::fieldType(std::string_view field) const
{
  for (const auto& [known, fieldType] : fields)
  {
    if (known == field)
    {
      return fieldType;
    }
  }
  for (const std::string_view known : ignored)
  {
    if (known == field)
    {
      return FieldType::unknown;
    }
  }
  return anyField ? std::optional(FieldType::unknown) : std::nullopt;
}

const NodeType* findNodeType(std::string_view name)
{
  const auto found = table().find(name);
  return found == table().end() ? nullptr : &found->second;
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
