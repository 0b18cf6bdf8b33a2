// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 1000;
constexpr double kTailStepM = 0.1;  // as for the scans of a local map
constexpr double kTailStepRad = 0.1;

}  // namespace

RunRecord::RunRecord(Bus& bus, const std::filesystem::path& scratch)
    : odometry_(scratch), unobserved_(scratch), doubts_(scratch), local_maps_(scratch) {
  subscribe_laser(bus, channels::kLaserFront);
  subscribe_laser(bus, channels::kLaserRear);
  subscribe<scan_match_t>(bus, channels::kScanMatch, Delivery::queued(kQueued),
                          [this](const ScanMatch& match) { on_match(match); });
  subscribe<match_doubt_t>(
      bus, channels::kMatchDoubt, Delivery::queued(kQueued), [this](const MatchDoubt& doubt) {
        doubts_.push_back({doubt.utime, doubt.from_utime, doubt.reason,
                           static_cast<std::uint32_t>(doubt.alternatives.size())});
      });
  map_subscription_.subscribe(
      bus, {.on_local_map = [this](LocalMap map) { on_local_map(std::move(map)); },
            .on_graph = [this](MapGraph graph) { graph_ = std::move(graph); },
            .on_association = [this](const Association& a) { associations_.push_back(a); },
            .on_contradictions =
                [this](MapContradictions found) { contradictions_ = std::move(found.pairs); }});
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
    ++counts_.rejected;
    return;
  }
  ++counts_.with_pose;
  counts_.matched += match.status == ScanMatch::Status::kMatched ? 1U : 0U;
  counts_.lost += match.status == ScanMatch::Status::kLost ? 1U : 0U;
  counts_.searched += match.searched ? 1U : 0U;
  counts_.degenerate += match.degenerate.empty() ? 0U : 1U;
  add_pose(match);
  segments_.add(match);
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

void RunRecord::add_pose(const ScanMatch& match) {
  bool unobserved = is_unobserved(match);
  // Of two lasers with the same time, the second match has the better pose.
  if (!odometry_.empty() && odometry_.back().utime == match.utime) {
    unobserved = unobserved || unobserved_.back() != 0;
    odometry_.pop_back();
    unobserved_.pop_back();
  }
  odometry_.push_back({match.utime, match.T_odom_body, match.z_m});
  unobserved_.push_back(unobserved ? 1 : 0);
}

}  // namespace adit
