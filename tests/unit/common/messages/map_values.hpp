// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "common/messages/codec.hpp"
#include "common/types/local_map.hpp"

namespace adit::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::int64_t kUtime = 1'600'000'000'000'000;

inline Eigen::Matrix3d information() {
  Eigen::Matrix3d matrix;
  matrix << 400.0, 20.0, 5.0, 20.0, 300.0, -7.0, 5.0, -7.0, 1e4;
  return matrix;
}

inline constexpr std::int64_t kPeriod = 100'000;  // between scans

/// A local map with scans of 181 beams.
inline LocalMap local_map(int id, int scans) {
  LocalMap map;
  map.id = id;
  map.session = 2;
  map.utime = kUtime;
  map.end_utime = kUtime + kPeriod * (scans - 1);
  map.T_odom_local = {12.0, -3.0, 0.7};
  map.T_previous_local = {5.0, 0.1, 0.02};
  map.information = information();
  for (int i = 0; i < scans; ++i) {
    LocalScan local{"LASER_FRONT", {kUtime + kPeriod * i, {}, -1.57, 0.0175}, {0.1 * i, 0.0, 0.01}};
    for (int beam = 0; beam < 181; ++beam) {
      local.scan.ranges_m.push_back(static_cast<float>(5.0 + std::sin(0.1 * beam + i)));
    }
    map.scans.push_back(local);
  }
  return map;
}

/// Encodes and decodes a value.
template <class Value>
auto round_trip(const Value& value) {
  const auto message = to_message(value);
  return from_message(*decode<std::remove_const_t<decltype(message)>>(encode(message)));
}

}  // namespace adit::test
