// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/laser/laser_device_node.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/lidar.hpp"
#include "common/messages/sensing.hpp"
#include "common/sensing/seconds.hpp"
#include "common/service/wall_time.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr std::int64_t kTickUs = 50'000;
constexpr std::int64_t kGapUs = 500'000;  // between two scans; the guard stops after 0.25 s
constexpr std::int64_t kGapReportedUs = 60'000'000;
constexpr std::int64_t kLineIntervalUs = 10'000'000;
constexpr double kCorruptShareMax = 0.02;

}  // namespace

LaserDeviceNode::LaserDeviceNode(Bus& bus, std::string name, const std::string& address,
                                 LaserId laser, std::unique_ptr<LaserDevice> device)
    : bus_(bus), name_(std::move(name)), laser_(laser), port_(address), device_(std::move(device)) {
  bus_.watch(port_.descriptor(), [this] { poll(); });
  bus_.create_wall_timer(kTickUs, [this](std::int64_t) { poll(); });
}

void LaserDeviceNode::poll() {
  const std::int64_t now_us = steady_us();
  if (port_.open_if_due(now_us)) device_->start(now_us);
  receive(now_us);
  if (port_.is_open()) device_->tick(now_us);
  obey();
  report_gaps(now_us);
  watch_line(now_us);
}

void LaserDeviceNode::receive(std::int64_t now_us) {
  const std::int64_t to_wall_us = wall_utime() - steady_us();
  for (auto bytes = port_.read(); !bytes.empty(); bytes = port_.read()) {
    for (LaserScan& scan : device_->receive(bytes, now_us)) {
      scan.utime += to_wall_us;
      publish(bus_, laser_channel(laser_), to_message(scan));
      if (last_scan_us_ && now_us - *last_scan_us_ > kGapUs) {
        ++gaps_;
        gap_end_us_ = now_us;
        gap_s_ = seconds(now_us - *last_scan_us_);
      }
      last_scan_us_ = now_us;
    }
    for (LidarRevolution& revolution : device_->take_revolutions()) {
      revolution.utime += to_wall_us;
      for (const LidarFragment& fragment : split(revolution)) {
        publish(bus_, channels::kLidar, to_message(fragment));
      }
    }
  }
}

void LaserDeviceNode::obey() {
  for (const PortRequest& request : device_->take_requests()) {
    if (request.baud) port_.set_baud(*request.baud);
    if (!request.bytes.empty()) port_.write(request.bytes);
  }
}

void LaserDeviceNode::report_gaps(std::int64_t now_us) {
  const bool is_lost = !last_scan_us_ || now_us - *last_scan_us_ > kGapUs;
  if (is_lost == is_lost_) return;
  is_lost_ = is_lost;
  const std::string problem = port_.failure().empty() ? device_->problem() : port_.failure();
  if (is_lost) {
    print_error("adit-" + name_, fmt::format("no scans: {}", problem));
  } else if (gap_end_us_) {
    print_error("adit-" + name_, fmt::format("scans again, after {:.1f} s", gap_s_));
  } else {
    print_error("adit-" + name_, "scans arrive");
  }
}

void LaserDeviceNode::watch_line(std::int64_t now_us) {
  if (now_us - line_us_ < kLineIntervalUs) return;
  const LaserDevice::LineCounts counts = device_->line_counts();
  const auto corrupt = static_cast<double>(counts.corrupt - line_counts_.corrupt);
  const double messages = corrupt + static_cast<double>(counts.messages - line_counts_.messages);
  corrupt_share_ = messages > 0.0 ? corrupt / messages : 0.0;
  line_counts_ = counts;
  line_us_ = now_us;
}

Health LaserDeviceNode::health() const {
  using Level = Health::Level;
  if (!port_.failure().empty()) return {Level::kFault, port_.failure()};
  const std::string problem = device_->problem();
  const std::int64_t now_us = steady_us();
  if (!last_scan_us_ || now_us - *last_scan_us_ > kGapUs) {
    return {Level::kFault, problem.empty() ? "no scans" : problem};
  }
  if (!problem.empty()) return {Level::kDegraded, problem};
  if (corrupt_share_ > kCorruptShareMax) {
    return {Level::kDegraded, fmt::format("{:.0f} % of the messages are damaged: check the cable",
                                          100.0 * corrupt_share_)};
  }
  if (gap_end_us_ && now_us - *gap_end_us_ < kGapReportedUs) {
    return {Level::kDegraded,
            fmt::format("{} gaps since the start, the last of {:.1f} s", gaps_, gap_s_)};
  }
  return {};
}

}  // namespace adit
