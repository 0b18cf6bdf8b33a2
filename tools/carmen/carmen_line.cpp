// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_line.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2.0;
constexpr double kLatestTimeSeconds = 1e11;  // year 5138

/// Thrown and caught within this file.
struct ParseError {
  std::string_view reason;
};

/// Reads the tokens of one line in order.
class Tokens {
 public:
  explicit Tokens(std::string_view line) : rest_(line) {}

  std::string_view next() {
    const std::size_t start = rest_.find_first_not_of(kBlanks);
    if (start == std::string_view::npos) return rest_ = {};
    rest_.remove_prefix(start);
    const std::string_view token = rest_.substr(0, rest_.find_first_of(kBlanks));
    rest_.remove_prefix(token.size());
    return token;
  }

  template <class T>
  T number() {
    const std::string_view token = next();
    if (token.empty()) throw ParseError{"incomplete line"};
    T value{};
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error != std::errc{} || end != token.data() + token.size()) {
      throw ParseError{"malformed number"};
    }
    return value;
  }

  double finite() {
    const auto value = number<double>();
    if (!std::isfinite(value)) throw ParseError{"value not finite"};
    return value;
  }

  void skip(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (next().empty()) throw ParseError{"incomplete line"};
    }
  }

  /// Upper bound of the number of remaining tokens.
  [[nodiscard]] std::size_t remaining_max() const { return (rest_.size() + 1) / 2; }

 private:
  static constexpr std::string_view kBlanks = " \t\r\n\f\v";
  std::string_view rest_;
};

/// Reads a count and checks that the rest of the line can hold as many tokens.
std::size_t read_count(Tokens& tokens) {
  const auto count = tokens.number<std::uint64_t>();
  if (count > tokens.remaining_max()) throw ParseError{"fewer readings than the count in the line"};
  return static_cast<std::size_t>(count);
}

std::vector<float> read_ranges(Tokens& tokens) {
  const std::size_t count = read_count(tokens);
  if (count < 2) throw ParseError{"fewer than two readings"};
  std::vector<float> ranges(count);
  for (float& range : ranges) range = tokens.number<float>();
  return ranges;
}

Pose2 read_pose(Tokens& tokens) {
  const double x = tokens.finite();
  const double y = tokens.finite();
  const double theta = tokens.finite();
  return {x, y, theta};
}

std::int64_t utime_of(double seconds) {
  return seconds > 0.0 && seconds <= kLatestTimeSeconds ? std::llround(seconds * 1e6) : 0;
}

/// Reads the end of a line, `time host time`; the second timestamp is that of the logger.
RecordedTimes read_timestamps(Tokens& tokens) {
  const double seconds = tokens.finite();
  tokens.skip(1);
  const double logged_seconds = tokens.finite();
  if (!tokens.next().empty()) throw ParseError{"excess tokens at the end of the line"};
  if (seconds > kLatestTimeSeconds) throw ParseError{"implausible timestamp"};
  return {utime_of(seconds), utime_of(logged_seconds)};
}

void set_times(CarmenScan& scan, const RecordedTimes& times) {
  scan.times = times;
  scan.scan.utime = times.measured_utime;
  scan.odometry.utime = times.measured_utime;
}

CarmenScan read_flaser(Tokens& tokens) {
  CarmenScan result;
  result.scan.ranges_m = read_ranges(tokens);
  const std::size_t beams = result.scan.ranges_m.size();
  const std::size_t steps = beams % 2 == 0 ? beams : beams - 1;
  result.scan.angle_min_rad = -kHalfPi;
  result.scan.angle_step_rad = std::numbers::pi / static_cast<double>(steps);
  result.T_log_laser = read_pose(tokens);
  result.odometry.T_wheel_body = read_pose(tokens);
  set_times(result, read_timestamps(tokens));
  return result;
}

CarmenScan read_robotlaser(Tokens& tokens) {
  CarmenScan result;
  tokens.skip(1);  // type
  result.scan.angle_min_rad = tokens.finite();
  tokens.skip(1);  // field of view
  result.scan.angle_step_rad = tokens.finite();
  if (result.scan.angle_step_rad <= 0.0) throw ParseError{"angular step not positive"};
  tokens.skip(3);  // maximum range, accuracy, remission mode
  result.scan.ranges_m = read_ranges(tokens);
  tokens.skip(read_count(tokens));  // remissions
  result.T_log_laser = read_pose(tokens);
  result.odometry.T_wheel_body = read_pose(tokens);
  tokens.skip(5);  // speeds, safety distances, turn axis
  set_times(result, read_timestamps(tokens));
  return result;
}

CarmenOdometry read_odom(Tokens& tokens) {
  CarmenOdometry result;
  result.odometry.T_wheel_body = read_pose(tokens);
  tokens.skip(3);  // speeds, acceleration
  result.times = read_timestamps(tokens);
  result.odometry.utime = result.times.measured_utime;
  return result;
}

}  // namespace

CarmenLine parse_carmen_line(std::string_view line) {
  Tokens tokens(line);
  const std::string_view kind = tokens.next();
  try {
    if (kind == "FLASER") return read_flaser(tokens);
    if (kind == "ROBOTLASER1") return read_robotlaser(tokens);
    if (kind == "ODOM") return read_odom(tokens);
  } catch (const ParseError& parse_error) {
    return CarmenError{parse_error.reason, kind != "ODOM"};
  }
  return CarmenIgnored{};
}

std::string flaser_line(const CarmenScan& scan) {
  std::string line = fmt::format("FLASER {}", scan.scan.ranges_m.size());
  const auto out = std::back_inserter(line);
  for (const float range : scan.scan.ranges_m) fmt::format_to(out, " {:.2f}", double{range});
  for (const Pose2& pose : {scan.T_log_laser, scan.odometry.T_wheel_body}) {
    fmt::format_to(out, " {:.6f} {:.6f} {:.6f}", pose.x, pose.y, pose.theta);
  }
  const double seconds = static_cast<double>(scan.scan.utime) * 1e-6;
  fmt::format_to(out, " {:.6f} adit {:.6f}", seconds, seconds);
  return line;
}

}  // namespace adit
