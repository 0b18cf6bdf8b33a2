// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/commission/stop_check.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Verdict = CheckResult::Verdict;

constexpr double kMovesM_S = 0.05;
constexpr double kStandsM_S = 0.01;

}  // namespace

const std::vector<StopCause>& stop_causes() {
  static const std::vector<StopCause> causes{
      {"obstacle", "Put an obstacle before the front laser.", "obstacle"},
      {"laser", "Unplug the laser in the direction of travel.", "laser "},
      {"operator", "End adit drive.", ""},
      {"supervisor", "Run: sudo systemctl kill -s KILL adit-supervisor", "supervisor"},
      {"guard", "Run: sudo systemctl stop adit-guard", ""}};
  return causes;
}

void StopCheck::add(const VehicleState& state, std::int64_t utime) {
  speed_m_s_ = state.speed_m_s;
  if (std::abs(state.speed_m_s) > kMovesM_S) {
    if (!moved_utime_) moved_utime_ = utime;
    stopped_utime_.reset();
  } else if (moved_utime_ && !stopped_utime_ && std::abs(state.speed_m_s) < kStandsM_S) {
    stopped_utime_ = utime;
  }
}

void StopCheck::add(const StopOrder& order, std::int64_t utime) {
  if (stopped_utime_) return;
  last_order_utime_ = utime;
  if (!moved_utime_ || !order.stopped) return;
  const bool is_reason =
      !cause_.reason.empty() && order.reason.find(cause_.reason) != std::string::npos;
  if (is_reason && !reason_utime_) reason_utime_ = utime;
  if (!is_reason && other_reason_.empty()) other_reason_ = order.reason;
}

void StopCheck::add(const DriveCommand& command, std::int64_t utime) {
  if (!stopped_utime_ && std::abs(command.speed_m_s) > kStandsM_S) last_command_utime_ = utime;
}

std::optional<std::int64_t> StopCheck::cause_utime() const {
  if (cause_.name == "operator") return last_command_utime_;
  return cause_.name == "guard" ? last_order_utime_ : reason_utime_;
}

CheckResult StopCheck::result() const {
  const auto bad = [&](const std::string& text) {
    return CheckResult{Verdict::kBad, cause_.name, text};
  };
  if (!moved_utime_) {
    return bad(
        "VEHICLE_STATE never reported more than 0.05 m/s: drive slowly, adit drive "
        "--keyboard, and check the driver of the vehicle");
  }
  const auto cause = cause_utime();
  if (!cause && !cause_.reason.empty()) {
    const std::string other =
        other_reason_.empty() ? "" : fmt::format(" (but: {})", message_line(other_reason_));
    return bad(
        fmt::format("no STOP named {}{}: the guard did not notice it; adit ps, and adit check "
                    "CONFIG",
                    cause_.name, other));
  }
  if (!cause) return bad("no DRIVE_COMMAND or STOP arrived: is this the network of the robot?");
  if (!stopped_utime_) {
    return bad(
        fmt::format("the wheels still turn, {:.2f} m/s: the driver of the vehicle must stop on "
                    "STOP, after 0.25 s without a command and after 0.5 s without the guard",
                    speed_m_s_));
  }
  const double seconds = 1e-6 * static_cast<double>(*stopped_utime_ - *cause);
  const std::string text = fmt::format("the wheels stood {:.2f} s after it", seconds);
  if (seconds < 0.0) return bad("the wheels stopped before it, by something else: try again");
  if (seconds <= kStopMaxS) return {Verdict::kGood, cause_.name, text};
  return bad(text + fmt::format(", at most {} s: brakes, or the driver of the vehicle", kStopMaxS));
}

}  // namespace adit
