// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_reader.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::size_t kLinesListed = 3;
constexpr std::int64_t kLateMaxUs = 1'000'000;
constexpr std::string_view kOutOfOrder = "timestamp long before those of the preceding lines";

std::string message(const CarmenReport::Rejected& rejected) {
  const std::size_t others = rejected.count - rejected.first_lines.size();
  return fmt::format("{} {}{}: {}", rejected.count == 1 ? "line" : "lines",
                     fmt::join(rejected.first_lines, ", "),
                     others > 0 ? fmt::format(" and {} more", others) : "", rejected.reason);
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
  return result;
}

bool TimestampFilter::accept(std::int64_t utime) {
  const bool in_order = !latest_ || utime >= *latest_ - kLateMaxUs;
  const bool clock_set_back = outlier_ && std::abs(utime - *outlier_) <= kLateMaxUs;
  if (!in_order && !clock_set_back) {
    outlier_ = utime;
    return false;
  }
  latest_ = utime;
  outlier_.reset();
  return true;
}

CarmenReader::CarmenReader(const std::filesystem::path& path) : source_(path) {}

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
  return std::nullopt;
}

std::optional<CarmenRecord> CarmenReader::accept(CarmenLine line) {
  if (const auto* rejected = std::get_if<CarmenError>(&line)) reject(rejected->reason);
  if (const auto* odometry = std::get_if<WheelOdometry>(&line)) return accept_odometry(*odometry);
  if (auto* scan = std::get_if<CarmenScan>(&line)) return accept_scan(std::move(*scan));
  return std::nullopt;
}

std::optional<CarmenRecord> CarmenReader::accept_odometry(const WheelOdometry& odometry) {
  if (!timestamps_.accept(odometry.utime)) {
    reject(kOutOfOrder);
    return std::nullopt;
  }
  ++report_.odometry_lines;
  return odometry;
}

std::optional<CarmenRecord> CarmenReader::accept_scan(CarmenScan scan) {
  if (!timestamps_.accept(scan.scan.utime)) {
    reject(kOutOfOrder);
    return std::nullopt;
  }
  ++report_.scans;
  const WheelOdometry odometry = scan.odometry;
  pending_ = std::move(scan);
  return odometry;
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
