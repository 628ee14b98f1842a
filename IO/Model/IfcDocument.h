// SPDX-License-Identifier: GPL-3.0-or-later
/// An IFC file as text, changed so that assimp can read it.
///
/// assimp knows IFC 2x3 alone. It crashes on entities of a later schema, or if an entity that it needs is missing. It
/// reads the elements below sites, or below buildings if there is no site.
#pragma once

#include "StepText.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace atria::model::ifc {

/// An element, a part of the site, or anything else with a place and perhaps a shape.
struct Product
{
  std::uint64_t id = 0;
  std::string type;       ///< its class in the file, such as IfcWallStandardCase
  std::string guid;       ///< global identifier, by which assimp's nodes can be found
  std::string name;       ///< in UTF-8; may be empty
  bool isSolid = false;   ///< all of its shapes are solids, which are closed
  bool isLossy = false;   ///< some of its shapes are of a later schema than 2x3
  bool isDropped = false; ///< it is of a later schema itself, or was taken out
};

class Document
{
public:
  explicit Document(std::string_view text);

  const std::string& schema() const { return schemaName; }
  /// Returns the length in meters that assimp takes the unit for. Differs from 1 if assimp does not know the file's
  /// unit.
  double lengthScale() const { return unitScale; }

  /// Returns the products whose shape stands in the model, in the order of the file; no openings, spaces and
  /// annotations.
  const std::vector<Product>& products() const { return found; }
  /// Returns openings by the element they are cut from.
  const std::multimap<std::uint64_t, std::uint64_t>& openings() const { return openingsOf; }

  step::File& file() { return content; }
  /// Returns the file without some elements and their openings.
  std::string textWithout(const std::set<std::uint64_t>& left) const;

private:
  void readUnits();
  void findProducts();
  void readLaterProducts();
  bool hasSolidsAlone(const step::Instance& shape) const;
  void visitItems(const step::Instance& shape, const std::function<void(const step::Instance&)>& visit) const;
  void dropOthers();
  void dropUnknown();
  void dropReferences(step::Instance& from, std::uint64_t to, std::vector<std::uint64_t>& removed);
  void markLossy();
  void putUnderOneSite();
  std::vector<std::uint64_t> rootsOfAssimp(std::uint64_t project) const;

  step::File content;
  std::string schemaName;
  double unitScale = 1.0;
  std::vector<Product> found;
  std::multimap<std::uint64_t, std::uint64_t> openingsOf;
  std::map<std::uint64_t, std::string> laterTypes; ///< in capitals, for products that 2x3 does not know
  std::set<std::uint64_t> lossyRepresentations;
};

} // namespace atria::model::ifc
