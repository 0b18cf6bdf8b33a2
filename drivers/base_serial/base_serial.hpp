// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/base_serial/differential.hpp"
#include "drivers/base_serial/frame.hpp"
#include "drivers/base_serial/messages.hpp"
#include "drivers/device/baud_search.hpp"
#include "drivers/device/device_protocol.hpp"
#include "drivers/timing/device_clock.hpp"

#include "common/config/bounds.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/drive_orders.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

struct BaseSerialParams {
  std::string device = "/dev/ttyUSB0";
  int baud = 115200;
  double ticks_per_m = 5000.0;       ///< of both encoders, along the ground
  double track_width_m = 0.6;        ///< with which it turns; of a skid-steered base, measured
  double wheel_speed_max_m_s = 0.5;  ///< of each side
  double acceleration_m_s2 = 0.5;    ///< of each side
  double braking_m_s2 = 1.0;         ///< of each side, also when a command expires
  double battery_empty_v = 22.0;     ///< `battery_share` 0
  double battery_full_v = 25.6;      ///< `battery_share` 1
  double delay_ms = 0.0;             ///< of a state behind its encoders, if it was measured

  template <class V>
  void visit(V& v) {
    v("device", device);
    v("baud", baud, within(4800, 921600));
    v("ticks_per_m", ticks_per_m, within(1.0, 1e7));
    v("track_width_m", track_width_m, within(0.05, 20.0));
    v("wheel_speed_max_m_s", wheel_speed_max_m_s, within(0.01, 20.0));
    v("acceleration_m_s2", acceleration_m_s2, within(0.01, 50.0));
    v("braking_m_s2", braking_m_s2, within(0.01, 50.0));
    v("battery_empty_v", battery_empty_v, within(0.0, 60.0));
    v("battery_full_v", battery_full_v, within(0.0, 60.0));
    v("delay_ms", delay_ms, within(-1000.0, 1000.0));
  }
};

/// What the base says of one moment.
struct BaseReading {
  WheelOdometry odometry;
  double yaw_rate_rad_s = 0.0;
  VehicleState state;
};

/// A differential or skid-steered base with the protocol of README.md, without port or clock: bytes
/// and orders in, readings and requests out. DRIVE is sent each 50 ms, and at once when an order
/// arrives; without a command in effect it brakes.
class BaseSerial final : public ReadingDevice<BaseReading> {
 public:
  using Params = BaseSerialParams;

  /// Throws std::invalid_argument, with the remedy, for parameters that contradict each other.
  explicit BaseSerial(const BaseSerialParams& params);

  /// An order at time `utime` by the clock that stamps orders; see DriveOrders.
  template <class Order>
  void obey(const Order& order, std::int64_t utime, std::int64_t now_us) {
    orders_.receive(order, utime, now_us);
    if (is_streaming()) send_drive(now_us);
  }

  void start(std::int64_t now_us) override;
  std::vector<BaseReading> receive(std::span<const std::uint8_t> bytes,
                                   std::int64_t now_us) override;
  void tick(std::int64_t now_us) override;
  std::vector<PortRequest> take_requests() override;
  [[nodiscard]] bool is_streaming() const override { return is_known_ && is_receiving_; }
  [[nodiscard]] std::string problem() const override;
  [[nodiscard]] LineCounts line_counts() const override;

  [[nodiscard]] const DeviceClock& clock() const { return clock_; }

 private:
  void request_baud(std::int64_t now_us);
  void send(BaseFrameType type, std::span<const std::uint8_t> payload);
  void send_hello(std::int64_t now_us);
  void send_drive(std::int64_t now_us);
  [[nodiscard]] std::int64_t device_us(std::uint32_t clock_us) const;
  void process(const BaseInfo& info, std::int64_t end_us);
  std::optional<BaseReading> process(const BaseState& state, const BaseFrame& frame);
  bool accept(const BaseState& state, std::int64_t at_us, std::int64_t arrival_us);
  void forget();
  void watch_damage(const BaseState& state, std::int64_t now_us);
  [[nodiscard]] double byte_us() const { return 1e7 / bauds_.current(); }

  BaseSerialParams params_;
  DriveOrders orders_{DriveOrders::Params{}};
  BaudSearch bauds_;
  BaseDecoder decoder_;
  std::vector<PortRequest> requests_;
  std::uint8_t sequence_ = 0;
  bool is_receiving_ = false;  ///< a state arrived in the last half second
  bool is_known_ = false;      ///< it speaks our version
  bool was_searched_ = false;  ///< at all baud rates, in vain
  std::optional<std::uint8_t> other_version_;
  std::int64_t received_us_ = 0;  ///< or when a baud rate was set
  std::int64_t hello_us_ = 0;
  std::uint8_t hello_sequence_ = 0;
  std::int64_t drive_us_ = 0;
  std::int64_t obeyed_us_ = 0;  ///< when the base last received another DRIVE
  bool is_obeyed_ = true;       ///< it did in the last second
  DifferentialOdometry odometry_;
  DeviceClock clock_;
  std::optional<BaseState> last_;
  std::int64_t last_us_ = 0;          ///< time of the last state by the base, without overflow
  std::int64_t last_arrival_us_ = 0;  ///< of it
  int implausible_ = 0;               ///< states, one after the other
  std::int64_t damage_us_ = 0;        ///< when damaged_ was taken
  std::uint16_t damaged_ = 0;
  int sent_ = 0;  ///< frames since then
  double damaged_share_ = 0.0;
};

}  // namespace adit
