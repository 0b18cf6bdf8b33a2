// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_line.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>

namespace adit {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2.0;
constexpr double kLatestTimeSeconds = 1e11;  // the year 5138; more is not a time

/// What is wrong with the line under the reader's eyes; does not leave this file.
struct Refusal {
  std::string_view reason;
};

/// The words of one line, taken from the left.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  std::string_view next() {
    const std::size_t start = rest_.find_first_not_of(kBlanks);
    if (start == std::string_view::npos) return rest_ = {};
    rest_.remove_prefix(start);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlanks));
    rest_.remove_prefix(word.size());
    return word;
  }

  template <class T>
  T number() {
    const std::string_view word = next();
    if (word.empty()) throw Refusal{"the line breaks off"};
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) {
      throw Refusal{"a word where a number belongs"};
    }
    return value;
  }

  double finite() {
    const auto value = number<double>();
    if (!std::isfinite(value)) throw Refusal{"a value that is not finite"};
    return value;
  }

  void skip(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (next().empty()) throw Refusal{"the line breaks off"};
    }
  }

  /// No more words than this can be left.
  [[nodiscard]] std::size_t most_left() const { return (rest_.size() + 1) / 2; }

 private:
  static constexpr std::string_view kBlanks = " \t\r\n\f\v";
  std::string_view rest_;
};

/// A count that the rest of the line can hold.
std::size_t read_count(Words& words) {
  const auto count = words.number<std::uint64_t>();
  if (count > words.most_left()) throw Refusal{"fewer readings than the line announces"};
  return static_cast<std::size_t>(count);
}

std::vector<float> read_ranges(Words& words) {
  const std::size_t count = read_count(words);
  if (count < 2) throw Refusal{"fewer than two readings"};
  std::vector<float> ranges(count);
  for (float& range : ranges) range = words.number<float>();
  return ranges;
}

Pose2 read_pose(Words& words) {
  const double x = words.finite();
  const double y = words.finite();
  const double theta = words.finite();
  return {x, y, theta};
}

/// Each line ends in `time host time`: two stamps, the second being the logger's own.
std::int64_t read_stamps(Words& words) {
  const double seconds = words.finite();
  words.skip(1);
  words.finite();
  if (!words.next().empty()) throw Refusal{"more words than the line announces"};
  if (seconds > kLatestTimeSeconds) throw Refusal{"a time beyond all reason"};
  const std::int64_t utime = seconds > 0.0 ? std::llround(seconds * 1e6) : 0;
  if (utime == 0) throw Refusal{"a time that is not positive"};
  return utime;
}

void stamp(CarmenScan& scan, std::int64_t utime) {
  scan.scan.utime = utime;
  scan.odometry.utime = utime;
}

CarmenScan read_flaser(Words& words) {
  CarmenScan result;
  result.scan.ranges_m = read_ranges(words);
  const std::size_t beams = result.scan.ranges_m.size();
  const std::size_t steps = beams % 2 == 0 ? beams : beams - 1;
  result.scan.angle_min_rad = -kHalfPi;
  result.scan.angle_step_rad = std::numbers::pi / static_cast<double>(steps);
  result.T_log_laser = read_pose(words);
  result.odometry.T_wheel_body = read_pose(words);
  stamp(result, read_stamps(words));
  return result;
}

CarmenScan read_robotlaser(Words& words) {
  CarmenScan result;
  words.skip(1);  // type
  result.scan.angle_min_rad = words.finite();
  words.skip(1);  // field of view
  result.scan.angle_step_rad = words.finite();
  if (result.scan.angle_step_rad <= 0.0) throw Refusal{"a step between beams that is not positive"};
  words.skip(3);  // maximum range, accuracy, remission mode
  result.scan.ranges_m = read_ranges(words);
  words.skip(read_count(words));  // remissions
  result.T_log_laser = read_pose(words);
  result.odometry.T_wheel_body = read_pose(words);
  words.skip(5);  // speeds, safety distances, turn axis
  stamp(result, read_stamps(words));
  return result;
}

WheelOdometry read_odom(Words& words) {
  WheelOdometry result;
  result.T_wheel_body = read_pose(words);
  words.skip(3);  // speeds, acceleration
  result.utime = read_stamps(words);
  return result;
}

}  // namespace

CarmenLine parse_carmen_line(std::string_view line) {
  Words words(line);
  const std::string_view kind = words.next();
  try {
    if (kind == "FLASER") return read_flaser(words);
    if (kind == "ROBOTLASER1") return read_robotlaser(words);
    if (kind == "ODOM") return read_odom(words);
  } catch (const Refusal& refusal) {
    return CarmenRefused{refusal.reason};
  }
  return CarmenIgnored{};
}

}  // namespace adit
