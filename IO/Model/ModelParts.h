// SPDX-License-Identifier: GPL-3.0-or-later
/// What a file of any format is read as, and what its readers share.
#pragma once

#include <vtkSmartPointer.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace atria::model {

/// What becomes one surface. `name` is what the file calls it, or what it belongs to.
struct Part
{
  std::string name;
  std::string material;  ///< empty where it has none
  std::size_t owner = 0; ///< the object or node it is part of; several parts of one owner are told apart by material
};

/// A node of a tree that parts are in: a part's owner is the place of its node in Model::groups.
struct PartGroup
{
  std::string name;                       ///< empty where it has none
  std::optional<std::size_t> parent = {}; ///< an earlier one
};

/// A warning of parts, behind which their names follow.
struct PartsWarning
{
  std::string text;
  struct Member
  {
    std::optional<std::size_t> group; ///< its first surface is that of this node; nothing where it has no surface
    std::string name;                 ///< what it is called without
  };
  std::vector<Member> members;
};

/// A model as polygons of named surfaces, as surfaceFromVtk takes it: polydata with SurfaceId and SurfaceName, or a
/// composite whose blocks have names.
struct Model
{
  vtkSmartPointer<vtkDataObject> data;
  std::map<std::string, Part> parts; ///< by name of the surface; those of which nothing more is known are left out
  std::vector<PartGroup> groups;     ///< where the format has them: parts of one name are then told apart by these
  std::vector<std::string> warnings; ///< without the file's name
  std::vector<PartsWarning> partsWarnings;
  std::vector<std::string> notes;           ///< what was done that nobody need worry about
  std::string head;                         ///< the first characters of a text file, where programs say who they are
  int upAxis = 2;                           ///< 1 y, 2 z
  bool unitKnown = false;                   ///< lengths are meters, as the format or the file says
  bool unitConverted = false;               ///< they were something else in the file
  bool axisKnown = false;                   ///< the format or the file says what is up
  std::vector<std::string> groundNames;     ///< beginnings of parts' names that say ground
  std::vector<std::string> groundMaterials; ///< materials that do
  bool singlePrecision = false;             ///< coordinates went through 32 bits on the way
};

/// The parts' names, made unique: `Wall`; `Wall_Brick` and `Wall_Glass` where an owner has several parts of different
/// materials; `Wall`, `Wall_2` where names repeat. A part without a name is called `fallback`.
std::vector<std::string> uniqueNames(const std::vector<Part>& parts, const std::string& fallback);

/// `Wall_Brick` and `Wall_Glass` where an owner has several parts of different materials. A part without a name is
/// called `fallback`. Names may repeat.
std::vector<std::string> namesByMaterial(const std::vector<Part>& parts, const std::string& fallback);

/// Gives `model` parts of a tree, whose names may repeat, under their numbers; returns these as names of surfaces.
std::vector<std::string> keepTree(Model& model, const std::vector<Part>& parts);

/// Gives `model` the parts under these names.
void keepParts(Model& model, const std::vector<Part>& parts, const std::vector<std::string>& names);

/// The name of a file without folder and ending, for surfaces that have no name.
std::string stemOf(const std::string& file);

/// The ending of a file's name, such as .obj, in small letters.
std::string lowerEnding(const std::string& file);

/// Polydata with the cell array SurfaceId and the field array SurfaceName, as the filters take it.
void setSurfaces(vtkPolyData* data, const std::vector<int>& ids, const std::vector<std::string>& names);

/// The first characters of a text; empty where the bytes are none.
std::string headOf(const std::string& bytes);

/// Throws Error where `file` cannot be read; else its bytes.
std::string readBytes(const std::string& file);

} // namespace atria::model
