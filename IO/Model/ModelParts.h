// SPDX-License-Identifier: GPL-3.0-or-later
/// The model that files of all formats become, and functions that their readers share.
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

/// A part of the file that becomes one surface. `name` is its name in the file, or that of its object.
struct Part
{
  std::string name;
  std::string material;  ///< empty where it has none
  std::size_t owner = 0; ///< the object or node it is part of; material distinguishes parts of one owner
};

/// A node of a tree that parts are in: a part's owner is the index of its node in Model::groups.
struct PartGroup
{
  std::string name;                       ///< empty where it has none
  std::optional<std::size_t> parent = {}; ///< an earlier one
};

/// A warning about parts, followed by their names.
struct PartsWarning
{
  std::string text;
  struct Member
  {
    std::optional<std::size_t> group; ///< node of its first surface; nothing if it has no surface
    std::string name;                 ///< its name if it has no surface
  };
  std::vector<Member> members;
};

/// A model as polygons of named surfaces, as surfaceFromVtk takes it: polydata with SurfaceId and SurfaceName, or a
/// composite whose blocks have names.
struct Model
{
  vtkSmartPointer<vtkDataObject> data;
  std::map<std::string, Part> parts; ///< keyed by surface name; those of which nothing more is known are left out
  std::vector<PartGroup> groups;     ///< nodes of formats with a tree; they distinguish parts of one name
  std::vector<std::string> warnings; ///< without the file's name
  std::vector<PartsWarning> partsWarnings;
  std::vector<std::string> notes;           ///< actions that need no attention
  std::string head;                         ///< first characters of a text file, where programs name themselves
  int upAxis = 2;                           ///< 1 y, 2 z
  bool unitKnown = false;                   ///< lengths are meters by the format or the file
  bool unitConverted = false;               ///< lengths had another unit in the file
  bool axisKnown = false;                   ///< the up axis follows from the format or the file
  std::vector<std::string> groundNames;     ///< beginnings of parts' names that mean ground
  std::vector<std::string> groundMaterials; ///< materials that mean ground
  bool singlePrecision = false;             ///< coordinates went through 32 bits on the way
};

/// Returns the parts' names, made unique: `Wall`; `Wall_Brick` and `Wall_Glass` if an owner has several parts of
/// different materials; `Wall`, `Wall_2` if names repeat. A part without a name is called `fallback`.
std::vector<std::string> uniqueNames(const std::vector<Part>& parts, const std::string& fallback);

/// Returns `Wall_Brick` and `Wall_Glass` if an owner has several parts of different materials. A part without a name is
/// called `fallback`. Names may repeat.
std::vector<std::string> namesByMaterial(const std::vector<Part>& parts, const std::string& fallback);

/// Gives `model` parts of a tree, whose names may repeat, under their numbers. Returns the numbers as names of
/// surfaces.
std::vector<std::string> keepTree(Model& model, const std::vector<Part>& parts);

/// Gives `model` the parts under these names.
void keepParts(Model& model, const std::vector<Part>& parts, const std::vector<std::string>& names);

/// Returns the name of a file without folder and ending, for surfaces that have no name.
std::string stemOf(const std::string& file);

/// Returns the ending of a file's name, such as .obj, in small letters.
std::string lowerEnding(const std::string& file);

/// Sets the cell array SurfaceId and the field array SurfaceName of polydata, as the filters take them.
void setSurfaces(vtkPolyData* data, const std::vector<int>& ids, const std::vector<std::string>& names);

/// Returns the first characters of a text; empty if the bytes are none.
std::string headOf(const std::string& bytes);

/// Returns the bytes of a file. Throws Error if `file` cannot be read.
std::string readBytes(const std::string& file);

} // namespace atria::model
