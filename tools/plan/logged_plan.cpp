// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/logged_plan.hpp"

#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/node/recorded_section.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/navigation.hpp"

namespace adit {
namespace {

constexpr const char* kStage = "planning";

/// The message of an event, if it is on this channel and valid.
template <class Message>
auto message_of(const LogEventView& event, std::string_view channel) {
  using Value = std::remove_cvref_t<decltype(*from_message(Message{}))>;
  std::optional<Value> value;
  if (event.channel != channel) return value;
  const auto message = decode<Message>(event.data);
  if (!message) return value;
  if (auto valid = from_message(*message)) value = std::move(*valid);
  return value;
}

/// Follows a log up to a goal and its answer.
class LogFollower {
 public:
  explicit LogFollower(int goal) : goal_(goal) {}

  void add(const LogEventView& event) {
    if (const auto tile = message_of<terrain_t>(event, channels::kTerrain)) {
      if (auto terrain = assembler_.add(*tile)) terrain_ = std::move(terrain);
    } else if (const auto fragment = message_of<cloud_t>(event, channels::kCloud)) {
      if (auto cloud = clouds_.add(*fragment)) cloud_ = std::move(*cloud);
    } else if (const auto pose = message_of<pose_t>(event, channels::kPose)) {
      T_odom_body_ = pose->T_odom_body;
    } else if (const auto config = message_of<config_t>(event, channels::kConfig)) {
      if (config->stage == kStage && !found_) config_ = *config;
    } else if (const auto goal = message_of<plan_goal_t>(event, channels::kGoal)) {
      if (goal->id == goal_ && !found_) begin(*goal);
    } else if (auto path = message_of<planned_path_t>(event, channels::kPath)) {
      if (path->id == goal_ && found_) found_->path = std::move(*path);
    }
  }
  [[nodiscard]] bool is_complete() const { return found_ && found_->path; }
  [[nodiscard]] std::optional<LoggedPlan>& found() { return found_; }

 private:
  void begin(const PlanGoal& goal) {
    if (goal.kind == PlanGoal::Kind::kRetrace) {
      throw std::runtime_error(
          fmt::format("goal {} retraces the traversed path, without a plan on terrain", goal_));
    }
    if (!terrain_ || !T_odom_body_) {
      throw std::runtime_error(
          fmt::format("no {} before goal {}", terrain_ ? "pose" : "complete terrain map", goal_));
    }
    found_ = LoggedPlan{*terrain_, goal, *T_odom_body_, {}, {}, {}, {}};
    if (cloud_.id == terrain_->id) found_->cloud = cloud_;
    if (config_)
      found_->params = recorded_section<PlanningParams>(*config_, kStage, found_->warnings);
  }

  int goal_;
  TerrainReassembler assembler_;
  std::optional<TerrainMap> terrain_;
  CloudReassembler clouds_;
  Cloud cloud_;
  std::optional<Pose2> T_odom_body_;
  std::optional<ConfigSnapshot> config_;
  std::optional<LoggedPlan> found_;
};

}  // namespace

LoggedPlan logged_plan(const std::filesystem::path& file, int goal) {
  LogFollower follower(goal);
  try {
    LogReader log(file);
    for (auto event = log.next(); event && !follower.is_complete(); event = log.next())
      follower.add(*event);
    if (!follower.found()) throw std::runtime_error(fmt::format("no goal {} on GOAL", goal));
    if (const auto corrupt = log.health().corrupt_bytes; corrupt > 0)
      follower.found()->warnings.push_back(fmt::format("skipped {} corrupt bytes", corrupt));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
  return std::move(*follower.found());
}

}  // namespace adit
