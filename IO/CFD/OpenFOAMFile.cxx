// SPDX-License-Identifier: GPL-3.0-or-later
#include "OpenFOAMFile.h"

#include "Support/Error.h"
#include "Support/Progress.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>

namespace atria {

namespace {

constexpr std::size_t bufferSize = std::size_t{1} << 20;
constexpr std::size_t longestNumber = 32;

} // namespace

OpenFOAMFile::OpenFOAMFile(const std::filesystem::path& path, const Header& header, const ProgressRange* progress)
    : path_(path), progress_(progress), file(std::fopen(path.c_str(), "wb")), buffer(bufferSize, '\0')
{
  if (!file)
  {
    fail();
  }
  const bool binary = header.format == OpenFOAMFormat::Binary;
  text("FoamFile\n{\n    version     2.0;\n    format      ").text(binary ? "binary" : "ascii").text(";\n");
  text("    arch        \"").text(std::endian::native == std::endian::little ? "LSB" : "MSB");
  text(";label=32;scalar=64\";\n    class       ").text(header.className).text(";\n");
  if (!header.note.empty())
  {
    text("    note        \"").text(header.note).text("\";\n");
  }
  text("    location    \"").text(header.location).text("\";\n");
  text("    object      ").text(path.filename().string()).text(";\n}\n\n");
}

OpenFOAMFile& OpenFOAMFile::text(std::string_view characters) { return raw(characters.data(), characters.size()); }

OpenFOAMFile& OpenFOAMFile::number(std::int64_t value)
{
  char* first = room(longestNumber);
  used += static_cast<std::size_t>(std::to_chars(first, first + longestNumber, value).ptr - first);
  return *this;
}

OpenFOAMFile& OpenFOAMFile::number(double value)
{
  char* first = room(longestNumber);
  used += static_cast<std::size_t>(std::to_chars(first, first + longestNumber, value).ptr - first);
  return *this;
}

OpenFOAMFile& OpenFOAMFile::raw(const void* bytes, std::size_t count)
{
  if (count == 0)
  {
    return *this;
  }
  const char* rest = static_cast<const char*>(bytes);
  if (count < bufferSize)
  {
    std::memcpy(room(count), rest, count);
    used += count;
    return *this;
  }
  flush();
  while (count > 0)
  {
    const std::size_t part = std::min(count, bufferSize);
    write(rest, part);
    rest += part;
    count -= part;
  }
  return *this;
}

void OpenFOAMFile::close()
{
  flush();
  if (std::fclose(file.release()) != 0)
  {
    fail();
  }
}

char* OpenFOAMFile::room(std::size_t count)
{
  if (used + count > bufferSize)
  {
    flush();
  }
  return buffer.data() + used;
}

void OpenFOAMFile::flush()
{
  write(buffer.data(), used);
  used = 0;
}

void OpenFOAMFile::write(const char* bytes, std::size_t count)
{
  if (progress_)
  {
    progress_->check();
  }
  if (std::fwrite(bytes, 1, count, file.get()) != count)
  {
    fail();
  }
}

void OpenFOAMFile::fail() const { throw Error("cannot write '" + path_.string() + "': " + std::strerror(errno)); }

} // namespace atria
