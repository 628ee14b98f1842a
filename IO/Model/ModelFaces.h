// SPDX-License-Identifier: GPL-3.0-or-later
/// Collects the faces of a file that may be damaged, and rejects those with unknown points.
#pragma once

#include "ModelParts.h"

#include "Support/IndexTable.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace atria::model {

class ModelFaces
{
public:
  /// Adds a point. One with a coordinate that is not finite is kept, but faces with it are not.
  void addPoint(const std::array<double, 3>& p) { points.push_back(p); }
  /// Returns the number of the first point at these coordinates among those added by this function, or adds one.
  /// Neighbors in files that repeat points for every face then share them, and later steps process fewer points.
  std::size_t pointAt(const std::array<double, 3>& p);
  std::size_t numberOfPoints() const { return points.size(); }
  const std::array<double, 3>& point(std::size_t i) const { return points[i]; }

  /// Adds a face. Leaves out and counts one with less than three corners, with one beyond the last point or with one
  /// that is not finite. `part` counts from 0.
  bool add(std::span<const std::size_t> corners, int part);

  /// Multiplies all coordinates.
  void scale(double factor);

  std::size_t numberOfFaces() const { return parts.size(); }

  /// Gives a model all faces, in double precision, with names for the parts. If faces were left out, the model gets a
  /// warning that calls them `kind`.
  void giveTo(Model& model, const std::vector<std::string>& names, const char* kind) const;

private:
  static std::uint64_t hashOf(const std::array<double, 3>& p);
  void reserveTable();

  std::vector<std::array<double, 3>> points;
  /// Points that pointAt() can find, and the number there is room for.
  IndexTable places{0};
  std::size_t room = 0;
  /// Points requested last: most are soon requested again, and the table is large.
  struct Recent
  {
    std::array<double, 3> place;
    Index point = noIndex;
  };
  std::vector<Recent> recent;
  std::vector<std::size_t> ids;
  std::vector<std::size_t> offsets{0};
  std::vector<int> parts;
  std::size_t leftOut = 0;
};

} // namespace atria::model
