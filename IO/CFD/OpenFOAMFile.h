// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "OutputFile.h"

#include <string>

namespace atria {

/// How lists are written. Both read back to the same bits.
enum class OpenFOAMFormat
{
  Ascii,
  Binary
};

/// A file with OpenFOAM's header; its name becomes the header's `object`.
class OpenFOAMFile : public OutputFile
{
public:
  struct Header
  {
    std::string className; ///< what OpenFOAM calls the kind of content, such as vectorField
    std::string location;  ///< folder within the case
    std::string note;      ///< left out when empty
    OpenFOAMFormat format = OpenFOAMFormat::Ascii;
  };

  OpenFOAMFile(const std::filesystem::path& path, const Header& header, const ProgressRange* progress = nullptr);
};

} // namespace atria
