// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads a model by assimp and writes what is in it to the standard output, as CBOR. A process of its own: assimp
/// crashes on some damaged files, or asks for all memory there is, which must not end the program that reads them.
///
/// Usage: atria-assimp FILE
///
/// Output: a map with `error`, or with
/// - `groups`: list of `name` and `parent` (absent at the root), parents first;
/// - `parts`: list of `name`, `material`, `group`, `points` (doubles), `corners` and `sizes` of faces (unsigned, 32
/// bits);
/// - `metadata`: what assimp says of the whole scene; `skipped`: numbers of faces that are points or lines.
///
/// Exit status: 0; 1 where the output cannot be written; 2 for other arguments; 3 where reading takes far too long.
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#if __has_include(<sys/resource.h>) && __has_include(<unistd.h>)
#include <sys/resource.h>
#include <unistd.h>
#define ATRIA_HAS_LIMITS
#endif
#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

namespace {

using Json = nlohmann::json;

template <typename T> Json binary(const std::vector<T>& values)
{
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  if (!bytes.empty())
  {
    std::memcpy(bytes.data(), values.data(), bytes.size());
  }
  return Json::binary(std::move(bytes));
}

Eigen::Affine3d transformOf(const aiMatrix4x4& m)
{
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      transform.matrix()(row, column) = m[static_cast<unsigned>(row)][column];
    }
  }
  return transform;
}

/// Returns what undoes the transformation of the root of an FBX file, which has none of its own: assimp 5.4 turns it by
/// the axes that `metadata` states, and 5.3 does not.
Eigen::Affine3d aroundRoot(const aiScene& scene)
{
  aiString format;
  const bool isFbx = scene.mMetaData && scene.mMetaData->Get("SourceAsset_Format", format) &&
                     std::string(format.C_Str()).find("FBX") != std::string::npos;
  return isFbx ? transformOf(scene.mRootNode->mTransformation).inverse() : Eigen::Affine3d::Identity();
}

class Scene
{
public:
  explicit Scene(const aiScene& read) : scene(read) {}

  Json written()
  {
    visit(*scene.mRootNode, aroundRoot(scene), -1);
    return {{"groups", groups}, {"parts", parts}, {"metadata", metadata()}, {"skipped", skipped}};
  }

private:
  void visit(const aiNode& node, const Eigen::Affine3d& around, int parent)
  {
    const Eigen::Affine3d here = around * transformOf(node.mTransformation);
    Json group{{"name", node.mName.C_Str()}};
    if (parent >= 0)
    {
      group["parent"] = parent;
    }
    const int own = static_cast<int>(groups.size());
    groups.push_back(std::move(group));
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
    {
      addPart(*scene.mMeshes[node.mMeshes[i]], here, own);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
    {
      visit(*node.mChildren[i], here, own);
    }
  }

  void addPart(const aiMesh& mesh, const Eigen::Affine3d& transform, int group)
  {
    std::vector<double> points;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i)
    {
      const aiVector3D& v = mesh.mVertices[i];
      const Eigen::Vector3d p = transform * Eigen::Vector3d(v.x, v.y, v.z);
      points.insert(points.end(), p.data(), p.data() + 3);
    }
    const bool mirrored = transform.linear().determinant() < 0.0;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> sizes;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i)
    {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices < 3)
      {
        ++skipped;
        continue;
      }
      sizes.push_back(face.mNumIndices);
      for (unsigned k = 0; k < face.mNumIndices; ++k)
      {
        corners.push_back(face.mIndices[mirrored ? face.mNumIndices - 1 - k : k]);
      }
    }
    aiString material;
    scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, material);
    parts.push_back({{"name", mesh.mName.C_Str()},
                     {"material", material.C_Str()},
                     {"group", group},
                     {"points", binary(points)},
                     {"corners", binary(corners)},
                     {"sizes", binary(sizes)}});
  }

  Json metadata() const
  {
    Json out = Json::object();
    const aiMetadata* data = scene.mMetaData;
    for (unsigned i = 0; data && i < data->mNumProperties; ++i)
    {
      const aiMetadataEntry& entry = data->mValues[i];
      const std::string key = data->mKeys[i].C_Str();
      switch (entry.mType)
      {
        case AI_INT32:
          out[key] = *static_cast<std::int32_t*>(entry.mData);
          break;
        case AI_FLOAT:
          out[key] = *static_cast<float*>(entry.mData);
          break;
        case AI_DOUBLE:
          out[key] = *static_cast<double*>(entry.mData);
          break;
        case AI_AISTRING:
          out[key] = static_cast<aiString*>(entry.mData)->C_Str();
          break;
        default:
          break;
      }
    }
    return out;
  }

  const aiScene& scene;
  Json groups = Json::array();
  Json parts = Json::array();
  std::size_t skipped = 0;
};

/// Ends the process after more computing time than an intact file of this size needs.
void limitTime(const std::string& file)
{
  std::error_code none;
  const std::uintmax_t bytes = std::filesystem::file_size(file, none);
  const double seconds = 20.0 + (none ? 0.0 : static_cast<double>(bytes) / 50'000.0);
  std::thread([seconds] {
    while (static_cast<double>(std::clock()) < seconds * CLOCKS_PER_SEC)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    std::_Exit(3);
  }).detach();
}

/// Limits memory to that of the machine, and writes no core. Windows has no such limits; sanitizers take more than
/// there is.
void limitMemory()
{
#ifdef ATRIA_HAS_LIMITS
  const auto limit = [](auto resource, rlim_t most) {
    const rlimit both{most, most};
    setrlimit(resource, &both);
  };
#ifndef __SANITIZE_ADDRESS__
  limit(RLIMIT_AS, static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)));
#endif
  limit(RLIMIT_CORE, 0);
#endif
}

/// Prevents Windows from adding a byte to each that ends a line.
void writeBytesAsTheyAre()
{
#ifdef _WIN32
  _setmode(_fileno(stdout), _O_BINARY);
#endif
}

Json read(const std::string& file)
{
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true); // else they are ids
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_ANIMATIONS);
  const aiScene* scene = importer.ReadFile(file, 0);
  if (!scene || !scene->mRootNode)
  {
    return {{"error", importer.GetErrorString()}};
  }
  return Scene(*scene).written();
}

Json readOrError(const std::string& file)
{
  try
  {
    return read(file);
  }
  catch (const std::exception& error)
  {
    return {{"error", error.what()}};
  }
}

} // namespace

int main(int argc, char** argv)
try
{
  if (argc != 2)
  {
    std::cerr << "usage: atria-assimp FILE\n";
    return 2;
  }
  limitMemory();
  limitTime(argv[1]);
  writeBytesAsTheyAre();
  Json::to_cbor(readOrError(argv[1]), nlohmann::detail::output_adapter<char>(std::cout));
  return std::cout.flush() ? 0 : 1;
}
catch (...)
{
  return 1;
}
