// SPDX-License-Identifier: GPL-3.0-or-later
#include "ColladaHoles.h"

#include "ModelText.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace atria::model {

namespace {

using std::string_view;
using Words = std::vector<string_view>;

constexpr string_view space = " \t\r\n";

/// Returns the text between the tags of the next element of that name from `at` on, and moves `at` behind it. Returns
/// nothing, and leaves `at` unchanged, if there is none.
string_view nextElement(string_view text, string_view name, std::size_t& at)
{
  const std::string open = "<" + std::string(name);
  const std::string close = "</" + std::string(name);
  std::size_t start = text.find(open, at);
  while (start != text.npos && start + open.size() < text.size() &&
         (string_view(">").find(text[start + open.size()]) == string_view::npos &&
          space.find(text[start + open.size()]) == string_view::npos))
  {
    start = text.find(open, start + 1); // a longer name
  }
  const std::size_t content = start == text.npos ? text.npos : text.find('>', start);
  const std::size_t end = content == text.npos ? text.npos : text.find(close, content);
  const std::size_t behind = end == text.npos ? text.npos : text.find('>', end);
  if (behind == text.npos)
  {
    return {};
  }
  at = behind + 1;
  return text.substr(content + 1, end - content - 1);
}

Words wordsOf(string_view text)
{
  Words words;
  for (std::size_t at = text.find_first_not_of(space); at != text.npos;)
  {
    const std::size_t end = std::min(text.find_first_of(space, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(space, end);
  }
  return words;
}

/// Returns the number of indices of a corner: one for each offset of the inputs before its polygon.
std::size_t numbersOfCorner(string_view before)
{
  const std::size_t element = before.rfind("<polygons");
  std::size_t most = 0;
  string_view inputs = before.substr(element == before.npos ? before.size() : element + 1);
  inputs = inputs.substr(0, inputs.find("<p"));
  constexpr string_view key = "offset=";
  for (std::size_t at = inputs.find(key); at != inputs.npos; at = inputs.find(key, at + 1))
  {
    std::size_t offset = 0;
    if (parse(inputs.substr(at + key.size() + 1), offset, "\"'"))
    {
      most = std::max(most, offset);
    }
  }
  return most + 1;
}

/// Repeats a corner's indices.
void repeat(Words& words, std::size_t corner, std::size_t size)
{
  for (std::size_t k = 0; k < size && corner + k < words.size(); ++k)
  {
    words.push_back(string_view(words[corner + k]));
  }
}

/// Returns outline and holes as one polygon: each ring returns to its first corner, and from there to the outline's.
std::string bridged(string_view polygon, std::size_t cornerSize)
{
  std::size_t at = 0;
  Words all = wordsOf(nextElement(polygon, "p", at));
  bool hasHole = false;
  for (std::size_t next = at; true; at = next)
  {
    const Words hole = wordsOf(nextElement(polygon, "h", next));
    if (next == at)
    {
      break;
    }
    if (!hasHole)
    {
      repeat(all, 0, cornerSize);
    }
    hasHole = true;
    const std::size_t start = all.size();
    all.insert(all.end(), hole.begin(), hole.end());
    repeat(all, start, cornerSize);
    repeat(all, 0, cornerSize);
  }
  std::string out = "<p>";
  for (const string_view word : all)
  {
    out.append(out.size() == 3 ? "" : " ").append(word);
  }
  return out + "</p>";
}

} // namespace

std::string withoutHoles(const std::string& file)
{
  const string_view text = file;
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = 0; true;)
  {
    const string_view polygon = nextElement(text, "ph", at);
    if (at == done)
    {
      break;
    }
    const auto content = static_cast<std::size_t>(polygon.data() - text.data());
    const std::size_t tag = text.rfind('<', content - 1);
    out.append(text.substr(done, tag - done)).append(bridged(polygon, numbersOfCorner(text.substr(0, tag))));
    done = at;
  }
  return done == 0 ? std::string() : out.append(text.substr(done));
}

} // namespace atria::model
