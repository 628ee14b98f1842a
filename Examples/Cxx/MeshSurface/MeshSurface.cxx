// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes the air around a house whose surfaces the program makes itself, and compares the mesh with the house.
///
///   MeshSurface [SIZE]     SIZE is that of elements at walls, in meters; without it, it follows from the house
#include <Mesher/MeshModel.h>
#include <Mesher/SuggestedSizes.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace {

/// Adds a rectangle from `corner` along `u` and `v`; its front is where these run counterclockwise.
void addRectangle(atria::TriangleSurface& to, const std::string& name, const atria::Vec3& corner, const atria::Vec3& u,
                  const atria::Vec3& v)
{
  const auto first = static_cast<atria::Index>(to.points.size());
  const auto surface = static_cast<atria::Index>(to.names.size());
  to.names.push_back(name);
  for (const atria::Vec3& offset : {atria::Vec3(0.0, 0.0, 0.0), u, atria::Vec3(u + v), v})
  {
    to.points.push_back(corner + offset);
  }
  for (const std::array<atria::Index, 3>& triangle :
       {std::array{first, first + 1, first + 2}, {first, first + 2, first + 3}})
  {
    to.triangles.push_back(triangle);
    to.surfaceIds.push_back(surface);
  }
}

constexpr double houseVolume = 12.0 * 8.0 * 6.0; // cubic meters

/// A closed box of 12 by 8 by 6 m on the ground.
atria::TriangleSurface makeHouse()
{
  const atria::Vec3 x(12.0, 0.0, 0.0);
  const atria::Vec3 y(0.0, 8.0, 0.0);
  const atria::Vec3 z(0.0, 0.0, 6.0);
  const atria::Vec3 origin(0.0, 0.0, 0.0);
  atria::TriangleSurface house;
  addRectangle(house, "WallSouth", origin, x, z);
  addRectangle(house, "WallEast", x, y, z);
  addRectangle(house, "WallNorth", x + y, -x, z);
  addRectangle(house, "WallWest", y, -y, z);
  addRectangle(house, "Roof", z, x, y);
  addRectangle(house, "Floor", y, x, -y);
  return house;
}

/// Prints each stage once.
class PrintedProgress : public atria::ProgressMonitor
{
public:
  void report(double fraction, const char* phase) override
  {
    if (phase != last_)
    {
      std::cout << std::lround(100.0 * fraction) << " % " << phase << '\n';
      last_ = phase;
    }
  }
  bool aborted() const override { return false; }

private:
  std::string last_;
};

} // namespace

int main(int argc, char** argv)
{
  try
  {
    const atria::TriangleSurface house = makeHouse();
    atria::MesherOptions options;
    options.site.mode = atria::DomainMode::automatic; // the domain follows from the height of the house
    options.sizes.sizeMin = 0.0;                      // sizes that are 0 follow from the model
    options.sizes.sizeMid = argc > 1 ? std::stod(argv[1]) : 0.0;
    options.sizes.sizeMax = 0.0;
    options.mesh.layers = {{"Wall*", {.layers = 3}}};
    options.sizes = atria::completeSizes(house, options);

    const atria::ThreadExecutor executor(2);
    PrintedProgress progress;
    const atria::MeshedModel meshed = atria::meshModel(house, options, {executor, atria::ProgressRange(progress)});

    std::cout << meshed.mesh.elementCount() << " elements, " << meshed.mesh.points.size() << " points\n";
    for (std::size_t i = 0; i < meshed.names.size(); ++i)
    {
      const atria::SurfaceAudit& surface = meshed.audit.surfaces[i];
      std::cout << meshed.names[i] << ": " << surface.drawnArea << " m2 drawn, " << surface.meshArea << " m2 meshed\n";
    }
    for (const std::string& warning : meshed.auditWarnings) // no air is below the floor
    {
      std::cout << "warning: " << warning << '\n';
    }
    const double solid = meshed.audit.volumes.displaced();
    std::cout << solid << " m3 are solid, of " << houseVolume << '\n';
    return std::abs(solid - houseVolume) < 0.005 * houseVolume ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception& error)
  {
    std::cerr << "error: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
