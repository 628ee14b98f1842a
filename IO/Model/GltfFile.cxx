// SPDX-License-Identifier: GPL-3.0-or-later
#include "GltfFile.h"

#include "ModelParts.h"

#include "Support/Error.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>

namespace atria::model::gltf {

namespace {

template <typename T> T valueAt(std::string_view bytes)
{
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T)); // little endian, as all machines in use
  return value;
}

std::string fromBase64(std::string_view text)
{
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text)
  {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+' || c == '-' ? 62
                      : c == '/' || c == '_' ? 63
                                             : -1;
    if (value < 0)
    {
      break; // the padding, or damage
    }
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8)
    {
      count -= 8;
      out.push_back(static_cast<char>(bits >> count & 0xff));
    }
  }
  return out;
}

int hexDigit(char c)
{
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                : -1;
}

/// %20 and the like as the characters they stand for.
std::string withoutEscapes(const std::string& uri)
{
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i)
  {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hexDigit(uri[i + 2]) : -1;
    out.push_back(low >= 0 ? static_cast<char>(16 * high + low) : uri[i]);
    i += low >= 0 ? 2 : 0;
  }
  return out;
}

/// Bytes of a component; 0 for a type there is not.
std::size_t sizeOfComponent(std::size_t type)
{
  constexpr std::array<std::size_t, 7> sizes{1, 1, 2, 2, 0, 4, 4}; // from 5120: bytes, shorts, unsigned, floats
  return type >= 5120 && type < 5120 + sizes.size() ? sizes[type - 5120] : 0;
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
  const auto fail = [&](const std::string& what) {
    throw Error("'" + name + "' cannot be read as glTF 2.0: " + what + "; export it again");
  };
  if (bytes.size() < header + chunkHeader || bytes.substr(0, 4) != "glTF" || bytes.substr(header + 4, 4) != "JSON")
  {
    fail("it does not begin as binary glTF does");
  }
  const std::size_t jsonSize = valueAt<std::uint32_t>(bytes.substr(header));
  bytes.remove_prefix(header + chunkHeader);
  if (jsonSize > bytes.size())
  {
    fail("it is cut off: its JSON has " + std::to_string(bytes.size()) + " of " + std::to_string(jsonSize) + " bytes");
  }
  parse(bytes.substr(0, jsonSize));
  bytes.remove_prefix(jsonSize);
  if (bytes.size() >= chunkHeader)
  {
    chunk = bytes.substr(chunkHeader, valueAt<std::uint32_t>(bytes));
  }
}

void File::parse(std::string_view json)
{
  // The parser calls itself for each level; no glTF is deeper than a few.
  constexpr int deepest = 500;
  const auto tooDeep = [](int depth, Json::parse_event_t, Json&) -> bool {
    if (depth > deepest)
    {
      throw Damaged("its JSON is nested too deeply");
    }
    return true;
  };
  std::string what = "its JSON is no object";
  try
  {
    document = Json::parse(json.begin(), json.end(), tooDeep);
  }
  catch (const std::exception& error)
  {
    what = error.what();
    document = nullptr;
  }
  if (!document.is_object())
  {
    throw Error("'" + name + "' cannot be read as glTF 2.0: " + what + "; export it again");
  }
  const auto asset = document.find("asset");
  const std::string version = asset != document.end() ? text(*asset, "version") : "";
  if (!version.empty() && version.front() != '2')
  {
    throw Error("'" + name + "' is glTF " + version + "; export it as glTF 2.0");
  }
}

/// Throws Error where geometry is hidden in extensions.
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
  const std::string uri = buffer.is_object() ? text(buffer, "uri") : "";
  std::string& bytes = buffers[number];
  if (uri.empty())
  {
    bytes = chunk;
  }
  else if (uri.compare(0, 5, "data:") == 0)
  {
    const std::size_t comma = uri.find(',');
    bytes = comma == uri.npos ? "" : fromBase64(std::string_view(uri).substr(comma + 1));
  }
  else
  {
    try
    {
      bytes = readBytes((std::filesystem::path(name).parent_path() / withoutEscapes(uri)).string());
    }
    catch (const std::exception& error)
    {
      bufferFaults[number] = error.what();
    }
  }
}

const Json& File::list(const char* key) const
{
  static const Json empty = Json::array();
  const auto found = document.find(key);
  return found != document.end() && found->is_array() ? *found : empty;
}

const Json* File::entry(const Json& of, std::size_t i) const
{
  return i < of.size() && of[i].is_object() ? &of[i] : nullptr;
}

std::optional<std::size_t> File::index(const Json& object, const char* key) const
{
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end())
  {
    return std::nullopt;
  }
  if (!found->is_number_unsigned())
  {
    throw Damaged(std::string("'") + key + "' is not a number from 0");
  }
  return found->get<std::size_t>();
}

std::vector<std::size_t> File::indexList(const Json& object, const char* key) const
{
  std::vector<std::size_t> out;
  const auto found = object.find(key);
  for (std::size_t i = 0; found != object.end() && i < found->size(); ++i)
  {
    if (!found->is_array() || !(*found)[i].is_number_unsigned())
    {
      throw Damaged(std::string("'") + key + "' is no list of numbers from 0");
    }
    out.push_back((*found)[i].get<std::size_t>());
  }
  return out;
}

std::vector<double> File::numbers(const Json& object, const char* key, std::size_t count) const
{
  std::vector<double> out;
  const auto found = object.find(key);
  if (found == object.end())
  {
    return out;
  }
  for (std::size_t i = 0; found->is_array() && i < found->size() && (*found)[i].is_number(); ++i)
  {
    out.push_back((*found)[i].get<double>());
  }
  if (out.size() != count || found->size() != count)
  {
    throw Damaged(std::string("'") + key + "' is no list of " + std::to_string(count) + " numbers");
  }
  return out;
}

std::string File::text(const Json& object, const char* key) const
{
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

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
  const std::size_t there = viewStart < bytes.size() ? std::min(viewSize, bytes.size() - viewStart) : 0;
  const bool fits = start < there && itemSize <= there - start && (count - 1) <= (there - start - itemSize) / stride;
  if (!fits)
  {
    throw Damaged("buffer " + std::to_string(*buffer) + " is too short for what is stated" +
                  (bufferFaults[*buffer].empty() ? "" : ": " + bufferFaults[*buffer]));
  }
  return {bytes.substr(viewStart + start), stride};
}

template <typename Put>
void File::forItems(const Json& accessor, std::size_t count, std::size_t itemSize, const Put& put) const
{
  if (count == 0)
  {
    return;
  }
  if (index(accessor, "bufferView"))
  {
    const Items items = itemsOf(accessor, count, itemSize);
    for (std::size_t i = 0; i < count; ++i)
    {
      put(i, items.bytes.substr(i * items.stride));
    }
  }
  const auto sparse = accessor.find("sparse");
  if (sparse == accessor.end())
  {
    return;
  }
  const auto places = sparse->is_object() ? sparse->find("indices") : sparse->end();
  const auto values = sparse->is_object() ? sparse->find("values") : sparse->end();
  const std::size_t changed = index(*sparse, "count").value_or(0);
  if (!sparse->is_object() || places == sparse->end() || values == sparse->end() || changed == 0 ||
      !index(*places, "bufferView") || !index(*values, "bufferView"))
  {
    throw Damaged("an accessor's sparse values are incomplete");
  }
  const std::size_t size = sizeOfComponent(index(*places, "componentType").value_or(0));
  const Items at = itemsOf(*places, changed, std::max(size, std::size_t{1}));
  const Items items = itemsOf(*values, changed, itemSize);
  for (std::size_t i = 0; i < changed && size > 0; ++i)
  {
    const std::size_t place = wholeNumber(at.bytes.substr(i * at.stride), size);
    if (place < count)
    {
      put(place, items.bytes.substr(i * items.stride));
    }
  }
}

std::vector<double> File::floats(std::size_t number, std::size_t width) const
{
  constexpr std::size_t floatType = 5126;
  // No more is asked for than the file can hold, or could with sparse values.
  constexpr std::size_t mostItems = std::size_t{1} << 31;
  const Json& accessor = accessorOf(number);
  const std::size_t count = index(accessor, "count").value_or(0);
  const bool isSparse = !index(accessor, "bufferView");
  if (index(accessor, "componentType").value_or(0) != floatType || text(accessor, "type") != "VEC3" ||
      count > mostItems || (isSparse && count > whole.size()))
  {
    throw Damaged("accessor " + std::to_string(number) + " holds no points");
  }
  if (count > 0 && !isSparse)
  {
    itemsOf(accessor, count, width * sizeof(float)); // before memory is asked for
  }
  std::vector<double> out(count * width, 0.0);
  forItems(accessor, count, width * sizeof(float), [&](std::size_t i, std::string_view bytes) {
    for (std::size_t k = 0; k < width; ++k)
    {
      out[i * width + k] = valueAt<float>(bytes.substr(k * sizeof(float)));
    }
  });
  return out;
}

std::vector<std::size_t> File::indices(std::size_t number) const
{
  constexpr std::size_t floatType = 5126;
  const Json& accessor = accessorOf(number);
  const std::size_t count = index(accessor, "count").value_or(0);
  const std::size_t type = index(accessor, "componentType").value_or(0);
  const std::size_t size = sizeOfComponent(type);
  if (size == 0 || type == floatType || text(accessor, "type") != "SCALAR" || !index(accessor, "bufferView"))
  {
    throw Damaged("accessor " + std::to_string(number) + " holds no corners of triangles");
  }
  if (count > 0)
  {
    itemsOf(accessor, count, size); // before memory is asked for
  }
  std::vector<std::size_t> out(count, 0);
  forItems(accessor, count, size, [&](std::size_t i, std::string_view bytes) { out[i] = wholeNumber(bytes, size); });
  return out;
}

} // namespace atria::model::gltf
