// SPDX-License-Identifier: GPL-3.0-or-later
/// The JSON and the buffers of a glTF 2.0 file. Nothing in it is trusted: what is asked for and is not there, or lies
/// beyond the end of a buffer, is said.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace atria::model::gltf {

using Json = nlohmann::json;

/// A part of the file makes no sense; the rest may.
class Damaged : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// What an accessor holds.
template <typename T> struct Values
{
  std::vector<T> values;
  std::string fault; ///< why there are fewer than stated; empty where there are not
};

class File
{
public:
  /// Opens .gltf and .glb files. Throws Error where its JSON is damaged or of another version.
  /// Texts that are no UTF-8 are taken as Latin-1.
  explicit File(const std::string& path);

  const std::string& path() const { return name; }
  const Json& root() const { return document; }
  /// The list of that name; an empty one where there is none.
  const Json& list(const char* key) const;
  /// An object of a list; null where it is none.
  const Json* entry(const Json& of, std::size_t i) const;

  /// A field that is a number from 0; nothing where it is absent. Throws Damaged where it is something else.
  std::optional<std::size_t> index(const Json& object, const char* key) const;
  /// A field that is a list of so many numbers; empty where it is absent. Throws Damaged where it is something else.
  std::vector<double> numbers(const Json& object, const char* key, std::size_t count) const;
  /// A field that is a text; empty where it is none.
  std::string text(const Json& object, const char* key) const;
  /// The name of an entry of a list; empty where there is none.
  std::string nameOf(const char* list, const std::optional<std::size_t>& i) const;

  /// The values of an accessor of coordinates, `width` for each item. Throws Damaged where there are none.
  Values<double> floats(std::size_t accessor, std::size_t width) const;
  /// The values of an accessor of single whole numbers. Throws Damaged where there are none.
  Values<std::size_t> indices(std::size_t accessor) const;

private:
  /// Items at equal distances in a buffer.
  struct Items
  {
    std::string_view bytes; ///< from the first on
    std::size_t stride = 0;
    std::size_t count = 0; ///< as many as are there of those asked for, one at least
    std::string fault;     ///< why there are fewer
  };

  void openBinary(std::string_view bytes);
  void parse(std::string_view json);
  void checkExtensions() const;
  void loadBuffer(const Json& buffer, std::size_t number);
  Items itemsOf(const Json& accessor, std::size_t count, std::size_t itemSize) const;
  /// Calls `put` with the number and the bytes of each sparse item of an accessor of `count` ones.
  template <typename Put>
  void forSparse(const Json& accessor, std::size_t count, std::size_t itemSize, const Put& put) const;
  const Json& accessorOf(std::size_t i) const;

  std::string name;
  std::string whole; ///< the file
  Json document;
  std::string_view chunk;                   ///< of a binary file, behind the JSON
  std::deque<std::string> decoded;          ///< buffers within the JSON
  std::map<std::string, std::string> files; ///< those in files, by URI
  std::vector<std::string_view> buffers;
  std::vector<std::string> bufferFaults; ///< why a buffer is shorter than stated
};

} // namespace atria::model::gltf
