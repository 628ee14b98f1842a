// SPDX-License-Identifier: GPL-3.0-or-later
/// The JSON and the buffers of a glTF 2.0 file. Nothing in it is trusted: requested data that is missing, or lies
/// beyond the end of a buffer, is reported.
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

/// A part of the file is invalid; the rest may be valid.
class Damaged : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The content of an accessor.
template <typename T> struct Values
{
  std::vector<T> values;
  std::string fault; ///< reason for fewer values than stated; empty if there are as many
};

class File
{
public:
  /// Opens .gltf and .glb files. Throws Error if the JSON is damaged or of another version. Texts that are no UTF-8 are
  /// taken as Latin-1.
  explicit File(const std::string& path);

  const std::string& path() const { return name; }
  const Json& root() const { return document; }
  /// Returns the list of that name; an empty one if there is none.
  const Json& list(const char* key) const;
  /// Returns an object of a list; null if it is none.
  const Json* entry(const Json& of, std::size_t i) const;

  /// Returns a field that is a number from 0; nothing if it is absent. Throws Damaged if it is something else.
  std::optional<std::size_t> index(const Json& object, const char* key) const;
  /// Returns a field that is a list of so many numbers; empty if it is absent. Throws Damaged if it is something else.
  std::vector<double> numbers(const Json& object, const char* key, std::size_t count) const;
  /// Returns a field that is a text; empty if it is none.
  std::string text(const Json& object, const char* key) const;
  /// Returns the name of an entry of a list; empty if there is none.
  std::string nameOf(const char* list, const std::optional<std::size_t>& i) const;

  /// Returns the values of an accessor of coordinates, `width` for each item. Throws Damaged if there are none.
  Values<double> floats(std::size_t accessor, std::size_t width) const;
  /// Returns the values of an accessor of single whole numbers. Throws Damaged if there are none.
  Values<std::size_t> indices(std::size_t accessor) const;

private:
  /// Items at equal distances in a buffer.
  struct Items
  {
    std::string_view bytes; ///< from the first on
    std::size_t stride = 0;
    std::size_t count = 0; ///< number of requested items that exist, at least one
    std::string fault;     ///< reason for fewer items than requested
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
  std::string_view chunk;                   ///< chunk of a binary file, behind the JSON
  std::deque<std::string> decoded;          ///< buffers within the JSON
  std::map<std::string, std::string> files; ///< buffers in files, by URI
  std::vector<std::string_view> buffers;
  std::vector<std::string> bufferFaults; ///< reasons why buffers are shorter than stated
};

} // namespace atria::model::gltf
