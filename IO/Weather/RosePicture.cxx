// SPDX-License-Identifier: GPL-3.0-or-later
#include "RosePicture.h"

#include "WeatherText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>
#include <vector>

namespace atria::weather {

namespace {

// Pixels of the picture.
constexpr double width = 760.0, height = 620.0;
constexpr double centerX = 300.0, centerY = 345.0;
constexpr double innerRadius = 26.0, outerRadius = 225.0;
constexpr double legendX = 600.0, legendY = 150.0;

struct SpeedClass
{
  double least; ///< m/s
  const char* name;
  const char* color; ///< light to dark, so that the order shows in gray, too
};
constexpr std::array classes{SpeedClass{0.0, "below 2 m/s", "#c6dbef"}, SpeedClass{2.0, "2 to 4", "#7fcdbb"},
                             SpeedClass{4.0, "4 to 6", "#41b6c4"},      SpeedClass{6.0, "6 to 8", "#1d91c0"},
                             SpeedClass{8.0, "8 to 10", "#225ea8"},     SpeedClass{10.0, "10 and more", "#0c2c84"}};

std::size_t classOf(double speed)
{
  std::size_t found = classes.size() - 1;
  while (speed < classes[found].least)
  {
    --found;
  }
  return found;
}

/// Returns the text of printf().
std::string format(const char* pattern, ...)
{
  char text[512];
  std::va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return out;
}

/// Returns a text at a place. Attributes say how it looks.
std::string textAt(double x, double y, const char* attributes, const std::string& text)
{
  return format("<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, attributes) + escaped(text) + "</text>\n";
}

struct Point
{
  double x, y;
};

/// Returns the place at a distance from the center, in a direction clockwise from north.
Point pointAt(double degrees, double radius)
{
  const double angle = degrees * std::numbers::pi / 180.0;
  return {centerX + radius * std::sin(angle), centerY - radius * std::cos(angle)};
}

/// The rings that say how long petals are.
struct RadialScale
{
  double step = 0.0; ///< share of hours between two rings
  int rings = 0;

  double radius(double share) const { return innerRadius + (outerRadius - innerRadius) * share / (step * rings); }
};

/// Returns three to six rings at steps of 1, 2 or 5 times a power of ten.
RadialScale scaleFor(double longest)
{
  constexpr int mostRings = 5;
  const double least = longest / mostRings;
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  RadialScale scale;
  for (const double factor : {1.0, 2.0, 5.0, 10.0})
  {
    scale.step = factor * decade;
    if (scale.step >= least * (1.0 - 1e-9))
    {
      break;
    }
  }
  scale.rings = std::max(2, static_cast<int>(std::ceil(longest / scale.step - 1e-9)));
  return scale;
}

/// Returns a part of a petal between two distances from the center.
std::string ringPart(double from, double halfWidth, double inner, double outer, const char* color)
{
  const Point a = pointAt(from - halfWidth, inner), b = pointAt(from - halfWidth, outer);
  const Point c = pointAt(from + halfWidth, outer), d = pointAt(from + halfWidth, inner);
  return format("<path d=\"M%.2f %.2fL%.2f %.2fA%.2f %.2f 0 0 1 %.2f %.2fL%.2f %.2fA%.2f %.2f 0 0 0 %.2f %.2fZ\" "
                "fill=\"%s\"/>\n",
                a.x, a.y, b.x, b.y, outer, outer, c.x, c.y, d.x, d.y, inner, inner, a.x, a.y, color);
}

std::string petal(const RoseSector& sector, const WindRose& rose, const RadialScale& scale)
{
  std::array<std::size_t, classes.size()> counts{};
  for (const double speed : sector.speeds)
  {
    ++counts[classOf(speed)];
  }
  constexpr double filled = 0.8; // share of the sector's angle
  const double halfWidth = filled * 180.0 / static_cast<double>(rose.sectors.size());
  std::string text;
  std::size_t below = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    const auto share = [&](std::size_t hours) { return static_cast<double>(hours) / static_cast<double>(rose.hours); };
    const double inner = scale.radius(share(below));
    below += counts[i];
    text += counts[i] > 0 ? ringPart(sector.from, halfWidth, inner, scale.radius(share(below)), classes[i].color) : "";
  }
  return text;
}

std::string percent(double share, int digits = 0) { return format("%.*f %%", digits, 100.0 * share); }

std::string rings(const RadialScale& scale)
{
  std::string text = "<g fill=\"none\" stroke=\"#d4d8dd\">\n";
  for (int i = 1; i <= scale.rings; ++i)
  {
    text += format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.2f\"/>\n", centerX, centerY, scale.radius(i * scale.step));
  }
  for (int i = 0; i < 8; ++i)
  {
    const Point a = pointAt(45.0 * i, innerRadius), b = pointAt(45.0 * i, outerRadius);
    text += format("<path d=\"M%.2f %.2fL%.2f %.2f\"/>\n", a.x, a.y, b.x, b.y);
  }
  return text + "</g>\n";
}

/// Returns the direction between two petals where both are shortest.
double emptiestGap(const WindRose& rose)
{
  const std::size_t count = rose.sectors.size();
  const auto longer = [&](std::size_t i) {
    return std::max(rose.sectors[i].speeds.size(), rose.sectors[(i + 1) % count].speeds.size());
  };
  std::size_t found = 0;
  for (std::size_t i = 1; i < count; ++i)
  {
    found = longer(i) < longer(found) ? i : found;
  }
  return rose.sectors[found].from + 180.0 / static_cast<double>(count);
}

/// Returns what the rings mean, along a direction, and the points of the compass.
std::string labels(const RadialScale& scale, double angle)
{
  std::string text;
  const int digits = scale.step < 0.0099 ? 1 : 0;
  for (int i = 1; i <= scale.rings; ++i)
  {
    const Point at = pointAt(angle, scale.radius(i * scale.step));
    text += textAt(at.x, at.y + 4.0,
                   "font-size=\"12\" text-anchor=\"middle\" fill=\"#5a6470\" stroke=\"#ffffff\" stroke-width=\"3\" "
                   "paint-order=\"stroke\"",
                   percent(i * scale.step, digits));
  }
  constexpr std::array points{"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Point at = pointAt(45.0 * static_cast<double>(i), outerRadius + 26.0);
    const char* look = i % 2 == 0 ? "font-size=\"18\" font-weight=\"bold\" text-anchor=\"middle\" fill=\"#282828\""
                                  : "font-size=\"13\" text-anchor=\"middle\" fill=\"#5a6470\"";
    text += textAt(at.x, at.y + (i % 2 == 0 ? 6.0 : 4.0), look, points[i]);
  }
  return text;
}

std::string middle(const WindRose& rose)
{
  const double calm = static_cast<double>(rose.calms) / static_cast<double>(rose.hours);
  const char* look = "font-size=\"12\" text-anchor=\"middle\" fill=\"#282828\"";
  return format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#ffffff\" stroke=\"#9aa3ad\"/>\n", centerX, centerY,
                innerRadius) +
         textAt(centerX, centerY - 3.0, look, "calm") + textAt(centerX, centerY + 12.0, look, percent(calm, 1));
}

/// Returns the classes of speed, fastest first, as petals have them from the outside in, and the mean.
std::string legend(const WindRose& rose)
{
  std::string text = textAt(legendX, legendY, "font-size=\"14\" font-weight=\"bold\" fill=\"#282828\"", "Wind speed");
  double y = legendY + 14.0;
  for (std::size_t i = classes.size(); i-- > 0; y += 26.0)
  {
    text +=
        format("<rect x=\"%.1f\" y=\"%.1f\" width=\"18\" height=\"18\" fill=\"%s\"/>\n", legendX, y, classes[i].color);
    text += textAt(legendX + 27.0, y + 14.0, "font-size=\"14\" fill=\"#282828\"", classes[i].name);
  }
  text += textAt(legendX, y + 28.0, "font-size=\"14\" fill=\"#282828\"", format("mean %.1f m/s", rose.meanSpeed));
  return text;
}

std::string head(const PictureTexts& texts)
{
  return format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
                "font-family=\"Arial, Helvetica, sans-serif\">\n",
                width, height, width, height) +
         "<title>" + escaped(texts.title) + "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
         textAt(30.0, 40.0, "font-size=\"21\" font-weight=\"bold\" fill=\"#282828\"", texts.title) +
         textAt(30.0, 64.0, "font-size=\"14\" fill=\"#5a6470\"", texts.subtitle);
}

} // namespace

std::string rosePicture(const WindRose& rose, const PictureTexts& texts)
{
  std::size_t longest = 0;
  for (const RoseSector& sector : rose.sectors)
  {
    longest = std::max(longest, sector.speeds.size());
  }
  const RadialScale scale = scaleFor(static_cast<double>(longest) / static_cast<double>(rose.hours));
  std::string text = head(texts) + rings(scale);
  for (const RoseSector& sector : rose.sectors)
  {
    text += petal(sector, rose, scale);
  }
  return text + middle(rose) + labels(scale, emptiestGap(rose)) + legend(rose) + "</svg>\n";
}

} // namespace atria::weather
