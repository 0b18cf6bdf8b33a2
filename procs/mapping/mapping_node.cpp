// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/mapping_node.hpp"

#include <exception>
#include <utility>

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

}  // namespace

MappingNode::MappingNode(Bus& bus, const Params& params) : bus_(bus), mapping_(params) {
  if (!params.journal.empty()) {
    journal_.emplace(params.journal);
    mapping_.restore(journal_->take_restored());
    graph_due_ = true;
  }
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

void MappingNode::on_match(const ScanMatch& match) {
  auto& waiting = waiting_[match.channel];
  while (!waiting.empty() && waiting.front().utime < match.utime) waiting.pop_front();
  if (waiting.empty() || waiting.front().utime != match.utime) return;
  const LaserScan scan = std::move(waiting.front());
  waiting.pop_front();
  if (const auto update = mapping_.add(match.channel, scan, match)) pass_on(*update);
}

/// To the disk first: what was announced is not forgotten.
void MappingNode::pass_on(const MapUpdate& update) {
  health_ = {};
  if (journal_) {
    try {
      journal_->append(update);
    } catch (const std::exception& failure) {
      health_ = {Health::Level::kDegraded, failure.what()};
    }
  }
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
  if (graph_due_) publish_graph();
  if (repeater_.done()) return;
  for (const LocalMapPiece& piece : repeater_.next(mapping_.local_maps(), kRepeatPieces)) {
    publish(bus_, channels::kLocalMap, to_message(piece));
  }
  graph_due_ = repeater_.done();
}

void MappingNode::publish_graph() {
  graph_due_ = false;
  if (mapping_.local_maps().empty()) return;
  for (const PoseGraphPiece& piece : divide(mapping_.graph())) {
    publish(bus_, channels::kPoseGraph, to_message(piece));
  }
  if (const auto correction = mapping_.correction()) {
    publish(bus_, channels::kMapCorrection, to_message(*correction));
  }
}

}  // namespace adit
