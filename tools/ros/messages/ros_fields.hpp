// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace adit {

/// Takes the fields of a serialized message of ROS, in their order: of ROS 1, or of ROS 2 in CDR
/// (OMG DDSI-RTPS 2.3, section 10; OMG DDS-XTypes 1.3, section 7.4), with either byte order. After
/// the end of the bytes every field is zero or empty and `ok` is false.
class RosFields {
 public:
  /// `encoding`: "ros1" or "cdr"; `ok` is false for another one, or one of CDR that is not plain.
  RosFields(std::span<const std::uint8_t> bytes, std::string_view encoding);

  template <class T>
  T number() {
    align(sizeof(T));
    return take<T>();
  }
  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::int32_t i32() { return number<std::int32_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  double f32() { return static_cast<double>(number<float>()); }
  double f64() { return number<double>(); }

  std::string text();
  /// The number of elements of a sequence, of which each takes at least `element_bytes`.
  std::size_t count(std::size_t element_bytes);
  std::vector<float> floats();
  /// A sequence of bytes, in place.
  std::span<const std::uint8_t> bytes();
  /// An array of fixed length that is not wanted.
  void skip_f64(std::size_t elements);

  /// Time and frame of std_msgs/Header; the time in µs since the epoch.
  struct Header {
    std::int64_t utime = 0;
    std::string frame;  ///< without the "/" that tf of early ROS 1 had
  };
  Header header();

  [[nodiscard]] bool ok() const { return ok_; }

 private:
  template <class T>
  T take() {
    static_assert(std::is_arithmetic_v<T>);
    std::uint8_t raw[sizeof(T)] = {};
    copy(raw, sizeof(T));
    T value{};
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }
  void align(std::size_t size);
  /// Copies a number into the byte order of this computer.
  void copy(std::uint8_t* to, std::size_t size);
  std::span<const std::uint8_t> raw(std::size_t size);

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
  bool ros1_ = false;
  bool big_endian_ = false;
  std::size_t align_max_ = 8;
};

/// The name of a frame as tf2 has it.
std::string frame_name(std::string_view name);

}  // namespace adit
