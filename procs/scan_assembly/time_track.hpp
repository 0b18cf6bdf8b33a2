// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>

#include "common/geometry/pose2.hpp"

namespace adit {

inline double interpolate(double a, double b, double share) { return a + share * (b - a); }

/// At constant velocity in the frame of `a`, which for small steps is a motion along an arc.
inline Pose2 interpolate(const Pose2& T_w_a, const Pose2& T_w_b, double share) {
  const Pose2 step = between(T_w_a, T_w_b);
  return T_w_a * Pose2{share * step.x, share * step.y, share * step.theta};
}

/// What was measured at some times, and so what was between them.
template <class Value>
class TimeTrack {
 public:
  /// In any order. False where there is one of that time already: it stays.
  bool add(std::int64_t utime, const Value& value) { return values_.emplace(utime, value).second; }

  void clear() { values_.clear(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  /// Of the newest; there must be one.
  [[nodiscard]] std::int64_t end_utime() const { return values_.rbegin()->first; }

  /// Between the neighbours in time; the nearest before the first and after the last. Nothing where
  /// there is none.
  [[nodiscard]] std::optional<Value> at(std::int64_t utime) const {
    if (values_.empty()) return std::nullopt;
    const auto after = values_.lower_bound(utime);
    if (after == values_.end()) return values_.rbegin()->second;
    if (after == values_.begin()) return after->second;
    const auto before = std::prev(after);
    const auto share = static_cast<double>(utime - before->first) /
                       static_cast<double>(after->first - before->first);
    return interpolate(before->second, after->second, share);
  }

 private:
  std::map<std::int64_t, Value> values_;
};

}  // namespace adit
