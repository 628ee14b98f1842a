// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes values as bytes and reads them back, for processes of the same program on machines of one kind.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace atria {

using Bytes = std::vector<std::byte>;

template <typename T>
concept IsList = requires(T list)
{
  list.data();
  list.resize(std::size_t{});
  list.size();
};

/// Appends values. A function that calls an archive with each member of something serves ByteWriter and ByteReader.
class ByteWriter
{
public:
  template <typename T> void operator()(const T& value)
  {
    static_assert(std::is_trivially_destructible_v<T>);
    append(&value, sizeof(T));
  }
  template <IsList T> void operator()(const T& list)
  {
    static_assert(std::is_trivially_destructible_v<std::decay_t<decltype(*list.data())>>);
    (*this)(list.size());
    append(list.data(), list.size() * sizeof(*list.data()));
  }

  Bytes take() { return std::move(bytes_); }

private:
  void append(const void* first, std::size_t count)
  {
    const auto* begin = static_cast<const std::byte*>(first);
    bytes_.insert(bytes_.end(), begin, begin + count);
  }

  Bytes bytes_;
};

/// Reads values in the order in which ByteWriter appended them.
class ByteReader
{
public:
  explicit ByteReader(const Bytes& bytes) : next_(bytes.data()) {}

  template <typename T> void operator()(T& value) { take(&value, sizeof(T)); }
  template <IsList T> void operator()(T& list)
  {
    std::size_t count = 0;
    (*this)(count);
    list.resize(count);
    take(list.data(), count * sizeof(*list.data()));
  }

private:
  void take(void* to, std::size_t count)
  {
    if (count > 0)
    {
      std::memcpy(to, next_, count);
      next_ += count;
    }
  }

  const std::byte* next_;
};

} // namespace atria
