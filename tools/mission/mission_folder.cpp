// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_folder.hpp"

#include <optional>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "procs/mission/mission_journal.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

fs::path log_of_run(const fs::path& folder, int run_number) {
  return folder /
         (run_number == 1 ? "run.lcmlog" : "run_" + std::to_string(run_number) + ".lcmlog");
}

std::optional<SimulatedPose> truth_pose_in(const LogEventView& event) {
  if (event.channel != channels::kTruth) return std::nullopt;
  const auto message = decode<pose_t>(event.data);
  if (!message) return std::nullopt;
  const auto pose = from_message(*message);  // TRUTH: T_world_body
  if (!pose) return std::nullopt;
  return SimulatedPose{pose->utime, pose->T_odom_body};
}

std::optional<SimulatedPose> last_truth_pose_in(const fs::path& log) {
  if (fs::file_size(log) == 0) return std::nullopt;
  const LogFile file(log);
  const auto events = file.events();
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    if (const auto pose = truth_pose_in(*event)) return pose;
  }
  return std::nullopt;
}

}  // namespace

MissionFolder::MissionFolder(const fs::path& path) {
  fs::create_directories(path);
  path_ = fs::canonical(path);
}

std::vector<fs::path> MissionFolder::logs() const {
  std::vector<fs::path> found;
  for (int run_number = 1; fs::exists(log_of_run(path_, run_number)); ++run_number) {
    found.push_back(log_of_run(path_, run_number));
  }
  return found;
}

fs::path MissionFolder::next_log() const {
  return log_of_run(path_, static_cast<int>(logs().size()) + 1);
}

bool MissionFolder::has_mission() const { return fs::exists(journal()) || !logs().empty(); }

void MissionFolder::require_new() const {
  if (!has_mission()) return;
  throw std::runtime_error(
      path_.string() + " already has a mission: resume it with --resume, or use another folder");
}

void MissionFolder::require_unfinished() const {
  if (!has_mission() || !fs::exists(world()) || !fs::exists(config())) {
    throw std::runtime_error(path_.string() + " has no mission to resume");
  }
  if (!fs::exists(journal())) return;  // power loss before the first phase
  const MissionJournal journal(this->journal());
  if (journal.last() && journal.last()->phase == Phase::kEnded) {
    throw std::runtime_error("the mission in " + path_.string() +
                             " has ended: " + journal.last()->reason);
  }
}

SimulatedPose MissionFolder::last_pose() const {
  const std::vector<fs::path> logs = this->logs();
  for (auto log = logs.rbegin(); log != logs.rend(); ++log) {
    if (const auto pose = last_truth_pose_in(*log)) return *pose;
  }
  throw std::runtime_error(path_.string() +
                           ": no log has TRUTH, the pose to resume from is unknown");
}

}  // namespace adit
