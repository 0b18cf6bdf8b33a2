// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/history_layer.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/seconds.hpp"
#include "viewer/scene/json_text.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

using nlohmann::json;

constexpr std::int64_t kRowPeriodUs = 1'000'000;
constexpr double kMovedM = 0.1;  // what a person sees on the map
constexpr double kUnknownValue = std::numeric_limits<double>::quiet_NaN();  // null in JSON

}  // namespace

HistoryLayer::HistoryLayer(TopicBoard& board, const MapFrame& frame, const MissionLayer& mission)
    : board_(board), frame_(frame), mission_(mission) {
  topic_ = board.add(json_topic("/history", "adit.History"));
}

void HistoryLayer::add_pose(const StampedPose& pose) {
  if (!chunks_.empty() && pose.utime < chunks_.back().rows.back().utime + kRowPeriodUs) return;
  if (chunks_.empty() || chunks_.back().rows.size() >= kRowsPerChunk) {
    chunks_.push_back({.number = chunks_.empty() ? 0 : chunks_.back().number + 1});
    if (chunks_.size() > kChunksMax) chunks_.pop_front();
  }
  Row row{.utime = pose.utime,
          .T_body = frame_.anchored({pose.T_odom_body, pose.z_m}),
          .speed_m_s = kUnknownValue,
          .battery_share = kUnknownValue,
          .position_sd_m = kUnknownValue,
          .methane_share = kUnknownValue};
  if (const auto& vehicle = mission_.vehicle()) {
    row.speed_m_s = vehicle->speed_m_s;
    row.battery_share = vehicle->battery_share;
  }
  if (const auto& correction = frame_.correction())
    row.position_sd_m = position_sd_m(correction->body_covariance);
  if (const auto& gas = mission_.gas()) row.methane_share = gas->methane_share;
  if (const auto& phase = mission_.phase()) row.phase = phase->phase;
  chunks_.back().rows.push_back(row);
  send(chunks_.back());
}

void HistoryLayer::update_poses() {
  for (Chunk& chunk : chunks_) {
    const LevelPose T_map_body = frame_.T_map(chunk.rows.back().T_body);
    if ((T_map_body.translation() - chunk.T_map_sent.translation()).norm() > kMovedM) send(chunk);
  }
}

void HistoryLayer::send(Chunk& chunk) {
  json rows = json::array();
  for (const Row& row : chunk.rows) {
    chunk.T_map_sent = frame_.T_map(row.T_body);
    const Pose2& plan = chunk.T_map_sent.plan;
    rows.push_back({seconds(row.utime), plan.x, plan.y, chunk.T_map_sent.z_m, plan.theta,
                    row.speed_m_s, row.battery_share, row.position_sd_m, row.methane_share,
                    name_of(row.phase)});
  }
  board_.append(topic_, chunk.rows.back().utime, json_text({{"rows", std::move(rows)}}),
                fmt::format("rows {}", chunk.number));
}

}  // namespace adit
