// SPDX-License-Identifier: GPL-3.0-or-later
/// model_seeds FOLDER: writes small models in the formats that model_fuzzer reads, for it to start from.
#include "IO/ModelSamples.h"

#include <cstdio>
#include <fstream>
#include <sstream>

namespace {

namespace fs = std::filesystem;

std::string bytesOf(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

std::string base64(const std::string& bytes)
{
  static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3)
  {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])); };
    const unsigned bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (const int shift : {18, 12, 6, 0})
    {
      out.push_back(digits[bits >> shift & 63]);
    }
  }
  return out;
}

/// Transforms of all kinds, indices of all kinds, a strip and a fan, sparse values, a buffer within the file.
const char* const oddGltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,2,3]}],"nodes":[)"
    R"({"mesh":0,"name":"A","children":[1],"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,3,4,5,1]},)"
    R"({"mesh":1,"translation":[1,2,3],"rotation":[0,0.7071068,0,0.7071068],"scale":[2,-1,1]},)"
    R"({"mesh":2,"name":"B"},{"mesh":0,"name":"B"}],"materials":[{"name":"Glass"}],"meshes":[)"
    R"({"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0},{"attributes":{"POSITION":0},"mode":5}]},)"
    R"({"name":"M","primitives":[{"attributes":{"POSITION":0},"mode":6,"indices":2},{"mode":1,"attributes":{}}]},)"
    R"({"primitives":[{"attributes":{"POSITION":3},"indices":1}]}],"accessors":[)"
    R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4},)"
    R"({"bufferView":1,"componentType":5123,"type":"SCALAR","count":6},)"
    R"({"bufferView":1,"componentType":5121,"type":"SCALAR","count":3,"byteOffset":2},)"
    R"({"componentType":5126,"type":"VEC3","count":4,"sparse":{"count":2,"indices":{"bufferView":1,"componentType":5123},)"
    R"("values":{"bufferView":2,"byteOffset":0}}}],"bufferViews":[{"buffer":0,"byteLength":48},)"
    R"({"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":0,"byteLength":48,"byteStride":12}],)"
    R"("buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)"
    R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAAAAABAAIAAgABAAMA"}]})";

const char* const oddObj = "mtllib a.mtl\nv 0 0 0 1 0 0\nv 1. 0 0\nv 1 +1e0 0 \\\n 1\nv .5 1 -0\nv 0 0 1\n"
                           "g A B\nusemtl M\ns 1\nf 1/1 2//2 3/3/3 -2\no O\nf -1 -2 -3\nl 1 2\np 1\nf 1 2 9\nf 1 2\n"
                           "vt 0 0\nvn 0 0 1\nusemtl\ng\nfo 5 3 1 # end\nsurf 0 1 0 1 1 2\nend\n";

const char* const oddPly = "ply\r\nformat binary_little_endian 1.0\r\ncomment x\r\nobj_info y\r\nelement vertex 3\r\n"
                           "property double x\r\nproperty uchar red\r\nproperty float y\r\nproperty short z\r\n"
                           "property list uchar int extra\r\nelement edge 1\r\nproperty uint a\r\nelement face 1\r\n"
                           "property list ushort uint vertex_index\r\nend_header\r\n";

const char* const oddStl = "solid A b \r\nFACET normal 0 0 1\r\nouter loop\r\nvertex 0 0 0\r\nvertex 1e0 0. 0\r\n"
                           "vertex +0 .1e1 -0\r\nendloop\r\nendfacet\r\nendsolid\r\nsolid\r\nfacet\r\nvertex 1 1 1\r\n"
                           "vertex 2 1 1\r\nvertex nan 2 1\r\nendfacet\r\nfacet\r\nvertex 1 1 1\r\nvertex 2 1 1\r\n"
                           "vertex 1 2 1\r\nendfacet\r\nendsolid\r\n";

} // namespace

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: model_seeds FOLDER\n");
    return 1;
  }
  const fs::path folder = argv[1];
  const auto house = atria::testing::sampleHouse();
  for (const char* format : {"obj", "stl", "glb", "gltf"})
  {
    atria::testing::writersWithNames().at(format)(house, folder / ("house." + std::string(format)));
  }
  atria::testing::writeBinaryStl(house, folder / "house_binary.stl");
  atria::testing::writePly(house, folder / "house.ply");
  // Its numbers move into the file, as it is read alone.
  std::string gltf = bytesOf(folder / "house.gltf");
  const std::string numbers = "data:application/octet-stream;base64," + base64(bytesOf(folder / "house.bin"));
  write(folder / "house.gltf", gltf.replace(gltf.find("house.bin"), 9, numbers));
  fs::remove(folder / "house.bin");
  write(folder / "odd.gltf", oddGltf);
  write(folder / "odd.obj", oddObj);
  write(folder / "odd.ply", oddPly + std::string(3 * (8 + 1 + 4 + 2 + 1), '\1') + std::string(30, '\0'));
  write(folder / "odd.stl", oddStl);
  return 0;
}
