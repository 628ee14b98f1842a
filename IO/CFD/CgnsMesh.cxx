// SPDX-License-Identifier: GPL-3.0-or-later
#include "CgnsMesh.h"

#include "OutputFolders.h"
#include "Support/Error.h"

#include <cgnslib.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace atria {

namespace {

void check(int status)
{
  if (status != CG_OK)
  {
    throw Error(std::string("libcgns: ") + cg_get_error());
  }
}

/// A file with one base of one zone. The destructor closes it.
class CgnsFile
{
public:
  explicit CgnsFile(const std::filesystem::path& path)
  {
    check(cg_set_file_type(CG_FILE_HDF5));
    check(cg_open(path.c_str(), CG_MODE_WRITE, &file));
    isOpen = true;
    check(cg_base_write(file, "Base", 3, 3, &base));
    check(cg_goto(file, base, "end"));
    check(cg_dataclass_write(CGNS_ENUMV(Dimensional)));
    check(cg_units_write(CGNS_ENUMV(Kilogram), CGNS_ENUMV(Meter), CGNS_ENUMV(Second), CGNS_ENUMV(Kelvin),
                         CGNS_ENUMV(Radian)));
  }
  ~CgnsFile()
  {
    if (isOpen)
    {
      cg_close(file);
    }
  }
  CgnsFile(const CgnsFile&) = delete;
  CgnsFile& operator=(const CgnsFile&) = delete;

  void writeZone(std::size_t points, std::size_t cells)
  {
    const std::array<cgsize_t, 3> size{static_cast<cgsize_t>(points), static_cast<cgsize_t>(cells), 0};
    check(cg_zone_write(file, base, "Zone", size.data(), CGNS_ENUMV(Unstructured), &zone));
  }

  void writeCoordinate(const char* name, const std::vector<double>& values) const
  {
    constexpr std::array<double, 5> length{0.0, 1.0, 0.0, 0.0, 0.0}; // exponents of mass, length, time …
    int index = 0;
    check(cg_coord_write(file, base, zone, CGNS_ENUMV(RealDouble), name, values.data(), &index));
    check(cg_goto(file, base, "Zone_t", zone, "GridCoordinates_t", 1, name, 0, "end"));
    check(cg_exponents_write(CGNS_ENUMV(RealDouble), length.data()));
  }

  /// Writes a section of elements with consecutive numbers from `first` on.
  int writeSection(const char* name, CGNS_ENUMT(ElementType_t) type, std::size_t first,
                   const std::vector<cgsize_t>& elements, const std::vector<cgsize_t>& offsets) const
  {
    int index = 0;
    const auto last = static_cast<cgsize_t>(first + offsets.size() - 2);
    check(cg_poly_section_write(file, base, zone, name, type, static_cast<cgsize_t>(first), last, 0, elements.data(),
                                offsets.data(), &index));
    return index;
  }

  void writeParents(int section, const std::vector<cgsize_t>& parents) const
  {
    check(cg_parent_data_write(file, base, zone, section, parents.data()));
  }

  /// Writes a family, which states the type of a boundary condition.
  void writeFamily(const std::string& name, CGNS_ENUMT(BCType_t) type, const std::string& original) const
  {
    int family = 0;
    int condition = 0;
    check(cg_family_write(file, base, name.c_str(), &family));
    check(cg_fambc_write(file, base, family, "FamBC", type, &condition));
    check(cg_goto(file, base, "Family_t", family, "end"));
    check(cg_descriptor_write("OriginalName", original.c_str()));
  }

  /// Writes the faces [first, first + count) of a patch, with its family, and with that of its group if it has one.
  void writeBoundary(const PatchName& name, std::size_t first, std::size_t count) const
  {
    int condition = 0;
    const std::array<cgsize_t, 2> range{static_cast<cgsize_t>(first), static_cast<cgsize_t>(first + count - 1)};
    check(cg_boco_write(file, base, zone, name.word.c_str(), CGNS_ENUMV(FamilySpecified), CGNS_ENUMV(PointRange), 2,
                        range.data(), &condition));
    check(cg_boco_gridlocation_write(file, base, zone, condition, CGNS_ENUMV(FaceCenter)));
    check(cg_goto(file, base, "Zone_t", zone, "ZoneBC_t", 1, "BC_t", condition, "end"));
    check(cg_famname_write(name.word.c_str()));
    if (!name.group.empty())
    {
      check(cg_multifam_write("Sheet", name.group.c_str()));
    }
  }

  void writeRegion(const std::string& name, const std::string& original, const std::vector<cgsize_t>& cells) const
  {
    int region = 0;
    check(cg_subreg_ptset_write(file, base, zone, name.c_str(), 3, CGNS_ENUMV(CellCenter), CGNS_ENUMV(PointList),
                                static_cast<cgsize_t>(cells.size()), cells.data(), &region));
    check(cg_goto(file, base, "Zone_t", zone, "ZoneSubRegion_t", region, "end"));
    check(cg_descriptor_write("OriginalName", original.c_str()));
  }

  void close()
  {
    isOpen = false;
    check(cg_close(file));
  }

private:
  int file = 0;
  int base = 0;
  int zone = 0;
  bool isOpen = false;
};

void checkIndices(const FaceMesh& mesh)
{
  constexpr std::size_t most = std::numeric_limits<cgsize_t>::max();
  const std::size_t cellFaces = mesh.faceCount() + mesh.internalFaceCount();
  if (mesh.facePoints.size() > most || cellFaces + mesh.cellCount > most || 4 * mesh.faceCount() > most)
  {
    throw Error("the mesh is too large for the indices of libcgns");
  }
}

void writePoints(const CgnsFile& file, const FaceMesh& mesh)
{
  constexpr std::array<const char*, 3> names{"CoordinateX", "CoordinateY", "CoordinateZ"};
  std::vector<double> values(mesh.points.size());
  for (int axis = 0; axis < 3; ++axis)
  {
    std::ranges::transform(mesh.points, values.begin(), [&](const Vec3& p) { return p[axis]; });
    file.writeCoordinate(names[static_cast<std::size_t>(axis)], values);
  }
}

/// Returns the elements of each face's two cells, owners first, 0 on the boundary; then the face's place among the
/// faces of each cell.
std::vector<cgsize_t> parentsOf(const FaceMesh& mesh, const CellFaces& cellFaces)
{
  const std::size_t count = mesh.faceCount();
  std::vector<cgsize_t> parents(4 * count, 0);
  for (std::size_t cell = 0; cell < mesh.cellCount; ++cell)
  {
    const auto faces = cellFaces.of(cell);
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
      const std::size_t side = mesh.owner[faces[i]] == cell ? 0 : 1;
      parents[side * count + faces[i]] = static_cast<cgsize_t>(count + cell + 1);
      parents[(2 + side) * count + faces[i]] = static_cast<cgsize_t>(i + 1);
    }
  }
  return parents;
}

void writeFaces(const CgnsFile& file, const FaceMesh& mesh, const CellFaces& cellFaces)
{
  std::vector<cgsize_t> corners(mesh.facePoints.size());
  std::ranges::transform(mesh.facePoints, corners.begin(), [](Index p) { return static_cast<cgsize_t>(p) + 1; });
  const std::vector<cgsize_t> offsets(mesh.faceOffsets.begin(), mesh.faceOffsets.end());
  const int section = file.writeSection("Faces", CGNS_ENUMV(NGON_n), 1, corners, offsets);
  file.writeParents(section, parentsOf(mesh, cellFaces));
}

/// Writes each cell's faces by number, negative if their normals point into the cell.
void writeCells(const CgnsFile& file, const FaceMesh& mesh, const CellFaces& cellFaces)
{
  std::vector<cgsize_t> faces(cellFaces.entries.size());
  for (std::size_t cell = 0; cell < mesh.cellCount; ++cell)
  {
    for (std::size_t i = cellFaces.offsets[cell]; i < cellFaces.offsets[cell + 1]; ++i)
    {
      const Index face = cellFaces.entries[i];
      const auto number = static_cast<cgsize_t>(face) + 1;
      faces[i] = mesh.owner[face] == cell ? number : -number;
    }
  }
  const std::vector<cgsize_t> offsets(cellFaces.offsets.begin(), cellFaces.offsets.end());
  file.writeSection("Cells", CGNS_ENUMV(NFACE_n), mesh.faceCount() + 1, faces, offsets);
}

void writePatches(const CgnsFile& file, const SolverMesh& mesh)
{
  const std::vector<PatchName> names = namesOf(mesh.patches, cgnsNames);
  std::vector<std::string> groups;
  for (std::size_t p = 0; p < names.size(); ++p)
  {
    const SolverPatch& patch = mesh.patches[p];
    const auto type = patch.isWall() ? CGNS_ENUMV(BCWall) : CGNS_ENUMV(BCGeneral);
    if (patch.faceCount == 0)
    {
      continue;
    }
    file.writeFamily(names[p].word, type, patch.name);
    if (const std::string& group = names[p].group; !group.empty() && std::ranges::find(groups, group) == groups.end())
    {
      groups.push_back(group);
      file.writeFamily(group, type, group);
    }
    file.writeBoundary(names[p], patch.firstFace + 1, patch.faceCount);
  }
}

/// Writes zones of cells. Face zones are left out: cgnscheck takes faces inside the mesh for cells.
void writeZones(const CgnsFile& file, const SolverMesh& mesh)
{
  std::vector<std::string> names{"Faces", "Cells", "GridCoordinates", "ZoneBC", "ZoneType"}; // names already used
  const auto taken = static_cast<std::ptrdiff_t>(names.size());
  std::ranges::transform(mesh.cellZones, std::back_inserter(names), &CellZone::name);
  const std::vector<PatchName> words = makePatchNames(names, cgnsNames);
  auto word = words.begin() + taken;
  for (const CellZone& zone : mesh.cellZones)
  {
    std::vector<cgsize_t> elements(zone.cells.size());
    std::ranges::transform(zone.cells, elements.begin(),
                           [&](Index cell) { return static_cast<cgsize_t>(mesh.mesh.faceCount() + cell + 1); });
    file.writeRegion((word++)->word, zone.name, elements);
  }
}

} // namespace

bool cgnsIsAvailable() { return true; }

void writeCgnsMesh(const std::filesystem::path& file, const SolverMesh& mesh, const RunContext& context)
{
  checkIndices(mesh.mesh);
  writeInPlace(file, [&](const std::filesystem::path& place) {
    CgnsFile cgns(place);
    cgns.writeZone(mesh.mesh.points.size(), mesh.mesh.cellCount);
    context.progress.report(0.1, "Writing points");
    writePoints(cgns, mesh.mesh);
    const CellFaces cellFaces = makeCellFaces(mesh.mesh);
    context.progress.report(0.3, "Writing faces");
    writeFaces(cgns, mesh.mesh, cellFaces);
    context.progress.report(0.6, "Writing cells");
    writeCells(cgns, mesh.mesh, cellFaces);
    context.progress.report(0.9, "Writing patches");
    writePatches(cgns, mesh);
    writeZones(cgns, mesh);
    cgns.close();
    context.progress.report(1.0, "File written");
  });
}

} // namespace atria
