// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/laser/laser_device.hpp"
#include "drivers/timing/device_clock.hpp"
#include "drivers/velodyne/data_packet.hpp"

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/level_view.hpp"
#include "common/sensing/spinning_lidar.hpp"

namespace adit {

struct VelodyneParams {
  std::string device =
      "udp://0.0.0.0:2368";  ///< address of the lidar or 0.0.0.0, and the port here
  int decimation = 4;        ///< each n-th revolution is published on LIDAR; all as level scans
  Lasers lasers;

  template <class V>
  void visit(V& v) {
    v("device", device);
    v("decimation", decimation, within(1, 100));
    v.shared(Lasers::kSection, lasers);
  }
};

/// A Velodyne VLP-16 without its port: data packets in, revolutions and their level scans out.
/// A revolution begins behind. Its stamps are mapped to the clock of the computer by DeviceClock.
class Velodyne final : public LaserDevice {
 public:
  using Params = VelodyneParams;

  /// Throws std::invalid_argument, with the remedy, if the configuration has no spinning lidar, or
  /// for the rear laser.
  Velodyne(const VelodyneParams& params, LaserId laser);

  void start(std::int64_t now_us) override;
  /// `bytes`: one datagram.
  std::vector<LaserScan> receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) override;
  std::vector<LidarRevolution> take_revolutions() override;
  void tick(std::int64_t now_us) override { now_us_ = now_us; }
  std::vector<PortRequest> take_requests() override { return {}; }
  [[nodiscard]] bool is_streaming() const override;
  [[nodiscard]] std::string problem() const override;
  /// Packets, and those of them that were damaged or did not arrive.
  [[nodiscard]] LineCounts line_counts() const override { return counts_; }

 private:
  bool accept_stamp(const velodyne::DataPacket& packet, std::int64_t arrival_us);
  void add_firing(const velodyne::Firing& firing, std::int64_t device_us);
  void finish_revolution();
  void begin_revolution(std::int64_t device_us);
  [[nodiscard]] std::vector<LidarRing> rings() const;

  VelodyneParams params_;
  LevelView level_view_;
  DeviceClock clock_;
  LineCounts counts_;
  std::int64_t now_us_ = 0;
  std::optional<std::int64_t> packet_us_;  ///< arrival of the last packet that was accepted
  std::string rejection_;                  ///< of the last packet, empty if it was accepted

  std::optional<std::int64_t> device_us_;  ///< stamp of the last packet, without overflow
  double packet_duration_us_ = 0.0;
  int implausible_ = 0;  ///< stamps, one after the other
  std::uint8_t product_ = 0;
  double degrees_per_us_ = 0.0;

  std::optional<LidarRevolution> revolution_;  ///< the current one, if its begin was seen
  std::int64_t begin_us_ = 0;                  ///< stamp of its first column
  double turned_deg_ = 0.0;                    ///< azimuth of the last column, after the seam
  std::int64_t number_ = 0;
  std::vector<LaserScan> scans_;
  std::vector<LidarRevolution> revolutions_;
};

}  // namespace adit
