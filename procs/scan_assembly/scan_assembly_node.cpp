// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/scan_assembly_node.hpp"

#include <exception>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::size_t kRequestQueueSize = 10;
constexpr std::size_t kScanQueueSize = 100;     // more than a second of an LMS-200 at 75 Hz
constexpr std::size_t kReadingQueueSize = 500;  // a second of tilt, pose and IMU readings
constexpr std::int64_t kPeriodUs = 20'000;      // the period of tilt readings

void publish_cloud(Bus& bus, std::string_view channel, const Cloud& cloud) {
  for (const CloudFragment& fragment : split(cloud)) publish(bus, channel, to_message(fragment));
}

}  // namespace

ScanAssemblyNode::ScanAssemblyNode(Bus& bus, const Params& params)
    : bus_(bus), scan_assembly_(params) {
  if (!params.journal.empty()) {
    journal_.emplace(params.journal);
    for (const Cloud& cloud : journal_->take_restored()) buffer_.add(cloud, cloud.utime);
  }
  const auto measured = Delivery::queued(kReadingQueueSize);
  subscribe<scan_request_t>(
      bus, channels::kScanRequest, Delivery::queued(kRequestQueueSize),
      [this](const ScanRequest& request) { scan_assembly_.begin(request, bus_.now_utime()); });
  subscribe_measured<pose_t>(
      bus, clocks_, channels::kPose, measured, [this](const StampedPose& pose) {
        scan_assembly_.add(pose.utime, pose.T_odom_body, pose.z_m, pose.attitude);
      });
  subscribe<imu_t>(bus, channels::kImu, measured,
                   [this](const ImuReading& reading) { scan_assembly_.add(reading); });
  subscribe_laser(LaserId::kFront, channels::kLaserFront, channels::kTiltFront);
  subscribe_laser(LaserId::kRear, channels::kLaserRear, channels::kTiltRear);
  subscribe<spinning_lidar_t>(bus, channels::kLidar, Delivery::queued(kScanQueueSize),
                              [this](const LidarFragment& fragment) {
                                if (const auto revolution = revolutions_.add(fragment)) {
                                  scan_assembly_.add(*revolution);
                                }
                              });
  subscribe<cloud_request_t>(bus, channels::kCloudRequest, Delivery::queued(kRequestQueueSize),
                             [this](const CloudRequest& request) { resend_missing(request); });
  bus.create_timer(kPeriodUs, [this](std::int64_t utime) { advance(utime); });
}

void ScanAssemblyNode::subscribe_laser(LaserId laser, std::string_view scans,
                                       std::string_view tilt) {
  subscribe_measured<planar_lidar_t>(
      bus_, clocks_, scans, Delivery::queued(kScanQueueSize),
      [this, laser](const LaserScan& scan) { scan_assembly_.add(laser, scan); });
  subscribe_measured<tilt_t>(
      bus_, clocks_, tilt, Delivery::queued(kReadingQueueSize),
      [this, laser](const TiltReading& reading) { scan_assembly_.add(laser, reading); });
}

void ScanAssemblyNode::advance(std::int64_t utime) {
  const ScanAssembly::Step step = scan_assembly_.advance(utime);
  if (step.command) {
    const bool front = scan_assembly_.laser() == LaserId::kFront;
    publish(bus_, front ? channels::kTiltCommandFront : channels::kTiltCommandRear,
            to_message(*step.command));
  }
  if (!step.cloud) return;
  buffer_.add(*step.cloud, utime);
  // On disk before it is published: a published scan is never lost.
  journal_failure_.clear();
  with_journal([&](CloudJournal& journal) { journal.store(*step.cloud); });
  publish_cloud(bus_, channels::kCloud, *step.cloud);
}

void ScanAssemblyNode::resend_missing(const CloudRequest& request) {
  with_journal([&](CloudJournal& journal) { journal.acknowledge(request.received_utime); });
  const Cloud* const missing = buffer_.find_missing(request, bus_.now_utime());
  if (missing != nullptr) publish_cloud(bus_, channels::kCloudResend, *missing);
}

void ScanAssemblyNode::with_journal(const std::function<void(CloudJournal&)>& work) {
  if (!journal_) return;
  try {
    work(*journal_);
  } catch (const std::exception& failure) {
    journal_failure_ = failure.what();
  }
}

Health ScanAssemblyNode::health() const {
  using Level = Health::Level;
  const std::string not_stored = storage_failure(journal_, journal_failure_);
  if (!not_stored.empty()) return {Level::kFault, not_stored};
  if (!scan_assembly_.problem().empty()) return {Level::kDegraded, scan_assembly_.problem()};
  if (journal_ && !journal_->damage().empty()) return {Level::kDegraded, journal_->damage()};
  const std::string fault = clocks_.fault(bus_.now_utime());
  return fault.empty() ? Health{} : Health{Level::kDegraded, fault};
}

}  // namespace adit
