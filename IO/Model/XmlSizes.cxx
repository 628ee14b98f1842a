// SPDX-License-Identifier: GPL-3.0-or-later
#include "XmlSizes.h"

#include "Base64.h"
#include "ModelParts.h"
#include "ModelText.h"

#include "Support/Error.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string_view>

namespace atria::model {

namespace {

using std::string_view;
using Attributes = std::map<string_view, string_view>;

/// Best ratio of compressors, reached for zeros. Without compression no file holds more than its size.
constexpr std::uint64_t bestRatio = 10000;

Attributes attributesIn(string_view tag)
{
  Attributes out;
  for (std::size_t equals = tag.find('='); equals != tag.npos; equals = tag.find('=', equals))
  {
    const string_view before = tag.substr(0, equals);
    const std::size_t blank = before.find_last_of(" \t\r\n");
    const std::size_t start = tag.find_first_of("\"'", equals);
    const std::size_t stop = start == tag.npos ? tag.npos : tag.find(tag[start], start + 1);
    if (stop == tag.npos)
    {
      break;
    }
    out[before.substr(blank == before.npos ? 0 : blank + 1)] = tag.substr(start + 1, stop - start - 1);
    equals = stop;
  }
  return out;
}

class Check
{
public:
  Check(const std::string& path, const std::string& all) : file(path), bytes(all)
  {
    mostValues = bestRatio * all.size();
  }

  void run()
  {
    const std::size_t appended = bytes.find("<AppendedData");
    const string_view head = bytes.substr(0, appended);
    if (appended != bytes.npos)
    {
      const std::size_t mark = bytes.find('_', appended);
      isRaw = bytes.substr(appended, mark - appended).find("\"raw\"") != bytes.npos;
      data = mark == bytes.npos ? string_view() : bytes.substr(mark + 1);
    }
    for (std::size_t at = head.find('<'); at != head.npos; at = head.find('<', at + 1))
    {
      const std::size_t end = std::min(head.find('>', at), head.size());
      const string_view tag = head.substr(at + 1, end - at - 1);
      element(tag.substr(0, tag.find_first_of(" \t\r\n")), attributesIn(tag),
              head.substr(std::min(end + 1, head.size())));
    }
  }

private:
  void element(string_view name, const Attributes& attributes, string_view content)
  {
    if (name == "VTKFile")
    {
      wordSize = valueOf(attributes, "header_type") == "UInt64" ? 8 : 4;
      isSwapped = (valueOf(attributes, "byte_order") == "BigEndian") != (std::endian::native == std::endian::big);
      isCompressed = attributes.count("compressor") > 0;
    }
    for (const auto& [key, text] : attributes)
    {
      std::uint64_t count = 0;
      const bool isCount = key.substr(0, 8) == "NumberOf";
      require(!isCount || (parse(text, count) && count <= mostValues), key, text);
      if (isCount && name == "Piece")
      {
        mostItems = std::max(mostItems, count);
      }
      if (key == "NumberOfComponents")
      {
        require(count * std::max(mostItems, std::uint64_t{1}) <= mostValues, key, text);
      }
    }
    const string_view format = valueOf(attributes, "format");
    std::uint64_t offset = 0;
    if (format == "appended")
    {
      const string_view text = valueOf(attributes, "offset");
      require(parse(text, offset) && offset < data.size(), "offset", text);
      block(data.substr(offset), isRaw);
    }
    else if (format == "binary")
    {
      block(content.substr(std::min(content.find_first_not_of(" \t\r\n"), content.size())), false);
    }
    const string_view part = valueOf(attributes, "file");
    // Only files that consist of others name files; one that named itself would be read without end.
    if (name == "DataSet" && !part.empty() && lowerEnding(file) != ".vtp")
    {
      const std::filesystem::path beside = std::filesystem::path(file).parent_path() / part;
      if (std::error_code ignored; lowerEnding(beside.string()) == ".vtp" && std::filesystem::exists(beside, ignored))
      {
        checkXmlSizes(beside.string());
      }
    }
  }

  /// Checks the sizes ahead of an array: its bytes; or the number of blocks, bytes of a block and of the last one, and
  /// the compressed bytes of each.
  void block(string_view source, bool raw) const
  {
    const std::uint64_t room = raw ? source.size() : source.size() / 4 * 3;
    const auto words = [&](std::uint64_t count) { return wordsOf(source, raw, count); };
    if (!isCompressed)
    {
      const std::vector<std::uint64_t> size = words(1);
      require(size.size() == 1 && size[0] <= room, "the size of an array", "");
      return;
    }
    const std::vector<std::uint64_t> first = words(3);
    const bool fits = first.size() == 3 && first[0] <= room / wordSize && first[1] <= mostValues &&
                      first[2] <= mostValues && first[0] * first[1] <= mostValues;
    require(fits, "the size of an array", "");
    const std::vector<std::uint64_t> all = words(3 + first[0]);
    require(all.size() == 3 + first[0] && std::all_of(all.begin() + 3, all.end(), [&](auto s) { return s <= room; }),
            "the size of an array", "");
  }

  std::vector<std::uint64_t> wordsOf(string_view source, bool raw, std::uint64_t count) const
  {
    const std::size_t size = static_cast<std::size_t>(count) * wordSize;
    std::string plain(source.substr(0, raw ? size : size / 3 * 4 + 4));
    plain = raw ? plain : fromBase64(plain);
    std::vector<std::uint64_t> out;
    for (std::size_t at = 0; at + wordSize <= plain.size() && out.size() < count; at += wordSize)
    {
      char word[8] = {};
      std::copy_n(plain.begin() + static_cast<std::ptrdiff_t>(at), wordSize, word);
      if (isSwapped)
      {
        std::reverse(word, word + wordSize);
      }
      std::uint64_t value = 0;
      std::memcpy(&value, word, sizeof value);
      out.push_back(value);
    }
    return out;
  }

  static string_view valueOf(const Attributes& attributes, string_view key)
  {
    const auto found = attributes.find(key);
    return found == attributes.end() ? string_view() : found->second;
  }

  void require(bool holds, string_view what, string_view value) const
  {
    if (!holds)
    {
      const std::string stated = value.empty() ? "" : " '" + std::string(value.substr(0, 40)) + "'";
      throw Error("'" + file + "' cannot be read as a VTK XML file: " + std::string(what) + stated +
                  " cannot be right for a file of " + std::to_string(bytes.size()) + " bytes; write it again");
    }
  }

  const std::string& file;
  string_view bytes;
  string_view data; ///< appended, behind its mark
  bool isRaw = false;
  bool isCompressed = false;
  bool isSwapped = false;
  std::size_t wordSize = 4;
  std::uint64_t mostValues = 0;
  std::uint64_t mostItems = 0;
};

} // namespace

void checkXmlSizes(const std::string& file) { Check(file, readBytes(file)).run(); }

} // namespace atria::model
