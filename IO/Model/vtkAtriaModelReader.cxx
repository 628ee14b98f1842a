// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaModelReader.h"

#include "Diagnostics.h"
#include "ForeignFormats.h"
#include "ModelFile.h"
#include "ModelSource.h"
#include "NameList.h"
#include "Surfaces.h"

#include "Support/Error.h"
#include "Support/Progress.h"
#include "VtkSurface.h"

#include <vtkObjectFactory.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkAtriaModelReader);

namespace {

namespace model = atria::model;

struct Format
{
  const char* ending;
  model::Model (*read)(const std::string& file, const atria::ProgressRange& progress);
};

/// A reader that ends before anybody could abort it.
template <model::Model (*Read)(const std::string&)>
model::Model quick(const std::string& file, const atria::ProgressRange&)
{
  return Read(file);
}

constexpr Format formats[] = {
    {".obj", quick<model::readObj>},
    {".stl", quick<model::readStl>},
    {".ply", quick<model::readPly>},
    {".gltf", quick<model::readGltf>},
    {".glb", quick<model::readGltf>},
    {".vtp", quick<model::readXml>},
    {".vtm", quick<model::readXml>},
    {".vtpc", quick<model::readXml>},
    {".json", quick<model::readCityJson>},
    {".jsonl", quick<model::readCityJson>},
    {".dae", model::readAssimp},
    {".3ds", model::readAssimp},
    {".fbx", model::readAssimp},
    {".dxf", quick<model::readDxf>},
    {".ifc", model::readIfc},
};

const Format* formatOf(const char* fileName)
{
  const std::string ending = fileName ? atria::model::lowerEnding(fileName) : std::string();
  const auto found = std::find_if(std::begin(formats), std::end(formats),
                                  [&](const Format& format) { return ending == format.ending; });
  return found == std::end(formats) ? nullptr : found;
}

/// Returns the groups of a scene. They hold all parts if the format has a tree.
std::vector<atria::scene::Group> groupsOf(const model::Model& model)
{
  std::vector<atria::scene::Group> groups;
  for (const model::PartGroup& group : model.groups)
  {
    const auto parent = group.parent ? static_cast<atria::Index>(*group.parent) : atria::noIndex;
    groups.push_back({group.name, parent, group.parent ? groups.at(parent).depth + 1 : 0});
  }
  return groups;
}

/// Returns surfaces that have triangles, as shapes of a scene.
atria::scene::Scene sceneOf(const atria::model::Model& model, atria::VtkSurface read)
{
  atria::scene::Scene scene;
  atria::TriangleSurface& surface = read.surface;
  std::vector<atria::Index> shapeOf(surface.names.size(), atria::noIndex);
  std::map<std::string, atria::Index> materials;
  std::map<std::string, atria::Index> groups;
  scene.groups = groupsOf(model);
  const auto indexOf = [](auto& known, auto& list, const std::string& key, auto&& make) {
    const auto [found, isNew] = known.try_emplace(key, static_cast<atria::Index>(list.size()));
    if (isNew)
    {
      list.push_back(make());
    }
    return found->second;
  };
  for (const atria::Index id : surface.surfaceIds)
  {
    if (shapeOf[id] == atria::noIndex)
    {
      shapeOf[id] = static_cast<atria::Index>(scene.shapes.size());
      const std::string& name = surface.names[id];
      atria::scene::Shape shape{name};
      if (const auto part = model.parts.find(name); part != model.parts.end())
      {
        const atria::model::Part& p = part->second;
        if (!p.material.empty())
        {
          shape.material =
              indexOf(materials, scene.materials, p.material, [&] { return atria::scene::Material{p.material}; });
        }
        shape.group = !model.groups.empty() ? static_cast<atria::Index>(p.owner)
                                            : indexOf(groups, scene.groups, std::to_string(p.owner), [&] {
                                                return atria::scene::Group{p.name.empty() ? name : p.name};
                                              });
        shape.name = model.groups.empty() ? name : p.name;
      }
      scene.shapes.push_back(shape);
    }
    scene.shapeIds.push_back(shapeOf[id]);
  }
  scene.points = std::move(surface.points);
  scene.triangles = std::move(surface.triangles);
  scene.faceIds = std::move(read.faceIds);
  if (read.ignoredCells > 0)
  {
    scene.skipped["cells that are no faces"] = read.ignoredCells;
  }
  return scene;
}

/// Returns a warning with the names that surfaces have when each shape is one.
std::string textOf(const model::PartsWarning& warning, const atria::scene::Scene& scene,
                   const atria::scene::Surfaces& surfaces)
{
  model::NameList names;
  for (const model::PartsWarning::Member& member : warning.members)
  {
    const auto shape = std::ranges::find_if(scene.shapes, [&](const atria::scene::Shape& each) {
      return member.group && each.group == static_cast<atria::Index>(*member.group);
    });
    const auto at = static_cast<std::size_t>(shape - scene.shapes.begin());
    names.add("'" + (at < surfaces.surfaces.size() ? surfaces.surfaces[at].name : member.name) + "'");
  }
  return warning.text + ": " + names.text();
}

} // namespace

bool vtkAtriaModelReader::CanReadFile(const char* fileName) { return formatOf(fileName) != nullptr; }

std::string vtkAtriaModelReader::GetExportAdvice(const char* fileName)
{
  return fileName ? atria::model::adviceOnForeignFile(fileName) : "";
}

std::string vtkAtriaModelReader::GetFileExtensions()
{
  std::string all;
  for (const Format& format : formats)
  {
    all.append(all.empty() ? "" : " ").append(format.ending);
  }
  return all;
}

atria::scene::ModelSource vtkAtriaModelReader::ReadSource(atria::scene::Diagnostics& diagnostics,
                                                          const atria::ProgressRange& progress)
{
  const std::string file = this->FileName;
  const Format* format = formatOf(this->FileName);
  if (!format)
  {
    if (const std::string advice = GetExportAdvice(this->FileName); !advice.empty())
    {
      throw atria::Error("'" + file + "' " + advice);
    }
    throw atria::Error("'" + file + "' is of a format that is not known; give a file that ends in one of " +
                       GetFileExtensions() + ", unpacked");
  }
  const atria::model::Model model = format->read(file, progress.part(0.0, 0.5));
  progress.report(0.5, "Triangulating faces");
  atria::VtkSurface read = atria::surfaceFromVtk({model.data});
  atria::scene::ModelSource source;
  source.name = std::filesystem::path(file).filename().string();
  source.head = model.head;
  source.upAxis = model.upAxis;
  source.axisKnown = model.axisKnown;
  source.unitKnown = model.unitKnown;
  source.unitConverted = model.unitConverted;
  source.groundNames = model.groundNames;
  source.groundMaterials = model.groundMaterials;
  const auto warn = [&](const std::string& text) { diagnostics.warn(source.name + ": " + text); };
  std::for_each(model.warnings.begin(), model.warnings.end(), warn);
  std::for_each(model.notes.begin(), model.notes.end(), [&](const std::string& text) { diagnostics.note(text); });
  if (read.ignoredCells > 0)
  {
    warn(std::to_string(read.ignoredCells) + " cells are no faces and make no surface");
  }
  if (read.crossingFaces > 0)
  {
    warn(std::to_string(read.crossingFaces) +
         (read.crossingFaces == 1 ? " face has an outline that crosses itself: in '"
                                  : " faces have outlines that cross themselves, the first of them in '") +
         read.surface.names[read.firstCrossing] +
         "'; what lies between cannot be told, and is missing in part or in whole: correct the order of corners");
  }
  if (const double rounding = model.singlePrecision ? atria::coarseRounding(read.surface) : 0.0; rounding > 0.0)
  {
    std::ostringstream text;
    text.precision(2);
    text << "the model lies far from the origin, and this format is read in single precision: points are off by up to "
         << rounding << "; move it to the origin, or export it as OBJ or VRML";
    warn(text.str());
  }
  source.scene = sceneOf(model, std::move(read));
  if (!model.partsWarnings.empty())
  {
    const atria::scene::Surfaces surfaces =
        atria::scene::makeSurfaces(source.scene, atria::scene::SurfaceBy::shape, 0.0);
    for (const model::PartsWarning& warning : model.partsWarnings)
    {
      warn(textOf(warning, source.scene, surfaces));
    }
  }
  progress.report(1.0, "File read");
  return source;
}
