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

/// An emulated laser in the world of a simulator.
class EmulatedLaser {
 public:
  EmulatedLaser() = default;
  virtual ~EmulatedLaser() = default;
  EmulatedLaser(const EmulatedLaser&) = delete;
  EmulatedLaser& operator=(const EmulatedLaser&) = delete;

  virtual void power_on(std::int64_t now) = 0;
  virtual void step(std::int64_t now) = 0;

  /// Scans or revolutions that it measured.
  [[nodiscard]] int scans() const { return scans_; }
  /// Those for which the simulator had none that began when they did.
  [[nodiscard]] int missing() const { return missing_; }

 protected:
  /// A scan begins; the simulator's begins at `sim_utime`.
  void count(std::int64_t scan_utime, std::int64_t sim_utime);

 private:
  int scans_ = 0;
  int missing_ = 0;
};

/// When to switch a laser on so that its scans begin when those of the simulator do: now or a
/// little later. Its mirror turns freely from then on. `sim_utime`: begin of a scan of the
/// simulator; `first_us`: from power on to the begin of the first scan.
std::int64_t power_on_in_phase(std::int64_t now, std::int64_t sim_utime, double first_us,
                               double period_us);

/// A level laser at one end of the robot: each of its scans is the one of the simulator that began
/// when its own did.
class EmulatedScanner : public EmulatedLaser {
 public:
  EmulatedScanner(const SimulatedRobot& robot, LaserId id) : robot_(robot), id_(id) {}

 protected:
  /// Begin of a scan of the simulator near this time.
  [[nodiscard]] std::int64_t sim_utime(std::int64_t now) const {
    return robot_.scan(id_, now)->utime;
  }
  /// Range of a beam [m]; `scan_start`: of its scan, which changes with beam 0 [µs].
  float range_m(std::int64_t scan_start, std::size_t beam);

 private:
  const SimulatedRobot& robot_;
  LaserId id_;
  const LaserScan* seen_ = nullptr;
};

/// A UTM-30LX by TCP; its address is written to a file once it is on.
class EmulatedHokuyo : public EmulatedScanner {
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
class EmulatedSick : public EmulatedScanner {
 public:
  EmulatedSick(const SimulatedRobot& robot, LaserId id, const std::filesystem::path& link);
  void power_on(std::int64_t now) override;
  void step(std::int64_t now) override { line_.step(now); }

 private:
  LmsEmulator laser_;
  PtyLaser<LmsEmulator> line_;
};

}  // namespace adit
