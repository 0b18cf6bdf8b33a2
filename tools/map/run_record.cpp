// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/run_record.hpp"

#include <algorithm>
#include <optional>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/laser_scan.hpp"
#include "common/messages/scan_match.hpp"

namespace adit {
namespace {

constexpr std::size_t kWaiting = 1000;

/// What a stretch consists of; nothing for a scan that is as it should be.
struct Kind {
  bool lost;
  bool filled;
  friend bool operator==(const Kind&, const Kind&) = default;
};

std::optional<Kind> kind_of(const ScanMatch& match) {
  if (match.status == ScanMatch::Status::kLost) return Kind{true, false};
  if (match.degenerate.empty()) return std::nullopt;
  const bool filled =
      std::none_of(match.degenerate.begin(), match.degenerate.end(),
                   [](const auto& d) { return d.fill == DegenerateDirection::Fill::kNone; });
  return Kind{false, filled};
}

}  // namespace

RunRecord::RunRecord(Bus& bus) {
  listen_to_laser(bus, channels::kLaserFront);
  listen_to_laser(bus, channels::kLaserRear);
  subscribe<scan_match_t>(bus, channels::kScanMatch, Delivery::queued(kWaiting),
                          [this](const ScanMatch& match) { on_match(match); });
}

void RunRecord::listen_to_laser(Bus& bus, std::string_view channel) {
  subscribe<planar_lidar_t>(
      bus, channel, Delivery::queued(kWaiting),
      [this, name = std::string(channel)](const LaserScan& scan) { last_scan_[name] = scan; });
}

void RunRecord::on_match(const ScanMatch& match) {
  const auto scan = last_scan_.find(match.channel);
  const bool known = scan != last_scan_.end() && scan->second.utime == match.utime;
  if (match.status == ScanMatch::Status::kRefused || !known) {
    ++refused_;
  } else {
    entries_.push_back({scan->second, match});
  }
}

Trajectory RunRecord::trajectory() const {
  Trajectory trajectory;
  for (const Entry& entry : entries_) {
    // Two lasers may have measured at one time; the second has the better pose.
    if (!trajectory.empty() && trajectory.back().utime == entry.match.utime) trajectory.pop_back();
    trajectory.push_back({entry.match.utime, entry.match.T_odom_body});
  }
  return trajectory;
}

std::vector<RunRecord::Stretch> RunRecord::stretches() const {
  std::vector<Stretch> stretches;
  std::optional<Kind> current;
  for (const Entry& entry : entries_) {
    const auto kind = kind_of(entry.match);
    if (kind && kind != current) {
      stretches.push_back(
          {entry.match.reference_utime, entry.match.utime, 0.0, 0, kind->lost, kind->filled});
    }
    current = kind;
    if (!kind) continue;
    stretches.back().to_utime = entry.match.utime;
    stretches.back().length_m += entry.match.T_reference_body.translation().norm();
    ++stretches.back().scans;
  }
  return stretches;
}

}  // namespace adit
