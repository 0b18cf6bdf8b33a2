// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace adit {

/// The bytes as text, which ends with them.
inline std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Takes little-endian fields from bytes; after the end of the bytes every field is empty and `ok`
/// is false.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint64_t number(std::size_t size) {
    const auto field = bytes(size);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < field.size(); ++i)
      value |= static_cast<std::uint64_t>(field[i]) << (8U * i);
    return value;
  }
  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }

  std::span<const std::uint8_t> bytes(std::size_t size) {
    if (size > left()) ok_ = false;
    if (!ok_) return {};
    const auto field = bytes_.subspan(at_, size);
    at_ += size;
    return field;
  }
  /// Bytes behind their number in 4 bytes.
  std::string_view text() {
    const auto field = bytes(u32());
    return {reinterpret_cast<const char*>(field.data()), field.size()};
  }
  std::span<const std::uint8_t> rest() { return bytes(left()); }

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace adit
