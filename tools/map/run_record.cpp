// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 1000;
constexpr double kTailStepM = 0.1;  // as for the scans of a local map
constexpr double kTailStepRad = 0.1;

/// Kind of a segment.
struct Kind {
  bool lost;
  bool filled;
  friend bool operator==(const Kind&, const Kind&) = default;
};

/// Nothing for a scan that observed all motion.
std::optional<Kind> kind_of(const ScanMatch& match) {
  if (match.status == ScanMatch::Status::kLost) return Kind{true, false};
  if (match.degenerate.empty()) return std::nullopt;
  const bool filled =
      std::none_of(match.degenerate.begin(), match.degenerate.end(),
                   [](const auto& d) { return d.fill == DegenerateDirection::Fill::kNone; });
  return Kind{false, filled};
}

}  // namespace

void MapSubscription::subscribe(Bus& bus, Handlers handlers) {
  handlers_ = std::move(handlers);
  const Delivery all = Delivery::queued(kQueued);
  adit::subscribe<local_map_t>(bus, channels::kLocalMap, all,
                               [this](const LocalMapFragment& fragment) {
                                 if (auto map = local_map_fragments_.add(fragment))
                                   handlers_.on_local_map(std::move(*map));
                               });
  adit::subscribe<pose_graph_t>(bus, channels::kPoseGraph, all,
                                [this](const PoseGraphFragment& fragment) {
                                  if (auto graph = graph_fragments_.add(fragment))
                                    handlers_.on_graph(std::move(*graph));
                                });
  adit::subscribe<association_t>(
      bus, channels::kAssociation, all,
      [this](const Association& association) { handlers_.on_association(association); });
}

RunRecord::RunRecord(Bus& bus) {
  subscribe_laser(bus, channels::kLaserFront);
  subscribe_laser(bus, channels::kLaserRear);
  subscribe<scan_match_t>(bus, channels::kScanMatch, Delivery::queued(kQueued),
                          [this](const ScanMatch& match) { on_match(match); });
  map_subscription_.subscribe(
      bus, {.on_local_map = [this](LocalMap map) { on_local_map(std::move(map)); },
            .on_graph = [this](MapGraph graph) { graph_ = std::move(graph); },
            .on_association = [this](const Association& a) { associations_.push_back(a); }});
}

void RunRecord::subscribe_laser(Bus& bus, std::string_view channel) {
  subscribe<planar_lidar_t>(
      bus, channel, Delivery::queued(kQueued),
      [this, name = std::string(channel)](const LaserScan& scan) { last_scan_[name] = scan; });
}

void RunRecord::on_match(const ScanMatch& match) {
  const auto scan = last_scan_.find(match.channel);
  const bool has_scan = scan != last_scan_.end() && scan->second.utime == match.utime;
  if (match.status == ScanMatch::Status::kRejected || !has_scan) {
    ++rejected_;
    return;
  }
  matches_.push_back(match);
  if (match.status != ScanMatch::Status::kLost && is_far_from_tail(match)) {
    tail_.push_back({scan->second, match});
  }
}

void RunRecord::on_local_map(LocalMap map) {
  std::erase_if(tail_, [&](const Entry& entry) { return entry.scan.utime <= map.end_utime; });
  local_maps_.push_back(std::move(map));
}

bool RunRecord::is_far_from_tail(const ScanMatch& match) const {
  const auto last = std::find_if(tail_.rbegin(), tail_.rend(), [&](const Entry& entry) {
    return entry.match.channel == match.channel;
  });
  if (last == tail_.rend()) return true;
  const Pose2 moved = between(last->match.T_odom_body, match.T_odom_body);
  return moved.translation().norm() >= kTailStepM || std::abs(moved.theta) >= kTailStepRad;
}

Trajectory RunRecord::odometry() const {
  Trajectory odometry;
  for (const ScanMatch& match : matches_) {
    // Of two lasers with the same time, the second match has the better pose.
    if (!odometry.empty() && odometry.back().utime == match.utime) odometry.pop_back();
    odometry.push_back({match.utime, match.T_odom_body, match.z_m});
  }
  return odometry;
}

bool is_unobserved(const ScanMatch& match) { return kind_of(match).has_value(); }

std::vector<RunRecord::Segment> RunRecord::segments() const {
  std::vector<Segment> segments;
  std::optional<Kind> current;
  for (const ScanMatch& match : matches_) {
    const auto kind = kind_of(match);
    if (kind && kind != current) {
      segments.push_back({match.reference_utime, match.utime, 0.0, 0, kind->lost, kind->filled});
    }
    current = kind;
    if (!kind) continue;
    segments.back().to_utime = match.utime;
    segments.back().length_m += match.T_reference_body.translation().norm();
    ++segments.back().scans;
  }
  return segments;
}

}  // namespace adit
