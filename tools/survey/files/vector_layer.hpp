// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// The value of an attribute; monostate: unknown.
using AttributeValue = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A number, unknown if it is not finite.
AttributeValue known(double number);

/// A point, or a line of two or more, in the grid: easting, northing, elevation [m].
struct VectorFeature {
  std::vector<Eigen::Vector3d> points;
  std::vector<AttributeValue> values;  ///< as many as fields of its layer
  std::string label;                   ///< text for drawings, or empty
};

/// Features of one kind.
struct VectorLayer {
  enum class Geometry : std::uint8_t { kPoint, kLine };
  struct Field {
    enum class Type : std::uint8_t { kInteger, kNumber, kText };
    std::string name;  ///< with unit: "width_m"
    Type type = Type::kNumber;
  };

  std::string name;
  Geometry geometry = Geometry::kPoint;
  std::vector<Field> fields;
  std::vector<VectorFeature> features;
};

}  // namespace adit
