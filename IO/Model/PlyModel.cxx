// SPDX-License-Identifier: GPL-3.0-or-later
/// PLY. Atria has a reader of its own because VTK 9.1's reader trusts the counts a file states, and has single
/// precision and short faces only.
#include "ModelFaces.h"
#include "ModelFile.h"
#include "ModelText.h"

#include "Support/Error.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>

namespace atria::model {

namespace {

using std::string_view;

enum class Type
{
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  float32,
  float64
};

std::optional<Type> typeOf(string_view word)
{
  static const std::map<string_view, Type> types{
      {"char", Type::int8},     {"int8", Type::int8},       {"uchar", Type::uint8},    {"uint8", Type::uint8},
      {"short", Type::int16},   {"int16", Type::int16},     {"ushort", Type::uint16},  {"uint16", Type::uint16},
      {"int", Type::int32},     {"int32", Type::int32},     {"uint", Type::uint32},    {"uint32", Type::uint32},
      {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64}};
  const auto found = types.find(word);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

struct Property
{
  std::string name;
  Type type = Type::float32;
  std::optional<Type> countType; ///< only for a list
};

struct Element
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  /// Returns the index of a property; -1 if there is none of that name.
  int find(string_view wanted) const
  {
    const auto found =
        std::find_if(properties.begin(), properties.end(), [&](const Property& p) { return p.name == wanted; });
    return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
  }
};

enum class Encoding
{
  ascii,
  little,
  big
};

struct Header
{
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::size_t end = 0;   ///< offset of the data
  std::size_t lines = 0; ///< lines of the header
};

class HeaderReader
{
public:
  HeaderReader(const std::string& path, string_view all) : file(path), text(all) {}

  Header read()
  {
    if (nextLine(text, header.end) != "ply")
    {
      throw Error("'" + file + "' is no PLY file: it does not begin with 'ply'");
    }
    bool hasFormat = false;
    for (header.lines = 2; header.end < text.size(); ++header.lines)
    {
      string_view line = nextLine(text, header.end);
      const string_view keyword = nextWord(line);
      if (keyword == "end_header")
      {
        check(hasFormat, "it does not state its format");
        return header;
      }
      if (keyword == "format")
      {
        format(nextWord(line));
        hasFormat = true;
      }
      else if (keyword == "element")
      {
        element(line);
      }
      else if (keyword == "property")
      {
        property(line);
      }
      else
      {
        check(keyword.empty() || keyword == "comment" || keyword == "obj_info",
              "'" + std::string(keyword.substr(0, 40)) + "' is no word of it");
      }
    }
    throw Error("'" + file + "' cannot be read as PLY: its header has no end; export it again");
  }

private:
  void check(bool good, const std::string& complaint) const
  {
    if (!good)
    {
      throw Error("'" + file + "' cannot be read as PLY: line " + std::to_string(header.lines) +
                  " of its header: " + complaint + "; export it again");
    }
  }

  void format(string_view word)
  {
    check(word == "ascii" || word == "binary_little_endian" || word == "binary_big_endian", "its format is not known");
    header.encoding = word == "ascii"               ? Encoding::ascii
                      : word == "binary_big_endian" ? Encoding::big
                                                    : Encoding::little;
  }

  void element(string_view line)
  {
    Element next;
    next.name = nextWord(line);
    check(!next.name.empty() && parse(nextWord(line), next.count), "expected the name and the number of elements");
    header.elements.push_back(next);
  }

  void property(string_view line)
  {
    check(!header.elements.empty(), "a property of no element");
    Property next;
    string_view word = nextWord(line);
    if (word == "list")
    {
      next.countType = typeOf(nextWord(line));
      check(next.countType.has_value(), "the type of a list's length is not known");
      word = nextWord(line);
    }
    const std::optional<Type> type = typeOf(word);
    check(type.has_value(), "the type of a property is not known");
    next.type = *type;
    next.name = nextWord(line);
    header.elements.back().properties.push_back(next);
  }

  const std::string& file;
  string_view text;
  Header header;
};

/// Numbers one after the other, as text or as bytes.
class Numbers
{
public:
  Numbers(string_view all, const Header& header) : text(all), at(header.end), encoding(header.encoding) {}

  /// Goes to the next line of text that is not empty. Returns false at the end.
  bool beginElement()
  {
    if (encoding != Encoding::ascii)
    {
      return at < text.size();
    }
    line = {};
    while (at < text.size() && line.find_first_not_of(blanks) == line.npos)
    {
      line = nextLine(text, at);
    }
    return line.find_first_not_of(blanks) != line.npos;
  }

  /// Returns the next number; nothing at the end, or if the text is no number.
  std::optional<double> next(Type type)
  {
    if (encoding == Encoding::ascii)
    {
      double value = 0.0;
      return parse(nextWord(line), value) ? std::optional(value) : std::nullopt;
    }
    switch (type)
    {
      case Type::int8:
        return take<std::int8_t>();
      case Type::uint8:
        return take<std::uint8_t>();
      case Type::int16:
        return take<std::int16_t>();
      case Type::uint16:
        return take<std::uint16_t>();
      case Type::int32:
        return take<std::int32_t>();
      case Type::uint32:
        return take<std::uint32_t>();
      case Type::float32:
        return take<float>();
      default:
        return take<double>();
    }
  }

  bool isText() const { return encoding == Encoding::ascii; }

private:
  template <typename T> std::optional<double> take()
  {
    if (text.size() - at < sizeof(T))
    {
      at = text.size();
      return std::nullopt;
    }
    std::array<char, sizeof(T)> bytes;
    std::copy_n(text.data() + at, sizeof(T), bytes.begin());
    at += sizeof(T);
    if ((encoding == Encoding::big) != (std::endian::native == std::endian::big))
    {
      std::reverse(bytes.begin(), bytes.end());
    }
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return static_cast<double>(value);
  }

  string_view text;
  std::size_t at;
  Encoding encoding;
  string_view line;
};

class BodyReader
{
public:
  BodyReader(const Header& declared, string_view all) : header(declared), numbers(all, header) {}

  /// Reads until the file ends, or makes no sense any more.
  void read()
  {
    for (const Element& element : header.elements)
    {
      if (!readAll(element))
      {
        return;
      }
    }
  }

  Model model(const std::string& file) const
  {
    const std::string what = complaint.empty() ? "" : "the file is damaged: " + complaint;
    if (faces.numberOfFaces() == 0)
    {
      throw Error("'" + file + "' holds no face that can be read" + (what.empty() ? "" : ": " + what) +
                  "; export it again");
    }
    Model result;
    if (!what.empty())
    {
      result.warnings.push_back(what + "; what is left is read");
    }
    faces.giveTo(result, {stemOf(file)}, "faces");
    return result;
  }

private:
  bool readAll(const Element& element)
  {
    const bool isVertex = element.name == "vertex";
    const bool isFace = element.name == "face";
    const int list = std::max(element.find("vertex_indices"), element.find("vertex_index"));
    const std::array<int, 3> axes{element.find("x"), element.find("y"), element.find("z")};
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
    {
      const bool present = numbers.beginElement();
      const bool good = present && readOne(element, isFace ? list : -1);
      if (!good && complaint.empty())
      {
        complaint = (present && numbers.isText() ? "a line does not hold " : "it ends before ") + element.name + " " +
                    std::to_string(i + 1) + " of " + std::to_string(element.count);
      }
      if (!present || (!good && !numbers.isText()))
      {
        return false;
      }
      if (isVertex)
      {
        // This replaces a vertex that cannot be read, so that those that follow keep their numbers.
        const double none = std::numeric_limits<double>::quiet_NaN();
        const auto at = [&](int axis) { return good ? scalars[static_cast<std::size_t>(axes[axis])] : none; };
        faces.addPoint({at(0), at(1), at(2)});
      }
      else if (isFace && good)
      {
        faces.add(corners, 0);
      }
    }
    return true;
  }

  /// Reads one element, and the values of its list with the index `wanted`.
  bool readOne(const Element& element, int wanted)
  {
    scalars.assign(element.properties.size(), 0.0);
    corners.clear();
    for (std::size_t p = 0; p < element.properties.size(); ++p)
    {
      const Property& property = element.properties[p];
      const std::optional<double> first = numbers.next(property.countType.value_or(property.type));
      if (!first || (property.countType && !(*first >= 0.0)))
      {
        return false;
      }
      scalars[p] = *first;
      // No list is longer than the file, so this ends.
      for (double i = 0.0; property.countType && i < *first; i += 1.0)
      {
        const std::optional<double> value = numbers.next(property.type);
        if (!value)
        {
          return false;
        }
        if (static_cast<int>(p) == wanted)
        {
          const bool isIndex = *value >= 0.0 && *value < 4294967296.0;
          corners.push_back(isIndex ? static_cast<std::size_t>(*value) : std::numeric_limits<std::size_t>::max());
        }
      }
    }
    return true;
  }

  const Header& header;
  Numbers numbers;
  ModelFaces faces;
  std::vector<double> scalars;
  std::vector<std::size_t> corners;
  std::string complaint; ///< the first
};

/// Throws Error unless there are vertices with coordinates, and then faces. Returns true if coordinates have 32 bits.
bool checkElements(const Header& header, const std::string& file)
{
  const auto find = [&](string_view name) {
    return std::find_if(header.elements.begin(), header.elements.end(),
                        [&](const Element& element) { return element.name == name; });
  };
  const auto vertex = find("vertex");
  const auto face = find("face");
  bool good = vertex < face && face != header.elements.end();
  bool isShort = false;
  for (const char* axis : {"x", "y", "z"})
  {
    const int at = good ? vertex->find(axis) : -1;
    good = at >= 0 && !vertex->properties[at].countType;
    isShort = isShort || (good && vertex->properties[at].type == Type::float32);
  }
  const int list = good ? std::max(face->find("vertex_indices"), face->find("vertex_index")) : -1;
  const auto count = [&](string_view name) {
    return std::count_if(header.elements.begin(), header.elements.end(),
                         [&](const Element& element) { return element.name == name; });
  };
  if (count("vertex") > 1 || count("face") > 1)
  {
    throw Error("'" + file + "' cannot be read as PLY: its header has vertices or faces twice; export it again");
  }
  if (list < 0 || !face->properties[list].countType)
  {
    throw Error("'" + file + "' holds no faces: its header lacks vertex x, y, z or face vertex_indices; a cloud of " +
                "points is no surface, export the model with its faces");
  }
  return isShort && header.encoding != Encoding::ascii;
}

} // namespace

Model readPly(const std::string& file)
{
  const std::string bytes = readBytes(file);
  const Header header = HeaderReader(file, bytes).read();
  const bool isShort = checkElements(header, file);
  BodyReader body(header, bytes);
  body.read();
  Model model = body.model(file);
  model.singlePrecision = isShort;
  model.head = headOf(bytes);
  return model;
}

} // namespace atria::model
