// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/device/device_node.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/sensing/seconds.hpp"
#include "common/service/wall_time.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr std::int64_t kGapReportedUs = 60'000'000;
constexpr std::int64_t kLineIntervalUs = 10'000'000;
constexpr double kCorruptShareMax = 0.02;

}  // namespace

DeviceNode::DeviceNode(Bus& bus, Options options, DeviceProtocol& device, Receive receive)
    : options_(std::move(options)),
      device_(device),
      receive_(std::move(receive)),
      port_(options_.address) {
  bus.watch(port_.descriptor(), [this] { poll(); });
  bus.create_wall_timer(options_.tick_us, [this](std::int64_t) {
    poll();  // first: what has arrived is not missing
    if (port_.is_open()) device_.tick(steady_us());
    obey();
  });
}

std::int64_t DeviceNode::to_wall_us() { return wall_utime() - steady_us(); }

void DeviceNode::poll() {
  const std::int64_t now_us = steady_us();
  if (port_.open_if_due(now_us)) device_.start(now_us);
  receive();
  obey();
  report_gaps(steady_us());
  watch_line(now_us);
}

void DeviceNode::receive() {
  bool has_more = true;
  while (has_more) {
    const auto bytes = port_.read();
    if (bytes.empty()) return;
    has_more = bytes.size() == ReconnectingPort::kReadBytesMax;
    // Behind the read: interrupted in between, a time before it would be earlier than the bytes.
    const std::int64_t now_us = steady_us();
    if (receive_(bytes, now_us) == 0) continue;
    if (last_reading_us_ && now_us - *last_reading_us_ > options_.gap_us) {
      ++gaps_;
      gap_end_us_ = now_us;
      gap_s_ = seconds(now_us - *last_reading_us_);
    }
    last_reading_us_ = now_us;
  }
}

void DeviceNode::obey() {
  for (const PortRequest& request : device_.take_requests()) {
    if (request.baud) port_.set_baud(*request.baud);
    if (!request.bytes.empty()) port_.write(request.bytes);
  }
}

void DeviceNode::report_gaps(std::int64_t now_us) {
  const bool is_lost = !last_reading_us_ || now_us - *last_reading_us_ > options_.gap_us;
  if (is_lost == is_lost_) return;
  is_lost_ = is_lost;
  const std::string program = "adit-" + options_.name;
  const std::string problem = port_.failure().empty() ? device_.problem() : port_.failure();
  if (is_lost) {
    print_error(program,
                fmt::format("no {}{}{}", options_.readings, problem.empty() ? "" : ": ", problem));
  } else if (gap_end_us_) {
    print_error(program, fmt::format("{} again, after {:.1f} s", options_.readings, gap_s_));
  } else {
    print_error(program, fmt::format("{} arrive", options_.readings));
  }
}

void DeviceNode::watch_line(std::int64_t now_us) {
  if (now_us - line_us_ < kLineIntervalUs) return;
  const DeviceProtocol::LineCounts counts = device_.line_counts();
  const auto corrupt = static_cast<double>(counts.corrupt - line_counts_.corrupt);
  const double messages = corrupt + static_cast<double>(counts.messages - line_counts_.messages);
  corrupt_share_ = messages > 0.0 ? corrupt / messages : 0.0;
  line_counts_ = counts;
  line_us_ = now_us;
}

Health DeviceNode::health() const {
  using Level = Health::Level;
  if (!port_.failure().empty()) return {Level::kFault, port_.failure()};
  const std::string problem = device_.problem();
  const std::int64_t now_us = steady_us();
  if (!last_reading_us_ || now_us - *last_reading_us_ > options_.gap_us) {
    return {Level::kFault, problem.empty() ? "no " + options_.readings : problem};
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
