// SPDX-License-Identifier: GPL-3.0-or-later
#include "FoamText.h"

#include "OpenFOAMFile.h"
#include "OutputFolders.h"
#include "Support/Error.h"

#include <charconv>
#include <fstream>

namespace atria {

namespace {

constexpr std::size_t valueColumn = 16;

} // namespace

FoamText& FoamText::indent()
{
  written.append(4 * depth, ' ');
  return *this;
}

FoamText& FoamText::entry(std::string_view key, std::string_view value)
{
  indent();
  written += key;
  written.append(key.size() < valueColumn ? valueColumn - key.size() : 1, ' ');
  written += value;
  written += ";\n";
  return *this;
}

FoamText& FoamText::entry(std::string_view key, double value) { return entry(key, foamNumber(value)); }

FoamText& FoamText::open(std::string_view name)
{
  line(name);
  line("{");
  ++depth;
  return *this;
}

FoamText& FoamText::close()
{
  --depth;
  return line("}");
}

FoamText& FoamText::blank()
{
  written += '\n';
  return *this;
}

FoamText& FoamText::comment(std::string_view text) { return line("// " + std::string(text)); }

FoamText& FoamText::line(std::string_view text)
{
  indent();
  written += text;
  written += '\n';
  return *this;
}

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

void writeFoamFile(const std::filesystem::path& caseFolder, std::string_view location, std::string_view name,
                   std::string_view className, const FoamText& content)
{
  makeFolder(caseFolder / location);
  OpenFOAMFile file(caseFolder / location / name,
                    {std::string(className), std::string(location), "", OpenFOAMFormat::Ascii});
  file.text(content.text()).close();
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

} // namespace atria
