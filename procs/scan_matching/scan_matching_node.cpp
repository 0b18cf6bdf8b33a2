// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/scan_matching_node.hpp"

#include <cmath>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::size_t kScansWaiting = 100;     // over 1 s of an LMS-200 at 75 Hz
constexpr std::size_t kReadingsWaiting = 500;  // the same time of odometry and IMU

Health health_of(const ScanMatch& match) {
  if (match.status == ScanMatch::Status::kLost) {
    return {Health::Level::kDegraded, "the last scan matched nothing"};
  }
  if (has_unobserved_direction(match)) {
    return {Health::Level::kDegraded, "motion is not observed in every direction"};
  }
  return {};
}

}  // namespace

ScanMatchingNode::ScanMatchingNode(Bus& bus, const Params& params)
    : bus_(bus),
      level_tilt_(params.level_tilt),
      lasers_tilt_(params.lasers_tilt),
      scan_matching_(params) {
  const auto measured = Delivery::queued(kReadingsWaiting);
  subscribe_measured<wheel_odometry_t>(bus, clocks_, channels::kWheelOdometry, measured,
                                       [this](const WheelOdometry& w) { scan_matching_.add(w); });
  subscribe_measured<imu_t>(bus, clocks_, channels::kImu, measured,
                            [this](const ImuReading& reading) { scan_matching_.add(reading); });

  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(CloudFragment::kFragmentsMax),
                     [this](const CloudFragment& fragment) {
                       if (const auto cloud = clouds_.add(fragment)) scan_matching_.add(*cloud);
                     });
  subscribe<terrain_t>(bus, channels::kTerrain, Delivery::queued(TerrainFragment::kFragmentsMax),
                       [this](const TerrainFragment& fragment) {
                         if (auto terrain = terrain_.add(fragment)) {
                           scan_matching_.add(std::move(*terrain));
                         }
                       });

  const auto subscribe_laser = [&](LaserId laser, std::string_view scans, std::string_view tilt) {
    // All readings are queued: a queue of one would put the newest reading behind the scans that
    // came before it, and each further reading behind more scans, so that a stage that runs late
    // would never receive the tilt of a laser.
    subscribe_measured<tilt_t>(
        bus, clocks_, tilt, measured,
        [this, laser](const TiltReading& reading) { tilt_[laser] = reading; });
    subscribe_measured<planar_lidar_t>(
        bus, clocks_, scans, Delivery::queued(kScansWaiting),
        [this, laser, channel = std::string(scans)](const LaserScan& scan) {
          on_scan(laser, channel, scan);
        });
  };
  subscribe_laser(LaserId::kFront, channels::kLaserFront, channels::kTiltFront);
  subscribe_laser(LaserId::kRear, channels::kLaserRear, channels::kTiltRear);
}

Health ScanMatchingNode::health() const {
  const std::string fault = clocks_.fault(bus_.now_utime());
  if (!fault.empty()) return {Health::Level::kDegraded, fault};
  return health_;
}

/// After a power loss in the middle of a sweep, the laser is still tilted.
bool ScanMatchingNode::is_level(LaserId laser) const {
  const auto tilt = tilt_.find(laser);
  return tilt == tilt_.end() ? !lasers_tilt_ : level_tilt_.is_level(tilt->second);
}

void ScanMatchingNode::on_scan(LaserId laser, const std::string& channel, const LaserScan& scan) {
  if (!is_level(laser)) return;
  ScanMatch match = scan_matching_.add_scan(laser, scan);
  match.channel = channel;
  health_ = health_of(match);
  publish(bus_, channels::kScanMatch, to_message(match));
  if (const auto& doubt = scan_matching_.doubt()) {
    publish(bus_, channels::kMatchDoubt, to_message(*doubt));
  }
  if (match.status == ScanMatch::Status::kRejected) return;
  publish(bus_, channels::kPose,
          to_message(StampedPose{
              match.utime, match.T_odom_body, {}, match.z_m, match.attitude.value_or(Attitude{})}));
}

}  // namespace adit
