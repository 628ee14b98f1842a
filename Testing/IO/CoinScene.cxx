// SPDX-License-Identifier: GPL-3.0-or-later
#include "CoinScene.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace atria::testing {

namespace {

/// For the shell.
std::string quoted(const std::string& text)
{
  std::string out = "'";
  for (const char c : text)
  {
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return out + "'";
}

std::string outputOf(const std::string& command)
{
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe)
  {
    throw std::runtime_error("cannot run " + command);
  }
  std::string out;
  char part[4096];
  while (const std::size_t count = std::fread(part, 1, sizeof part, pipe.get()))
  {
    out.append(part, count);
  }
  return out;
}

} // namespace

std::size_t CoinScene::triangles() const
{
  std::size_t sum = 0;
  for (const CoinShape& shape : shapes)
  {
    sum += shape.triangles;
  }
  return sum;
}

double CoinScene::area() const
{
  double sum = 0.0;
  for (const CoinShape& shape : shapes)
  {
    sum += shape.area;
  }
  return sum;
}

bool CoinScene::hasRound() const
{
  return std::any_of(shapes.begin(), shapes.end(), [](const CoinShape& shape) {
    return shape.type.find("Sphere") != std::string::npos || shape.type.find("Cone") != std::string::npos ||
           shape.type.find("Cylinder") != std::string::npos;
  });
}

CoinScene readWithCoin(const std::filesystem::path& file)
{
  CoinScene scene;
  scene.crashed = true;
  std::istringstream lines(outputOf(quoted(ATRIA_COIN_PROGRAM) + " " + quoted(file.string()) + " 2>/dev/null"));
  for (std::string line; std::getline(lines, line);)
  {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "read")
    {
      words >> scene.read;
    }
    else if (keyword == "shape")
    {
      CoinShape shape;
      words >> shape.triangles >> shape.area >> shape.type >> shape.name;
      scene.shapes.push_back(shape);
    }
    else if (keyword == "bound")
    {
      scene.bounds.emplace_back();
      words >> scene.bounds.back();
    }
    else if (keyword == "error")
    {
      scene.errors.push_back(line.substr(keyword.size()));
    }
    scene.crashed = scene.crashed && keyword != "end";
  }
  return scene;
}

} // namespace atria::testing
