// SPDX-License-Identifier: GPL-3.0-or-later
#include "FoamText.h"

#include "OpenFOAMFile.h"
#include "OutputFolders.h"
#include "Support/Error.h"

#include <charconv>
#include <fstream>

namespace atria {

namespace {

/// Returns the text of lines, each with its end.
std::string joinedLines(const Lines& lines)
{
  std::string text;
  for (const std::string& line : lines)
  {
    text += line + '\n';
  }
  return text;
}

} // namespace

std::string foamNumber(double value)
{
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value == 0.0 ? 0.0 : value).ptr;
  return {digits, end};
}

std::string foamVector(const Vec3& v)
{
  const std::string components[] = {foamNumber(v[0]), foamNumber(v[1]), foamNumber(v[2])};
  return foamList(components);
}

std::string foamList(std::span<const std::string> words)
{
  std::string list = "(";
  for (const std::string& word : words)
  {
    list += (list.size() > 1 ? " " : "") + word;
  }
  return list + ")";
}

void writeFoamFile(const std::filesystem::path& caseFolder, const std::filesystem::path& path,
                   std::string_view className, const Lines& content)
{
  const std::filesystem::path folder = path.parent_path();
  makeFolder(caseFolder / folder);
  OpenFOAMFile file(caseFolder / path, {std::string(className), folder.string(), "", OpenFOAMFormat::Ascii});
  file.text(joinedLines(content)).close();
}

void writePlainFile(const std::filesystem::path& path, std::string_view content)
{
  const std::filesystem::path beside = path.string() + ".unfinished";
  std::ofstream file(beside, std::ios::binary);
  file << content;
  file.close();
  std::error_code error;
  if (file)
  {
    std::filesystem::rename(beside, path, error);
  }
  if (!file || error)
  {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw OutputError("cannot write '" + path.string() + "'");
  }
}

void writeScript(const std::filesystem::path& path, const Lines& content)
{
  using std::filesystem::perms;
  writePlainFile(path, joinedLines(content));
  std::error_code ignored;
  std::filesystem::permissions(path, perms::owner_exec | perms::group_exec | perms::others_exec,
                               std::filesystem::perm_options::add, ignored);
}

} // namespace atria
