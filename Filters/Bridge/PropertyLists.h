// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists that are properties of filters, readers and writers: the bodies of Add, RemoveAll, GetNumberOf and Get.
#pragma once

#include <vtkObject.h>

#include <string>
#include <vector>

namespace atria {

/// Adds a text to a list of `owner`, which is marked as modified. Null is an empty text.
inline void addText(vtkObject& owner, std::vector<std::string>& list, const char* text)
{
  list.emplace_back(text ? text : "");
  owner.Modified();
}

/// Empties a list of `owner`, which is marked as modified.
template <typename Entry> void removeAll(vtkObject& owner, std::vector<Entry>& list)
{
  list.clear();
  owner.Modified();
}

template <typename Entry> int numberOf(const std::vector<Entry>& list) { return static_cast<int>(list.size()); }

/// Returns an entry; an empty text or 0 if the list has no such entry.
template <typename Entry> Entry entryAt(const std::vector<Entry>& list, int i)
{
  return i >= 0 && i < numberOf(list) ? list[static_cast<std::size_t>(i)] : Entry();
}

} // namespace atria
