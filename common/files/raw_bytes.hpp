// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace adit {

/// Values as they are in memory, for files that only this process reads.
class RawWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof(T));
  }
  /// A vector or a string.
  template <class Elements>
  void put_all(const Elements& elements) {
    static_assert(std::is_trivially_copyable_v<typename Elements::value_type>);
    put(elements.size());
    append(elements.data(), elements.size() * sizeof(typename Elements::value_type));
  }

  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  void append(const void* from, std::size_t size) {
    const auto* begin = static_cast<const std::uint8_t*>(from);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }

  std::vector<std::uint8_t> bytes_;
};

/// Takes what was put, in the same order.
class RawReader {
 public:
  explicit RawReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class T>
  T take() {
    T value{};
    copy(&value, sizeof(T));
    return value;
  }
  template <class Elements>
  Elements take_all() {
    Elements elements;
    elements.resize(take<std::size_t>());
    copy(elements.data(), elements.size() * sizeof(typename Elements::value_type));
    return elements;
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size == 0) return;
    std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  std::span<const std::uint8_t> bytes_;
};

}  // namespace adit
