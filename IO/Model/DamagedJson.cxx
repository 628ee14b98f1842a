// SPDX-License-Identifier: GPL-3.0-or-later
#include "DamagedJson.h"

#include "Support/Utf8.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <vector>

namespace atria::model {

namespace {

using Json = nlohmann::json;
using std::string_view;

constexpr string_view blanks = " \t\r\n";
constexpr string_view delimiters = " \t\r\n,:{}[]\"";

void appendUtf8(std::string& out, std::uint32_t code)
{
  const auto put = [&](std::uint32_t byte) { out.push_back(static_cast<char>(byte)); };
  if (code < 0x80)
  {
    put(code);
    return;
  }
  const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  constexpr std::uint32_t lead[] = {0, 0xc0, 0xe0, 0xf0};
  put(lead[more] | code >> 6 * more);
  for (int i = more - 1; i >= 0; --i)
  {
    put(0x80 | (code >> 6 * i & 0x3f));
  }
}

/// The unit of UTF-16 in four digits; no such unit where they are none.
std::uint32_t unitIn(string_view digits)
{
  constexpr std::uint32_t none = 0x110000;
  std::uint32_t value = none;
  const char* const last = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), last, value, 16);
  return error == std::errc{} && stop == last && digits.size() == 4 ? value : none;
}

/// Appends the character that the digits at `at` stand for, and those of a second escape where it takes two. Returns
/// how many bytes were used.
std::size_t appendEscaped(std::string& out, string_view text, std::size_t at)
{
  constexpr std::uint32_t unknown = 0xfffd;
  const auto unit = [&](std::size_t from) { return unitIn(text.substr(std::min(from, text.size()), 4)); };
  const std::uint32_t first = unit(at);
  const bool isPair = first >= 0xd800 && first <= 0xdbff && text.substr(std::min(at + 4, text.size()), 2) == "\\u";
  const std::uint32_t second = isPair ? unit(at + 6) : 0;
  if (second >= 0xdc00 && second <= 0xdfff)
  {
    appendUtf8(out, 0x10000 + ((first - 0xd800) << 10) + (second - 0xdc00));
    return 10;
  }
  appendUtf8(out, first > 0xffff || (first >= 0xd800 && first <= 0xdfff) ? unknown : first);
  return first > 0xffff ? 0 : 4;
}

/// Takes the escapes out of what stands between quotes.
std::string unescaped(string_view text)
{
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    if (text[at] != '\\' || at + 1 == text.size())
    {
      out.push_back(text[at]);
      continue;
    }
    ++at;
    constexpr string_view letters = "bfnrt";
    constexpr string_view meant = "\b\f\n\r\t";
    if (text[at] == 'u')
    {
      at += appendEscaped(out, text, at + 1);
      continue;
    }
    const std::size_t escape = letters.find(text[at]);
    out.push_back(escape == letters.npos ? text[at] : meant[escape]);
  }
  return out;
}

class Reader
{
public:
  explicit Reader(string_view all) : text(all) {}

  Json read()
  {
    while ((at = text.find_first_not_of(blanks, at)) != text.npos)
    {
      token();
    }
    if (!open.empty())
    {
      at = text.size();
      complain("the closing bracket");
    }
    return std::move(root);
  }

  std::string complaint;

private:
  /// A list or an object that has not been closed.
  struct Level
  {
    Json* value;
    std::string key; ///< of the object's next value
    bool hasKey = false;
    bool hasColon = false;
  };

  void token()
  {
    const char c = text[at];
    if (c == '{' || c == '[')
    {
      begin(c == '{' ? Json::object() : Json::array());
    }
    else if (c == '}' || c == ']')
    {
      end(c == '}');
    }
    else if (c == ',' || c == ':')
    {
      separate(c == ':');
    }
    else if (c == '"')
    {
      string();
    }
    else
    {
      word();
    }
  }

  void begin(Json value)
  {
    closeBefore(value);
    // No glTF is deeper than a few, and values are destroyed by calls within calls.
    constexpr std::size_t deepest = 500;
    if (open.size() >= deepest)
    {
      complain("less than " + std::to_string(deepest) + " brackets around one another");
      at = text.size();
      return;
    }
    if (Json* place = add(std::move(value)))
    {
      open.push_back({place, {}});
    }
    ++at;
  }

  /// An object without a key, in one of a list of objects, is the next of that list.
  void closeBefore(const Json& value)
  {
    const std::size_t depth = open.size();
    if (value.is_object() && depth > 1 && open.back().value->is_object() && !open.back().hasKey &&
        open[depth - 2].value->is_array())
    {
      complain("a closing bracket");
      open.pop_back();
    }
  }

  /// Closes the innermost object or list, with all in it that has not been closed. The outermost stays open as long as
  /// there is more.
  void end(bool object)
  {
    auto found = std::find_if(open.rbegin(), open.rend(),
                              [&](const Level& level) { return level.value->is_object() == object; });
    if (found != open.rend() && found + 1 == open.rend() && text.find_first_not_of(blanks, at + 1) != text.npos)
    {
      found = open.rend();
    }
    if (found != open.rbegin() || open.empty())
    {
      complain(found == open.rend() ? "no closing bracket" : "another closing bracket");
    }
    if (found != open.rend())
    {
      open.erase(found.base() - 1, open.end());
    }
    ++at;
  }

  /// Where a colon stands in a list, the object ahead was closed too early: what is before the colon is a key of it.
  void reopen()
  {
    Json& list = *open.back().value;
    const std::size_t count = list.size();
    if (count > 1 && list[count - 1].is_string() && list[count - 2].is_object())
    {
      std::string key = list[count - 1].get<std::string>();
      list.erase(count - 1);
      open.push_back({&list.back(), std::move(key), true, false});
    }
  }

  void separate(bool colon)
  {
    if (colon && !open.empty() && open.back().value->is_array())
    {
      complain("no colon");
      reopen();
    }
    Level* level = open.empty() ? nullptr : &open.back();
    const bool good = level && (colon ? level->hasKey && !level->hasColon : !level->hasKey);
    if (!good)
    {
      complain("a value");
    }
    if (level)
    {
      level->hasKey = level->hasKey && colon;
      level->hasColon = level->hasKey;
    }
    ++at;
  }

  void string() { put(toUtf8(quoted())); }

  /// A key or a text.
  void put(const std::string& value)
  {
    Level* level = open.empty() ? nullptr : &open.back();
    if (level && level->value->is_object() && !level->hasKey)
    {
      level->key = value;
      level->hasKey = true;
      return;
    }
    add(value);
  }

  /// The text from a quote to the next. Where something else follows than may, one of the two is missing, and the text
  /// ends with its word.
  std::string quoted()
  {
    const std::size_t start = at;
    std::string out = untilQuote();
    const std::size_t next = text.find_first_not_of(blanks, at);
    if (next != text.npos && delimiters.find(text[next]) != delimiters.npos && text[next] != '{' && text[next] != '[')
    {
      return out;
    }
    const std::size_t stop = std::min(text.find_first_of(",:{}[]", start), text.size());
    if (next != text.npos && stop < at)
    {
      at = stop;
      complain("the closing quote");
      out = text.substr(start + 1, stop - start - 1);
    }
    return out;
  }

  std::string untilQuote()
  {
    const std::size_t start = ++at;
    while (at < text.size() && text[at] != '"')
    {
      at += text[at] == '\\' ? 2 : 1;
    }
    if (at >= text.size())
    {
      complain("the closing quote");
      at = text.size();
      return unescaped(toUtf8(text.substr(start)));
    }
    ++at;
    return unescaped(toUtf8(text.substr(start, at - 1 - start)));
  }

  /// A number or a keyword.
  void word()
  {
    const std::size_t stop = std::min(text.find_first_of(delimiters, at), text.size());
    const string_view all = text.substr(at, stop - at);
    Json value = all == "true" ? Json(true) : all == "false" ? Json(false) : number(all);
    const bool isKnown = !value.is_null() || all == "null";
    if (!isKnown)
    {
      complain("a value");
    }
    at = stop;
    const bool isKey = !open.empty() && open.back().value->is_object() && !open.back().hasKey;
    const bool isText = at < text.size() && text[at] == '"'; // without its first quote
    if (isKnown || !(isKey || isText))
    {
      add(std::move(value));
      return;
    }
    at += isText ? 1 : 0;
    put(toUtf8(all));
  }

  static Json number(string_view all)
  {
    const char* const last = all.data() + all.size();
    const auto parsed = [&](auto value) {
      const auto [end, error] = std::from_chars(all.data(), last, value);
      return error == std::errc{} && end == last ? Json(value) : Json();
    };
    Json value = parsed(std::uint64_t{});
    value = value.is_null() ? parsed(std::int64_t{}) : value;
    return value.is_null() ? parsed(double{}) : value;
  }

  /// Where the value was put; null where there is no place for it.
  Json* add(Json value)
  {
    if (open.empty())
    {
      if (!root.is_null())
      {
        complain("the end of the file");
        return nullptr;
      }
      root = std::move(value);
      return &root;
    }
    Level& level = open.back();
    if (level.value->is_array())
    {
      level.value->push_back(std::move(value));
      return &level.value->back();
    }
    if (!level.hasColon)
    {
      complain(level.hasKey ? "a colon" : "a key");
    }
    Json& place = (*level.value)[level.hasKey ? level.key : std::string()];
    place = std::move(value);
    level.hasKey = level.hasColon = false;
    return &place;
  }

  void complain(const std::string& expected)
  {
    if (complaint.empty())
    {
      const string_view before = text.substr(0, at);
      const auto line = 1 + std::count(before.begin(), before.end(), '\n');
      const std::size_t column = at - (before.rfind('\n') + 1);
      complaint = "line " + std::to_string(line) + ", column " + std::to_string(column + 1) + ": expected " + expected;
    }
  }

  string_view text;
  std::size_t at = 0;
  Json root;
  std::vector<Level> open;
};

} // namespace

Json readDamagedJson(string_view text, std::string& complaint)
{
  Reader reader(text);
  Json value = reader.read();
  complaint = reader.complaint;
  return value;
}

} // namespace atria::model
