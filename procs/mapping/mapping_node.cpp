// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/mapping_node.hpp"

#include <cmath>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/association.hpp"
#include "common/messages/laser_scan.hpp"
#include "common/messages/local_map_pieces.hpp"
#include "common/messages/map_correction.hpp"
#include "common/messages/map_request.hpp"
#include "common/messages/pose_graph_pieces.hpp"
#include "common/messages/scan_match.hpp"

namespace adit {
namespace {

constexpr std::size_t kScansWaiting = 500;  // while a closure is searched, at 75 Hz
// A local map has about three pieces; exploration takes some 30 ms for one, and holds 500 pieces.
constexpr std::int64_t kRepeatPeriodUs = 50'000;
constexpr std::size_t kRepeatPieces = 4;
constexpr int kReplaced = -2;  // no id

}  // namespace

MappingNode::MappingNode(Bus& bus, const Params& params)
    : bus_(bus), params_(params), mapping_(params) {
  if (!params.journal.empty()) restore(params.journal);
  for (const std::string_view channel : {channels::kLaserFront, channels::kLaserRear}) {
    subscribe<planar_lidar_t>(bus, channel, Delivery::queued(kScansWaiting),
                              [this, channel = std::string(channel)](const LaserScan& scan) {
                                auto& waiting = waiting_[channel];
                                waiting.push_back(scan);
                                if (waiting.size() > kScansWaiting) waiting.pop_front();
                              });
  }
  subscribe<scan_match_t>(bus, channels::kScanMatch, Delivery::queued(kScansWaiting),
                          [this](const ScanMatch& match) { on_match(match); });
  subscribe<map_request_t>(bus, channels::kMapRequest, Delivery::queued(10),
                           [this](const MapRequest&) {
                             repeater_.ask(mapping_.local_maps().size());
                             graph_due_ = true;
                           });
  bus.every(kRepeatPeriodUs, [this](std::int64_t) { repeat(); });
}

void MappingNode::restore(const std::string& journal) {
  journal_.emplace(journal);
  restored_ = mapping_.restore(journal_->take_restored());
  if (restored_) keep([&] { journal_->append(*restored_); });
  graph_due_ = true;
}

void MappingNode::on_match(const ScanMatch& match) {
  const auto found = waiting_.find(match.channel);
  if (found == waiting_.end()) return;
  auto& waiting = found->second;
  while (!waiting.empty() && waiting.front().utime < match.utime) waiting.pop_front();
  if (waiting.empty() || waiting.front().utime != match.utime) return;
  const LaserScan scan = std::move(waiting.front());
  waiting.pop_front();
  const bool knew = mapping_.correction().has_value();
  if (const auto update = mapping_.add(match.channel, scan, match)) {
    pass_on(*update);
  } else if (!knew && mapping_.correction()) {
    publish_graph();
  }
  if (journal_) keep_unfinished();
}

/// Each 0.3 m or half a radian of the way; and where the way begins, since that is home. The first
/// local map of a session is over before that, and how it hangs on the map is not known yet.
void MappingNode::keep_unfinished() {
  const LocalMap& map = mapping_.unfinished();
  const auto& maps = mapping_.local_maps();
  if (map.scans.empty() || (!maps.empty() && maps.back().session != map.session)) return;
  if (const bool replaces = kept_map_ == kReplaced; map.id != kept_map_) {
    kept_map_ = map.id;
    T_local_kept_ = {};
    start_is_due_ = maps.empty() || replaces;
  }
  const Pose2& T_local_body = map.scans.back().T_local_body;
  const Pose2 moved = between(T_local_kept_, T_local_body);
  const bool moved_on =
      moved.translation().norm() >= params_.keep_m || std::abs(moved.theta) >= params_.lost_rad;
  if (!moved_on && !(start_is_due_ && map.scans.size() > 1)) return;
  start_is_due_ = false;
  T_local_kept_ = T_local_body;
  keep([&] { journal_->append_unfinished(map); });
}

void MappingNode::keep(const std::function<void()>& append) {
  health_ = {};
  try {
    append();
  } catch (const std::exception& failure) {
    health_ = {Health::Level::kDegraded, failure.what()};
  }
}

/// To the disk first: what was announced is not forgotten. What is not kept leaves the graph as it
/// was; where the body is goes to the disk with what is made next.
void MappingNode::pass_on(const MapUpdate& update) {
  if (!update.kept) {
    kept_map_ = kReplaced;
    publish_correction();
    return;
  }
  if (journal_) keep([&] { journal_->append(update); });
  publish_update(update);
}

void MappingNode::publish_update(const MapUpdate& update) {
  for (const LocalMapPiece& piece : divide(update.map)) {
    publish(bus_, channels::kLocalMap, to_message(piece));
  }
  for (const Association& association : update.associations) {
    publish(bus_, channels::kAssociation, to_message(association));
  }
  publish_graph();
}

/// Never more at once than the queues of those who asked can hold.
void MappingNode::repeat() {
  if (restored_) publish_update(*std::exchange(restored_, std::nullopt));
  if (graph_due_) publish_graph();
  const std::vector<LocalMap>& maps = mapping_.local_maps();
  for (std::size_t sent = 0; sent < kRepeatPieces; ++sent) {
    if (repeated_.empty()) {
      const auto next = repeater_.next(maps.size());
      if (!next) return;
      for (LocalMapPiece& piece : divide(maps[*next])) repeated_.push_back(std::move(piece));
    }
    publish(bus_, channels::kLocalMap, to_message(repeated_.front()));
    repeated_.pop_front();
    graph_due_ = repeated_.empty() && repeater_.done();
  }
}

void MappingNode::publish_graph() {
  graph_due_ = false;
  if (mapping_.local_maps().empty()) return;
  for (const PoseGraphPiece& piece : divide(mapping_.graph())) {
    publish(bus_, channels::kPoseGraph, to_message(piece));
  }
  publish_correction();
}

void MappingNode::publish_correction() {
  if (const auto correction = mapping_.correction()) {
    publish(bus_, channels::kMapCorrection, to_message(*correction));
  }
}

}  // namespace adit
