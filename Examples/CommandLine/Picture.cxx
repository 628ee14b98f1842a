// SPDX-License-Identifier: GPL-3.0-or-later
#include "Picture.h"

#include <cstdio>

namespace atria::tool {

namespace {

/// Two digits behind the point are finer than any screen.
std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::string rgb(const Color& color)
{
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", color[0], color[1], color[2]);
  return text;
}

std::string svgOf(const Bar& bar)
{
  const std::string rect = "<rect x=\"" + number(bar.x) + "\" y=\"" + number(bar.y) + "\" width=\"" +
                           number(bar.width) + "\" height=\"" + number(bar.height) + "\" fill=\"" + rgb(bar.color) +
                           '"';
  return bar.tip.empty() ? rect + "/>" : rect + "><title>" + escaped(bar.tip) + "</title></rect>";
}

std::string svgOf(const Line& line)
{
  std::string points;
  for (const auto& [x, y] : line.points)
  {
    points += number(x) + ',' + number(y) + ' ';
  }
  return "<polyline points=\"" + points + "\" fill=\"none\" stroke=\"" + rgb(line.color) + "\" stroke-width=\"" +
         number(line.width) + "\"/>";
}

std::string svgOf(const Text& text)
{
  const char* const anchors[] = {"start", "middle", "end"};
  return "<text x=\"" + number(text.x) + "\" y=\"" + number(text.y) + "\" font-size=\"" + number(text.size) +
         "\" text-anchor=\"" + anchors[static_cast<int>(text.anchor)] + "\" dy=\"0.35em\" fill=\"" + rgb(text.color) +
         '"' + (text.bold ? " font-weight=\"bold\">" : ">") + escaped(text.text) + "</text>";
}

void move(Bar& bar, double x, double y)
{
  bar.x += x;
  bar.y += y;
}

void move(Line& line, double x, double y)
{
  for (auto& point : line.points)
  {
    point.first += x;
    point.second += y;
  }
}

void move(Text& text, double x, double y)
{
  text.x += x;
  text.y += y;
}

} // namespace

void Picture::add(const Picture& other, double x, double y)
{
  for (auto shape : other.shapes)
  {
    std::visit([&](auto& kind) { move(kind, x, y); }, shape);
    shapes.push_back(std::move(shape));
  }
}

std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    switch (c)
    {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string toSvg(const Picture& picture)
{
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(picture.width) + ' ' +
                    number(picture.height) + "\" width=\"" + number(picture.width) + "\" height=\"" +
                    number(picture.height) + "\" font-family=\"Arial, Helvetica, sans-serif\">\n";
  for (const auto& shape : picture.shapes)
  {
    svg += std::visit([](const auto& kind) { return svgOf(kind); }, shape) + '\n';
  }
  return svg + "</svg>\n";
}

} // namespace atria::tool
