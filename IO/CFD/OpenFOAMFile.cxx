// SPDX-License-Identifier: GPL-3.0-or-later
#include "OpenFOAMFile.h"

#include <bit>

namespace atria {

OpenFOAMFile::OpenFOAMFile(const std::filesystem::path& path, const Header& header, const ProgressRange* progress)
    : OutputFile(path, progress)
{
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

} // namespace atria
