// SPDX-License-Identifier: GPL-3.0-or-later
#include "GmshMesh.h"

#include "GmshEntities.h"
#include "OutputFile.h"
#include "OutputFolders.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace atria {

namespace {

/// Types of elements, in the order in which they are written.
struct GmshType
{
  CellType cell;
  int number;
};
constexpr GmshType volumeTypes[] = {{hexahedronCell, 5}, {wedgeCell, 6}, {pyramidCell, 7}, {tetrahedronCell, 4}};
/// Number of corners, number of the type.
constexpr int surfaceTypes[][2] = {{4, 3}, {3, 2}};

class GmshWriter
{
public:
  GmshWriter(const std::filesystem::path& path, const ElementMesh& source, const ProgressRange& range)
      : mesh(source), faces(source.mesh.mesh), entities(gmshEntitiesOf(source)), file(path, &range)
  {
  }

  void write()
  {
    file.text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    writeNames();
    writeEntities();
    writeNodes();
    writeElements();
    writeOriginals();
    file.close();
  }

private:
  GmshWriter& integer(std::size_t value)
  {
    file.number(static_cast<std::int64_t>(value)).text(" ");
    return *this;
  }

  void endLine() { file.text("\n"); }

  void writeNames()
  {
    file.text("$PhysicalNames\n");
    file.number(static_cast<std::int64_t>(entities.groups.size())).text("\n");
    for (const GmshGroup& group : entities.groups)
    {
      integer(static_cast<std::size_t>(group.dimension)).integer(group.tag);
      file.text("\"").text(group.word).text("\"\n");
    }
    file.text("$EndPhysicalNames\n");
  }

  void writeEntities()
  {
    file.text("$Entities\n0 0 ");
    integer(entities.surfaces.size()).integer(entities.volumes.size()).endLine();
    for (const std::vector<GmshEntity>* list : {&entities.surfaces, &entities.volumes})
    {
      for (std::size_t i = 0; i < list->size(); ++i)
      {
        writeEntity(i + 1, (*list)[i]);
      }
    }
    file.text("$EndEntities\n");
  }

  void writeEntity(std::size_t tag, const GmshEntity& entity)
  {
    integer(tag);
    for (const Vec3* corner : {&entity.low, &entity.high})
    {
      file.number((*corner)[0]).text(" ").number((*corner)[1]).text(" ").number((*corner)[2]).text(" ");
    }
    for (const std::vector<Index>* tags : {&entity.groups, &entity.bounds})
    {
      integer(tags->size());
      std::ranges::for_each(*tags, [&](Index own) { integer(own); });
    }
    endLine();
  }

  /// Numbers points in the order in which entities have them.
  void writeNodes()
  {
    file.text("$Nodes\n");
    const std::size_t count = faces.points.size();
    const auto hasPoints = [](const GmshEntity& entity) { return !entity.points.empty(); };
    integer(static_cast<std::size_t>(std::ranges::count_if(entities.surfaces, hasPoints) +
                                     std::ranges::count_if(entities.volumes, hasPoints)));
    integer(count).integer(1).integer(count).endLine();
    numberOf.resize(count);
    std::size_t written = 0;
    for (const std::vector<GmshEntity>* list : {&entities.surfaces, &entities.volumes})
    {
      for (std::size_t i = 0; i < list->size(); ++i)
      {
        if (hasPoints((*list)[i]))
        {
          integer(list == &entities.surfaces ? 2 : 3).integer(i + 1).integer(0).integer((*list)[i].points.size());
          endLine();
          writePoints((*list)[i].points, written);
        }
      }
    }
    file.text("$EndNodes\n");
  }

  void writePoints(const std::vector<Index>& points, std::size_t& written)
  {
    for (const Index p : points)
    {
      numberOf[p] = static_cast<Index>(++written);
      file.number(std::int64_t{numberOf[p]}).text("\n");
    }
    std::size_t place = written - points.size();
    for (const Index p : points)
    {
      file.report(0.0, 0.4, place++, faces.points.size(), "Writing points");
      const Vec3& x = faces.points[p];
      file.number(x[0]).text(" ").number(x[1]).text(" ").number(x[2]).text("\n");
    }
  }

  /// Elements of one entity and type.
  struct Block
  {
    int dimension;
    std::size_t entity;
    int type;
    std::vector<Index> members; ///< faces or cells
  };

  std::vector<Block> blocksOfElements() const
  {
    std::vector<Block> blocks;
    const auto add = [&](int dimension, std::size_t entity, int type, const std::vector<Index>& from, auto&& isOf) {
      Block block{dimension, entity + 1, type, {}};
      std::ranges::copy_if(from, std::back_inserter(block.members), isOf);
      if (!block.members.empty())
      {
        blocks.push_back(std::move(block));
      }
    };
    for (std::size_t s = 0; s < entities.surfaces.size(); ++s)
    {
      for (const auto& [corners, number] : surfaceTypes)
      {
        add(2, s, number, entities.surfaces[s].members,
            [&, n = static_cast<std::size_t>(corners)](Index face) { return faces.face(face).size() == n; });
      }
    }
    for (std::size_t v = 0; v < entities.volumes.size(); ++v)
    {
      for (const GmshType& type : volumeTypes)
      {
        add(3, v, type.number, entities.volumes[v].members,
            [&](Index cell) { return mesh.elements.types[cell] == type.cell; });
      }
    }
    return blocks;
  }

  void writeElements()
  {
    const std::vector<Block> blocks = blocksOfElements();
    std::size_t count = 0;
    std::ranges::for_each(blocks, [&](const Block& block) { count += block.members.size(); });
    file.text("$Elements\n");
    integer(blocks.size()).integer(count).integer(1).integer(count).endLine();
    std::size_t written = 0;
    for (const Block& block : blocks)
    {
      integer(static_cast<std::size_t>(block.dimension)).integer(block.entity);
      integer(static_cast<std::size_t>(block.type)).integer(block.members.size()).endLine();
      for (const Index member : block.members)
      {
        file.report(0.4, 1.0, written, count, "Writing elements");
        integer(++written);
        if (block.dimension == 2)
        {
          writeFace(member);
        }
        else
        {
          writeCell(member);
        }
        endLine();
      }
    }
    file.text("$EndElements\n");
  }

  void writeFace(Index face)
  {
    for (const Index p : faces.face(face))
    {
      integer(numberOf[p]);
    }
  }

  void writeCell(Index cell)
  {
    const auto corners = mesh.elements.cornersOf(cell);
    for (const std::uint8_t i : standardOrder(mesh.elements.types[cell]))
    {
      integer(numberOf[corners[i]]);
    }
  }

  void writeOriginals()
  {
    if (std::ranges::all_of(entities.groups, [](const GmshGroup& group) { return group.word == group.name; }))
    {
      return;
    }
    file.text("$Comments\n");
    for (const GmshGroup& group : entities.groups)
    {
      if (group.word != group.name)
      {
        file.text(group.word).text(": \"").text(inOneLine(group.name)).text("\"\n");
      }
    }
    file.text("$EndComments\n");
  }

  const ElementMesh& mesh;
  const FaceMesh& faces;
  const GmshEntities entities;
  OutputFile file;
  std::vector<Index> numberOf; ///< in the file, one per point
};

} // namespace

void writeGmshMesh(const std::filesystem::path& file, const ElementMesh& mesh, const RunContext& context)
{
  writeInPlace(file, [&](const std::filesystem::path& place) { GmshWriter(place, mesh, context.progress).write(); });
}

} // namespace atria
