// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "common/sensing/seconds.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// What a vehicle obeys: the drive command in effect, and whether it must stand.
///
/// Drive commands that are not finite or older than the last one are ignored. A time in the future
/// counts as now. Without a command younger than the expiry the vehicle stands. A stop order takes
/// effect whatever its time, since the clock of its sender may have jumped back; only an order
/// newer than all previous ones releases it. After the first order, orders must keep arriving:
/// otherwise their sender is assumed dead, and the vehicle stands until a valid order arrives. If
/// no order has ever arrived, drive commands alone control the vehicle.
///
/// Each call has two times: `utime` by the clock that stamps orders [µs since the epoch], and
/// `now_us` by one that does not jump [µs], by which orders expire. A simulator has one for both.
class DriveOrders {
 public:
  struct Params {
    double command_expiry_s = 0.25;
    double stop_order_expiry_s = 0.5;  ///< maximum interval of stop orders, after the first one
  };

  explicit DriveOrders(const Params& params) : params_(params) {}

  void receive(const DriveCommand& command, std::int64_t utime, std::int64_t now_us) {
    if (!std::isfinite(command.speed_m_s) || !std::isfinite(command.curvature_1_m)) return;
    const std::int64_t stamp = std::min(command.utime, utime);
    if (command_ && stamp < command_->utime && !expired(now_us)) return;
    command_ = {stamp, command.speed_m_s, command.curvature_1_m};
    command_us_ = now_us - (utime - stamp);
  }

  void receive(const StopOrder& order, std::int64_t utime, std::int64_t now_us) {
    std::int64_t stamp = std::min(order.utime, utime);
    if (order_ && order.stopped) stamp = std::max(stamp, order_->utime);
    if (order_ && !order.stopped && stamp <= order_->utime) return;
    order_ = {stamp, order.stopped, order.reason};
    order_us_ = now_us;
  }

  /// Held by an order, or because orders timed out.
  [[nodiscard]] bool stopped(std::int64_t now_us) const {
    return order_ && (order_->stopped || is_past(order_us_, params_.stop_order_expiry_s, now_us));
  }

  /// Without a command that is valid.
  [[nodiscard]] bool expired(std::int64_t now_us) const {
    return !command_ || is_past(command_us_, params_.command_expiry_s, now_us);
  }

  /// The command in effect; nothing while the vehicle must stand.
  [[nodiscard]] std::optional<DriveCommand> command(std::int64_t now_us) const {
    return stopped(now_us) || expired(now_us) ? std::nullopt : command_;
  }

 private:
  static bool is_past(std::int64_t then_us, double expiry_s, std::int64_t now_us) {
    return seconds(now_us - then_us) >= expiry_s;
  }

  Params params_;
  std::optional<DriveCommand> command_;
  std::int64_t command_us_ = 0;  ///< its stamp, by the clock that does not jump
  std::optional<StopOrder> order_;
  std::int64_t order_us_ = 0;  ///< when it was received
};

}  // namespace adit
