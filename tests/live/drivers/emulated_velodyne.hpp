// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "tests/live/drivers/emulated_laser.hpp"
#include "tests/live/drivers/simulated_robot.hpp"
#include "tests/support/lasers/udp_sender.hpp"
#include "tests/support/lasers/vlp16_emulator.hpp"

namespace adit {

/// A VLP-16 that sends packets by UDP to port 2368 of this computer. It turns in phase with the
/// lidar of the simulator, whose 16 rings are its own; between the columns of that it interpolates.
class EmulatedVelodyne : public EmulatedLaser {
 public:
  explicit EmulatedVelodyne(const SimulatedRobot& robot);
  void power_on(std::int64_t now) override;
  void step(std::int64_t now) override;

 private:
  [[nodiscard]] double range_m(double us, double x, double y, double z);

  const SimulatedRobot& robot_;
  std::int64_t revolution_utime_ = 0;  ///< of the simulator, that was used last
  Vlp16Emulator lidar_;
  UdpSender sender_{2368};
};

}  // namespace adit
