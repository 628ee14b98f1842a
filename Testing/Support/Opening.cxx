// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/Opening.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace atria::testing {

std::vector<Opening> readOpenings(const std::filesystem::path& file)
{
  std::ifstream in(file);
  std::vector<Opening> out;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line))
  {
    std::istringstream cells(line);
    Opening opening;
    std::getline(cells, opening.name, ',');
    std::vector<double> numbers;
    for (std::string cell; std::getline(cells, cell, ',');)
    {
      numbers.push_back(std::stod(cell));
    }
    if (numbers.size() < 9 || numbers.size() % 3 != 0)
    {
      throw std::runtime_error(file.string() + ": not an opening: " + line);
    }
    for (std::size_t i = 0; i < numbers.size(); i += 3)
    {
      opening.outline.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    }
    out.push_back(opening);
  }
  if (out.empty())
  {
    throw std::runtime_error(file.string() + ": no openings");
  }
  return out;
}

FlatOpening::FlatOpening(const Opening& opening) : origin(opening.outline.front()), normal(Vec3::Zero())
{
  const std::size_t n = opening.outline.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    normal += (opening.outline[i] - origin).cross(opening.outline[(i + 1) % n] - origin);
  }
  area = 0.5 * normal.norm();
  normal.normalize();
  u = (opening.outline[1] - origin).normalized();
  v = normal.cross(u);
  low = high = {0.0, 0.0};
  for (const Vec3& p : opening.outline)
  {
    outline.push_back({(p - origin).dot(u), (p - origin).dot(v)});
    for (int i = 0; i < 2; ++i)
    {
      low[i] = std::min(low[i], outline.back()[i]);
      high[i] = std::max(high[i], outline.back()[i]);
    }
  }
}

bool FlatOpening::contains(double x, double y) const
{
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++)
  {
    const auto& [xi, yi] = outline[i];
    const auto& [xj, yj] = outline[j];
    if ((yi > y) != (yj > y) && x < (xj - xi) * (y - yi) / (yj - yi) + xi)
    {
      inside = !inside;
    }
  }
  return inside;
}

} // namespace atria::testing
