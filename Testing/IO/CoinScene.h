// SPDX-License-Identifier: GPL-3.0-or-later
/// A model as Coin reads it: another reader of VRML, in single precision.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace atria::testing {

struct CoinShape
{
  std::string name;          ///< DEF name of the shape, else of its geometry, else of the nearest node around it
  std::string type;          ///< of the geometry, such as VRMLIndexedFaceSet
  std::size_t triangles = 0; ///< those with an area
  double area = 0.0;
};

struct CoinScene
{
  bool crashed = false; ///< while reading
  bool read = false;
  std::vector<CoinShape> shapes; ///< those that have triangles, without texts
  std::vector<double> bounds;    ///< xmin, xmax, ymin, … of their triangles
  std::vector<std::string> errors;

  std::size_t triangles() const;
  double area() const;
  /// Whether there are shapes that each reader tessellates its own way.
  bool hasRound() const;
};

/// Runs Coin in a process of its own.
CoinScene readWithCoin(const std::filesystem::path& file);

} // namespace atria::testing
