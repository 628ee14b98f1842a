// SPDX-License-Identifier: GPL-3.0-or-later
/// Adds named arrays to VTK data; docs/arrays.md lists the arrays.
#pragma once

#include <vtkFieldData.h>
#include <vtkNew.h>

#include <functional>
#include <iterator>
#include <type_traits>

namespace atria {

/// Adds an empty array and returns it. The data owns it.
template <typename Array> Array* addArray(vtkFieldData* data, const char* name, int components = 1)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  data->AddArray(array);
  return array;
}

/// Adds an array with valueOf(entry) for each entry of a list.
template <typename Array, typename List, typename ValueOf = std::identity>
void addArrayOf(vtkFieldData* data, const char* name, const List& list, ValueOf&& valueOf = {})
{
  Array* const array = addArray<Array>(data, name);
  array->SetNumberOfValues(static_cast<vtkIdType>(std::size(list)));
  vtkIdType i = 0;
  for (const auto& entry : list)
  {
    const auto& value = std::invoke(valueOf, entry);
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
    {
      array->SetValue(i++, static_cast<typename Array::ValueType>(value));
    }
    else
    {
      array->SetValue(i++, value);
    }
  }
}

} // namespace atria
