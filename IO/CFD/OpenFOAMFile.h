// SPDX-License-Identifier: GPL-3.0-or-later
/// Files with OpenFOAM's header, in text or binary form.
#pragma once

#include "OutputFile.h"

#include <string>

namespace atria {

/// Format of lists. Both formats read back to the same bits.
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
    std::string className; ///< OpenFOAM's name for the kind of content, such as vectorField
    std::string location;  ///< folder within the case
    std::string note;      ///< left out when empty
    OpenFOAMFormat format = OpenFOAMFormat::Ascii;
  };

  OpenFOAMFile(const std::filesystem::path& path, const Header& header, const ProgressRange* progress = nullptr);
};

} // namespace atria
