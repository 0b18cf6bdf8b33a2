// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace adit::test {

using Points = std::vector<Eigen::Vector3d>;

inline std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Binary encoding of a number.
template <class T>
std::string encoded(T value, bool big_endian = false) {
  using Bits = std::conditional_t<
      sizeof(T) == 8, std::uint64_t,
      std::conditional_t<sizeof(T) == 4, std::uint32_t,
                         std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
  const auto bits = std::bit_cast<Bits>(value);
  std::string text;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t byte = big_endian ? sizeof(T) - 1 - i : i;
    text += static_cast<char>(static_cast<std::uint64_t>(bits) >> 8U * byte & 0xffU);
  }
  return text;
}

inline std::string as_text(const Points& points) {
  std::string text;
  for (const auto& p : points) {
    text +=
        std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  }
  return text;
}

template <class T>
std::string ply(const std::string& format, const std::string& type, const Points& points) {
  std::string text = "ply\nformat " + format + " 1.0\nelement vertex " +
                     std::to_string(points.size()) + "\nproperty " + type + " x\nproperty " + type +
                     " y\nproperty " + type + " z\nend_header\n";
  if (format == "ascii") return text + as_text(points);
  for (const auto& p : points) {
    for (const double value : p) {
      text += encoded(static_cast<T>(value), format == "binary_big_endian");
    }
  }
  return text;
}

inline std::string pcd_head(const std::string& data, char type, int size, std::size_t points) {
  const std::string sizes = std::to_string(size);
  const std::string letter(1, type);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE " + sizes +
         " " + sizes + " " + sizes + "\nTYPE " + letter + " " + letter + " " + letter +
         "\nCOUNT 1 1 1\nWIDTH " + std::to_string(points) +
         "\nHEIGHT 1\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS " + std::to_string(points) + "\nDATA " +
         data + "\n";
}

/// PCD data compressed with LZF, as literals only.
inline std::string packed(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); i += 32) {
    const std::string literal = text.substr(i, 32);
    out += static_cast<char>(literal.size() - 1) + literal;
  }
  return encoded(static_cast<std::uint32_t>(out.size())) +
         encoded(static_cast<std::uint32_t>(text.size())) + out;
}

template <class T>
std::string pcd(const std::string& data, char type, const Points& points) {
  const std::string head = pcd_head(data, type, sizeof(T), points.size());
  if (data == "ascii") return head + as_text(points);
  std::string body;
  if (data == "binary") {
    for (const auto& p : points) {
      for (const double value : p) body += encoded(static_cast<T>(value));
    }
    return head + body;
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const auto& p : points) body += encoded(static_cast<T>(p[axis]));
  }
  return head + packed(body);
}

/// Points that floating-point and integer types represent exactly.
inline Points some_points() { return {{1, -2, 3}, {0, 0, 0}, {-100, 50, 7}, {4, 5, -6}}; }

}  // namespace adit::test
