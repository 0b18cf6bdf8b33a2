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

/// A simulated robot with a guard and a driver without obstacle avoidance, which follows the centre
/// line (y = 0) or a given curvature. Simulated time is counted in seconds from the start.
class GuardedRobot {
 public:
  explicit GuardedRobot(World world, const SimulationParams& params = {});

  void drive(double speed_m_s) { drive(speed_m_s, std::nullopt); }
  /// With this curvature; std::nullopt follows the centre line.
  void drive(double speed_m_s, std::optional<double> curvature_1_m) {
    speed_m_s_ = speed_m_s;
    curvature_1_m_ = curvature_1_m;
  }
  void stop_commands() { commands_ = false; }
  void stop_localization() { robot_.stop_localization(); }
  [[nodiscard]] MemoryBus& bus() { return robot_.bus(); }
  /// Starts or stops the HEARTBEAT of a supervisor, with a period of one second.
  void set_supervised(bool alive) { supervised_ = alive; }

  void run(double seconds);

  /// Time from the condition to standstill, that is two seconds without motion [s]; negative if the
  /// vehicle stopped before the condition. Nothing if one of them does not occur within the time.
  std::optional<double> seconds_to_standstill(const std::function<bool()>& condition,
                                              double seconds_max);

  /// Time since the last message on a channel [s].
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
  [[nodiscard]] int stops() const { return stops_; }  ///< number of stops after a release

 private:
  void subscribe_all();
  void command(std::int64_t utime);
  [[nodiscard]] double curvature_to_centre_line() const;

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
