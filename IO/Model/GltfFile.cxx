// SPDX-License-Identifier: GPL-3.0-or-later
#include "GltfFile.h"

#include "Base64.h"
#include "JsonText.h"
#include "ModelParts.h"

#include "Support/Error.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

namespace atria::model::gltf {

namespace {

template <typename T> T valueAt(std::string_view bytes)
{
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T)); // little endian, as all machines in use
  return value;
}

/// Returns the bytes of a component; 0 for an unknown type.
std::size_t sizeOfComponent(std::size_t type)
{
  constexpr std::array<std::size_t, 7> sizes{1, 1, 2, 2, 0, 4, 4}; // from 5120: bytes, shorts, unsigned, floats
  return type >= 5120 && type < 5120 + sizes.size() ? sizes[type - 5120] : 0;
}

/// Returns a coordinate of any component type. Normalized whole numbers stand for 0 to 1, or -1 to 1.
double coordinate(std::string_view bytes, std::size_t type, bool normalized)
{
  const auto whole = [&](auto value) {
    const double share = static_cast<double>(value) / static_cast<double>(std::numeric_limits<decltype(value)>::max());
    return normalized ? std::max(share, -1.0) : static_cast<double>(value);
  };
  switch (type)
  {
    case 5120:
      return whole(valueAt<std::int8_t>(bytes));
    case 5121:
      return whole(valueAt<std::uint8_t>(bytes));
    case 5122:
      return whole(valueAt<std::int16_t>(bytes));
    case 5123:
      return whole(valueAt<std::uint16_t>(bytes));
    default:
      return valueAt<float>(bytes);
  }
}

std::size_t wholeNumber(std::string_view bytes, std::size_t size)
{
  return size == 1   ? valueAt<std::uint8_t>(bytes)
         : size == 2 ? valueAt<std::uint16_t>(bytes)
                     : valueAt<std::uint32_t>(bytes);
}

} // namespace

File::File(const std::string& path) : name(path), whole(readBytes(path))
{
  if (whole.compare(0, 4, "glTF") == 0 || lowerEnding(path) == ".glb")
  {
    openBinary(whole);
  }
  else
  {
    parse(whole);
  }
  checkExtensions();
  const Json& stated = list("buffers");
  buffers.resize(stated.size());
  bufferFaults.resize(stated.size());
  for (std::size_t i = 0; i < stated.size(); ++i)
  {
    loadBuffer(stated[i], i);
  }
}

void File::openBinary(std::string_view bytes)
{
  constexpr std::size_t header = 12;
  constexpr std::size_t chunkHeader = 8;
  const bool begins =
      bytes.size() >= header + chunkHeader && (bytes.substr(0, 4) == "glTF" || bytes.substr(header + 4, 4) == "JSON");
  if (!begins)
  {
    throw Error("'" + name + "' cannot be read as glTF 2.0: it does not begin as binary glTF does; export it again");
  }
  if (const auto container = valueAt<std::uint32_t>(bytes.substr(4)); bytes.substr(0, 4) == "glTF" && container != 2)
  {
    throw Error("'" + name + "' is binary glTF " + std::to_string(container) + "; export it as glTF 2.0");
  }
  const std::size_t jsonSize = valueAt<std::uint32_t>(bytes.substr(header));
  bytes.remove_prefix(header + chunkHeader);
  parse(bytes.substr(0, jsonSize));
  bytes.remove_prefix(std::min(jsonSize, bytes.size()));
  if (bytes.size() >= chunkHeader)
  {
    if (bytes.substr(4, 4) != std::string_view("BIN\0", 4))
    {
      throw Error("'" + name + "' cannot be read as glTF 2.0: no binary chunk follows the " + std::to_string(jsonSize) +
                  " bytes stated for its JSON; export it again");
    }
    chunk = bytes.substr(chunkHeader, valueAt<std::uint32_t>(bytes));
  }
}

void File::parse(std::string_view json)
{
  try
  {
    document = parseJson(json);
    if (!document.is_object() || document.empty())
    {
      throw Error("its JSON is no object");
    }
  }
  catch (const Error& error)
  {
    throw Error("'" + name + "' cannot be read as glTF 2.0: " + error.what() + "; export it again");
  }
  const std::string version = text(entryOf(document, "asset"), "version");
  if (!version.empty() && version.substr(0, version.find('.')) != "2")
  {
    throw Error("'" + name + "' is glTF " + version + "; export it as glTF 2.0");
  }
}

/// Throws Error if geometry is hidden in extensions.
void File::checkExtensions() const
{
  for (const char* key : {"extensionsUsed", "extensionsRequired"})
  {
    for (const Json& extension : list(key))
    {
      for (const char* hiding : {"draco", "meshopt", "mesh_gpu_instancing"})
      {
        if (extension.is_string() && extension.get_ref<const std::string&>().find(hiding) != std::string::npos)
        {
          throw Error("'" + name + "' uses the extension " + extension.get<std::string>() +
                      ", which is not read; export the model without compression and instancing extensions");
        }
      }
    }
  }
}

void File::loadBuffer(const Json& buffer, std::size_t number)
{
  const std::string uri = text(buffer, "uri");
  if (uri.empty())
  {
    buffers[number] = number == 0 ? chunk : std::string_view();
    return;
  }
  if (uri.compare(0, 5, "data:") == 0)
  {
    const std::size_t comma = uri.find(',');
    decoded.push_back(comma == uri.npos ? "" : fromBase64(std::string_view(uri).substr(comma + 1)));
    buffers[number] = decoded.back();
    return;
  }
  try
  {
    const auto [found, isNew] = files.try_emplace(uri);
    if (isNew)
    {
      found->second =
          readBytes((std::filesystem::path(name).parent_path() / vtksys::SystemTools::DecodeURL(uri)).string());
    }
    buffers[number] = found->second;
  }
  catch (const std::exception& error)
  {
    bufferFaults[number] = error.what();
  }
}

const Json& File::list(const char* key) const
{
  static const Json empty = Json::array();
  const Json& found = entryOf(document, key);
  return found.is_array() ? found : empty;
}

const Json* File::entry(const Json& of, std::size_t i) const
{
  return i < of.size() && of[i].is_object() ? &of[i] : nullptr;
}

std::optional<std::size_t> File::index(const Json& object, const char* key) const
{
  const Json& found = entryOf(object, key);
  if (found.is_null())
  {
    return std::nullopt;
  }
  if (!found.is_number_unsigned())
  {
    throw Damaged(std::string("'") + key + "' is not a number from 0");
  }
  return found.get<std::size_t>();
}

std::vector<double> File::numbers(const Json& object, const char* key, std::size_t count) const
{
  std::vector<double> out;
  const Json& found = entryOf(object, key);
  if (found.is_null())
  {
    return out;
  }
  for (std::size_t i = 0; found.is_array() && i < found.size() && found[i].is_number(); ++i)
  {
    out.push_back(found[i].get<double>());
  }
  if (out.size() != count || found.size() != count)
  {
    throw Damaged(std::string("'") + key + "' is no list of " + std::to_string(count) + " numbers");
  }
  return out;
}

std::string File::text(const Json& object, const char* key) const { return textOf(entryOf(object, key)); }

std::string File::nameOf(const char* key, const std::optional<std::size_t>& i) const
{
  const Json* found = i ? entry(list(key), *i) : nullptr;
  return found ? text(*found, "name") : std::string();
}

const Json& File::accessorOf(std::size_t i) const
{
  const Json* accessor = entry(list("accessors"), i);
  if (!accessor)
  {
    throw Damaged("accessor " + std::to_string(i) + " does not exist");
  }
  return *accessor;
}

File::Items File::itemsOf(const Json& accessor, std::size_t count, std::size_t itemSize) const
{
  const std::size_t number = *index(accessor, "bufferView");
  const Json* view = entry(list("bufferViews"), number);
  const auto buffer = view ? index(*view, "buffer") : std::nullopt;
  if (!buffer || *buffer >= buffers.size())
  {
    throw Damaged("buffer view " + std::to_string(number) + " or its buffer does not exist");
  }
  const std::string_view bytes = buffers[*buffer];
  const std::size_t viewStart = index(*view, "byteOffset").value_or(0);
  const std::size_t viewSize = index(*view, "byteLength").value_or(0);
  const std::size_t start = index(accessor, "byteOffset").value_or(0);
  const std::size_t stride = std::max(index(*view, "byteStride").value_or(itemSize), std::size_t{1});
  const auto holds = [&](std::size_t room) {
    return start < room && itemSize <= room - start ? 1 + (room - start - itemSize) / stride : 0;
  };
  if (holds(viewSize) < count)
  {
    throw Damaged("buffer view " + std::to_string(number) + " is too short for what is stated");
  }
  // Items before the end of a truncated file are good.
  const std::size_t there = viewStart < bytes.size() ? std::min(viewSize, bytes.size() - viewStart) : 0;
  const std::size_t present = std::min(count, holds(there));
  std::string fault;
  if (present < count)
  {
    fault = "buffer " + std::to_string(*buffer) + " is too short for what is stated" +
            (bufferFaults[*buffer].empty() ? "" : ": " + bufferFaults[*buffer]);
  }
  if (present == 0)
  {
    throw Damaged(fault);
  }
  return {bytes.substr(viewStart + start), stride, present, fault};
}

template <typename Put>
void File::forSparse(const Json& accessor, std::size_t count, std::size_t itemSize, const Put& put) const
{
  const Json& sparse = entryOf(accessor, "sparse");
  if (sparse.is_null())
  {
    return;
  }
  const Json& places = entryOf(sparse, "indices");
  const Json& values = entryOf(sparse, "values");
  const std::size_t changed = index(sparse, "count").value_or(0);
  if (changed == 0 || !index(places, "bufferView") || !index(values, "bufferView"))
  {
    throw Damaged("an accessor's sparse values are incomplete");
  }
  const std::size_t size = sizeOfComponent(index(places, "componentType").value_or(0));
  const Items at = itemsOf(places, changed, std::max(size, std::size_t{1}));
  const Items items = itemsOf(values, changed, itemSize);
  if (!at.fault.empty() || !items.fault.empty())
  {
    throw Damaged(at.fault.empty() ? items.fault : at.fault); // points would stay where they should not be
  }
  for (std::size_t i = 0; i < changed && size > 0; ++i)
  {
    const std::size_t place = wholeNumber(at.bytes.substr(i * at.stride), size);
    if (place < count)
    {
      put(place, items.bytes.substr(i * items.stride));
    }
  }
}

Values<double> File::floats(std::size_t number, std::size_t width) const
{
  constexpr std::size_t unsignedType = 5125;
  const Json& accessor = accessorOf(number);
  const std::size_t type = index(accessor, "componentType").value_or(0);
  const std::size_t size = sizeOfComponent(type);
  const bool normalized = entryOf(accessor, "normalized") == true;
  std::size_t count = index(accessor, "count").value_or(0);
  const bool isSparse = !index(accessor, "bufferView");
  // The request is bounded by what the file can hold, or could with sparse values.
  if (size == 0 || type == unsignedType || text(accessor, "type") != "VEC3" || count == 0 ||
      (isSparse && count > whole.size()))
  {
    throw Damaged("accessor " + std::to_string(number) + " holds no points");
  }
  const Items items = isSparse ? Items{} : itemsOf(accessor, count, width * size);
  count = isSparse ? count : items.count;
  Values<double> out{std::vector<double>(count * width, 0.0), items.fault};
  const auto put = [&](std::size_t i, std::string_view bytes) {
    for (std::size_t k = 0; k < width; ++k)
    {
      out.values[i * width + k] = coordinate(bytes.substr(k * size), type, normalized);
    }
  };
  for (std::size_t i = 0; i < items.count; ++i)
  {
    put(i, items.bytes.substr(i * items.stride));
  }
  forSparse(accessor, count, width * size, put);
  return out;
}

Values<std::size_t> File::indices(std::size_t number) const
{
  constexpr std::size_t floatType = 5126;
  const Json& accessor = accessorOf(number);
  const std::size_t count = index(accessor, "count").value_or(0);
  const std::size_t type = index(accessor, "componentType").value_or(0);
  const std::size_t size = sizeOfComponent(type);
  if (size == 0 || type == floatType || text(accessor, "type") != "SCALAR" || !index(accessor, "bufferView") ||
      count == 0)
  {
    throw Damaged("accessor " + std::to_string(number) + " holds no corners of triangles");
  }
  const Items items = itemsOf(accessor, count, size);
  Values<std::size_t> out{std::vector<std::size_t>(items.count), items.fault};
  for (std::size_t i = 0; i < items.count; ++i)
  {
    out.values[i] = wholeNumber(items.bytes.substr(i * items.stride), size);
  }
  forSparse(accessor, items.count, size,
            [&](std::size_t i, std::string_view bytes) { out.values[i] = wholeNumber(bytes, size); });
  return out;
}

} // namespace atria::model::gltf
