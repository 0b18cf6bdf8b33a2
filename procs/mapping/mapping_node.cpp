// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/mapping_node.hpp"

#include <cmath>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/cloud_match.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::size_t kScansWaiting = 500;     // while a loop closure is searched, at 75 Hz
constexpr std::size_t kReadingsWaiting = 500;  // as long
// A local map has about three fragments; exploration takes some 30 ms for a map and queues 500
// fragments.
constexpr std::int64_t kResendPeriodUs = 50'000;
constexpr std::size_t kResendFragments = 4;
constexpr std::int64_t kCorrectionPeriodUs = 1'000'000;
constexpr int kReplaced = -2;  // not an id

}  // namespace

MappingNode::MappingNode(Bus& bus, const Params& params)
    : bus_(bus), params_(params), mapping_(params) {
  if (!params.journal.empty()) restore(params.journal);
  for (const std::string_view channel : {channels::kLaserFront, channels::kLaserRear}) {
    subscribe_measured<planar_lidar_t>(
        bus, clocks_, channel, Delivery::queued(kScansWaiting),
        [this, channel = std::string(channel)](const LaserScan& scan) {
          auto& waiting = waiting_[channel];
          waiting.push_back(scan);
          if (waiting.size() > kScansWaiting) waiting.pop_front();
        });
  }
  subscribe_measured<wheel_odometry_t>(
      bus, clocks_, channels::kWheelOdometry, Delivery::queued(kReadingsWaiting),
      [this](const WheelOdometry& reading) { mapping_.add(reading); });
  subscribe_measured<scan_match_t>(bus, clocks_, channels::kScanMatch,
                                   Delivery::queued(kScansWaiting),
                                   [this](const ScanMatch& match) { on_match(match); });
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(CloudFragment::kFragmentsMax),
                     [this](const CloudFragment& fragment) {
                       if (const auto cloud = clouds_.add(fragment)) mapping_.add(*cloud);
                     });
  subscribe<map_request_t>(bus, channels::kMapRequest, Delivery::queued(10),
                           [this](const MapRequest&) {
                             resender_.request(mapping_.local_maps().size());
                             graph_pending_ = true;
                           });
  bus.create_timer(kResendPeriodUs, [this](std::int64_t) { resend(); });
  bus.create_timer(kCorrectionPeriodUs, [this](std::int64_t) { publish_correction(); });
}

void MappingNode::restore(const std::string& journal) {
  journal_.emplace(journal);
  restored_ = mapping_.restore(journal_->take_restored());
  if (restored_) store(*restored_);
  const std::vector<Association> reconnected = mapping_.reconnect();
  if (!reconnected.empty()) write_journal([&] { journal_->append(reconnected); });
  graph_pending_ = true;
}

void MappingNode::restart_time() {
  waiting_.clear();
  mapping_.restart_time();
}

void MappingNode::on_match(const ScanMatch& match) {
  const auto found = waiting_.find(match.channel);
  if (found == waiting_.end()) return;
  auto& waiting = found->second;
  while (!waiting.empty() && waiting.front().utime < match.utime) waiting.pop_front();
  if (waiting.empty() || waiting.front().utime != match.utime) return;
  const LaserScan scan = std::move(waiting.front());
  waiting.pop_front();
  const bool was_localized = mapping_.correction().has_value();
  if (const auto update = mapping_.add(match.channel, scan, match)) {
    handle_update(*update);
  } else if (!was_localized && mapping_.correction()) {
    publish_graph();
  }
  if (journal_) journal_unfinished();
}

/// Stores the unfinished local map every 0.3 m or half a radian; and at the start of the path,
/// since that is home. The first local map of a session is finished before, when its link to the
/// map is not known yet.
void MappingNode::journal_unfinished() {
  const LocalMap& map = mapping_.unfinished();
  const auto& maps = mapping_.local_maps();
  if (map.scans.empty() || (!maps.empty() && maps.back().session != map.session)) return;
  if (!unstored_.empty()) return;  // parts without the local map before would take its place
  if (const bool replaces = journaled_map_ == kReplaced; map.id != journaled_map_) {
    journaled_map_ = map.id;
    T_local_journaled_ = {};
    start_pending_ = maps.empty() || replaces;
  }
  const Pose2& T_local_body = map.scans.back().T_local_body;
  const Pose2 moved = between(T_local_journaled_, T_local_body);
  const bool moved_on = moved.translation().norm() >= params_.journal_interval_m ||
                        std::abs(moved.theta) >= params_.restart_sd_rad;
  if (!moved_on && !(start_pending_ && map.scans.size() > 1)) return;
  start_pending_ = false;
  T_local_journaled_ = T_local_body;
  write_journal([&] { journal_->append_unfinished(map); });
}

/// A map that the journal has lost parts of is doubtful as long as the stage runs.
Health MappingNode::health() const {
  const std::string not_stored = storage_failure(journal_, journal_failure_);
  if (!not_stored.empty()) return {Health::Level::kFault, not_stored};
  if (journal_ && journal_->is_damaged()) return {Health::Level::kDegraded, journal_->report()};
  const std::string fault = clocks_.fault(bus_.now_utime());
  return fault.empty() ? Health{} : Health{Health::Level::kDegraded, fault};
}

void MappingNode::write_journal(const std::function<void()>& append) {
  journal_failure_.clear();
  try {
    append();
  } catch (const std::exception& failure) {
    journal_failure_ = failure.what();
  }
}

/// What could not be stored is stored with a later update.
void MappingNode::store(const MapUpdate& update) {
  unstored_.push_back(update);
  write_journal([&] {
    for (; !unstored_.empty(); unstored_.pop_front()) journal_->append(unstored_.front());
  });
}

/// Stored before it is published: what was announced is never lost. A discarded map leaves the
/// graph unchanged; the pose of the body is stored with the next map.
void MappingNode::handle_update(const MapUpdate& update) {
  if (!update.stored) {
    journaled_map_ = kReplaced;
    publish_correction();
    return;
  }
  if (journal_) store(update);
  publish_update(update);
}

void MappingNode::publish_update(const MapUpdate& update) {
  for (const LocalMapFragment& fragment : split(update.map)) {
    publish(bus_, channels::kLocalMap, to_message(fragment));
  }
  for (const Association& association : update.associations) {
    publish(bus_, channels::kAssociation, to_message(association));
  }
  for (const CloudMatch& match : update.cloud_matches) {
    publish(bus_, channels::kCloudMatch, to_message(match));
  }
  publish_graph();
}

/// Sends no more at a time than the queues of the subscribers hold.
void MappingNode::resend() {
  if (restored_) publish_update(*std::exchange(restored_, std::nullopt));
  if (graph_pending_) publish_graph();
  const LocalMapStore& maps = mapping_.local_maps();
  for (std::size_t sent = 0; sent < kResendFragments; ++sent) {
    if (resend_queue_.empty()) {
      const auto next = resender_.next(maps.size());
      if (!next) return;
      for (LocalMapFragment& fragment : split(maps.load(*next)))
        resend_queue_.push_back(std::move(fragment));
    }
    publish(bus_, channels::kLocalMap, to_message(resend_queue_.front()));
    resend_queue_.pop_front();
    graph_pending_ = resend_queue_.empty() && resender_.done();
  }
}

void MappingNode::publish_graph() {
  graph_pending_ = false;
  if (mapping_.local_maps().empty()) return;
  for (const PoseGraphFragment& fragment : split(mapping_.graph())) {
    publish(bus_, channels::kPoseGraph, to_message(fragment));
  }
  publish_contradictions();
  publish_correction();
}

void MappingNode::publish_contradictions() {
  const MapContradictions contradictions = mapping_.contradictions();
  if (contradictions.pairs == published_contradictions_) return;
  published_contradictions_ = contradictions.pairs;
  publish(bus_, channels::kContradictions, to_message(contradictions));
}

void MappingNode::publish_correction() {
  if (const auto correction = mapping_.correction()) {
    publish(bus_, channels::kMapCorrection, to_message(*correction));
  }
}

}  // namespace adit
