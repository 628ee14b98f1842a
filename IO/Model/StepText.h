// SPDX-License-Identifier: GPL-3.0-or-later
/// STEP physical files (ISO 10303-21): their instances and arguments as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace atria::model::step {

/// An instance, such as `#12=IFCWALL('…',#2,$);`.
struct Instance
{
  std::uint64_t id = 0;
  std::string type;      ///< in capitals
  std::string arguments; ///< between the outer parentheses
};

/// The instances of a file, in its order, by their numbers.
class File
{
public:
  /// Reads as much as possible; without a section of data there are no instances.
  explicit File(std::string_view text);

  std::vector<Instance>& instances() { return all; }
  const std::vector<Instance>& instances() const { return all; }
  /// Returns null if there is none.
  Instance* find(std::uint64_t id);
  const Instance* find(std::uint64_t id) const;
  /// Returns null if the text is no reference, or one to nothing.
  const Instance* find(std::string_view reference) const;

  /// Adds an instance with a number of its own, and returns the number.
  std::uint64_t add(const std::string& type, const std::string& arguments);
  void remove(std::uint64_t id);
  bool isRemoved(const Instance& instance) const { return instance.type.empty(); }

  /// Changes the schema that the header states, if it states one.
  void setSchema(const std::string& name);

  /// Returns the whole file, one instance a line, without removed ones.
  std::string text() const;

private:
  void addStatement(std::string_view statement);

  std::string header;
  std::vector<Instance> all;
  std::unordered_map<std::uint64_t, std::size_t> placeOf;
  std::uint64_t lastId = 0;
};

/// Returns the arguments one by one, without blanks around them. A list in parentheses is one argument.
std::vector<std::string_view> argumentsOf(std::string_view text);
/// Returns the text between the parentheses of a list; empty if it is no list.
std::string_view insideOf(std::string_view list);
std::string joinedArguments(const std::vector<std::string_view>& arguments);

/// Returns the argument at an index; empty if there are fewer.
std::string_view argument(const Instance& instance, std::size_t i);
/// Changes the argument at an index, if there is one.
void setArgument(Instance& instance, std::size_t i, const std::string& value);

/// Returns a reference, such as `#12`.
std::string reference(std::uint64_t id);
/// Returns the number of a reference `#12`; nothing for other texts.
std::optional<std::uint64_t> referenceIn(std::string_view text);
/// Calls `visit` with the number of each reference that is not in a string.
void forReferences(std::string_view text, const std::function<void(std::uint64_t)>& visit);

std::optional<double> numberIn(std::string_view text);
/// Returns a string without its quotes, in UTF-8; empty for other texts.
std::string stringIn(std::string_view text);

} // namespace atria::model::step
