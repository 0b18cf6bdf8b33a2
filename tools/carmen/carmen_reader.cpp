// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_reader.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"

namespace adit {
namespace {

constexpr std::size_t kLinesListed = 3;
constexpr std::string_view kNoTime = "timestamp not positive";
constexpr std::string_view kOutOfOrder = "timestamp long before those of the preceding lines";

std::string message(const CarmenReport::Rejected& rejected) {
  const std::size_t others = rejected.count - rejected.first_lines.size();
  return fmt::format("{} {}{}: {}", rejected.count == 1 ? "line" : "lines",
                     fmt::join(rejected.first_lines, ", "),
                     others > 0 ? fmt::format(" and {} more", others) : "", rejected.reason);
}

/// Adds the times of a line to those that are judged.
void add_times(const CarmenLine& line, TimeJudge& judge) {
  if (const auto* scan = std::get_if<CarmenScan>(&line)) {
    judge.add_scan(channels::kLaserFront, scan->times, scan->scan.angle_step_rad,
                   &scan->odometry.T_wheel_body);
  } else if (const auto* odometry = std::get_if<CarmenOdometry>(&line)) {
    judge.add_reading(channels::kWheelOdometry, odometry->times, &odometry->odometry.T_wheel_body);
  }
}

bool has_time(const CarmenLine& line) {
  const auto* scan = std::get_if<CarmenScan>(&line);
  return scan != nullptr && scan->times.measured_utime > 0;
}

/// The times of a log. A scan that was written twice tells nothing about the clock.
TimeChoice judged_times(const std::filesystem::path& path,
                        const std::function<void(double)>& progress) {
  GzipLineReader source(path);
  TimeJudge judge;
  std::string previous;
  while (const auto line = source.next()) {
    const CarmenLine parsed = parse_carmen_line(line->text);
    const bool repeated = line->text == previous && has_time(parsed);
    previous = line->text;
    if (!repeated) add_times(parsed, judge);
    if (progress) progress(source.fraction_read());
  }
  return judge.choose();
}

}  // namespace

std::size_t CarmenReport::rejected_lines() const {
  std::size_t total = 0;
  for (const Rejected& entry : rejected) total += entry.count;
  return total;
}

std::vector<std::string> CarmenReport::messages() const {
  std::vector<std::string> result;
  for (const Rejected& entry : rejected) result.push_back(message(entry));
  if (!damage.empty()) result.push_back(damage);
  return result;
}

bool TimestampFilter::accept(std::int64_t utime) {
  const bool in_order = !latest_ || utime >= *latest_ - kReorderWindowUs;
  const bool clock_set_back = outlier_ && std::abs(utime - *outlier_) <= kReorderWindowUs;
  if (!in_order && !clock_set_back) {
    outlier_ = utime;
    return false;
  }
  latest_ = utime;
  outlier_.reset();
  return true;
}

CarmenReader::CarmenReader(const std::filesystem::path& path,
                           const std::function<void(double)>& progress)
    : source_(path), times_(judged_times(path, progress)) {
  report_.times = times_.choice();
}

std::optional<CarmenRecord> CarmenReader::next() {
  if (pending_) return CarmenRecord(*std::exchange(pending_, std::nullopt));
  while (const auto line = source_.next()) {
    ++report_.lines;
    if (!line->error.empty()) {
      reject(line->error);
    } else if (auto record = accept(parse_carmen_line(line->text))) {
      return record;
    }
  }
  report_.damage = source_.damage();
  return std::nullopt;
}

std::optional<CarmenRecord> CarmenReader::accept(CarmenLine line) {
  if (const auto* rejected = std::get_if<CarmenError>(&line)) {
    reject(rejected->reason);
    if (rejected->scan) ++report_.rejected_scans;
  }
  if (auto* odometry = std::get_if<CarmenOdometry>(&line)) return accept_odometry(*odometry);
  if (auto* scan = std::get_if<CarmenScan>(&line)) return accept_scan(std::move(*scan));
  return std::nullopt;
}

std::optional<CarmenRecord> CarmenReader::accept_odometry(CarmenOdometry line) {
  line.odometry.utime = times_.next(channels::kWheelOdometry, line.times);
  if (!accept_time(line.odometry.utime)) return std::nullopt;
  ++report_.odometry_lines;
  return line.odometry;
}

std::optional<CarmenRecord> CarmenReader::accept_scan(CarmenScan scan) {
  scan.scan.utime = scan.odometry.utime = times_.next(channels::kLaserFront, scan.times);
  if (!accept_time(scan.scan.utime)) {
    ++report_.rejected_scans;
    return std::nullopt;
  }
  ++report_.scans;
  const WheelOdometry odometry = scan.odometry;
  pending_ = std::move(scan);
  return odometry;
}

bool CarmenReader::accept_time(std::int64_t utime) {
  if (utime <= 0) {
    reject(kNoTime);
    return false;
  }
  if (timestamps_.accept(utime)) return true;
  reject(kOutOfOrder);
  return false;
}

void CarmenReader::reject(std::string_view reason) {
  auto& rejected = report_.rejected;
  auto entry = std::find_if(rejected.begin(), rejected.end(),
                            [&](const auto& other) { return other.reason == reason; });
  if (entry == rejected.end()) entry = rejected.insert(rejected.end(), {reason, 0, {}});
  if (entry->first_lines.size() < kLinesListed) entry->first_lines.push_back(report_.lines);
  ++entry->count;
}

}  // namespace adit
