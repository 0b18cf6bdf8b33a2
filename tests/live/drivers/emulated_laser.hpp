// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "tests/live/drivers/simulated_robot.hpp"
#include "tests/support/lasers/lms_emulator.hpp"
#include "tests/support/lasers/pty_line.hpp"
#include "tests/support/lasers/scip_emulator.hpp"
#include "tests/support/lasers/tcp_laser.hpp"

namespace adit {

/// An emulated laser that measures what the simulator says of one end of the robot: each of its
/// scans is the one of the simulator that began when its own did.
class EmulatedLaser {
 public:
  EmulatedLaser(const SimulatedRobot& robot, LaserId id) : robot_(robot), id_(id) {}
  virtual ~EmulatedLaser() = default;
  EmulatedLaser(const EmulatedLaser&) = delete;
  EmulatedLaser& operator=(const EmulatedLaser&) = delete;

  virtual void power_on(std::int64_t now) = 0;
  virtual void step(std::int64_t now) = 0;

  [[nodiscard]] int scans() const { return scans_; }
  /// Scans for which the simulator had none that began within 0.1 ms.
  [[nodiscard]] int missing() const { return missing_; }

 protected:
  /// The mirror turns freely from power on: at this time, or a little later, so that scans begin
  /// when those of the simulator do.
  [[nodiscard]] std::int64_t in_phase(std::int64_t now, std::int64_t first_scan_us,
                                      double period_us) const;
  /// Range of a beam [m]; `scan_start`: of its scan, which changes with beam 0 [µs].
  float range_m(std::int64_t scan_start, std::size_t beam);

 private:
  const SimulatedRobot& robot_;
  LaserId id_;
  const LaserScan* seen_ = nullptr;
  int scans_ = 0;
  int missing_ = 0;
};

/// A UTM-30LX by TCP; its address is written to a file once it is on.
class EmulatedHokuyo : public EmulatedLaser {
 public:
  EmulatedHokuyo(const SimulatedRobot& robot, LaserId id, std::filesystem::path address_file);
  void power_on(std::int64_t now) override;
  void step(std::int64_t now) override { line_.step(now); }

 private:
  ScipEmulator laser_;
  TcpLaser<ScipEmulator> line_;
  std::filesystem::path address_file_;
};

/// An LMS-200 on a pseudo-terminal, set to 0.5° and cm by its driver.
class EmulatedSick : public EmulatedLaser {
 public:
  EmulatedSick(const SimulatedRobot& robot, LaserId id, const std::filesystem::path& link);
  void power_on(std::int64_t now) override;
  void step(std::int64_t now) override { line_.step(now); }

 private:
  LmsEmulator laser_;
  PtyLaser<LmsEmulator> line_;
};

}  // namespace adit
