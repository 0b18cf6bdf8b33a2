// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/cloud/number_type.hpp"
#include "tools/cloud/text_lines.hpp"

namespace adit {

/// What the head of a PCD file (version 0.7 of the Point Cloud Library) announces.
struct PcdHeader {
  enum class Data : std::uint8_t { kAscii, kBinary, kCompressed };

  struct Field {
    std::string name;
    NumberType type;
    std::size_t count = 1;
  };

  std::vector<Field> fields;
  std::array<std::size_t, 3> xyz{};  ///< their places among the fields
  std::uint64_t points = 0;
  Data data = Data::kAscii;
  std::optional<Eigen::Vector3d> viewpoint;

  /// Of one point, in a binary file.
  [[nodiscard]] std::size_t stride() const;
  /// Bytes before a field in a point.
  [[nodiscard]] std::size_t offset(std::size_t field) const;
};

/// Takes the head off the lines. Throws std::runtime_error, with the line, where it is none.
PcdHeader read_pcd_header(TextLines& lines);

}  // namespace adit
