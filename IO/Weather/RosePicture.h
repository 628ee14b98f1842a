// SPDX-License-Identifier: GPL-3.0-or-later
/// Draws a wind rose as SVG.
#pragma once

#include "WindClimate.h"

#include <string>

namespace atria::weather {

/// Texts above the rose, in UTF-8.
struct PictureTexts
{
  std::string title;
  std::string subtitle;
};

/// Returns a picture of the rose, north up. A petal is as long as its share of the hours whose wind is known; colors
/// are classes of speed, calm hours stand in the middle. Needs no other file.
std::string rosePicture(const WindRose& rose, const PictureTexts& texts);

} // namespace atria::weather
