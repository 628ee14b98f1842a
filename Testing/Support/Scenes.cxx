// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/Scenes.h"

#include "Support/Cities.h"
#include "Support/SceneParts.h"

#include <Eigen/Geometry>

#include <cmath>
#include <optional>

namespace atria::testing {

namespace {

/// Houses on bases at different heights above the lowest, some without a bottom, and a cellar.
Scene bases(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  scene.options.site.mode = DomainMode::automatic;
  scene.options.sizes.sizeMax = 8.0;
  const double ground = draw.length(-3.0, 3.0);
  for (int i = 0; i < 3; ++i)
  {
    // The ground is at the base of the first, as the others together are not much larger.
    const Vec3 size(i == 0 ? draw.length(6, 7) : draw.length(4, 5), draw.length(4, 5), draw.length(4, 6));
    const double base = ground + (i == 0 ? 0.0 : draw.length(0.2, 0.9));
    const Box3 house = standing(10.0 * i, 0.0, size, base);
    const std::string name = "House" + std::to_string(i);
    addStanding(scene, name, house, ground);
    if (draw.chance())
    {
      // The bottom is the last side but one.
      TriangleSurface& surface = scene.surface;
      surface.triangles.erase(surface.triangles.end() - 4, surface.triangles.end() - 2);
      surface.surfaceIds.resize(surface.triangles.size());
    }
  }
  if (draw.chance())
  {
    const double depth = draw.length(1.0, 2.0);
    const Vec3 size(draw.length(2, 3), draw.length(2, 3), depth + draw.length(3, 5));
    addStanding(scene, "Cellar", standing(0.0, 10.0, size, ground - depth), ground);
  }
  return scene;
}

/// Windows, a door and a skylight as faces on walls that are not cut. The house is a box, or a surface by wall.
Scene panes(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const Vec3 size(draw.length(5, 7), draw.length(4, 6), draw.length(4, 6));
  const Box3 house = standing(0, 0, size);
  const Vec3 x(size[0], 0, 0), y(0, size[1], 0), z(0, 0, size[2]);
  const std::array<std::string, 5> sides{"South", "East", "North", "West", "Roof"};
  const std::array<std::array<Vec3, 3>, 5> frames{{{house.min, x, z},
                                                   {house.min + x, y, z},
                                                   {house.max - z, -x, z},
                                                   {house.min + y, -y, z},
                                                   {house.min + z, x, y}}};
  const bool isBox = draw.chance();
  if (isBox)
  {
    addBox(scene.surface, "House", house);
  }
  std::array<std::string, 5> names;
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    const auto& [corner, u, v] = frames[i];
    names[i] = isBox ? "House" : sides[i];
    scene.areas[names[i]] += u.norm() * v.norm();
    if (!isBox)
    {
      addSheet(scene.surface, names[i], corner, u, v);
    }
  }
  scene.displaced = size.prod();
  scene.footprint = floorOf(size);
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    const auto& [corner, u, v] = frames[i];
    const Vec3 along = u.normalized();
    const Vec3 up = v.normalized();
    const double width = draw.length(1.0, 1.5);
    const double sill = i == 0 ? 0.0 : draw.length(1.0, 1.5);
    addPane(scene, draw, (i == 0 ? "Door" : "Window") + sides[i], names[i],
            corner + draw.length(0.5, 1.0) * along + sill * up, width * along, draw.length(1.0, 2.0) * up);
    if (i < 4 && draw.chance())
    {
      addPane(scene, draw, "Second" + sides[i], names[i], corner + draw.length(2.75, 3.0) * along + 1.0 * up,
              draw.length(0.75, 1.0) * along, draw.length(1.0, 2.0) * up);
    }
  }
  scene.surface = draw.shuffled(scene.surface);
  return scene;
}

/// Rooms in a row in a solid.
Scene rooms(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = indoors();
  const int count = draw.count(1, 3);
  const double thickness = draw.length(0.25, 0.5);
  const double depth = draw.length(3.0, 4.0);
  const double height = draw.length(2.25, 2.75);
  std::vector<Box3> boxes;
  double x = thickness;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 low(x, thickness, thickness);
    const Vec3 size(draw.length(2.0, 3.0), depth, height);
    boxes.push_back({low, low + size});
    scene.roomVolume += size.prod();
    x += size[0] + thickness;
  }
  const Box3 outside{Vec3::Zero(), Vec3(x, depth + 2.0 * thickness, height + 2.0 * thickness)};
  addBox(scene.surface, "Outside", outside);
  // Rooms that are smaller than the walls around them are told by their winding alone.
  const bool isWoundWell = draw.chance() || scene.roomVolume < 0.55 * outside.size().prod();
  for (const Box3& box : boxes)
  {
    const std::string name = "Room" + std::to_string(scene.surface.names.size());
    addBox(scene.surface, name, box);
    if (isWoundWell)
    {
      flipLast(scene.surface);
    }
    scene.areas[name] = wallsOf(box.size()) + 2.0 * floorOf(box.size());
  }
  scene.surface = draw.shuffled(scene.surface);
  return scene;
}

/// A room with thick walls, a wardrobe and a shelf partly in these, and a table on one leg.
Scene furniture(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = indoors();
  const double thickness = draw.length(0.25, 0.4);
  const Vec3 size(draw.length(4, 5), draw.length(3, 4), draw.length(2.5, 3));
  const Box3 room{Vec3::Zero(), size};
  addBox(scene.surface, "Outside", {room.min.array() - thickness, room.max.array() + thickness});
  addBox(scene.surface, "Inside", room);
  flipLast(scene.surface);
  double& inside = scene.areas["Inside"];
  inside = wallsOf(size) + 2.0 * floorOf(size);
  scene.roomVolume = size.prod();

  // Against the wall at x = 0.
  const Vec3 wardrobe(draw.length(0.5, 0.75), draw.length(1.0, 1.5), draw.length(1.5, 2.0));
  addBox(scene.surface, "Wardrobe", {Vec3(-0.5 * thickness, 0.5, 0.0), Vec3(0.0, 0.5, 0.0) + wardrobe});
  scene.areas["Wardrobe"] = wallsOf(wardrobe) + floorOf(wardrobe) - wardrobe[1] * wardrobe[2];
  inside -= floorOf(wardrobe) + wardrobe[1] * wardrobe[2];
  scene.roomVolume -= wardrobe.prod();

  // Against the wall at x = size[0].
  const Vec3 shelf(draw.length(0.5, 0.75), draw.length(1.0, 2.0), draw.length(0.5, 0.75));
  addBox(scene.surface, "Shelf",
         {Vec3(size[0] - shelf[0], 0.5, 1.0), Vec3(size[0] + 0.5 * thickness, 0.5 + shelf[1], 1.0 + shelf[2])});
  scene.areas["Shelf"] = wallsOf(shelf) + 2.0 * floorOf(shelf) - shelf[1] * shelf[2];
  inside -= shelf[1] * shelf[2];
  scene.roomVolume -= shelf.prod();

  const Vec3 leg(draw.length(0.5, 0.75), draw.length(0.5, 0.75), draw.length(0.5, 0.75));
  const Vec3 top(draw.length(1.0, 1.25), draw.length(1.25, 1.5), draw.length(0.3, 0.5));
  addBox(scene.surface, "Leg", standing(0.5 * size[0], 0.5 * size[1], leg));
  addBox(scene.surface, "Top", standing(0.5 * size[0], 0.5 * size[1], top, leg[2]));
  scene.areas["Leg"] = wallsOf(leg);
  scene.areas["Top"] = wallsOf(top) + 2.0 * floorOf(top) - floorOf(leg);
  inside -= floorOf(leg);
  scene.roomVolume -= leg.prod() + top.prod();
  return scene;
}

/// A house with a bay and a balcony that go into it.
Scene builtIn(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const Vec3 house(draw.length(5, 7), draw.length(4, 6), draw.length(5, 6));
  addStanding(scene, "House", standing(0, 0, house));
  const double south = -0.5 * house[1];

  const Vec3 bay(draw.length(1.5, 2.0), draw.length(1.0, 1.5), draw.length(2, 3));
  addBox(scene.surface, "Bay",
         {Vec3(-2.0, south - bay[1], 0.0), Vec3(-2.0 + bay[0], south + draw.length(0.2, 1.5), bay[2])});
  scene.areas["Bay"] = wallsOf(bay) + floorOf(bay) - bay[0] * bay[2];
  scene.areas["House"] -= bay[0] * bay[2];
  scene.displaced += bay.prod();
  scene.footprint += floorOf(bay);

  const Vec3 balcony(draw.length(1.5, 2.0), draw.length(1.0, 1.5), draw.length(0.75, 1.0));
  addBox(scene.surface, "Balcony",
         {Vec3(0.5, south - balcony[1], 3.0), Vec3(0.5 + balcony[0], south + draw.length(0.2, 1.5), 3.0 + balcony[2])});
  scene.areas["Balcony"] = wallsOf(balcony) + 2.0 * floorOf(balcony) - balcony[0] * balcony[2];
  scene.areas["House"] -= balcony[0] * balcony[2];
  scene.displaced += balcony.prod();
  return scene;
}

/// A house that reaches below the ground beside one that does not.
Scene cellars(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const Vec3 plain(draw.length(3, 4), draw.length(4, 6), draw.length(4, 6));
  addStanding(scene, "House", standing(-4, 0, plain));
  const double depth = draw.length(1, 3);
  const Vec3 deep(draw.length(3, 4), draw.length(4, 6), depth + draw.length(4, 6));
  addStanding(scene, "Deep", standing(4, 0, deep, -depth));
  return scene;
}

/// A solid that is a flight of terraces.
Scene terraces(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const double depth = draw.length(4, 6);
  const int count = draw.count(2, 4);
  const Vec3 foot(-5, -0.5 * depth, 0);
  std::vector<Eigen::Vector2d> profile{{foot[0], 0.0}};
  double x = 0.0;
  double height = draw.length(5, 6);
  double& area = scene.areas["Terraces"];
  for (int i = 0; i < count; ++i)
  {
    const double width = draw.length(1.5, 2.5);
    profile.insert(profile.begin() + 1, {{foot[0] + x + width, height}, {foot[0] + x, height}});
    x += width;
    area += width * depth + 2.0 * width * height;
    scene.displaced += width * height * depth;
    if (i == 0)
    {
      area += 2.0 * height * depth; // the high side, and all risers together
    }
    height -= draw.length(0.75, 1.5);
  }
  profile.insert(profile.begin() + 1, {foot[0] + x, 0.0});
  addProfile(scene.surface, "Terraces", profile, foot[1], depth);
  scene.footprint = x * depth;
  return scene;
}

/// A house on a slab.
Scene slabs(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const Vec3 slab(draw.length(8, 10), draw.length(7, 9), draw.length(0.5, 1.5));
  addStanding(scene, "Slab", standing(0, 0, slab));
  const Vec3 house(draw.length(4, 6), draw.length(4, 5), draw.length(3, 5));
  addBox(scene.surface, "House", standing(0.5, -0.5, house, slab[2]));
  scene.areas["House"] = wallsOf(house) + floorOf(house);
  scene.areas["Slab"] -= floorOf(house);
  scene.displaced += house.prod();
  scene.surface = draw.shuffled(scene.surface);
  return scene;
}

/// A house around a court.
Scene courtyards(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const Vec3 size(draw.length(8, 10), draw.length(7, 9), draw.length(4, 6));
  const Vec3 court(draw.length(2.5, 4), draw.length(2.5, 4), size[2]);
  addRing(scene.surface, "Ring", standing(0, 0, size), standing(draw.length(-0.5, 0.5), draw.length(-0.5, 0.5), court));
  scene.areas["Ring"] = wallsOf(size) + wallsOf(court) + floorOf(size) - floorOf(court);
  scene.displaced = size.prod() - court.prod();
  scene.footprint = floorOf(size) - floorOf(court);
  return scene;
}

/// A house around a closed void.
Scene atria(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const Vec3 size(draw.length(6, 8), draw.length(6, 8), draw.length(5, 6));
  addStanding(scene, "House", standing(0, 0, size));
  const Vec3 hollow(draw.length(2, 4), draw.length(2, 4), draw.length(2, 3));
  addBox(scene.surface, "Void", standing(draw.length(-0.5, 0.5), draw.length(-0.5, 0.5), hollow, draw.length(0.5, 1)));
  if (draw.chance())
  {
    flipLast(scene.surface);
  }
  return scene;
}

/// Houses of unequal height whose walls coincide; in half of them fronts are in one plane.
Scene rows(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const int count = draw.count(2, 4);
  const bool isStaggered = draw.chance();
  const double depth = draw.length(4, 6);
  double x = -6.0;
  std::optional<Box3> before;
  for (int i = 0; i < count; ++i)
  {
    const double front = -0.5 * depth + (isStaggered ? draw.length(-1, 1) : 0.0);
    const Vec3 size(draw.length(2.5, 3.5), isStaggered ? draw.length(4, 6) : depth, draw.length(3, 6));
    const Vec3 low(x, front, 0.0);
    const Box3 house{low, low + size};
    const std::string name = "House" + std::to_string(i);
    addStanding(scene, name, house);
    if (before)
    {
      const Vec3 shared = before->max.cwiseMin(house.max) - before->min.cwiseMax(house.min);
      scene.areas[name] -= shared[1] * shared[2];
      scene.areas["House" + std::to_string(i - 1)] -= shared[1] * shared[2];
    }
    before = house;
    x = house.max[0];
  }
  scene.surface = draw.shuffled(scene.surface);
  return scene;
}

/// Walls without thickness: one that stands alone, two that meet, and one off the ground.
Scene freeWalls(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const auto add = [&](const std::string& name, const Vec3& corner, const Vec3& u, double height) {
    addSheet(scene.surface, name, corner, u, Vec3(0, 0, height));
    scene.areas[name] = 2.0 * u.norm() * height;
    scene.sheets.insert(name);
  };
  add("Alone", Vec3(-3, -4, 0), Vec3(draw.length(3, 6), draw.length(-1, 1), 0), draw.length(2, 4));
  const double height = draw.length(2, 4);
  const Vec3 corner(draw.length(-1, 0), 0, 0);
  add("First", corner, Vec3(draw.length(2, 4), 0, 0), height);
  add("Second", corner, Vec3(0, draw.length(2, 4), 0), height);
  add("Sign", Vec3(-5, 0, draw.length(1, 2)), Vec3(draw.length(-1, 1), draw.length(2, 3), 0), draw.length(1, 2));
  return scene;
}

/// A roof without thickness on four posts.
Scene canopies(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  const double width = draw.length(5, 8);
  const double depth = draw.length(5, 8);
  const Vec3 post(draw.length(0.75, 1.0), draw.length(0.75, 1.0), draw.length(2.5, 4));
  addSheet(scene.surface, "Canopy", Vec3(-0.5 * width, -0.5 * depth, post[2]), Vec3(width, 0, 0), Vec3(0, depth, 0));
  scene.areas["Canopy"] = 2.0 * width * depth;
  scene.sheets.insert("Canopy");
  for (int i = 0; i < 4; ++i)
  {
    const std::string name = "Post" + std::to_string(i);
    addStanding(scene, name, standing((i & 1 ? 0.25 : -0.25) * width, (i & 2 ? 0.25 : -0.25) * depth, post));
    scene.areas[name] = wallsOf(post) + floorOf(post); // its top is the smaller of two faces in one place
    scene.areas["Canopy"] -= 2.0 * floorOf(post);
  }
  return scene;
}

/// Houses whose bases are sunk into a terrain that slopes.
Scene slopes(unsigned seed)
{
  SceneDraw draw(seed);
  Scene scene = outdoors();
  scene.options.site.terrain = "Terrain";
  const double height = draw.length(2, 3); // at the middle
  const Vec3 slope(draw.length(-0.2, 0.2), draw.length(-0.15, 0.15), 0.0);
  const auto groundAt = [&](double x, double y) { return Vec3(x, y, height + slope.dot(Vec3(x, y, 0))); };
  constexpr double reach = 20.0;
  const Vec3 corner = groundAt(-reach, -reach);
  addSheet(scene.surface, "Terrain", corner, groundAt(reach, -reach) - corner, groundAt(-reach, reach) - corner);
  for (int i = 0; i < 2; ++i)
  {
    const double x = i == 0 ? -4.0 : 4.0;
    const double ground = groundAt(x, 0.0)[2];
    // Sides are as high above the ground as at their middles, and the house as at its own.
    const Vec3 size(draw.length(3, 4), draw.length(4, 6), draw.length(3, 4));
    const double sunk = draw.length(1.0, 1.5);
    const std::string name = "House" + std::to_string(i);
    addBox(scene.surface, name, standing(x, 0.0, size + Vec3(0, 0, sunk), ground - sunk));
    scene.areas[name] = wallsOf(size) + floorOf(size);
    scene.displaced += size.prod();
    scene.footprint += floorOf(size);
  }
  const Vec3 domain = openAir.size();
  scene.emptyVolume = floorOf(domain) * (openAir.max[2] - height);
  scene.areas["Terrain"] = (floorOf(domain) - scene.footprint) * std::sqrt(1.0 + slope.squaredNorm());
  return scene;
}

} // namespace

const std::vector<SceneKind>& sceneKinds()
{
  static const std::vector<SceneKind> kinds{{"Bases", bases},         {"Panes", panes},     {"Rooms", rooms},
                                            {"Furniture", furniture}, {"BuiltIn", builtIn}, {"Cellars", cellars},
                                            {"Terraces", terraces},   {"Slabs", slabs},     {"Courtyards", courtyards},
                                            {"Atria", atria},         {"Rows", rows},       {"FreeWalls", freeWalls},
                                            {"Canopies", canopies},   {"Slopes", slopes}};
  return kinds;
}

Scene turnedScene(const SceneKind& kind, unsigned seed, double degrees)
{
  Scene scene = kind.make(seed);
  turn(scene.surface, degrees);
  if (scene.isIndoors)
  {
    scene.options.site.domainAngle = degrees;
    scene.options.site.alignment = seed % 2 == 0 ? GridAlignment::domain : GridAlignment::axes;
  }
  return scene;
}

} // namespace atria::testing
