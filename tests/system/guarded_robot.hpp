// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "common/types/vehicle_state.hpp"
#include "procs/guard/guard_node.hpp"
#include "tests/support/robots/simulated_robot.hpp"

namespace adit {

/// A simulated robot with a guard and somebody who drives on and on down the middle (y = 0) or as a
/// test says, whatever is there. Simulated time is counted in seconds from the start.
class GuardedRobot {
 public:
  explicit GuardedRobot(World world, const SimulationParams& params = {});

  void drive(double speed_m_s) { drive(speed_m_s, std::nullopt); }
  /// With a curvature of its own, instead of that which leads to the middle.
  void drive(double speed_m_s, std::optional<double> curvature_1_m) {
    speed_m_s_ = speed_m_s;
    curvature_1_m_ = curvature_1_m;
  }
  void stop_commands() { commands_ = false; }
  void stop_localization() { robot_.stop_localization(); }
  [[nodiscard]] MemoryBus& bus() { return robot_.bus(); }
  /// HEARTBEAT of a supervisor each second, from now on or no more.
  void set_supervised(bool alive) { supervised_ = alive; }

  void run(double seconds);

  /// How long after something came true the vehicle stands for good [s]: it does not move for two
  /// seconds. Nothing if neither happens within the time. Negative where it stood before.
  std::optional<double> seconds_to_standstill(const std::function<bool()>& is_true,
                                              double seconds_max);

  /// Since the last message on a channel.
  [[nodiscard]] double message_age_s(std::string_view channel) const;

  [[nodiscard]] double speed_m_s() const;
  [[nodiscard]] const StopOrder& order() const { return order_; }
  [[nodiscard]] const BodyMotion& motion() const;
  [[nodiscard]] const GasReading& gas() const { return gas_; }
  [[nodiscard]] const SinkageReading& sinkage() const { return sinkage_; }
  [[nodiscard]] std::string failure() const { return robot_.simulation().state().failure; }
  [[nodiscard]] double distance_travelled_m() const {
    return robot_.simulation().state().distance_travelled_m;
  }
  [[nodiscard]] int stops() const { return stops_; }  ///< after a release

 private:
  void subscribe_all();
  void command(std::int64_t utime);
  [[nodiscard]] double curvature_to_middle() const;

  GroundTruthRobot robot_;
  GuardNode guard_;
  double speed_m_s_ = 0.0;
  std::optional<double> curvature_1_m_;
  bool commands_ = true;
  bool supervised_ = false;
  int stops_ = 0;
  StopOrder order_{0, true, ""};
  GasReading gas_;
  SinkageReading sinkage_;
  std::map<std::string, std::int64_t, std::less<>> received_utime_;
};

}  // namespace adit
